// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Every baseline does what its paper says on a scene with exact depth.
#include "gigaray/baselines/baseline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "gigaray/baselines/photo_consistency.h"
#include "gigaray/core/region_metrics.h"
#include "gigaray/core/synthetic.h"

namespace gigaray::baselines {

void PrintTo(const Baseline& baseline, std::ostream* out) { *out << baseline.name; }

namespace {

SyntheticLightField planes(int views_s, int views_t, DisparityRange range = {-1, 1}) {
  SyntheticOptions options;
  options.scene = "planes";
  options.width = 121;
  options.height = 97;
  options.views_s = views_s;
  options.views_t = views_t;
  options.disparity = range;
  return render_synthetic(options, {});
}

/// Percentage of pixels off by more than an eighth of a pixel per view step.
double bad(const FloatMap& map, const FloatMap& truth) { return bad_pix(map, truth, 0.125, 8, {}); }

class EveryBaseline : public testing::TestWithParam<Baseline> {};

INSTANTIATE_TEST_SUITE_P(, EveryBaseline, testing::ValuesIn(all_baselines()),
                         [](const auto& info) { return info.param.name; });

TEST_P(EveryBaseline, FindsSlantedPlanes) {
  const SyntheticLightField scene = planes(9, 1);
  const int view = centre_view(scene.light_field);
  double best = 100;
  for (const Trial& trial : GetParam().trials({scene.light_field, view, {-1.1, 1.1}})) {
    const Estimate estimate = trial.run({});
    ASSERT_EQ(estimate.disparity.width(), 121);
    ASSERT_EQ(estimate.disparity.height(), 97);
    EXPECT_EQ(estimate.views.front(), view);
    EXPECT_GT(estimate.views.size(), 1u);
    best = std::min(best, bad(estimate.disparity, scene.disparity[view]));
  }
  EXPECT_LT(best, 20) << GetParam().name;
}

TEST_P(EveryBaseline, TheFirstAndTheLastViewOfARowToo) {
  // The last one has others to its left alone.
  const SyntheticLightField scene = planes(9, 1);
  for (const int view : {0, 8}) {
    double best = 100;
    for (const Trial& trial : GetParam().trials({scene.light_field, view, {-1.1, 1.1}}))
      best = std::min(best, bad(trial.run({}).disparity, scene.disparity[view]));
    EXPECT_LT(best, 30) << GetParam().name << ", view " << view;
  }
}

TEST_P(EveryBaseline, TwiceTheSame) {
  const SyntheticLightField scene = planes(5, 1);
  const Problem problem{scene.light_field, centre_view(scene.light_field), {-1.1, 1.1}};
  const std::vector<Trial> trials = GetParam().trials(problem);
  ASSERT_FALSE(trials.empty());
  const FloatMap first = trials.back().run({}).disparity, second = trials.back().run({}).disparity;
  for (std::size_t i = 0; i < first.size(); ++i)
    ASSERT_TRUE(first.data()[i] == second.data()[i] ||
                (std::isnan(first.data()[i]) && std::isnan(second.data()[i])));
}

TEST_P(EveryBaseline, FillsThePictureToItsRim) {
  const SyntheticLightField scene = planes(9, 1);
  const int view = centre_view(scene.light_field);
  const FloatMap map =
      GetParam().trials({scene.light_field, view, {-1.1, 1.1}}).back().run({}).disparity;
  for (const float d : map) ASSERT_TRUE(d >= -2.5f && d <= 2.5f) << d;
}

TEST_P(EveryBaseline, AColumnWillDoWhereThereIsNoRow) {
  const SyntheticLightField scene = planes(1, 9);
  const int view = centre_view(scene.light_field);
  double best = 100;
  for (const Trial& trial : GetParam().trials({scene.light_field, view, {-1.1, 1.1}}))
    best = std::min(best, bad(trial.run({}).disparity, scene.disparity[view]));
  EXPECT_LT(best, 25) << GetParam().name;
}

TEST_P(EveryBaseline, RowsOfAGridWithLittleParallaxAreKeptApart) {
  // Less than half a pixel from row to row.
  const SyntheticLightField scene = planes(5, 5, {-0.3, 0.3});
  const int view = centre_view(scene.light_field);
  const auto trials = GetParam().trials({scene.light_field, view, {-0.33, 0.33}});
  ASSERT_FALSE(trials.empty()) << GetParam().name;
  const std::vector<int> views = trials.front().run({}).views;
  for (const int other : views) {
    const View &a = scene.light_field.views[view], &b = scene.light_field.views[other];
    EXPECT_TRUE(a.s == b.s || a.t == b.t) << GetParam().name << ": " << b.name;
  }
}

TEST(Baselines, PairsAreOneTwoAndFourStepsApart) {
  const SyntheticLightField scene = planes(9, 1);
  const auto trials = all_baselines().front().trials({scene.light_field, 4, {-1.1, 1.1}});
  ASSERT_EQ(trials.size(), 3u);
  EXPECT_EQ(trials[0].run({}).views, (std::vector<int>{4, 5}));
  EXPECT_EQ(trials[1].run({}).views, (std::vector<int>{4, 6}));
  EXPECT_EQ(trials[2].run({}).views, (std::vector<int>{4, 8}));
}

TEST(Baselines, AGridGivesRowsAndColumns) {
  const SyntheticLightField scene = planes(5, 5);
  const int view = centre_view(scene.light_field);
  int tried = 0;
  for (const Baseline& baseline : all_baselines()) {
    if (!baseline.name.starts_with("structure_tensor")) continue;
    ++tried;
    const auto trials = baseline.trials({scene.light_field, view, {-1.1, 1.1}});
    ASSERT_EQ(trials.size(), 1u);
    const Estimate estimate = trials.front().run({});
    EXPECT_EQ(estimate.views.size(), 9u);
    EXPECT_LT(bad(estimate.disparity, scene.disparity[view]), 20) << baseline.name;
  }
  EXPECT_EQ(tried, 2);
}

TEST(Baselines, TwoViewsAreNoEpipolarPlaneImage) {
  const SyntheticLightField scene = planes(2, 1);
  for (const Baseline& baseline : all_baselines()) {
    const bool needs_many =
        baseline.name == "edge_lines" || baseline.name.starts_with("structure_tensor");
    EXPECT_EQ(baseline.trials({scene.light_field, 0, {-1.1, 1.1}}).empty(), needs_many)
        << baseline.name;
  }
}

class StructureTensor : public testing::Test {
 protected:
  static double bad_of(const LightField& light_field, const FloatMap& truth, DisparityRange range) {
    const auto tensor = std::ranges::find(all_baselines(), "structure_tensor", &Baseline::name);
    const int view = centre_view(light_field);
    return bad(tensor->trials({light_field, view, range}).at(0).run({}).disparity, truth);
  }
};

TEST_F(StructureTensor, ShearsLargeDisparities) {
  const SyntheticLightField scene = planes(9, 1, {2, 5});
  EXPECT_LT(bad_of(scene.light_field, scene.disparity[4], {1.9, 5.1}), 30);
}

TEST_F(StructureTensor, ShearsByViewsNotBySteps) {
  const SyntheticLightField scene = planes(17, 1);
  std::vector<int> odd;
  for (int i = 1; i < 17; i += 2) odd.push_back(i);
  EXPECT_LT(bad_of(without(scene.light_field, odd), scene.disparity[8], {-1.1, 1.1}), 20);
}

TEST(PhotoConsistency, IsLeastAtTheTruth) {
  const SyntheticLightField scene = planes(7, 3);
  const int view = centre_view(scene.light_field);
  FloatMap map = scene.disparity[view];
  const double right = photo_consistency(scene.light_field, view, map);
  for (float& d : map) d += 0.3f;
  const double wrong = photo_consistency(scene.light_field, view, map);
  EXPECT_LT(right, 4);
  EXPECT_GT(wrong, 2 * right);
  for (float& d : map) d = kNoEstimate;
  EXPECT_TRUE(std::isnan(photo_consistency(scene.light_field, view, map)));
}

TEST(PhotoConsistency, LeavesOutWhatPicturesDoNotShow) {
  const SyntheticLightField scene = planes(5, 1);
  // The left half of every picture is nonsense, and says so.
  std::vector<Image<std::uint16_t>> pictures;
  for (int i = 0; i < 5; ++i) {
    const Image<std::uint16_t> whole = read_view(scene.light_field, i);
    Image<std::uint16_t> masked(whole.width(), whole.height(), 4);
    for (int v = 0; v < whole.height(); ++v)
      for (int u = 0; u < whole.width(); ++u)
        for (int c = 0; c < 4; ++c) {
          const bool is_shown = u >= whole.width() / 2;
          masked(u, v, c) =
              is_shown ? (c == 3 ? 255 : whole(u, v, c)) : (c == 3 ? 0 : 97 * i % 256);
        }
    pictures.push_back(std::move(masked));
  }
  struct Masked : PixelSource {
    std::vector<Image<std::uint16_t>> pictures;
    Image<std::uint16_t> read(int view_idx) const override { return pictures[view_idx]; }
    bool has_mask() const override { return true; }
    int bit_depth() const override { return 8; }
  };
  auto source = std::make_shared<Masked>();
  source->pictures = std::move(pictures);
  LightField light_field = scene.light_field;
  light_field.pixels = source;
  EXPECT_LT(photo_consistency(light_field, 2, scene.disparity[2]), 4);
}

}  // namespace
}  // namespace gigaray::baselines
