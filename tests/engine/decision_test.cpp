// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Reconstruction::decision: which level and which view an estimate comes from.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "gigaray/engine/reconstruct.h"
#include "support/analytic_field.h"
#include "support/errors.h"

namespace gigaray::testing_support {
namespace {

/// A near patch over a far plane.
AnalyticField two_layers() {
  return analytic_field(93, 61, row_of_views(7), {{-0.5, 1}, {1.3, 2, 1, 30, 60, 12, 33}});
}

Reconstruction run(const LightField& light_field, const std::string& preset) {
  DepthOptions options = preset_options(preset);
  options.disparity = DisparityRange{-1, 2};
  options.hypotheses = 61;
  options.propagation.final_median_radius = 0;
  options.keep_searches = true;
  return reconstruct(light_field, options, {"opencl", ""}, {});
}

TEST(Decision, TellsTheEstimateThatTheMapShowsAndItsLevel) {
  for (const char* preset : {"paper", "auto"}) {
    Reconstruction result = run(two_layers().light_field, preset);
    for (const int view : {0, 3, 6}) {
      const ViewDepth depth = result.view(view);
      for (int v = 1; v < 61; v += 7)
        for (int u = 0; u < 93; u += 5) {
          const Decision decision = result.decision(view, u, v);
          EXPECT_EQ(decision.level, depth.level(u, v)) << preset << " " << u << " " << v;
          EXPECT_EQ(decision.disparity, depth.disparity(u, v));
          EXPECT_GE(decision.disparity, decision.bounds.min - 0.051);
          EXPECT_LE(decision.disparity, decision.bounds.max + 0.051);
        }
    }
  }
}

TEST(Decision, NamesTheViewThatFoundIt) {
  const AnalyticField field = two_layers();
  Reconstruction result = run(field.light_field, "auto");
  const int centre = centre_view(field.light_field);
  std::set<int> deciders;
  int unnamed = 0, centre_pixels = 0, own_decisions = 0;
  for (int v = 1; v < 61; v += 3)
    for (int u = 0; u < 93; u += 3) {
      const Decision own = result.decision(centre, u, v);
      // What the centre left open another view may have decided.
      ++centre_pixels;
      own_decisions += own.view == centre;
      const Decision other = result.decision(0, u, v);
      if (other.view < 0) {
        ++unnamed;
        continue;
      }
      deciders.insert(other.view);
      if (other.level > 0) continue;
      // The ray of the deciding pixel ends here.
      const double s = field.light_field.views[other.view].s - field.light_field.views[0].s;
      EXPECT_NEAR(other.u + s * other.disparity, u, 0.76);
      EXPECT_EQ(other.v, v);
    }
  EXPECT_GT(own_decisions, 0.9 * centre_pixels);
  EXPECT_TRUE(deciders.contains(centre));
  EXPECT_GT(deciders.size(), 1u);  // what the centre does not see
  EXPECT_LT(unnamed, 40);
}

TEST(Decision, CoarserLevelsSearchBetweenFinerEstimates) {
  // A patch without texture: its edges decide on level 0, its inside on coarser ones.
  const AnalyticField field =
      analytic_field(93, 61, row_of_views(7), {{-0.5, 1}, {1.3, 2, 0, 25, 68, 10, 50}});
  Reconstruction result = run(field.light_field, "paper");
  const int centre = 3;
  int bounded = 0;
  for (int v = 0; v < 61; ++v)
    for (int u = 0; u < 93; ++u) {
      const Decision decision = result.decision(centre, u, v);
      if (decision.level == 0) {
        EXPECT_FLOAT_EQ(float(decision.bounds.min), -1);
        EXPECT_FLOAT_EQ(float(decision.bounds.max), 2);
      }
      bounded += decision.level > 0 && decision.bounds.max - decision.bounds.min < 2.9;
    }
  EXPECT_GT(bounded, 0);
}

TEST(Decision, APixelOutsideOrAViewWithoutDepthIsAnError) {
  DepthOptions options = preset_options("auto");
  options.disparity = DisparityRange{-1, 2};
  options.views = {3};
  const AnalyticField field = two_layers();
  const Reconstruction result = reconstruct(field.light_field, options, {"opencl", ""}, {});
  expect_error(ErrorCode::kInvalidArgument, {"has no depth"}, [&] { result.decision(2, 0, 0); });
  expect_error(ErrorCode::kInvalidArgument, {"has no depth"}, [&] { result.decision(3, 93, 0); });
  expect_error(ErrorCode::kInvalidArgument, {"has no depth"}, [&] { result.decision(3, 0, -1); });
}

}  // namespace
}  // namespace gigaray::testing_support
