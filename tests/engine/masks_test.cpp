// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Masks of 3D and 4D light fields; those of posed cameras are in unstructured_test.cpp.
#include <gtest/gtest.h>

#include "engine/cache_fixture.h"
#include "engine/masked_pictures.h"
#include "support/analytic_field.h"
#include "support/depth_result.h"

namespace gigaray::testing_support {
namespace {

constexpr int kWidth = 121, kHeight = 61;

constexpr int kBarBegin = 50, kBarEnd = 64;
bool is_in_bar(int u) { return u >= kBarBegin && u < kBarEnd; }

AnalyticField barred(std::vector<View> views) {
  AnalyticField field = analytic_field(kWidth, kHeight, std::move(views), {{1.3, 5}});
  field.light_field.pixels = with_bar(field.light_field.pixels, kBarBegin, kBarEnd);
  return field;
}

ViewDepth depth_of_middle(const AnalyticField& field, const char* preset, const char* backend) {
  DepthOptions options = preset_options(preset);
  options.disparity = {-0.5, 2};
  options.hypotheses = 64;
  options.views = {field.light_field.num_views() / 2};
  Reconstruction result = reconstruct(field.light_field, options, {backend, ""}, RunControl{});
  return result.view(options.views.front());
}

class Masks : public testing::TestWithParam<const char*> {};

TEST_P(Masks, HaveNoDepthAndAddNothingToOthersInRowsAndGrids) {
  for (const std::vector<View>& views : {row_of_views(7), grid_of_views(3, 3)}) {
    SCOPED_TRACE(views.size());
    const AnalyticField field = barred(views);
    const ViewDepth depth = depth_of_middle(field, GetParam(), "opencl");
    const ViewDepth reference = depth_of_middle(field, GetParam(), "reference");
    long right = 0, shown = 0, apart = 0;
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) {
        ASSERT_EQ(is_in_bar(u), std::isnan(depth.disparity(u, v))) << u << " " << v;
        if (is_in_bar(u)) continue;
        ++shown;
        right += std::abs(depth.disparity(u, v) - 1.3) < 0.1;
        // Beside the bar fewer views count, in both backends alike.
        apart += std::abs(depth.confidence(u, v) - reference.confidence(u, v)) > 0.01;
      }
    EXPECT_GT(double(right), 0.97 * double(shown));
    EXPECT_LT(double(apart), 0.01 * double(shown));
  }
}

INSTANTIATE_TEST_SUITE_P(Presets, Masks, testing::Values("paper", "auto"));

}  // namespace
}  // namespace gigaray::testing_support
