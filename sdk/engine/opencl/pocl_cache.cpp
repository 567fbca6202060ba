// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/pocl_cache.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include "opencl/cache_folder.h"
#include "opencl/content_hash.h"
#include "opencl/ready_kernels.h"

namespace gigaray::opencl {
namespace fs = std::filesystem;
namespace {

constexpr const char* kHead = "gigaray pocl 1";

fs::path record_file(const fs::path& folder) { return folder.string() + ".record"; }

int open_lock(const fs::path& folder) {
  return open((folder.string() + ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
}

/// The folder of the program that a file belongs to: the first two names of its path, as PoCL
/// splits its hashes. Files elsewhere are what is left of one that was being made: they stand for
/// themselves.
fs::path program_of(const fs::path& relative) {
  auto name = relative.begin();
  fs::path program = *name++;
  if (name != relative.end()) program /= *name;
  return program;
}

/// PoCL touches a file of each program at every use; what it loads are these.
bool is_loaded(const fs::path& file) {
  return file.extension() == ".so" || file.extension() == ".bc";
}

/// Calls visit(relative path) for every file in the folder. What another process removes meanwhile
/// is left out.
template <class Visit>
void for_each_file(const fs::path& folder, Visit visit) {
  std::error_code error;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    std::error_code vanished;
    if (!it->is_directory(vanished)) visit(it->path().lexically_relative(folder));
  }
}

}  // namespace

PoclCache::PoclCache(fs::path folder) : folder_(std::move(folder)), lock_(open_lock(folder_)) {
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
  std::map<std::string, std::string> recorded;  // file -> hash
  std::istringstream lines(read_file(record_file(folder_)).value_or(""));
  if (std::string head; std::getline(lines, head) && head == kHead)
    for (std::string hash, name; lines >> hash && std::getline(lines >> std::ws, name);)
      recorded.emplace(name, hash);

  std::set<fs::path> damaged, left_over;  // PoCL itself leaves an empty file at every start
  for_each_file(folder_, [&](const fs::path& file) {
    const fs::path program = program_of(file);
    if (program == file) left_over.insert(file);
    if (!is_loaded(file) || damaged.contains(program)) return;
    const auto known = recorded.find(file.string());
    const auto content = read_file(folder_ / file);
    if (known == recorded.end() || !content || to_hex(content_hash(*content)) != known->second)
      damaged.insert(program);
    else
      recorded.erase(known);
  });
  for (const auto& [missing, hash] : recorded) damaged.insert(program_of(missing));
  if (!damaged.empty()) forget_ready_kernels(folder_.parent_path());
  damaged.merge(left_over);
  for (const fs::path& program : damaged) {
    std::error_code ignored;
    fs::remove_all(folder_ / program, ignored);
  }
}

void PoclCache::record_programs() const {
  // What was written to a full disk need not be whole.
  if (!why_no_room(folder_, kPoclRoom / 8).empty()) return;
  std::string text = std::string(kHead) + "\n";
  for_each_file(folder_, [&](const fs::path& file) {
    if (!is_loaded(file)) return;
    if (const auto content = read_file(folder_ / file))
      text += to_hex(content_hash(*content)) + " " + file.string() + "\n";
  });
  write_file_atomically(record_file(folder_), text);
}

PoclCacheAlone::PoclCacheAlone(const fs::path& folder) : lock_(open_lock(folder)) {
  is_in_use_ = lock_ >= 0 && flock(lock_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

PoclCacheAlone::~PoclCacheAlone() {
  if (lock_ >= 0) close(lock_);
}

}  // namespace gigaray::opencl
