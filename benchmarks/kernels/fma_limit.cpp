// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "kernels/fma_limit.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

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

/// Seconds of the fastest of several runs within about `budget` seconds.
double best_seconds(const Device& device, double budget, const std::function<void()>& run) {
  using Clock = std::chrono::steady_clock;
  run();
  device.finish();
  double best = 1e30;
  double total = 0;
  for (int repeat = 0; repeat < 3 || total < budget; ++repeat) {
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

struct MachineLimit::Impl {
  explicit Impl(const std::string& name) : device(Device::open(name)) {
    const auto& info = device.info();
    is_gpu = info.type == DeviceType::kGpu;
    // A GPU hides latency with many items per unit; a CPU thread runs one item at a time.
    group = is_gpu ? 64 : 1;
    items = std::size_t(info.compute_units) * (is_gpu ? 2048 : 8);
    double best = 0;
    for (const int lanes : is_gpu ? std::vector{1, 4} : std::vector{16, 8}) {
      Chains chains{build(device, "fma_chains", lanes),
                    Buffer(device, items * lanes * sizeof(float)), lanes};
      // Rounds that take about 10 ms, from the time of a short run.
      constexpr int kShort = 1 << 12;
      chains.rounds = kShort;
      chains.rounds =
          int(std::clamp(kShort * 0.01 / seconds_of(chains, 0.1), double(kShort), double(1 << 28)));
      const double rate = rate_of(chains, 0.2);
      if (rate > best) {
        best = rate;
        fastest = std::move(chains);
      }
    }
  }

  struct Chains {
    Kernel kernel;
    Buffer out;
    int lanes = 1;
    int rounds = 0;
  };

  double seconds_of(Chains& chains, double budget) {
    chains.kernel.set_args(chains.out, chains.rounds);
    return best_seconds(device, budget, [&] { chains.kernel.run(items, group); });
  }
  double rate_of(Chains& chains, double budget) {
    const double steps = double(kChains) * kStepsPerRound * chains.rounds;
    return double(items) * chains.lanes * steps / seconds_of(chains, budget);
  }

  Device device;
  bool is_gpu = false;
  std::size_t group = 1, items = 1;
  Chains fastest;
};

MachineLimit::MachineLimit(const std::string& device) : impl_(std::make_unique<Impl>(device)) {}
MachineLimit::~MachineLimit() = default;

double MachineLimit::fma_per_second(double seconds) {
  return impl_->rate_of(impl_->fastest, seconds);
}

double MachineLimit::copy_bytes_per_second(double seconds) {
  Device& device = impl_->device;
  const auto& info = device.info();
  const std::size_t bytes =
      std::min<std::uint64_t>({std::uint64_t(impl_->is_gpu ? 1024 : 256) << 20, info.max_allocation,
                               info.global_memory / 8});
  const int lanes = impl_->is_gpu ? 4 : 16;
  const std::size_t group = impl_->is_gpu ? 256 : 4096;
  const std::size_t items =
      bytes / (lanes * sizeof(float)) / group * group;  // whole groups: no item without data
  const std::size_t local = std::min<std::size_t>(group, info.max_group_size);

  Buffer from(device, bytes);
  const Buffer to(device, bytes);
  from.clear();
  Kernel kernel = build(device, "copy", lanes);
  kernel.set_args(from, to);
  const double best = best_seconds(device, seconds, [&] { kernel.run(items, local); });
  return 2.0 * double(items) * lanes * sizeof(float) / best;
}

}  // namespace gigaray::benchmarks
