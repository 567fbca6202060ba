// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Maps of posed views against each other.
#include "src/view_consensus.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>

#include "gigaray/core/parallel.h"
#include "gigaray/engine/calibration.h"
#include "support/cameras.h"
#include "support/errors.h"

namespace gigaray::testing_support {
namespace {

constexpr int kWidth = 61, kHeight = 43;
constexpr double kStep = 0.02;
constexpr float kSure = 0.4f, kDoubtful = 0.05f;  // contrast

/// Cameras side by side before a wall that stands across at depth 10, which is hypothesis 0.3.
class ViewConsensus : public testing::Test {
 protected:
  static constexpr double kFar = 1 / 13.0, kWall = 0.1, kNear = kFar + (kWall - kFar) / 0.3;
  static constexpr float kHere = 0.3f;

  explicit ViewConsensus(int views = 5) {
    for (int i = 0; i < views; ++i) {
      Camera camera = centred_camera(kWidth, kHeight, 60);
      camera.translation = {-0.5 * i, 0, 0};
      camera.inverse_depth = InverseDepthRange{kFar, kNear};
      cameras_.push_back(camera);
      active_.push_back(i);
    }
    maps_ = FinishedMaps(views, kWidth, kHeight, "");
    for (int i = 0; i < views; ++i) put(i, [](int, int) { return kHere; });
  }

  void put(int view, const std::function<float(int, int)>& hypothesis, float contrast = kSure) {
    StripMap<float> hypotheses(kWidth, {0, kHeight}), contrasts(kWidth, {0, kHeight});
    StripMap<std::int8_t> levels(kWidth, {0, kHeight});
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u) {
        hypotheses.row(v)[u] = hypothesis(u, v);
        contrasts.row(v)[u] = std::isnan(hypothesis(u, v)) ? kNoEstimate : contrast;
        levels.row(v)[u] = std::int8_t(u % 3);
      }
    maps_.put(view, hypotheses.view(), contrasts.view(), levels.view());
  }

  struct Row {
    std::vector<float> hypothesis = std::vector<float>(kWidth), confidence = hypothesis;
    std::vector<std::int8_t> level = std::vector<std::int8_t>(kWidth);
    bool operator==(const Row& other) const {
      const auto same = [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); };
      return std::ranges::equal(hypothesis, other.hypothesis, same) &&
             std::ranges::equal(confidence, other.confidence, same) && level == other.level;
    }
  };
  static Row row_of(const FinishedMaps& maps, int place, int v) {
    Row row;
    maps.read(place, v, row.hypothesis.data(), row.confidence.data(), row.level.data());
    return row;
  }
  FinishedMaps copy() const {
    FinishedMaps result(int(cameras_.size()), kWidth, kHeight, "");
    StripMap<float> hypotheses(kWidth, {0, kHeight}), contrasts(kWidth, {0, kHeight});
    StripMap<std::int8_t> levels(kWidth, {0, kHeight});
    for (int view = 0; view < int(cameras_.size()); ++view) {
      for (int v = 0; v < kHeight; ++v)
        maps_.read(view, v, hypotheses.row(v), contrasts.row(v), levels.row(v));
      result.put(view, hypotheses.view(), contrasts.view(), levels.view());
    }
    return result;
  }
  FinishedMaps agreed(std::size_t bytes_at_once = 128 << 20) const {
    return view_consensus(UnstructuredSampler(cameras_), active_, copy(), kStep, "", RunControl{},
                          bytes_at_once);
  }

  std::vector<Camera> cameras_;
  std::vector<int> active_;
  FinishedMaps maps_;
};

bool is_inside(int u, int v) { return u >= 25 && u < 35 && v >= 15 && v < 25; }

TEST_F(ViewConsensus, WhatAllSayStaysAndIsSure) {
  const FinishedMaps maps = agreed();
  for (int place = 0; place < 5; ++place) {
    const Row row = row_of(maps, place, 20);
    for (int u = 0; u < kWidth; ++u) {
      EXPECT_NEAR(row.hypothesis[u], kHere, 1e-5);
      EXPECT_GT(row.confidence[u], 0.97f);
      EXPECT_EQ(row.level[u], u % 3);
    }
  }
}

TEST_F(ViewConsensus, WhatOneViewSaysAloneGivesWay) {
  // Behind the wall, before it, and a little beside it.
  for (const float alone : {0.05f, 0.8f, kHere + 0.09f}) {
    put(2, [&](int u, int v) { return is_inside(u, v) ? alone : kHere; });
    const FinishedMaps maps = agreed();
    for (int u = 0; u < kWidth; ++u)
      EXPECT_NEAR(row_of(maps, 2, 20).hypothesis[u], kHere, 1e-4) << alone << " " << u;
    // It does no harm to the others, and they are less sure of it.
    for (int u = 0; u < kWidth; ++u)
      EXPECT_NEAR(row_of(maps, 1, 20).hypothesis[u], kHere, 1e-4) << alone << " " << u;
    EXPECT_LT(row_of(maps, 2, 20).confidence[30], row_of(maps, 2, 5).confidence[30]);
  }
}

TEST_F(ViewConsensus, OfWhatIsTheSameTheMeanIsTaken) {
  const float off = float(0.5 * kStep);
  put(2, [&](int, int) { return kHere + off; });
  const float here = row_of(agreed(), 2, 20).hypothesis[30];
  EXPECT_NEAR(here, kHere + off / 5, 1e-4) << "one of five views";
  put(
      2, [&](int, int) { return kHere + off; }, kDoubtful);
  EXPECT_NEAR(row_of(agreed(), 2, 20).hypothesis[30], kHere, 0.05 * off) << "doubtful";
}

TEST_F(ViewConsensus, DoubtfulViewsDontOutvoteASureOne) {
  for (int view = 0; view < 5; ++view)
    if (view != 2)
      put(
          view, [](int u, int v) { return u < 20 ? 0.6f + 0.1f * float(v % 3) : kHere; },
          kDoubtful);
  const Row row = row_of(agreed(), 2, 20);
  for (int u = 0; u < kWidth; ++u) EXPECT_NEAR(row.hypothesis[u], kHere, 1e-3) << u;
}

TEST_F(ViewConsensus, AnObjectBeforeTheWallStaysInEveryView) {
  // A card at depth 8, in the place where each view sees it.
  const float card = float((1 / 8.0 - kFar) / (kNear - kFar));
  const auto left = [&](int view) {
    return int(std::lround(UnstructuredSampler(cameras_).locate(2, view, {25, 20, card})->u));
  };
  for (int view = 0; view < 5; ++view)
    put(view, [&, from = left(view)](int u, int v) {
      return is_inside(u - from + 25, v) ? card : kHere;
    });
  const FinishedMaps maps = agreed();
  for (int view = 0; view < 5; ++view) {
    const Row row = row_of(maps, view, 20);
    for (int u = 0; u < kWidth; ++u) {
      const int in_card = u - left(view) + 25;
      // Whose pixels its edges are depends on how each view rounds.
      if (is_inside(in_card - 1, 20) != is_inside(in_card + 1, 20)) continue;
      EXPECT_NEAR(row.hypothesis[u], is_inside(in_card, 20) ? card : kHere, 1e-3)
          << view << " " << u;
    }
  }
}

TEST_F(ViewConsensus, ASteepFloorStaysExact) {
  // Four hypotheses from row to row; a rounded row would be off by two.
  const auto floor = [](int, int v) { return float(0.1 + 4 * kStep * (v - 12)); };
  for (int view = 0; view < 5; ++view) put(view, floor);
  // A speck in one view continues what is around it.
  put(2, [&](int u, int v) { return u == 30 && v == 20 ? 0.2f : floor(u, v); });
  const FinishedMaps maps = agreed();
  for (int view = 0; view < 5; ++view)
    for (const int v : {13, 20, 22}) {
      const Row row = row_of(maps, view, v);
      for (int u = 0; u < kWidth; ++u) {
        EXPECT_NEAR(row.hypothesis[u], floor(u, v), 0.05 * kStep) << view << " " << u << " " << v;
        EXPECT_GT(row.confidence[u], u == 30 && v == 20 ? 0.6f : 0.9f)
            << view << " " << u << " " << v;
      }
    }
}

TEST_F(ViewConsensus, WhatIsFarBeyondTheRangeIsLeftAlone) {
  put(2, [](int, int) { return 1.6f; });
  const Row row = row_of(agreed(), 2, 20);
  EXPECT_EQ(row.hypothesis[30], 1.6f);
  EXPECT_EQ(row.confidence[30], calibrated_confidence(kSure, LightFieldKind::kUnstructured));
}

TEST_F(ViewConsensus, WhatHasNoEstimateGetsNone) {
  put(2, [](int u, int v) { return is_inside(u, v) ? kNoEstimate : kHere; });
  const Row row = row_of(agreed(), 2, 20);
  for (int u = 0; u < kWidth; ++u) {
    EXPECT_EQ(std::isnan(row.hypothesis[u]), is_inside(u, 20));
    EXPECT_EQ(std::isnan(row.confidence[u]), is_inside(u, 20));
  }
}

TEST_F(ViewConsensus, WithNobodyToAskAllStaysAsItWas) {
  cameras_[4].translation.z() = -1000;
  cameras_[4].translation.x() = 1000;
  const Row row = row_of(agreed(), 4, 20);
  EXPECT_EQ(row.hypothesis[30], kHere);
  EXPECT_EQ(row.confidence[30], calibrated_confidence(kSure, LightFieldKind::kUnstructured));
}

TEST_F(ViewConsensus, BandsAndThreadsChangeNoBit) {
  put(1, [](int u, int v) { return 0.2f + 0.01f * float((7 * u + 3 * v) % 29); });
  put(
      3, [](int u, int v) { return 0.2f + 0.01f * float((5 * u + 11 * v) % 31); }, 0.15f);
  const FinishedMaps expected = agreed();
  for (const std::size_t bytes : {std::size_t(1), std::size_t(60000)}) {
    set_num_threads(bytes == 1 ? 1 : 3);
    const FinishedMaps actual = agreed(bytes);
    set_num_threads(0);
    for (int place = 0; place < 5; ++place)
      for (int v = 0; v < kHeight; ++v)
        EXPECT_EQ(row_of(actual, place, v), row_of(expected, place, v)) << place << " " << v;
  }
}

TEST_F(ViewConsensus, StopsWhenAsked) {
  RunControl control;
  control.cancel();
  expect_error(ErrorCode::kCancelled, {"stopped"}, [&] {
    view_consensus(UnstructuredSampler(cameras_), active_, copy(), kStep, "", control);
  });
}

}  // namespace
}  // namespace gigaray::testing_support
