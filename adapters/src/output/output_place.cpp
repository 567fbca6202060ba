// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "output/output_place.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "gigaray/core/error.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& named, const std::string& why) {
  throw Error(ErrorCode::kInvalidArgument, named.string() + ": " + why);
}

std::error_code last_error() { return {errno, std::generic_category()}; }

/// Is `path` `folder` or in it? Both as output_place() gives them.
bool is_within(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first ==
         folder.end();
}

fs::path real_path(const fs::path& path) {
  std::error_code error;
  fs::path real = fs::weakly_canonical(fs::absolute(path, error), error);
  if (error) return {};
  return real.has_filename() ? real : real.parent_path();
}

bool is_mount_point(const fs::path& place) {
#ifdef STATX_ATTR_MOUNT_ROOT
  struct statx status = {};
  return statx(AT_FDCWD, place.c_str(), AT_SYMLINK_NOFOLLOW, STATX_BASIC_STATS, &status) == 0 &&
         (status.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
#else
  struct stat status = {}, above = {};
  return lstat(place.c_str(), &status) == 0 && lstat(place.parent_path().c_str(), &above) == 0 &&
         status.st_dev != above.st_dev;
#endif
}

}  // namespace

void cannot_write(const fs::path& path, const std::error_code& why) {
  throw Error(ErrorCode::kIo, path.string() + ": can't be written (" + why.message() + ")");
}

fs::path output_place(const fs::path& path) {
  if (path.empty()) throw Error(ErrorCode::kInvalidArgument, "the name of the output is empty");
  std::error_code error;
  fs::path place = fs::weakly_canonical(fs::absolute(path), error);
  if (error) cannot_write(path, error);
  if (!place.has_filename()) place = place.parent_path();
  const fs::file_status status = fs::symlink_status(place, error);
  if (status.type() == fs::file_type::none) cannot_write(path, error);
  if (fs::is_symlink(status)) refuse(path, "is a link that leads nowhere");
  return place;
}

void check_folder_place(const fs::path& place, const fs::path& named, const OutputRules& rules) {
  std::error_code error;
  if (const fs::path here = fs::current_path(error); !error && is_within(here, place))
    refuse(named, "is the folder you are in, or above it; name a folder in it or beside it");
  if (is_mount_point(place))
    refuse(named,
           "is a place where a file system is mounted and can't be put in place as a "
           "whole; name a folder in it");
  for (const fs::path& input : rules.inputs) {
    const fs::path real = real_path(input);
    if (real.empty()) continue;
    if (place == real) refuse(named, "is what is read too; name another folder");
    if (is_within(real, place))
      refuse(named, "holds " + input.string() + ", which is read; name another folder");
    if (is_within(place, real))
      refuse(named,
             "lies in " + input.string() + ", which is read; name a folder that isn't in it");
  }
}

void check_file_place(const fs::path& place, const fs::path& named, const OutputRules& rules) {
  std::error_code error;
  if (fs::is_directory(place, error)) refuse(named, "is a folder; name a file");
  for (const fs::path& input : rules.inputs)
    if (place == real_path(input)) refuse(named, "is what is read too; name another file");
}

fs::path free_old_name(const fs::path& place) {
  for (int i = 1;; ++i) {
    fs::path old = place;
    old += ".old-" + std::to_string(i);
    std::error_code error;
    if (!fs::exists(fs::symlink_status(old, error))) return old;
  }
}

void rename_to_free(const fs::path& from, const fs::path& to) {
  if (renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return;
  if (errno != EINVAL && errno != ENOSYS) cannot_write(to, last_error());
  std::error_code error;
  if (fs::exists(fs::symlink_status(to, error)))
    cannot_write(to, std::make_error_code(std::errc::file_exists));
  fs::rename(from, to, error);
  if (error) cannot_write(to, error);
}

bool exchange_names(const fs::path& a, const fs::path& b) {
  if (renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0) return true;
  if (errno != EINVAL && errno != ENOSYS) cannot_write(b, last_error());
  return false;
}

void sync_names(const fs::path& folder) {
  const int file = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file < 0) return;
  fsync(file);
  close(file);
}

}  // namespace gigaray
