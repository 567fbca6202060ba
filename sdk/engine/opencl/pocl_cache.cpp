// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/pocl_cache.h"

#include <cstdint>
#include <set>
#include <sstream>
#include <string>

#include "opencl/cache_folder.h"

namespace gigaray::opencl {
namespace fs = std::filesystem;
namespace {

fs::path record_file(const fs::path& folder) { return folder.string() + ".sizes"; }

/// The folder of the program that a file belongs to: the first two names of its path, as PoCL
/// splits its hashes.
fs::path program_of(const fs::path& relative) {
  auto name = relative.begin();
  fs::path program = *name++;
  if (name != relative.end()) program /= *name;
  return program;
}

}  // namespace

void remove_damaged_pocl_programs(const fs::path& folder) {
  const auto record = read_file(record_file(folder));
  if (!record) return;
  std::istringstream lines(*record);
  std::set<fs::path> damaged;
  std::uintmax_t size = 0;
  for (std::string name; lines >> size && std::getline(lines >> std::ws, name);) {
    std::error_code error;
    const auto now = fs::file_size(folder / name, error);
    if (error || now != size) damaged.insert(program_of(name));
  }
  for (const fs::path& program : damaged) {
    std::error_code ignored;
    fs::remove_all(folder / program, ignored);
  }
}

void record_pocl_programs(const fs::path& folder) {
  std::ostringstream lines;
  std::error_code error;
  // Another process may add and remove files meanwhile: what vanishes is not recorded.
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    std::error_code vanished;
    if (!it->is_regular_file(vanished)) continue;
    const fs::path relative = it->path().lexically_relative(folder);
    // PoCL touches a file at each use and makes temporary ones.
    if (relative.extension() != ".so" && relative.extension() != ".bc") continue;
    if (const auto size = it->file_size(vanished); !vanished)
      lines << size << ' ' << relative.string() << '\n';
  }
  write_file_atomically(record_file(folder), lines.str());
}

}  // namespace gigaray::opencl
