// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <memory>
#include <string>

namespace gigaray::benchmarks {

/// What the device reaches, measured now and in this process; a kernel's speed is quoted beside it.
class MachineLimit {
 public:
  /// device: see select_device(). Finds the vector width that is fastest; takes about a second.
  explicit MachineLimit(const std::string& device = "");
  ~MachineLimit();

  /// Scalar single-precision multiply-adds per second of all compute units together: chains of
  /// dependent fma() without memory access. One of them is two floating-point operations. The best
  /// of several runs within about `seconds`: other work disturbs some.
  double fma_per_second(double seconds = 0.2);

  /// Bytes read plus bytes written per second by a kernel that copies a buffer larger than any
  /// cache.
  double copy_bytes_per_second(double seconds = 0.5);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gigaray::benchmarks
