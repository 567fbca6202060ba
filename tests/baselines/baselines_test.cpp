// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Every baseline does what its paper says on a scene with exact depth.
#include "baselines/baseline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "baselines/photo_consistency.h"
#include "gigaray/region_metrics.h"
#include "gigaray/synthetic.h"

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

/// Percentage of pixels off by more than half a pixel of the widest pair.
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

TEST_P(EveryBaseline, SaysWhatItIs) {
  const Baseline& baseline = GetParam();
  EXPECT_FALSE(baseline.title.empty());
  EXPECT_NE(baseline.reference.find_first_of("0123456789"), std::string::npos) << "no year";
  EXPECT_FALSE(baseline.parameters.empty());
}

TEST(Baselines, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const Baseline& baseline : all_baselines()) names.insert(baseline.name);
  EXPECT_EQ(names.size(), all_baselines().size());
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
  for (const Baseline& baseline : all_baselines()) {
    if (!baseline.name.starts_with("structure_tensor")) continue;
    const auto trials = baseline.trials({scene.light_field, view, {-1.1, 1.1}});
    ASSERT_EQ(trials.size(), 1u);
    const Estimate estimate = trials.front().run({});
    EXPECT_EQ(estimate.views.size(), 9u);
    EXPECT_LT(bad(estimate.disparity, scene.disparity[view]), 20) << baseline.name;
  }
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

TEST(Baselines, LargeDisparitiesAreSheared) {
  const SyntheticLightField scene = planes(9, 1, {2, 5});
  const int view = centre_view(scene.light_field);
  for (const Baseline& baseline : all_baselines()) {
    if (baseline.name != "structure_tensor") continue;
    const Estimate estimate = baseline.trials({scene.light_field, view, {1.9, 5.1}})[0].run({});
    EXPECT_LT(bad(estimate.disparity, scene.disparity[view]), 30);
  }
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

}  // namespace
}  // namespace gigaray::baselines
