// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/result.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "gigaray/workflows/depth.h"
#include "gigaray/workflows/masks.h"
#include "gigaray/workflows/novel_views.h"
#include "workflows_test.h"

namespace gigaray {
namespace {

using Result = WorkflowsTest;

bool same(const FloatMap& a, const FloatMap& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

TEST_F(Result, InMemoryIsThatOfItsFolder) {
  OpenedInput input = open_input({.path = walk()}, control);
  const auto depth = std::make_shared<const Reconstruction>(compute_depth(input, {}, control));
  write_depth_folder(input, *depth, {folder / "out"}, control);
  DepthScene computed(input, depth), opened({folder / "out"});
  EXPECT_EQ(computed.top_view(), opened.top_view());
  EXPECT_EQ(computed.views(), opened.views());
  for (const int view : opened.views()) {
    const DepthView& a = computed.view(view);
    const DepthView& b = opened.view(view);
    EXPECT_TRUE(same(a.inverse_depth, b.inverse_depth)) << view;
    EXPECT_TRUE(same(a.confidence, b.confidence)) << view;
    EXPECT_TRUE(a.picture == b.picture) << view;
  }
}

TEST_F(Result, MasksOfAPixelHoldIt) {
  OpenedInput input = open_input({.path = grid()}, control);
  const auto depth = std::make_shared<const Reconstruction>(compute_depth(input, {}, control));
  const DepthScene scene(input, depth);
  const SceneMasks masks(scene, {.at = PixelPlace{46, 31}});
  const Mask mask = masks.view(scene.top_view()).mask;
  EXPECT_EQ(mask(46, 31), 1);
  EXPECT_LT(std::count(mask.begin(), mask.end(), 1), std::ptrdiff_t(mask.size()));
  EXPECT_NE(refusal(ErrorCode::kInvalidArgument,
                    [&] {
                      SceneMasks(scene, {.at = PixelPlace{93, 0}});
                    })
                .find("`at` 93 0"),
            std::string::npos);
  refusal(ErrorCode::kInvalidArgument, [&] { SceneMasks(scene, {}); });
}

TEST_F(Result, NovelViewAtAViewIsNearThatView) {
  OpenedInput input = open_input({.path = grid()}, control);
  DepthScene scene(input,
                   std::make_shared<const Reconstruction>(compute_depth(input, {}, control)));
  const LeaveOneOut result = leave_one_out(scene, "centre", {}, control);
  constexpr double kLeast = 20;  // dB, of a small picture with fine texture
  EXPECT_GT(result.quality.psnr, kLeast);
  EXPECT_TRUE(result.took_part_in_depth);
  EXPECT_EQ(parse_path("-1,0;1,0", scene).size(), 2u);
  refusal(ErrorCode::kInvalidArgument, [&] { parse_path("centre", scene); });
  refusal(ErrorCode::kInvalidArgument, [&] { scene.left_out("nobody"); });
}

}  // namespace
}  // namespace gigaray
