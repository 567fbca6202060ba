// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "kernels/fma_limit.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "opencl/buffer.h"
#include "opencl/program_cache.h"

namespace gigaray::benchmarks {
namespace {

using opencl::Buffer;
using opencl::Device;
using opencl::Kernel;

constexpr int kChains = 8;  // hides a latency of 4 cycles on two ports
constexpr int kStepsPerRound = 4;

constexpr std::string_view kSource = R"(
#if LANES == 1
typedef float vfloat;
#define STORE(value, i, to) (to)[i] = (value)
#define LOAD(i, from) (from)[i]
#else
#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)
typedef JOIN(float, LANES) vfloat;
#define STORE JOIN(vstore, LANES)
#define LOAD JOIN(vload, LANES)
#endif

#define STEP                                                      \
  a = fma(a, m, c); b = fma(b, m, c); d = fma(d, m, c); e = fma(e, m, c); \
  f = fma(f, m, c); g = fma(g, m, c); h = fma(h, m, c); k = fma(k, m, c);

// x <- x m + c tends to 1: no overflow, no denormal number.
__kernel void fma_chains(__global float* out, const int rounds) {
  const size_t i = get_global_id(0);
  const vfloat m = 0.75f, c = 0.25f;
  vfloat a = (float)i, b = a + 1, d = a + 2, e = a + 3, f = a + 4, g = a + 5, h = a + 6, k = a + 7;
  for (int round = 0; round < rounds; ++round) { STEP STEP STEP STEP }
  STORE(a + b + d + e + f + g + h + k, i, out);
}

__kernel void copy(__global const float* from, __global float* to) {
  const size_t i = get_global_id(0);
  STORE(LOAD(i, from), i, to);
}
)";

Kernel build(Device& device, const char* name, int lanes) {
  const opencl::SourcePart part{"fma_limit.cl", kSource};
  return Kernel(
      device, opencl::build_program(device, {&part, 1}, "-DLANES=" + std::to_string(lanes)), name);
}

/// Seconds of the fastest of several runs, half a second of them: other work disturbs some.
double best_seconds(const Device& device, const std::function<void()>& run) {
  using Clock = std::chrono::steady_clock;
  run();
  device.finish();
  double best = 1e30;
  double total = 0;
  for (int repeat = 0; repeat < 5 || total < 0.5; ++repeat) {
    const auto begin = Clock::now();
    run();
    device.finish();
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    best = std::min(best, seconds);
    total += seconds;
  }
  return best;
}

}  // namespace

double measure_fma_per_second(Device& device) {
  const auto& info = device.info();
  const bool gpu = info.type == DeviceType::kGpu;
  // A GPU hides latency with many items per unit; a CPU thread runs one item at a time.
  const std::size_t group = gpu ? 64 : 1;
  const std::size_t items = std::size_t(info.compute_units) * (gpu ? 2048 : 8);

  double best = 0;
  for (const int lanes : gpu ? std::array{1, 4} : std::array{16, 8}) {
    Kernel kernel = build(device, "fma_chains", lanes);
    const Buffer out(device, items * lanes * sizeof(float));
    // Rounds that take about 20 ms, from the time of a short run.
    const auto seconds_of = [&](int rounds) {
      kernel.set_args(out, rounds);
      return best_seconds(device, [&] { kernel.run(items, group); });
    };
    constexpr int kShort = 1 << 12;
    const double rounds =
        std::clamp(kShort * 0.02 / seconds_of(kShort), double(kShort), double(1 << 28));
    const double seconds = seconds_of(int(rounds));
    best = std::max(best, double(items) * lanes * kChains * kStepsPerRound * int(rounds) / seconds);
  }
  return best;
}

double measure_copy_bytes_per_second(Device& device) {
  const auto& info = device.info();
  const bool gpu = info.type == DeviceType::kGpu;
  const std::size_t bytes = std::min<std::uint64_t>(
      {std::uint64_t(gpu ? 1024 : 256) << 20, info.max_allocation, info.global_memory / 8});
  const int lanes = gpu ? 4 : 16;
  const std::size_t group = gpu ? 256 : 4096;
  const std::size_t items =
      bytes / (lanes * sizeof(float)) / group * group;  // whole groups: no item without data
  const std::size_t local = std::min<std::size_t>(group, info.max_group_size);

  Buffer from(device, bytes);
  const Buffer to(device, bytes);
  from.clear();
  Kernel kernel = build(device, "copy", lanes);
  kernel.set_args(from, to);
  const double seconds = best_seconds(device, [&] { kernel.run(items, local); });
  return 2.0 * double(items) * lanes * sizeof(float) / seconds;
}

}  // namespace gigaray::benchmarks
