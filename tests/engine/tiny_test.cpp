// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Every kernel and whole runs, as small as they go: what scripts/oclgrind looks at, where a kernel
// is interpreted instruction by instruction.
#include <gtest/gtest.h>

#include "engine/lane_check.h"
#include "engine/masked_pictures.h"
#include "gigaray/engine/reconstruct.h"
#include "support/depth_result.h"

namespace gigaray::testing_support {
namespace {

constexpr ParityCase kSize{21, 19, {16, 18}, BandEncoding::kBits16};
constexpr int kHypotheses = 6;

template <class S>
class Tiny : public testing::Test {
 protected:
  /// Several groups in a row of so few pixels.
  static opencl::TuningOverrides grouped() {
    opencl::TuningOverrides tuning = tuned_for_a_gpu();
    for (auto& [kernel, parameters] : tuning) parameters["GROUP"] = 8;
    return tuning;
  }
  static opencl::TuningOverrides in_lanes() {
    opencl::TuningOverrides tuning;
    for (const auto& [kernel, parameters] : tuned_for_a_gpu()) {
      tuning[kernel] = {{"LANES", 4}, {"GROUP", 2}};
      if (parameters.contains("STAGE")) tuning[kernel]["STAGE"] = 1;
      if (parameters.contains("UNITS")) tuning[kernel]["UNITS"] = 2;
      if (parameters.contains("HYPOTHESES")) tuning[kernel]["HYPOTHESES"] = 3;
      if (parameters.contains("VECTORS")) tuning[kernel]["VECTORS"] = 2;
    }
    return tuning;
  }
};
using Samplers = testing::Types<EpiSampler, GridSampler, UnstructuredSampler>;
TYPED_TEST_SUITE(Tiny, Samplers);

TYPED_TEST(Tiny, OneLaneInGroups) {
  LaneCheck<TypeParam> check(", tiny", this->grouped(), kSize, kHypotheses);
  check.paper();
  check.automatic();
}

TYPED_TEST(Tiny, FourLanes) {
  LaneCheck<TypeParam> check(", tiny lanes", this->in_lanes(), kSize, kHypotheses);
  check.paper();
  check.automatic();
}

class TinyRuns : public testing::TestWithParam<std::tuple<const char*, bool>> {};

TEST_P(TinyRuns, AllViewsOfMaskedPictures) {
  const auto [preset, is_grid] = GetParam();
  AnalyticField field =
      analytic_field(25, 21, is_grid ? grid_of_views(2, 2) : row_of_views(3), {{0.6, 5}});
  field.light_field.pixels = with_bar(field.light_field.pixels, 9, 12);
  DepthOptions options = preset_options(preset);
  options.disparity = {-0.5, 1.5};
  options.hypotheses = 9;
  Reconstruction result = reconstruct(field.light_field, options, {"opencl", ""}, RunControl{});
  const ViewDepth depth = result.view(1);
  int right = 0, shown = 0;
  for (int v = 0; v < 21; ++v)
    for (int u = 0; u < 25; ++u) {
      ASSERT_EQ(u >= 9 && u < 12, std::isnan(depth.disparity(u, v))) << u << " " << v;
      if (u >= 9 && u < 12) continue;
      ++shown;
      right += std::abs(depth.disparity(u, v) - 0.6) < 0.3;
    }
  EXPECT_GT(2 * right, shown);
}

INSTANTIATE_TEST_SUITE_P(Presets, TinyRuns,
                         testing::Combine(testing::Values("paper", "auto"), testing::Bool()));

}  // namespace
}  // namespace gigaray::testing_support
