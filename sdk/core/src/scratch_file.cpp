// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/scratch_file.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

#include "gigaray/core/error.h"

namespace gigaray {
namespace {

[[noreturn]] void fail(const std::string& folder, const std::string& what) {
  throw Error(ErrorCode::kIo, folder + ": " + what + " intermediate data: " + std::strerror(errno));
}

/// Calls step(done) for what is left until all bytes are done; as pread and pwrite return.
template <class Step>
bool do_all(std::size_t bytes, Step step) {
  for (std::size_t done = 0; done < bytes;) {
    const ssize_t n = step(done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    done += std::size_t(n);
  }
  return true;
}

}  // namespace

std::string temporary_folder(const std::string& advice) {
  std::error_code error;
  const auto folder = std::filesystem::temp_directory_path(error);
  if (!error) return folder.string();
  const char* stated = std::getenv("TMPDIR");
  throw Error(ErrorCode::kIo, "TMPDIR: " + std::string(stated ? stated : "the system's /tmp") +
                                  " is no folder for temporary files; set TMPDIR to one" + advice);
}

ScratchFile::ScratchFile(std::string folder) : folder_(std::move(folder)) {
  std::string name = folder_ + "/gigaray-XXXXXX";
  file_ = mkstemp(name.data());
  if (file_ < 0) fail(folder_, "can't make a file for");
  unlink(name.c_str());
}

ScratchFile::ScratchFile(ScratchFile&& other) noexcept { *this = std::move(other); }

ScratchFile& ScratchFile::operator=(ScratchFile&& other) noexcept {
  std::swap(folder_, other.folder_);
  std::swap(file_, other.file_);
  return *this;
}

ScratchFile::~ScratchFile() {
  if (file_ >= 0) close(file_);
}

void ScratchFile::reserve(std::uint64_t bytes) {
  // Beyond RLIMIT_FSIZE a signal would end the process.
  rlimit limit{};
  const bool is_limited = getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  errno = is_limited && bytes > limit.rlim_cur ? EFBIG : posix_fallocate(file_, 0, off_t(bytes));
  if (errno != 0) fail(folder_, "no room for " + std::to_string(bytes >> 20) + " MiB of");
}

void ScratchFile::read(std::uint64_t offset, std::size_t bytes, void* out) const {
  const auto step = [&](std::size_t done) {
    return pread(file_, static_cast<char*>(out) + done, bytes - done, off_t(offset + done));
  };
  if (!do_all(bytes, step)) fail(folder_, "can't read");
}

void ScratchFile::write(std::uint64_t offset, std::size_t bytes, const void* in) {
  const auto step = [&](std::size_t done) {
    return pwrite(file_, static_cast<const char*>(in) + done, bytes - done, off_t(offset + done));
  };
  if (!do_all(bytes, step)) fail(folder_, "can't write");
}

}  // namespace gigaray
