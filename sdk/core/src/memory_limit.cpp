// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/memory_limit.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "control_groups.h"

namespace gigaray {
namespace fs = std::filesystem;
namespace {

/// Address space that libraries and threads map beyond what they use of it.
constexpr double kUnusedSpace = 300 * double(1 << 20);
constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// A count of bytes; nothing for "max" and for what is none.
std::optional<double> parse_bytes(const std::string& text) {
  std::uint64_t bytes = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, bytes);
  if (error != std::errc() || stop != end) return std::nullopt;
  return double(bytes);
}

std::optional<double> read_bytes(const fs::path& file) {
  std::string word;
  std::ifstream(file) >> word;
  return parse_bytes(word);
}

/// The numbers of a file with lines like "inactive_file 4096", or "MemAvailable: 12 kB".
std::map<std::string, double> read_table(const fs::path& file) {
  std::map<std::string, double> table;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream words(line);
    std::string key, number;
    words >> key >> number;
    if (const auto value = parse_bytes(number)) table[key] = *value;
  }
  return table;
}

double value_of(const std::map<std::string, double>& table, const char* key) {
  const auto found = table.find(key);
  return found == table.end() ? 0 : found->second;
}

/// What the files of a group are called.
struct GroupFiles {
  std::vector<const char*> limits;
  const char* usage;
  std::vector<const char*> cached;  ///< keys of memory.stat, of the group and those in it
};

const GroupFiles kVersion1{{"memory.limit_in_bytes"},
                           "memory.usage_in_bytes",
                           {"total_inactive_file", "total_active_file"}};
const GroupFiles kVersion2{
    {"memory.max", "memory.high"}, "memory.current", {"inactive_file", "active_file"}};

double left_by_group(const ControlGroup& of) {
  const fs::path& group = of.folder;
  const GroupFiles& kind = of.version == 1 ? kVersion1 : kVersion2;
  double limit = kUnlimited;
  for (const char* name : kind.limits)
    limit = std::min(limit, read_bytes(group / name).value_or(kUnlimited));
  const auto usage = read_bytes(group / kind.usage);
  if (std::isinf(limit) || !usage) return limit;
  const auto stat = read_table(group / "memory.stat");
  double cached = 0;
  for (const char* key : kind.cached) cached += value_of(stat, key);
  return std::max(0.0, limit - std::max(0.0, *usage - cached));
}

double left_by_machine(const fs::path& root) {
  const auto table = read_table(root / "proc/meminfo");
  const auto available = table.find("MemAvailable:");
  return available == table.end() ? kUnlimited : available->second * 1024;
}

}  // namespace

double memory_left_by_system(const fs::path& root) {
  double left = left_by_machine(root);
  for (const ControlGroup& group : control_groups(root, "memory"))
    left = std::min(left, left_by_group(group));
  return left;
}

double memory_left_by_limits(const fs::path& root) {
  // Pages: all that is mapped, …, the sixth what is data and stack.
  std::ifstream file(root / "proc/self/statm");
  double pages[6] = {};
  for (double& count : pages)
    if (!(file >> count)) count = 0;
  const double page = double(sysconf(_SC_PAGESIZE));
  const auto left_of = [&](int resource, double mapped) {
    rlimit limit{};
    if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kUnlimited;
    return std::max(0.0, double(limit.rlim_cur) - mapped * page);
  };
  return std::min(left_of(RLIMIT_AS, pages[0] + kUnusedSpace / page),
                  left_of(RLIMIT_DATA, pages[5]));
}

double available_memory() {
  const double left = std::min(memory_left_by_system("/"), memory_left_by_limits("/"));
  if (!std::isinf(left)) return left;
  return double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE)) / 2;
}

double default_memory_limit() { return 0.75 * available_memory(); }

}  // namespace gigaray
