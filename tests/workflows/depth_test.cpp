// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/depth.h"

#include <algorithm>
#include <cmath>

#include "gigaray/adapters/maps.h"
#include "gigaray/workflows/evaluate.h"
#include "gigaray/workflows/result.h"
#include "workflows_test.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

using Depth = WorkflowsTest;

bool same(const FloatMap& a, const FloatMap& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

TEST_F(Depth, OfAFolderIsThatOfTheMapsItWrites) {
  OpenedInput input = open_input({.path = grid()}, control);
  const Reconstruction result = compute_depth(input, {.views = "centre"}, control);
  const DepthReport report = write_depth_folder(input, result, {folder / "out"}, control);
  EXPECT_EQ(report.num_views, 1);
  const int centre = centre_view(input.light_field);
  EXPECT_TRUE(
      same(read_float_map(folder / "out" / "disparity.pfm"), result.view(centre).disparity));
}

TEST_F(Depth, FromPicturesToAFolderIsTheSame) {
  const fs::path place = grid();
  OpenedInput input = open_input({.path = place}, control);
  const Reconstruction result = compute_depth(input, {}, control);
  const DepthReport report = compute_depth_folder({.path = place}, {}, {folder / "out"}, control);
  EXPECT_EQ(report.num_views, 9);
  for (const int view : result.views()) {
    const std::string& name = input.light_field.views[std::size_t(view)].name;
    EXPECT_TRUE(
        same(read_float_map(folder / "out" / name / "disparity.pfm"), result.view(view).disparity))
        << name;
  }
}

TEST_F(Depth, IsNearTheTruthByItsScores) {
  const fs::path place = grid();
  compute_depth_folder({.path = place}, {.views = "centre"}, {folder / "out"}, control);
  const ScoreTable table =
      evaluate({.estimates = {folder / "out"}, .truth = place, .choice = {.border = 4}}, control);
  ASSERT_EQ(table.rows.size(), 1u);
  const auto& scores = table.rows.front().scores;
  const auto bad = std::ranges::find(scores, "BadPix0.07", &Score::name);
  ASSERT_NE(bad, scores.end());
  constexpr double kMostBad = 45;  // % of so small a picture
  EXPECT_LT(bad->value, kMostBad);
}

TEST_F(Depth, FieldsThatCantBeMeantAreNamed) {
  OpenedInput input = open_input({.path = grid()}, control);
  const auto prepare = [&](const DepthRequest& request) {
    return refusal(ErrorCode::kInvalidArgument, [&] { prepare_depth(input, request, control); });
  };
  EXPECT_NE(prepare({.distances = DistanceRange{3, 1}}).find("`distances` 3 1"), std::string::npos);
  EXPECT_NE(prepare({.views = "nobody"}).find("nobody"), std::string::npos);
  EXPECT_NE(
      refusal(ErrorCode::kInvalidArgument,
              [&] { open_input({.path = folder / "grid", .rig = {.focal_px = 0.5}}, control); })
          .find("`focal_px` 0.5"),
      std::string::npos);
  EXPECT_NE(refusal(ErrorCode::kBadInput, [&] { open_input({.path = folder / "no"}, control); })
                .find("no"),
            std::string::npos);
}

TEST_F(Depth, APlaceThatIsTakenShowsBeforeTheWork) {
  const fs::path place = grid();
  refusal(ErrorCode::kInvalidArgument,
          [&] { compute_depth_folder({.path = place}, {}, {place}, control); });
}

}  // namespace
}  // namespace gigaray
