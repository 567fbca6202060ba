// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstddef>
#include <memory>
#include <utility>

#include "strip_map.h"

namespace gigaray {

/// Memory of a workspace's device. The host reaches it through the workspace alone.
class Memory {
 public:
  explicit Memory(std::size_t bytes) : bytes_(bytes) {}
  virtual ~Memory() = default;
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  std::size_t bytes() const { return bytes_; }

 private:
  std::size_t bytes_;
};

/// Values of some rows of one view on a device, in the layout of StripMap. A handle: copies share
/// the memory.
template <class T>
class Map {
 public:
  Map() = default;
  Map(std::shared_ptr<Memory> memory, int width, RowRange rows)
      : memory_(std::move(memory)), width_(width), rows_(rows) {}

  explicit operator bool() const { return memory_ != nullptr; }
  int width() const { return width_; }
  RowRange rows() const { return rows_; }
  Memory& memory() const { return *memory_; }

 private:
  std::shared_ptr<Memory> memory_;
  int width_ = 0;
  RowRange rows_;
};

/// Rows of some views side by side on a device: [v - begin][stored view][…].
struct RowsOnDevice {
  std::shared_ptr<Memory> memory;
  int begin = 0;         ///< the row that the memory begins with
  int stored_views = 1;  ///< in a row

  explicit operator bool() const { return memory != nullptr; }
};

/// The rows of one view among them.
struct ViewRows {
  RowsOnDevice rows;
  int at = 0;  ///< which of the stored views it is

  explicit operator bool() const { return bool(rows); }
};

}  // namespace gigaray
