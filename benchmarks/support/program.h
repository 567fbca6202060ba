// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <vector>

namespace gigaray::benchmarks {

/// The main() of a benchmark program: version, device and driver into the context of the report,
/// Google Benchmark's own options, then `declare` registers benchmarks with what is left of argv.
/// Errors become one line and exit code 1. The device is the one of GIGARAY_DEVICE, see
/// select_device().
int run_program(int argc, char** argv,
                const std::function<void(const std::vector<std::string>& arguments)>& declare);

/// Repeats a benchmark and reports the smallest and the largest of every figure beside mean, median
/// and spread: of a rate on a noisy machine the largest says what the kernel can do, the median
/// what it did.
benchmark::internal::Benchmark* repeated(benchmark::internal::Benchmark* benchmark);

}  // namespace gigaray::benchmarks
