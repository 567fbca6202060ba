// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/engine/depth_options.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "support/errors.h"

namespace gigaray {
namespace {

using testing_support::expect_error;

TEST(DepthOptions, PresetsPassTheirOwnCheck) {
  for (const char* name : {"auto", "paper"}) {
    const DepthOptions options = preset_options(name);
    EXPECT_EQ(options.preset, name);
    EXPECT_NO_THROW(options.check());
  }
  EXPECT_NO_THROW(DepthOptions().check());
  expect_error(ErrorCode::kInvalidArgument, {"fast", "auto", "paper"},
               [] { preset_options("fast"); });
}

TEST(DepthOptions, PaperHasTheConstantsOfThePaper) {
  const DepthOptions paper = paper_options();
  EXPECT_EQ(2 * paper.edge.radius + 1, 9);
  EXPECT_EQ(paper.edge.threshold, 0.02f);
  EXPECT_EQ(paper.score.bandwidth, 0.02f);
  EXPECT_EQ(paper.score.mean_shift_iterations, 10);
  EXPECT_EQ(paper.hypotheses, 256);
  EXPECT_EQ(2 * paper.winner.median_radius + 1, 11);
  EXPECT_EQ(paper.winner.median_tolerance, 0.1f);
  EXPECT_EQ(paper.propagation.tolerance, 0.1f);
  EXPECT_EQ(paper.support.radius, 0);
  EXPECT_FALSE(paper.winner.refine);
  EXPECT_FALSE(paper.score.gradient);
  EXPECT_FALSE(paper.score.from_noise);
  EXPECT_TRUE(paper.score.linear_rgb);
}

TEST(DepthOptions, AValueOutOfRangeIsNamedWithItsField) {
  struct Wrong {
    const char* field;
    const char* value;
    std::function<void(DepthOptions&)> set;
  };
  const Wrong wrongs[] = {
      {"hypotheses", "1", [](auto& o) { o.hypotheses = 1; }},
      {"hypotheses", "5000", [](auto& o) { o.hypotheses = 5000; }},
      {"hypotheses", "-3", [](auto& o) { o.hypotheses = -3; }},
      {"hypothesis_step", "0", [](auto& o) { o.hypothesis_step = 0; }},
      {"hypothesis_step", "nan", [](auto& o) { o.hypothesis_step = std::nan(""); }},
      {"edge.radius", "17", [](auto& o) { o.edge.radius = 17; }},
      {"edge.radius", "0", [](auto& o) { o.edge.radius = 0; }},
      {"edge.threshold", "not a number", [](auto& o) { o.edge.threshold = NAN; }},
      {"winner.min_confidence", "not a number", [](auto& o) { o.winner.min_confidence = NAN; }},
      {"score.bandwidth", "0", [](auto& o) { o.score.bandwidth = 0; }},
      {"score.bandwidth", "nan", [](auto& o) { o.score.bandwidth = NAN; }},
      {"score.gradient_bandwidth", "-1", [](auto& o) { o.score.gradient_bandwidth = -1; }},
      {"score.gradient_share", "1.5", [](auto& o) { o.score.gradient_share = 1.5f; }},
      {"score.mean_shift_iterations", "101", [](auto& o) { o.score.mean_shift_iterations = 101; }},
      {"score.min_views", "2", [](auto& o) { o.score.min_views = 2; }},
      {"score.floor_views", "-0.5", [](auto& o) { o.score.floor_views = -0.5f; }},
      {"support.radius", "9", [](auto& o) { o.support.radius = 9; }},
      {"support.sigma_colour", "0", [](auto& o) { o.support.sigma_colour = 0; }},
      {"support.sigma_space", "0", [](auto& o) { o.support.sigma_space = 0; }},
      {"support.max_slope", "-1", [](auto& o) { o.support.max_slope = -1; }},
      {"support.slanted", "radius", [](auto& o) { o.support.radius = 0; }},
      {"winner.median_radius", "9", [](auto& o) { o.winner.median_radius = 9; }},
      {"winner.median_tolerance", "0", [](auto& o) { o.winner.median_tolerance = 0; }},
      {"propagation.tolerance", "0", [](auto& o) { o.propagation.tolerance = 0; }},
      {"propagation.finished_lead", "-1", [](auto& o) { o.propagation.finished_lead = -1; }},
      {"propagation.final_median_radius", "-1",
       [](auto& o) { o.propagation.final_median_radius = -1; }},
      {"disparity", "1 1",
       [](auto& o) {
         o.disparity = DisparityRange{1, 1};
       }},
      {"disparity", "2 -1",
       [](auto& o) {
         o.disparity = DisparityRange{2, -1};
       }},
      {"disparity", "inf",
       [](auto& o) {
         o.disparity = DisparityRange{0, INFINITY};
       }},
      {"disparity", "nan",
       [](auto& o) {
         o.disparity = DisparityRange{std::nan(""), 1};
       }},
      {"memory", "negative", [](auto& o) { o.memory_bytes = -1; }},
      {"support.radius", "min_views", [](auto& o) { o.score.min_views = 0.2f; }},
  };
  for (const Wrong& wrong : wrongs) {
    DepthOptions options = auto_options();
    wrong.set(options);
    expect_error(ErrorCode::kInvalidArgument, {wrong.field, wrong.value}, [&] { options.check(); });
  }
}

}  // namespace
}  // namespace gigaray
