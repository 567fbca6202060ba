// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// What maps of half the size say about where to search.
#include "src/coarse_guide.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/cache_fixture.h"
#include "gigaray/engine/estimator.h"
#include "gigaray/engine/reconstruct.h"
#include "support/depth_result.h"
#include "support/errors.h"
#include "support/posed_field.h"

namespace gigaray::testing_support {
namespace {

constexpr int kWidth = 121, kHeight = 87, kHalfWidth = 61, kHalfHeight = 44;
constexpr HypothesisRange kRange{0, 1, 201};
constexpr float kSure = 0.9f, kDoubtful = 0.4f;

struct Told {
  float hypothesis, confidence;
};

CoarseGuide guide_of(const std::function<Told(int, int)>& told) {
  FinishedMaps maps(1, kHalfWidth, kHalfHeight, "");
  StripMap<float> hypotheses(kHalfWidth, {0, kHalfHeight}), confidences = hypotheses;
  const StripMap<std::int8_t> levels(kHalfWidth, {0, kHalfHeight});
  for (int v = 0; v < kHalfHeight; ++v)
    for (int u = 0; u < kHalfWidth; ++u) {
      hypotheses.row(v)[u] = told(u, v).hypothesis;
      confidences.row(v)[u] = told(u, v).confidence;
    }
  maps.put(0, hypotheses, confidences, levels);
  return CoarseGuide(std::move(maps));
}

StripMap<HypothesisBounds> bounds_of(const CoarseGuide& guide, RowRange rows = {0, kHeight}) {
  return guide.bounds(0, kWidth, rows, kRange);
}

bool holds(const HypothesisBounds& bounds, float hypothesis) {
  const double index = hypothesis / kRange.step();
  return bounds.first <= index && index <= bounds.last;
}
int size_of(const HypothesisBounds& bounds) { return bounds.last - bounds.first + 1; }

TEST(CoarseGuide, WhatIsSureIsSearchedAroundIt) {
  const auto bounds = bounds_of(guide_of([](int, int) { return Told{0.4f, kSure}; }));
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) {
      ASSERT_TRUE(holds(bounds.row(v)[u], 0.4f - 0.02f) && holds(bounds.row(v)[u], 0.4f + 0.02f));
      ASSERT_LT(size_of(bounds.row(v)[u]), 20) << u << ", " << v;
    }
}

TEST(CoarseGuide, WhereNothingIsSureAnEstimateIsSearchedFartherAround) {
  const auto bounds = bounds_of(guide_of([](int, int) { return Told{0.4f, kDoubtful}; }));
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) {
      ASSERT_TRUE(holds(bounds.row(v)[u], 0.4f - 0.05f) && holds(bounds.row(v)[u], 0.4f + 0.05f));
      ASSERT_LT(size_of(bounds.row(v)[u]), 40) << u << ", " << v;
    }
}

TEST(CoarseGuide, NoEstimateMeansTheWholeRange) {
  const auto bounds = bounds_of(guide_of([](int, int) { return Told{kNoEstimate, kNoEstimate}; }));
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u)
      ASSERT_EQ(bounds.row(v)[u], (HypothesisBounds{0, 200})) << u << ", " << v;
}

TEST(CoarseGuide, BesideASilhouetteBothSurfacesAreSearched) {
  const auto bounds = bounds_of(guide_of([](int u, int) {
    return Told{u < 30 ? 0.2f : 0.8f, kSure};
  }));
  for (const int u : {57, 59, 60, 63}) {
    EXPECT_TRUE(holds(bounds.row(40)[u], 0.2f)) << u;
    EXPECT_TRUE(holds(bounds.row(40)[u], 0.8f)) << u;
  }
  EXPECT_FALSE(holds(bounds.row(40)[40], 0.8f));
  EXPECT_FALSE(holds(bounds.row(40)[80], 0.2f));
}

TEST(CoarseGuide, DoubtIsSearchedBetweenWhatIsSureNearby) {
  const auto is_doubtful = [](int u, int v) {
    return std::abs(u - 30) < 5 && std::abs(v - 20) < 5;
  };
  const auto bounds = bounds_of(guide_of([&](int u, int v) {
    return is_doubtful(u, v) ? Told{0.9f, kDoubtful} : Told{u < 30 ? 0.3f : 0.5f, kSure};
  }));
  const HypothesisBounds& inside = bounds.row(40)[60];
  for (const float likely : {0.3f, 0.5f, 0.9f}) EXPECT_TRUE(holds(inside, likely)) << likely;
  EXPECT_FALSE(holds(inside, 0.1f));
}

TEST(CoarseGuide, TellsARowTheSameWhateverItsOthers) {
  const CoarseGuide guide = guide_of([](int u, int v) {
    return Told{0.5f + 0.3f * std::sin(0.3f * float(u * v)), (u + v) % 3 > 0 ? kSure : kDoubtful};
  });
  const auto all = bounds_of(guide);
  const auto between = guide.hypotheses(0, kWidth, {0, kHeight});
  for (const RowRange rows : {RowRange{0, 1}, RowRange{17, 86}, RowRange{86, 87}}) {
    const auto some = bounds_of(guide, rows);
    const auto some_between = guide.hypotheses(0, kWidth, rows);
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < kWidth; ++u) {
        ASSERT_EQ(some.row(v)[u], all.row(v)[u]) << u << ", " << v;
        ASSERT_EQ(some_between.row(v)[u], between.row(v)[u]) << u << ", " << v;
      }
  }
}

TEST(CoarseGuide, GoesOnBetweenItsPixels) {
  const auto slanted = [](double u, double v) { return float(0.1 + 0.004 * u + 0.002 * v); };
  const auto full = guide_of([&](int u, int v) {
                      return Told{slanted(2 * u, 2 * v), kSure};
                    }).hypotheses(0, kWidth, {0, kHeight});
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) ASSERT_NEAR(full.row(v)[u], slanted(u, v), 1e-6);
}

class GuidedRun : public testing::Test {
 protected:
  static constexpr int kSize = 128;

  GuidedRun() {
    const std::vector<View> grid = grid_of_views(3, 2);
    field_ = posed_field(cameras_around(grid, kSize + 9, kSize), grid);
    options_ = auto_options();
    options_.hypotheses = 64;
    options_.coarse_first = kSize;
  }
  Reconstruction run(const DepthOptions& options, const std::string& backend = "opencl") const {
    return reconstruct(field_.light_field, options, {backend, ""}, RunControl{});
  }
  /// Share of a view's pixels whose depth is right within 1 %.
  double within(Reconstruction& result, int view) const {
    const FloatMap found = result.view(view).disparity;
    const FloatMap& truth = field_.depth[view];
    int right = 0;
    for (int v = 0; v < truth.height(); ++v)
      for (int u = 0; u < truth.width(); ++u)
        right += std::abs(1 / found(u, v) - truth(u, v)) < 0.01 * truth(u, v);
    return right / double(truth.size());
  }
  PosedField field_;
  DepthOptions options_;
};

TEST_F(GuidedRun, FindsWhatARunWithoutItFinds) {
  DepthOptions alone = options_;
  alone.coarse_first = 0;
  Reconstruction guided = run(options_), unguided = run(alone);
  for (const int view : unguided.views()) {
    EXPECT_GT(within(unguided, view), 0.9);
    EXPECT_GT(within(guided, view), within(unguided, view) - 0.01) << "view " << view;
  }
}

TEST_F(GuidedRun, ReferenceAgrees) {
  options_.hypotheses = 24;
  options_.support.radius = options_.support.radius_in_doubt = 2;
  Reconstruction opencl = run(options_), reference = run(options_, "reference");
  for (const int view : opencl.views())
    EXPECT_NEAR(within(opencl, view), within(reference, view), 0.01) << "view " << view;
}

TEST_F(GuidedRun, NeitherMemoryNorPartitionsChangeTheResult) {
  Reconstruction expected = run(options_);
  DepthOptions little = options_;
  little.memory_bytes = 1.05 * least_memory_bytes(field_.light_field, options_);
  const Device device = Device::open();
  const Estimator two({device, device});
  const RunControl control;
  const DepthResult result = all_of(expected);
  expect_identical(all_of(run(little)), result, "little memory");
  expect_identical(all_of(two.reconstruct(field_.light_field, options_, control)), result,
                   "two partitions");
}

TEST_F(GuidedRun, OneViewAloneIsSearchedAsEver) {
  options_.views = {2};
  DepthOptions alone = options_;
  alone.coarse_first = 0;
  expect_identical(all_of(run(options_)), all_of(run(alone)), "one view");
}

TEST_F(GuidedRun, SaysHowFarItIsAndStopsWhenAsked) {
  std::vector<std::string> stages;
  RunControl control;
  control.on_progress = [&](const std::string& stage, double, double) {
    if (stages.empty() || stages.back() != stage) stages.push_back(stage);
    if (stage.find(", level 0") != std::string::npos) control.cancel();
  };
  expect_error(ErrorCode::kCancelled, {"stopped"}, [&] {
    reconstruct(field_.light_field, options_, {"opencl", ""}, control);
  });
  ASSERT_FALSE(stages.empty());
  EXPECT_EQ(stages.back(), "69x64, level 0");
}

}  // namespace
}  // namespace gigaray::testing_support
