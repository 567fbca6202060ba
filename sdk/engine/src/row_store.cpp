// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "row_store.h"

#include <cstdlib>
#include <cstring>
#include <new>

#include "gigaray/core/error.h"

namespace gigaray {

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
    : rows_(rows), row_bytes_(row_bytes) {
  const std::size_t bytes = std::size_t(rows) * row_bytes;
  if (folder.empty()) {
    memory_.at_least(bytes);
    std::memset(memory_.data(), 0, bytes);
    return;
  }
  file_ = ScratchFile(folder);
  file_.reserve(bytes);
}

void RowStore::read(int row, std::size_t offset, std::size_t bytes, void* out) const {
  const std::size_t begin = std::size_t(row) * row_bytes_ + offset;
  if (file_.is_open())
    file_.read(begin, bytes, out);
  else
    std::memcpy(out, memory_.data() + begin, bytes);
}

void RowStore::write(int row, std::size_t offset, std::size_t bytes, const void* in) {
  const std::size_t begin = std::size_t(row) * row_bytes_ + offset;
  if (file_.is_open())
    file_.write(begin, bytes, in);
  else
    std::memcpy(memory_.data() + begin, in, bytes);
}

std::span<std::byte> RowStore::bytes() {
  GIGARAY_CHECK(!file_.is_open());
  return {memory_.data(), std::size_t(rows_) * row_bytes_};
}

}  // namespace gigaray
