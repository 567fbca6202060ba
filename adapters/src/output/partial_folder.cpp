// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "output/partial_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <fstream>
#include <random>
#include <string_view>
#include <system_error>
#include <vector>

#include "gigaray/core/error.h"
#include "output/output_manifest.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

/// In place of the manifest until the folder is complete.
constexpr const char* kMark =
    "{\"format\": \"gigaray output\", \"version\": 1, \"partial\": true}\n";
/// So that the whole name is none that is too long.
constexpr std::size_t kMostOfName = 200;
constexpr std::size_t kRandom = 6;

/// NAME of a partial folder; empty: its name was cut.
std::string name_of(const fs::path& path) {
  std::string name = path.filename().native().substr(std::string(kPartialPrefix).size());
  if (name.size() <= kRandom + 1) return {};
  name.resize(name.size() - kRandom - 1);
  return name.size() < kMostOfName ? name : std::string();
}

/// A lock that nobody else has; closed again at the end.
class Lock {
 public:
  explicit Lock(const fs::path& path)
      : file_(open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK)) {
    is_held_ = file_ >= 0 && flock(file_, LOCK_EX | LOCK_NB) == 0;
  }
  ~Lock() {
    if (file_ >= 0) close(file_);
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

  bool is_held() const { return is_held_; }

 private:
  int file_;
  bool is_held_ = false;
};

void tidy_folder(const fs::path& path) {
  std::error_code error;
  if (const auto manifest = OutputManifest::read(path)) {
    const std::string name = name_of(path);
    const fs::path place = path.parent_path() / name;
    if (!name.empty() && !fs::exists(fs::symlink_status(place, error)))
      fs::rename(path, place, error);
    else
      manifest->remove(path);
  } else if (fs::is_regular_file(fs::symlink_status(path / OutputManifest::kFileName, error))) {
    fs::remove_all(path, error);
  } else if (fs::is_empty(path, error) && !error) {
    // One without a mark is empty, and perhaps about to be locked.
    constexpr auto kLongAgo = std::chrono::minutes(1);
    const auto made = fs::last_write_time(path, error);
    if (!error && fs::file_time_type::clock::now() - made > kLongAgo) fs::remove(path, error);
  }
}

}  // namespace

fs::path partial_path(const fs::path& parent, const std::string& name) {
  constexpr std::string_view kLetters = "0123456789abcdefghijklmnopqrstuvwxyz";
  std::random_device random;
  std::string suffix;
  for (std::size_t i = 0; i < kRandom; ++i) suffix += kLetters[random() % kLetters.size()];
  return parent / (kPartialPrefix + name.substr(0, kMostOfName) + "-" + suffix);
}

void tidy_partials(const fs::path& parent) {
  std::vector<fs::path> partials;
  std::error_code error;
  for (fs::directory_iterator it(parent, error), end; !error && it != end; it.increment(error))
    if (it->path().filename().native().starts_with(kPartialPrefix)) partials.push_back(it->path());
  for (const fs::path& path : partials) {
    const fs::file_status status = fs::symlink_status(path, error);
    if (!fs::is_directory(status) && !fs::is_regular_file(status)) continue;
    const Lock lock(path);
    if (!lock.is_held()) continue;
    if (fs::is_directory(status))
      tidy_folder(path);
    else
      fs::remove(path, error);
  }
}

PartialFolder::PartialFolder(const fs::path& parent, const std::string& name) {
  const auto fail = [&](int error) {
    throw Error(ErrorCode::kIo, (parent / name).string() + ": can't be written (" +
                                    std::generic_category().message(error) + ")");
  };
  tidy_partials(parent);
  for (;;) {
    path_ = partial_path(parent, name);
    if (mkdir(path_.c_str(), 0777) == 0) break;
    if (errno != EEXIST) fail(errno);
  }
  // A file system without locks leaves it unlocked; then nobody else takes one either.
  lock_ = open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ >= 0) flock(lock_, LOCK_EX | LOCK_NB);
  std::ofstream mark(path_ / OutputManifest::kFileName);
  if (mark << kMark << std::flush) return;
  const int error = errno;
  remove();
  fail(error);
}

PartialFolder::~PartialFolder() { remove(); }

void PartialFolder::remove() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
  if (lock_ >= 0) close(lock_);
  path_.clear();
  lock_ = -1;
}

}  // namespace gigaray
