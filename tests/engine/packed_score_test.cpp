// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Pixels that stand alone are scored by another kernel than those side by side.
#include <gtest/gtest.h>

#include "engine/parity_bench.h"

namespace gigaray::testing_support {
namespace {

// Rounding of colours times the slope of the kernel, as in parity_test.cpp.
constexpr double kScore = 1e-4;

template <class S>
class PackedScore : public testing::Test {};
using Samplers = testing::Types<EpiSampler, GridSampler>;
TYPED_TEST_SUITE(PackedScore, Samplers);

/// About one pixel in seven, some at the ends of the rows.
template <class S>
StripMap<std::uint8_t> lonely_pixels(ParityBench<S>& bench) {
  StripMap<std::uint8_t> todo(bench.width(), bench.rows());
  for (int v = bench.rows().begin; v < bench.rows().end; ++v) {
    for (int u = 0; u < bench.width(); ++u) todo.row(v)[u] = bench.uniform() < 0.15;
    todo.row(v)[v % 2 ? 0 : bench.width() - 1] = 1;
  }
  return todo;
}

template <class S>
void expect_scores_near(ParityBench<S>& bench, const StripMap<std::uint8_t>& todo,
                        const StripMap<HypothesisBounds>& bounds, HostSteps& expected,
                        double tolerance) {
  for (int v = bench.rows().begin; v < bench.rows().end; ++v)
    for (int u = 0; u < bench.width(); ++u) {
      if (!todo.row(v)[u]) continue;
      const auto truth = expected.scores_at(u, v);
      const auto score = bench.opencl->scores_at(u, v);
      for (int i = bounds.row(v)[u].first; i <= bounds.row(v)[u].last; ++i)
        ASSERT_NEAR(truth[i], score[i], tolerance) << "at " << u << ", " << v << ", " << i;
    }
}

TYPED_TEST(PackedScore, LonelyPixelsScoreAsTheReference) {
  for (const ParityCase& size : parity_cases())
    for (const int iterations : {0, 2}) {
      DepthOptions options = paper_options();
      options.score.mean_shift_iterations = iterations;
      options.score.bandwidth = 0.1f;
      ParityBench<TypeParam> bench(size, options);
      const auto todo = lonely_pixels(bench);
      const auto bounds = bench.random_bounds(bench.rows());
      bench.reference->density_score(3, bench.rows(), todo, bounds);
      bench.opencl->density_score(3, bench.rows(), todo, bounds);
      expect_scores_near(bench, todo, bounds, *bench.reference, kScore);
    }
}

TYPED_TEST(PackedScore, BlocksOfEveryFilling) {
  // None to 16 pixels of a block, scattered; the last block of a row is cut off.
  DepthOptions options = paper_options();
  options.score.mean_shift_iterations = 2;
  options.score.bandwidth = 0.1f;
  ParityBench<TypeParam> bench(ParityCase{93, 31, {5, 22}, BandEncoding::kBits16}, options);
  StripMap<std::uint8_t> todo(bench.width(), bench.rows());
  for (int v = bench.rows().begin; v < bench.rows().end; ++v)
    for (int u = 0; u < bench.width(); ++u)
      todo.row(v)[u] = (5 * u + 3 * v) % 16 < (u / 16 + v) % 17;
  const auto bounds = bench.random_bounds(bench.rows());
  bench.reference->density_score(1, bench.rows(), todo, bounds);
  bench.opencl->density_score(1, bench.rows(), todo, bounds);
  expect_scores_near(bench, todo, bounds, *bench.reference, kScore);
  // None to do: nothing is packed.
  const StripMap<std::uint8_t> nothing(bench.width(), bench.rows());
  bench.opencl->density_score(1, bench.rows(), nothing, bounds);
}

TYPED_TEST(PackedScore, NeighboursDoNotChangeTheScoreOfAPixel) {
  for (const ParityCase& size : parity_cases()) {
    ParityBench<TypeParam> bench(size, paper_options());  // stops early, each pixel by itself
    const auto todo = lonely_pixels(bench);
    const auto bounds = bench.full_bounds(bench.rows());
    bench.opencl->density_score(3, bench.rows(), bench.all_todo(bench.rows()), bounds);
    std::vector<std::vector<float>> among_others;
    for (int v = bench.rows().begin; v < bench.rows().end; ++v)
      for (int u = 0; u < bench.width(); ++u)
        if (todo.row(v)[u]) among_others.push_back(bench.opencl->scores_at(u, v));
    bench.opencl->density_score(3, bench.rows(), todo, bounds);
    std::size_t i = 0;
    for (int v = bench.rows().begin; v < bench.rows().end; ++v)
      for (int u = 0; u < bench.width(); ++u)
        if (todo.row(v)[u]) {
          ASSERT_EQ(among_others[i++], bench.opencl->scores_at(u, v)) << "at " << u << ", " << v;
        }
  }
}

}  // namespace
}  // namespace gigaray::testing_support
