// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Every lane width, with the tuning of CPUs and of GPUs, against the reference: what other devices
// run is tested here too.
#include <gtest/gtest.h>

#include "engine/parity_bench.h"

namespace gigaray::testing_support {
namespace {

constexpr double kRounding = 4e-6, kScore = 1e-4, kSlope = 5e-4;  // as in parity_test.cpp
constexpr ParityCase kCase{93, 23, {7, 12}, BandEncoding::kBits16};
constexpr HypothesisRange kHypotheses{-1.31, 1.73, 19};

class ParityLanes : public testing::Test {
 protected:
  static void TearDownTestSuite() { ParityTable::instance().print(); }

  static void expect_within(const std::string& stage, const Difference& difference,
                            double tolerance) {
    ParityTable::instance().add("Epi", stage, difference);
    EXPECT_LE(difference.largest, tolerance) << stage;
    EXPECT_EQ(difference.one_sided + difference.apart, 0) << stage;
  }

  static opencl::TuningOverrides tuned(int lanes, int group, int stage) {
    opencl::TuningOverrides overrides;
    for (const KernelTuning& kernel : tuning_in_force(select_device())) {
      overrides[kernel.kernel] = {{"LANES", lanes}, {"GROUP", group}};
      if (kernel.parameters.contains("STAGE")) overrides[kernel.kernel]["STAGE"] = stage;
    }
    return overrides;
  }

  static void check_paper(const std::string& lanes, const opencl::TuningOverrides& tuning) {
    DepthOptions options = paper_options();
    options.score.mean_shift_iterations = 2;
    options.winner.refine = true;
    ParityBench<EpiSampler> bench(kCase, options, irregular_row(), kHypotheses, tuning);
    const RowRange rows = bench.rows();
    StripMap<float> expected(bench.width(), rows), actual = expected, lead = expected;
    bench.reference->edge_confidence(1, rows, expected);
    bench.opencl->edge_confidence(1, rows, actual);
    expect_within("edge confidence" + lanes, compare(expected, actual, rows), kRounding);

    const auto todo = bench.random_todo(rows);
    const auto bounds = bench.random_bounds(rows);
    bench.reference->density_score(3, rows, todo, bounds);
    bench.opencl->density_score(3, rows, todo, bounds);
    expect_within("score, paper" + lanes, compare_scores(bench, rows, todo, 1), kScore);

    StripMap<float> expected_lead = expected;
    bench.reference->winner(rows, todo, bounds, expected, expected_lead);
    bench.opencl->winner(rows, todo, bounds, actual, lead);
    expect_within("winner, contrast" + lanes, compare(expected_lead, lead, rows), kScore);
    EXPECT_EQ(compare(expected, actual, rows).one_sided, 0) << lanes;
    // Where rounding chooses another winner the scores are alike; parity_test.cpp looks at that.
    int same = 0, all = 0;
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < bench.width(); ++u) {
        if (!todo.row(v)[u]) continue;
        ++all;
        same += std::abs(expected.row(v)[u] - actual.row(v)[u]) < 0.01 * bench.hypotheses().step();
      }
    EXPECT_GT(same, 0.8 * all) << lanes;

    const auto in = bench.random_disparity(bench.around(2), 0.6);
    bench.reference->bilateral_median(2, rows, 2, 0.1f, in, expected);
    bench.opencl->bilateral_median(2, rows, 2, 0.1f, in, actual);
    expect_within("median" + lanes, compare(expected, actual, rows), 0);

    const RowRange small{(rows.begin + 1) / 2, (rows.end + 1) / 2};
    std::vector<float> expected_small(std::size_t(small.size()) * bench.sampler().num_views() * 3 *
                                      ((bench.width() + 1) / 2));
    auto actual_small = expected_small;
    bench.reference->downsample(small, bench.sampler().num_views(), expected_small);
    bench.opencl->downsample(small, bench.sampler().num_views(), actual_small);
    Difference difference;
    for (std::size_t i = 0; i < actual_small.size(); ++i)
      difference.add(expected_small[i], actual_small[i]);
    expect_within("downsampling" + lanes, difference, kRounding);
  }

  static void check_auto(const std::string& lanes, const opencl::TuningOverrides& tuning) {
    DepthOptions options = auto_options();
    options.score.gradient_bandwidth = 0.02f;
    ParityBench<EpiSampler> bench(kCase, options, irregular_row(), kHypotheses, tuning);
    const RowRange rows = bench.rows(), around = bench.around(options.support.radius);
    const auto all = bench.all_todo(around);
    const auto full = bench.full_bounds(around);
    const auto todo = bench.random_todo(rows);
    const auto bounds = bench.random_bounds(rows);
    for (HostSteps* backend : {bench.reference.get(), bench.opencl.get()})
      backend->robust_score(0, around, all, full, ScoreViews::kAll);
    expect_within("robust score" + lanes, compare_scores(bench, around, all, 1), kScore);
    for (HostSteps* backend : {bench.reference.get(), bench.opencl.get()})
      backend->score_support(0, rows, todo, bounds);
    expect_within("score support" + lanes, compare_scores(bench, rows, todo, 1), kScore);
    for (HostSteps* backend : {bench.reference.get(), bench.opencl.get()})
      backend->robust_score(0, around, all, full, ScoreViews::kHalfPlanes);
    expect_within("robust score, half-planes" + lanes, compare_scores(bench, around, all, 1),
                  kScore);
    const auto slopes = bench.random_slopes(rows);
    for (HostSteps* backend : {bench.reference.get(), bench.opencl.get()})
      backend->slanted_support(0, rows, todo, bounds, slopes);
    expect_within("slanted support" + lanes, compare_scores(bench, rows, todo, 1), kScore);

    const auto in = bench.slanted_disparity(bench.around(kSlopeReach));
    StripMap<Slope> expected(bench.width(), rows), actual = expected;
    bench.reference->slope_fit(2, rows, in, expected);
    bench.opencl->slope_fit(2, rows, in, actual);
    expect_within("slope fit" + lanes, compare(expected, actual, rows), kSlope);
  }
};

TEST_F(ParityLanes, OneLaneInGroupsOf64AsOnAGpu) {
  check_paper(", 1 lane", tuned(1, 64, 0));
  check_auto(", 1 lane", tuned(1, 64, 0));
}

TEST_F(ParityLanes, FourLanesInGroupsOf3) {
  check_paper(", 4 lanes", tuned(4, 3, 1));
  check_auto(", 4 lanes", tuned(4, 3, 1));
}

TEST_F(ParityLanes, EightLanesNotStaged) {
  check_paper(", 8 lanes", tuned(8, 1, 0));
  check_auto(", 8 lanes", tuned(8, 1, 0));
}

TEST_F(ParityLanes, SixteenLanes) {
  check_paper(", 16 lanes", tuned(16, 1, 1));
  check_auto(", 16 lanes", tuned(16, 1, 1));
}

}  // namespace
}  // namespace gigaray::testing_support
