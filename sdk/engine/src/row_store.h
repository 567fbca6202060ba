// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "gigaray/core/scratch_file.h"

namespace gigaray {

/// 64-byte aligned memory, which OpenCL drivers of CPUs use without a copy.
class AlignedBytes {
 public:
  explicit AlignedBytes(std::size_t size = 0);
  std::byte* data() { return data_.get(); }
  const std::byte* data() const { return data_.get(); }
  std::size_t size() const { return size_; }
  void at_least(std::size_t size);  ///< Grows; the content is lost then.

 private:
  struct Free {
    void operator()(std::byte* p) const;
  };
  std::unique_ptr<std::byte, Free> data_;
  std::size_t size_ = 0;
};

/// Rows of equal size, in memory or in a file without a name, so that a band of rows is one
/// sequential read and nothing is left after a crash. Zero at first. Different rows may be used by
/// different threads. Errors of the file throw Error(kIo) naming the folder.
class RowStore {
 public:
  RowStore() = default;
  /// folder: where the file goes; empty keeps the rows in memory.
  RowStore(int rows, std::size_t row_bytes, const std::string& folder);

  bool empty() const { return rows_ == 0; }
  std::size_t row_bytes() const { return row_bytes_; }

  /// Bytes [offset, offset + bytes) of a row.
  void read(int row, std::size_t offset, std::size_t bytes, void* out) const;
  void write(int row, std::size_t offset, std::size_t bytes, const void* in);

  /// All rows in place. They are in memory.
  std::span<std::byte> bytes();

 private:
  int rows_ = 0;
  std::size_t row_bytes_ = 0;
  AlignedBytes memory_;
  ScratchFile file_;
};

}  // namespace gigaray
