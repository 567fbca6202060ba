// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/pocl_cache.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdint>
#include <set>
#include <sstream>
#include <string>
#include <utility>

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

PoclCache::PoclCache(fs::path folder) : folder_(std::move(folder)) {
  lock_ = open((folder_.string() + ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (lock_ < 0) return;
  if (is_alone()) remove_damaged_programs();
  flock(lock_, LOCK_SH);
}

PoclCache::~PoclCache() {
  if (lock_ < 0) return;
  if (is_alone()) record_programs();
  close(lock_);
}

bool PoclCache::is_alone() const { return flock(lock_, LOCK_EX | LOCK_NB) == 0; }

void PoclCache::remove_damaged_programs() const {
  const auto record = read_file(record_file(folder_));
  if (!record) return;
  std::istringstream lines(*record);
  std::set<fs::path> damaged;
  std::uintmax_t size = 0;
  for (std::string name; lines >> size && std::getline(lines >> std::ws, name);) {
    std::error_code error;
    const auto now = fs::file_size(folder_ / name, error);
    if (error || now != size) damaged.insert(program_of(name));
  }
  for (const fs::path& program : damaged) {
    std::error_code ignored;
    fs::remove_all(folder_ / program, ignored);
  }
}

void PoclCache::record_programs() const {
  std::ostringstream lines;
  std::error_code error;
  // A user of the cache may remove files meanwhile: what vanishes is not recorded.
  for (fs::recursive_directory_iterator it(folder_, error), end; !error && it != end;
       it.increment(error)) {
    std::error_code vanished;
    if (!it->is_regular_file(vanished)) continue;
    const fs::path relative = it->path().lexically_relative(folder_);
    // PoCL touches a file at each use and makes temporary ones.
    if (relative.extension() != ".so" && relative.extension() != ".bc") continue;
    if (const auto size = it->file_size(vanished); !vanished)
      lines << size << ' ' << relative.string() << '\n';
  }
  write_file_atomically(record_file(folder_), lines.str());
}

}  // namespace gigaray::opencl
