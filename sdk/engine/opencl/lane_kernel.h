// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>

#include "opencl/buffer.h"

namespace gigaray::opencl {

/// A kernel that works on blocks of `lanes` pixels in groups of `group` work-items.
struct LaneKernel {
  Kernel kernel;
  int lanes = 1;
  int group = 1;
  int units = 1;        ///< Blocks of lanes that a work-item does.
  bool staged = false;  ///< STAGE 1, see density_score.cl.

  void run(int width, int rows, int views = 1) const {
    const std::size_t pixels = std::size_t(lanes) * units;
    kernel.run(WorkSize(round_up((width + pixels - 1) / pixels, group), rows, views),
               WorkSize(group, 1, 1));
  }
  /// Of kernels with a work-item per pixel: their lanes are hypotheses.
  void run_pixels(int width, int rows) const {
    kernel.run(WorkSize(round_up(width, group), rows), WorkSize(group, 1));
  }
  /// Local memory of `count` vectors for every work-item of a group.
  LocalMemory vectors(std::size_t count) const {
    return {std::max<std::size_t>(count, 1) * lanes * group * sizeof(float)};
  }
};

/// A device buffer that only grows.
struct Scratch {
  Buffer buffer;
  std::size_t bytes = 0;

  /// At least `size` bytes. New memory is zero: kernels may load (never use) what was not written,
  /// and that must not be a NaN.
  Buffer& at_least(const Device& device, std::size_t size) {
    if (size > bytes) {
      buffer = Buffer();
      buffer = Buffer::zeroed(device, size);
      bytes = size;
    }
    return buffer;
  }
};

inline std::string define(const std::string& name, int value) {
  return " -D" + name + "=" + std::to_string(value);
}

}  // namespace gigaray::opencl
