// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <gtest/gtest.h>

#include <array>

#include "engine/parity_bench.h"

namespace gigaray::testing_support {

inline opencl::TuningOverrides tuned_for_a_gpu() {
  DeviceInfo gpu;
  gpu.name = "some GPU";
  gpu.type = DeviceType::kGpu;
  opencl::TuningOverrides overrides;
  for (const KernelTuning& kernel : tuning_in_force(gpu))
    overrides[kernel.kernel] = kernel.parameters;
  return overrides;
}

/// Every kernel with some lanes and groups against the reference.
template <class S>
class LaneCheck {
 public:
  /// lanes: for the table. size: begins at a block of scan-lines, with the rows around it that they
  /// follow.
  LaneCheck(std::string lanes, opencl::TuningOverrides tuning,
            const ParityCase& size = {93, 37, {16, 21}, BandEncoding::kBits16},
            int hypotheses = ParityRig<S>::hypotheses().count)
      : lanes_(std::move(lanes)), tuning_(std::move(tuning)), size_(size) {
    hypotheses_.count = hypotheses;
  }

  void paper() {
    DepthOptions options = paper_options();
    options.score.mean_shift_iterations = 2;
    options.winner.refine = true;
    ParityBench<S> bench(size_, options, ParityRig<S>::irregular(), hypotheses_, tuning_);
    const RowRange rows = bench.rows();
    StripMap<float> expected(bench.width(), rows), actual = expected;
    bench.reference->edge_confidence(1, rows, expected);
    bench.opencl->edge_confidence(1, rows, actual);
    expect_within("edge confidence", compare(expected, actual, rows), kRounding);

    const auto todo = bench.random_todo(rows);
    const auto bounds = bench.random_bounds(rows);
    for (HostSteps* steps : both(bench)) steps->density_score(3, rows, todo, bounds);
    expect_within("score, paper", compare_scores(bench, rows, todo, kScore), kScore);
    winners(bench, todo, bounds);

    const auto in = bench.random_disparity(bench.around(2), 0.6);
    bench.reference->bilateral_median(2, rows, 2, 0.1f, in, expected);
    bench.opencl->bilateral_median(2, rows, 2, 0.1f, in, actual);
    expect_within("median", compare(expected, actual, rows), 0);
    radiance(bench);
    propagation(bench);
    downsampling(bench);
  }

  void automatic() {
    DepthOptions options = auto_options();
    options.score.bandwidth = 0.1f;
    options.score.gradient_bandwidth = 0.05f;
    options.score.min_views = 0.4f;
    ParityBench<S> bench(size_, options, ParityRig<S>::irregular(), hypotheses_, tuning_);
    const RowRange rows = bench.rows(), supported = bench.around(kScanlineReach);
    const RowRange scored = bench.around(kScanlineReach + options.support.radius);
    const auto all = bench.all_todo(scored), todo = bench.random_todo(supported);
    const auto full = bench.full_bounds(scored);
    for (HostSteps* steps : both(bench))
      steps->robust_score(0, scored, all, full, ScoreViews::kAll);
    expect_within("robust score", compare_scores(bench, rows, all, 1), kScore);
    for (HostSteps* steps : both(bench)) {
      steps->score_support(0, supported, todo, full);
      steps->scanline(0, rows, todo);
    }
    expect_within("score support", compare_scores(bench, rows, todo, 1), kScore);
    winners(bench, todo, full);

    const auto bounds = bench.random_bounds(rows);
    for (HostSteps* steps : both(bench))
      steps->robust_score(0, bench.around(options.support.radius), all, full,
                          ScoreViews::kHalfPlanes);
    expect_within("robust score, half-planes", compare_scores(bench, rows, all, 1), kScore);
    const auto slopes = bench.random_slopes(rows);
    for (HostSteps* steps : both(bench)) steps->slanted_support(0, rows, todo, bounds, slopes);
    expect_within("slanted support", compare_scores(bench, rows, todo, 1), kScore);

    const auto in = bench.slanted_disparity(bench.around(kSlopeReach));
    StripMap<Slope> expected(bench.width(), rows), actual = expected;
    bench.reference->slope_fit(2, rows, in, expected);
    bench.opencl->slope_fit(2, rows, in, actual);
    expect_within("slope fit", compare(expected, actual, rows), kSlope);
    const auto [evidence, choice] = compare_sides(bench, 2, kScore);
    expect_within("evidence of sides", evidence, kScore);
    expect_within("choice of sides", choice, 0);
    radiance(bench);
    means(bench);
  }

 private:
  // As in parity_test.cpp.
  static constexpr double kRounding = 4e-6, kScore = 1e-4, kSlope = 5e-4, kRadiance = 5e-4;
  static constexpr double kUnstableShare = 2e-3;
  // All pixels, of which a few come near where mean-shift is unstable.
  static constexpr double kAnyScore = 5e-4;

  static std::array<HostSteps*, 2> both(ParityBench<S>& bench) {
    return {bench.reference.get(), bench.opencl.get()};
  }

  void expect_within(const std::string& step, const Difference& difference, double tolerance) {
    const std::string stage = step + lanes_;
    ParityTable::instance().add(ParityRig<S>::kName, stage, difference);
    EXPECT_LE(difference.largest, tolerance) << stage;
    EXPECT_EQ(difference.one_sided, 0) << stage;
    EXPECT_LE(double(difference.apart), kUnstableShare * double(difference.values)) << stage;
  }

  /// Where rounding chooses another winner the scores are alike; parity_test.cpp looks at that.
  void winners(ParityBench<S>& bench, const StripMap<std::uint8_t>& todo,
               const StripMap<HypothesisBounds>& bounds) {
    const RowRange rows = bench.rows();
    StripMap<float> expected(bench.width(), rows), actual = expected, expected_lead = expected,
                                                   lead = expected;
    bench.reference->winner(rows, todo, bounds, expected, expected_lead);
    bench.opencl->winner(rows, todo, bounds, actual, lead);
    expect_within("winner, contrast", compare(expected_lead, lead, rows), kAnyScore);
    EXPECT_EQ(compare(expected, actual, rows).one_sided, 0) << lanes_;
    int same = 0, all = 0;
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < bench.width(); ++u) {
        if (!todo.row(v)[u]) continue;
        ++all;
        same += std::isnan(expected.row(v)[u]) ||
                std::abs(expected.row(v)[u] - actual.row(v)[u]) < 0.01 * bench.hypotheses().step();
      }
    EXPECT_GT(same, 0.75 * all) << lanes_;
    StripMap<float> expected_score = expected, score = expected;
    bench.reference->score_of_estimate(rows, todo, expected, expected_score);
    bench.opencl->score_of_estimate(rows, todo, expected, score);
    expect_within("score of an estimate", compare(expected_score, score, rows), kAnyScore);
  }

  void radiance(ParityBench<S>& bench) {
    const auto disparity = bench.random_disparity(bench.rows(), 0.8);
    StripMap<Radiance> expected(bench.width(), bench.rows()), actual = expected;
    bench.reference->mean_radiance(4, bench.rows(), disparity, expected);
    bench.opencl->mean_radiance(4, bench.rows(), disparity, actual);
    expect_within("mean radiance", compare(expected, actual, disparity, bench.rows()), kRadiance);
  }

  void propagation(ParityBench<S>& bench) {
    const RowRange rows = bench.rows(), reached = bench.rows_of_all(rows);
    std::vector<PackedEstimate> expected(std::size_t(reached.size()) * bench.active_count *
                                         bench.width());
    for (PackedEstimate& estimate : expected)
      if (bench.uniform() < 0.5) estimate = pack_estimate(float(bench.uniform() - 0.5), 0.4f);
    auto actual = expected;
    const auto before = expected;
    const auto disparity = bench.random_disparity(rows, 0.9);
    const auto confidence = bench.random_values(rows);
    StripMap<Radiance> radiance(bench.width(), rows);
    bench.reference->mean_radiance(0, rows, disparity, radiance);
    bench.reference->propagation(0, rows, disparity, confidence, radiance, reached,
                                 bench.active_count, 2, expected);
    bench.opencl->propagation(0, rows, disparity, confidence, radiance, reached, bench.active_count,
                              2, actual);
    EXPECT_NE(expected, before);
    Difference hypothesis;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const float a = hypothesis_of(expected[i]), b = hypothesis_of(actual[i]);
      if (std::abs(a - b) > 1e-5 || confidence_of(expected[i]) != confidence_of(actual[i]))
        ++hypothesis.values, ++hypothesis.apart;
      else
        hypothesis.add(a, b);
    }
    expect_within("propagation", hypothesis, S::kRaysShiftAlike ? 0 : 1e-5);
  }

  void downsampling(ParityBench<S>& bench) {
    const RowRange small{(bench.rows().begin + 1) / 2, (bench.rows().end + 1) / 2};
    const int views = bench.sampler().num_views();
    std::vector<float> expected(std::size_t(small.size()) * views * 3 * ((bench.width() + 1) / 2));
    auto actual = expected;
    bench.reference->downsample(small, views, expected);
    bench.opencl->downsample(small, views, actual);
    Difference difference;
    for (std::size_t i = 0; i < actual.size(); ++i) difference.add(expected[i], actual[i]);
    expect_within("downsampling", difference, kRounding);
  }

  /// The reference without its noise, and the gradients that are taken of it.
  void means(ParityBench<S>& bench) {
    const RowRange rows = bench.rows(), around = bench.around(1);
    StripMap<float> expected;
    expect_within("ray mean", compare_ray_means(bench, 2, around, expected), kRadiance);
    const auto all = bench.all_todo(rows);
    const auto full = bench.full_bounds(rows);
    for (HostSteps* steps : both(bench)) {
      steps->replace_reference(expected);
      steps->robust_score(2, rows, all, full, ScoreViews::kAll);
      steps->restore_reference();
    }
    expect_within("robust score against means", compare_scores(bench, rows, all, 1), kScore);
  }

  std::string lanes_;
  opencl::TuningOverrides tuning_;
  ParityCase size_;
  HypothesisRange hypotheses_ = ParityRig<S>::hypotheses();
};

}  // namespace gigaray::testing_support
