// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "opencl/device.h"

namespace gigaray::benchmarks {

/// What the device reaches, measured now and in this process; a kernel's speed is quoted beside it.

/// Scalar single-precision multiply-adds per second of all compute units together: chains of
/// dependent fma() without memory access, the best of several vector widths. One of them is two
/// floating-point operations.
double measure_fma_per_second(opencl::Device& device);

/// Bytes read plus bytes written per second by a kernel that copies a buffer larger than any cache.
double measure_copy_bytes_per_second(opencl::Device& device);

}  // namespace gigaray::benchmarks
