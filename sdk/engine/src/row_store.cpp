// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "row_store.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

#include "gigaray/error.h"

namespace gigaray {
namespace {

[[noreturn]] void fail(const std::string& folder, const char* what) {
  throw Error(ErrorCode::kIo, folder + ": " + what + " intermediate data: " + std::strerror(errno));
}

}  // namespace

void AlignedBytes::Free::operator()(std::byte* p) const { std::free(p); }

AlignedBytes::AlignedBytes(std::size_t size) { at_least(size); }

void AlignedBytes::at_least(std::size_t size) {
  if (size <= size_) return;
  data_.reset();
  size_ = (size + 63) / 64 * 64;
  data_.reset(static_cast<std::byte*>(std::aligned_alloc(64, size_)));
  if (!data_) throw std::bad_alloc();
}

RowStore::RowStore(int rows, std::size_t row_bytes, const std::string& folder)
    : folder_(folder), rows_(rows), row_bytes_(row_bytes) {
  const std::size_t bytes = std::size_t(rows) * row_bytes;
  if (folder.empty()) {
    memory_.at_least(bytes);
    std::memset(memory_.data(), 0, bytes);
    return;
  }
  std::string name = folder + "/gigaray-XXXXXX";
  file_ = mkstemp(name.data());
  if (file_ < 0) fail(folder_, "can't make a file for");
  unlink(name.c_str());
  // Space is taken now, so that a full disk shows before the work and not in the middle of it.
  if (const int error = posix_fallocate(file_, 0, off_t(bytes)); error != 0) {
    errno = error;
    close_file();
    fail(folder_, ("no room for " + std::to_string(bytes >> 20) + " MiB of").c_str());
  }
}

RowStore::RowStore(RowStore&& other) noexcept { *this = std::move(other); }

RowStore& RowStore::operator=(RowStore&& other) noexcept {
  std::swap(folder_, other.folder_);
  std::swap(rows_, other.rows_);
  std::swap(row_bytes_, other.row_bytes_);
  std::swap(memory_, other.memory_);
  std::swap(file_, other.file_);
  return *this;
}

RowStore::~RowStore() { close_file(); }

void RowStore::close_file() {
  if (file_ >= 0) ::close(file_);
  file_ = -1;
}

void RowStore::read(int row, std::size_t offset, std::size_t bytes, void* out) const {
  const std::size_t begin = std::size_t(row) * row_bytes_ + offset;
  if (file_ < 0) {
    std::memcpy(out, memory_.data() + begin, bytes);
    return;
  }
  for (std::size_t done = 0; done < bytes;) {
    const ssize_t n =
        pread(file_, static_cast<char*>(out) + done, bytes - done, off_t(begin + done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail(folder_, "can't read");
    done += std::size_t(n);
  }
}

void RowStore::write(int row, std::size_t offset, std::size_t bytes, const void* in) {
  const std::size_t begin = std::size_t(row) * row_bytes_ + offset;
  if (file_ < 0) {
    std::memcpy(memory_.data() + begin, in, bytes);
    return;
  }
  for (std::size_t done = 0; done < bytes;) {
    const ssize_t n =
        pwrite(file_, static_cast<const char*>(in) + done, bytes - done, off_t(begin + done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail(folder_, "can't write");
    done += std::size_t(n);
  }
}

std::byte* RowStore::open(RowRange rows, AlignedBytes& scratch) const {
  if (file_ < 0)
    return const_cast<std::byte*>(memory_.data()) + std::size_t(rows.begin) * row_bytes_;
  const std::size_t bytes = std::size_t(rows.size()) * row_bytes_;
  scratch.at_least(bytes);
  read(rows.begin, 0, bytes, scratch.data());
  return scratch.data();
}

void RowStore::close(RowRange rows, const std::byte* opened) {
  if (file_ >= 0) write(rows.begin, 0, std::size_t(rows.size()) * row_bytes_, opened);
}

}  // namespace gigaray
