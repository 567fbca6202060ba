// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "src/memory_plan.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "gigaray/samplers/unstructured_sampler.h"
#include "support/analytic_field.h"
#include "support/cameras.h"
#include "support/errors.h"

namespace gigaray {
namespace {

using namespace testing_support;

constexpr double kMiB = 1 << 20;
constexpr HypothesisRange kHypotheses{-1, 2, 86};

/// A large light field of which no pixel is read.
LightField described(std::vector<View> views, int width, int height, int bit_depth = 8) {
  LightField light_field;
  light_field.kind = kind_from_positions(views);
  light_field.width = width;
  light_field.height = height;
  light_field.views = std::move(views);
  light_field.pixels = pixels_in_memory({}, bit_depth);
  return light_field;
}

MemoryPlan plan(const LightField& light_field, double mib, const std::string& preset = "paper") {
  DepthOptions options = preset_options(preset);
  options.memory_bytes = mib * kMiB;
  options.work_folder = "work";
  return plan_memory(light_field, options, kHypotheses, DeviceLimits{});
}

TEST(LevelShapes, HalveAndRoundUpUntilTenPixels) {
  const auto shapes = level_shapes(93, 145, true);
  const std::pair<int, int> expected[] = {{93, 145}, {47, 73}, {24, 37}, {12, 19}};
  ASSERT_EQ(shapes.size(), std::size(expected));
  for (int i = 0; i < int(shapes.size()); ++i) {
    EXPECT_EQ(shapes[i].level, i);
    EXPECT_EQ(std::pair(shapes[i].width, shapes[i].height), expected[i]);
  }
  EXPECT_EQ(level_shapes(93, 145, false).size(), 1u);
  EXPECT_EQ(level_shapes(7, 5, true).size(), 1u);
  EXPECT_EQ(level_shapes(20, 1000, true).size(), 2u);
}

TEST(MemoryPlan, ForecastObeysTheLimit) {
  const LightField fields[] = {
      described(row_of_views(100), 1920, 1080), described(row_of_views(50), 352, 240),
      described(row_of_views(100), 5616, 3744), described(grid_of_views(9, 9), 512, 512, 16)};
  for (const LightField& light_field : fields)
    for (const char* preset : {"paper", "auto"})
      for (const double mib : {600.0, 1024.0, 2048.0, 8192.0, 32768.0}) {
        MemoryPlan result;
        try {
          result = plan(light_field, mib, preset);
        } catch (const Error& error) {
          EXPECT_EQ(error.code(), ErrorCode::kOutOfMemory);
          EXPECT_LE(mib, 2048) << light_field.width;
          continue;
        }
        EXPECT_LE(result.forecast.memory_bytes, mib * kMiB);
        EXPECT_EQ(result.forecast.disk_bytes > 0, result.work_folder == "work");
        const LevelPlan& first = result.levels.front();
        EXPECT_GE(result.forecast.bands * first.band_rows, light_field.height);
        EXPECT_LT((result.forecast.bands - 1) * first.band_rows, light_field.height);
        for (const LevelPlan& level : result.levels) {
          EXPECT_GE(level.band_rows, 1);
          EXPECT_LE(level.band_rows, level.shape.height);
        }
      }
}

TEST(MemoryPlan, HundredViewsOfTwoMegapixelsFitIntoOneGiB) {
  const LightField light_field = described(row_of_views(100), 1920, 1080);
  for (const char* preset : {"paper", "auto"}) {
    const Forecast forecast = plan(light_field, 1024, preset).forecast;
    EXPECT_GT(forecast.bands, 1);
    EXPECT_GT(forecast.disk_bytes, 0);
    EXPECT_GT(forecast.memory_all_bytes, 1024 * kMiB);
  }
}

TEST(MemoryPlan, MoreMemoryMeansNoMoreBands) {
  const LightField light_field = described(row_of_views(100), 1920, 1080);
  int last = light_field.height;
  for (double mib = 600; mib < 40000; mib *= 1.5) {
    const MemoryPlan result = plan(light_field, mib);
    if (result.work_folder.empty()) break;  // in memory fewer rows are left for a band
    EXPECT_LE(result.forecast.bands, last);
    last = result.forecast.bands;
  }
  EXPECT_LT(last, light_field.height);
}

TEST(MemoryPlan, PlentyOfMemoryNeedsNoFile) {
  const MemoryPlan result = plan(described(grid_of_views(9, 9), 512, 512), 64 * 1024);
  EXPECT_TRUE(result.work_folder.empty());
  EXPECT_EQ(result.forecast.disk_bytes, 0);
}

TEST(MemoryPlan, TheHaloHoldsEveryWindow) {
  for (const char* preset : {"paper", "auto"}) {
    DepthOptions options = preset_options(preset);
    options.winner.median_radius = 8;
    options.edge.radius = 16;
    const LightField light_field = described(row_of_views(9), 200, 200);
    for (const LevelPlan& level :
         plan_memory(light_field, options, kHypotheses, DeviceLimits{}).levels) {
      EXPECT_GE(level.halo, options.winner.median_radius);
      EXPECT_GE(level.halo, options.edge.radius + 2)
          << "edges of the rows that the opening looks at";
      EXPECT_GE(level.halo, options.support.radius + 3) << "with gradients and interpolation taps";
      EXPECT_GE(level.halo, options.support.slanted ? kSlopeReach : 0);
      EXPECT_GE(level.halo, 3 + 1) << "downsampling";
    }
  }
}

TEST(MemoryPlan, FewerViewsThatKeepDepthTakeLess) {
  const LightField light_field = described(grid_of_views(9, 9), 512, 512);
  DepthOptions options = paper_options();
  options.memory_bytes = 64e9;
  const double all =
      plan_memory(light_field, options, kHypotheses, DeviceLimits{}).forecast.memory_all_bytes;
  options.views = {40};
  EXPECT_LT(
      plan_memory(light_field, options, kHypotheses, DeviceLimits{}).forecast.memory_all_bytes,
      all);
}

TEST(MemoryPlan, ABandInTheHostsMemoryIsModerate) {
  const LightField many = described(grid_of_views(17, 17), 1024, 1024);
  DepthOptions options = auto_options();
  options.support.fill_hidden = false;  // as prepared by reconstruct(): there are more views
  options.views = {144};
  options.memory_bytes = 64e9;
  const MemoryPlan plenty = plan_memory(many, options, kHypotheses, {0, 16e9, true});
  EXPECT_EQ(plenty.place, Place::kDevice);
  EXPECT_GT(plenty.forecast.bands, 1);
  EXPECT_LT(plenty.forecast.memory_bytes, 4800 * kMiB);
  for (const LevelPlan& level : plenty.levels) {
    EXPECT_GT(level.window_rows, 0) << "rows are loaded once";
    EXPECT_TRUE(level.keeps_scores || level.shape.level > 0);
    EXPECT_GE(level.loaded_rows, level.window_rows);
  }
  // Less memory: strips take less, and bands are swept still.
  options.memory_bytes = plenty.forecast.memory_bytes - 100 * kMiB;
  const MemoryPlan less = plan_memory(many, options, kHypotheses, {0, 16e9, true});
  EXPECT_EQ(less.place, Place::kDevice);
  EXPECT_GT(less.levels.front().window_rows, 0);
  options.memory_bytes = 64e9;
  options.views = {40};
  const LightField few = described(grid_of_views(9, 9), 512, 512);
  EXPECT_EQ(plan_memory(few, options, kHypotheses, {0, 16e9, true}).forecast.bands, 1);
}

TEST(MemoryPlan, WhatTheCallerTakesCounts) {
  const LightField light_field = described(row_of_views(20), 640, 480);
  DepthOptions options = auto_options();
  options.memory_bytes = 64e9;
  const double alone =
      plan_memory(light_field, options, kHypotheses, DeviceLimits{}).forecast.memory_bytes;
  options.memory_beside = 100 * kMiB;
  EXPECT_DOUBLE_EQ(
      plan_memory(light_field, options, kHypotheses, DeviceLimits{}).forecast.memory_bytes,
      alone + 100 * kMiB);
  options.memory_bytes = alone + 50 * kMiB;
  EXPECT_LE(plan_memory(light_field, options, kHypotheses, DeviceLimits{}).forecast.memory_bytes,
            options.memory_bytes);
}

TEST(MemoryPlan, AnImpossibleLimitSaysWhatItTakes) {
  const LightField light_field = described(row_of_views(100), 1920, 1080);
  for (const char* preset : {"paper", "auto"}) {
    std::string line;
    try {
      plan(light_field, 100, preset);
    } catch (const Error& error) {
      line = error.what();
    }
    const auto at = line.find("at least ");
    ASSERT_NE(at, std::string::npos) << line;
    const double least = std::stod(line.substr(at + 9));
    EXPECT_NO_THROW(plan(light_field, least, preset)) << line;
    EXPECT_THROW(plan(light_field, 0.97 * least, preset), Error) << line;
  }
  expect_error(ErrorCode::kOutOfMemory, {"100 MiB", "100 views", "at least"},
               [&] { plan(light_field, 100); });
}

/// Cameras that look ahead, `step` scene units apart down a line.
LightField column_of_cameras(int num_views, double step) {
  LightField light_field = described(row_of_views(num_views), 2048, 1536);
  light_field.kind = LightFieldKind::kUnstructured;
  for (int i = 0; i < num_views; ++i) {
    Camera camera = centred_camera(2048, 1536, 2458);
    camera.translation = {0, -step * i, 0};
    camera.inverse_depth = InverseDepthRange{0.4, 1};
    light_field.cameras.push_back(camera);
  }
  return light_field;
}

TEST(MemoryPlan, UnstructuredViewsThatReachFarSayWhatHelps) {
  DepthOptions options = auto_options();
  options.memory_bytes = 16384 * kMiB;
  options.work_folder = "work";
  const HypothesisRange hypotheses{0, 1, 64};
  LightField near = column_of_cameras(100, 0.0005);
  EXPECT_LE(plan_memory(near, options, hypotheses, DeviceLimits{}).forecast.bands, 16);
  LightField far = column_of_cameras(100, 0.002);
  expect_error(ErrorCode::kOutOfMemory, {"DepthOptions::most_partners", "smaller pictures"},
               [&] { plan_memory(far, options, hypotheses, DeviceLimits{}); });
  far.most_partners = 20;
  EXPECT_NO_THROW(plan_memory(far, options, hypotheses, DeviceLimits{}));
}

TEST(MemoryPlan, EstimatesThatABandReachesFitIntoOneBuffer) {
  LightField light_field = column_of_cameras(100, 0.0005);
  light_field.most_partners = 8;  // little of a band, and all views get depth
  DepthOptions options = auto_options();
  options.memory_bytes = 16384 * kMiB;
  options.work_folder = "work";
  const double largest = 400 * kMiB;
  const HypothesisRange hypotheses{0, 1, 64};
  const MemoryPlan plan = plan_memory(light_field, options, hypotheses, {0, largest, true});
  ASSERT_NE(plan.place, Place::kDevice);
  const int rows = plan.levels.front().band_rows, height = light_field.height;
  const UnstructuredSampler sampler(light_field.cameras, light_field.most_partners);
  for (int view = 0; view < light_field.num_views(); ++view)
    for (int v = 0; v < height; v += rows) {
      const RowRange band{v, std::min(v + rows, height)};
      const double reached = sampler.rows_needed(view, band, hypotheses, height).size();
      ASSERT_LE(reached * light_field.width * 100 * sizeof(PackedEstimate), 1.05 * largest);
    }
}

TEST(MemoryPlan, FilesOnlyWhereMemoryDoesNotHoldTheStores) {
  // 4K, 50 views: one buffer of the device holds few rows of them, memory holds all.
  const LightField light_field = described(row_of_views(50), 3840, 2160);
  DepthOptions options = preset_options("auto");
  options.memory_bytes = 1e12;
  const MemoryPlan small_buffers =
      plan_memory(light_field, options, kHypotheses, {0, 1800 * kMiB, true});
  EXPECT_GT(small_buffers.forecast.bands, 4);
  EXPECT_EQ(small_buffers.forecast.disk_bytes, 0);
  const MemoryPlan large_buffers =
      plan_memory(light_field, options, kHypotheses, {1e12, 1e12, false});
  EXPECT_EQ(large_buffers.forecast.bands, 1);
  EXPECT_EQ(large_buffers.place, Place::kDevice);
}

TEST(MemoryPlan, ADeviceWithMemoryOfItsOwnIsPlannedByIt) {
  const LightField light_field = described(grid_of_views(9, 9), 1024, 1024);
  DepthOptions options = preset_options("auto");
  options.memory_bytes = 64e9;
  const double gib = 1024 * kMiB;
  // All of it fits; then the stores stay with the host; then little of a band does.
  const MemoryPlan large =
      plan_memory(light_field, options, kHypotheses, {80 * gib, 20 * gib, false});
  EXPECT_EQ(large.place, Place::kDevice);
  EXPECT_EQ(large.forecast.bands, 1);
  const MemoryPlan middle = plan_memory(light_field, options, kHypotheses, {3 * gib, gib, false});
  EXPECT_EQ(middle.place, Place::kHost);
  EXPECT_GT(middle.forecast.bands, 1);
  EXPECT_GT(middle.forecast.memory_bytes, large.forecast.memory_bytes) << "of the host";
  options.memory_bytes = 0.9e9;
  EXPECT_EQ(plan_memory(light_field, options, kHypotheses, {80 * gib, 20 * gib, false}).place,
            Place::kFile)
      << "81 finished maps end with the host";
  options.memory_bytes = 1.3e9;
  EXPECT_EQ(plan_memory(light_field, options, kHypotheses, {3 * gib, gib, false}).place,
            Place::kFile);
  options.memory_bytes = 64e9;
  expect_error(ErrorCode::kOutOfMemory, {"its memory"}, [&] {
    plan_memory(light_field, options, kHypotheses, {0.3 * gib, 0.1 * gib, false});
  });
}

}  // namespace
}  // namespace gigaray
