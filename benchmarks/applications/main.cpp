// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// What a slider waits for: the mask of a view of 21 megapixels, beside what memory allows.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <vector>

#include "gigaray/applications/segmentation.h"
#include "gigaray/core/error.h"

namespace gigaray::benchmarks {
namespace {

constexpr int kWidth = 5616, kHeight = 3744;  // the paper's camera

FloatMap ramp() {
  FloatMap map(kWidth, kHeight);
  for (std::size_t i = 0; i < map.size(); ++i) map.data()[i] = float(i % 1009) / 1009;
  return map;
}

/// Copies as many bytes as a mask reads and writes.
double copy_seconds() {
  const std::size_t bytes = (sizeof(float) + 1) * std::size_t(kWidth) * kHeight / 2;
  const std::vector<char> from(bytes, 1);
  std::vector<char> to(bytes);
  double best = 1e9;
  for (int i = 0; i < 10; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    std::memcpy(to.data(), from.data(), bytes);
    benchmark::DoNotOptimize(to.data());
    best = std::min(
        best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return best;
}

void segment_21_megapixels(benchmark::State& state) {
  const FloatMap map = ramp();
  Mask mask(kWidth, kHeight);
  segment(map, {0.25f, 0.5f}, mask);
  for (std::size_t i = 0; i < map.size(); ++i)
    GIGARAY_CHECK(mask.data()[i] == (map.data()[i] >= 0.25f && map.data()[i] <= 0.5f));
  for (auto _ : state) {
    segment(map, {0.25f, 0.5f}, mask);
    benchmark::DoNotOptimize(mask.data());
  }
  state.counters["copy_ms"] = 1e3 * copy_seconds();
  state.SetBytesProcessed(std::int64_t(state.iterations()) * std::int64_t(map.size()) *
                          std::int64_t(sizeof(float) + 1));
}
BENCHMARK(segment_21_megapixels)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace gigaray::benchmarks

BENCHMARK_MAIN();
