// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/memory_limit.h"

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

/// A kind of control groups: where they are, and what their files are called.
struct GroupKind {
  fs::path mount;
  std::vector<const char*> limits;
  const char* usage;
  std::vector<const char*> cached;  ///< keys of memory.stat, of the group and those in it
};

double left_by_group(const fs::path& group, const GroupKind& kind) {
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

/// The least that a group and those around it leave. In a container the path can be that of the
/// machine, of which only the root is to be seen: folders that are missing are passed over.
double left_by_groups(const std::string& path, const GroupKind& kind) {
  double left = left_by_group(kind.mount, kind);
  fs::path group = kind.mount;
  for (const fs::path& name : fs::path(path).relative_path()) {
    if (name == "..") break;  // a group beside the root of this name space
    group /= name;
    left = std::min(left, left_by_group(group, kind));
  }
  return left;
}

double left_by_machine(const fs::path& root) {
  const auto table = read_table(root / "proc/meminfo");
  const auto available = table.find("MemAvailable:");
  return available == table.end() ? kUnlimited : available->second * 1024;
}

/// Is a controller in the list "cpu,memory"?
bool names_memory(const std::string& controllers) {
  return ("," + controllers + ",").find(",memory,") != std::string::npos;
}

}  // namespace

double memory_left_by_system(const fs::path& root) {
  const fs::path groups = root / "sys/fs/cgroup";
  const GroupKind version_1{groups / "memory",
                            {"memory.limit_in_bytes"},
                            "memory.usage_in_bytes",
                            {"total_inactive_file", "total_active_file"}};
  GroupKind version_2{
      groups, {"memory.max", "memory.high"}, "memory.current", {"inactive_file", "active_file"}};
  std::error_code ignored;
  if (fs::is_directory(groups / "unified", ignored)) version_2.mount = groups / "unified";

  double left = left_by_machine(root);
  std::ifstream own(root / "proc/self/cgroup");
  for (std::string line; std::getline(own, line);) {
    // NUMBER:CONTROLLERS:PATH; a path may have colons.
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const std::string path = line.substr(second + 1);
    if (controllers.empty())
      left = std::min(left, left_by_groups(path, version_2));
    else if (names_memory(controllers))
      left = std::min(left, left_by_groups(path, version_1));
  }
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
