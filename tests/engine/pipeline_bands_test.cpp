// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// The result does not depend on memory, files, bands or strips, and is the same every time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/cache_fixture.h"
#include "engine/masked_pictures.h"
#include "engine/planned_run.h"
#include "src/band_ring.h"
#include "support/analytic_field.h"
#include "support/depth_result.h"
#include "support/memory_limits.h"
#include "support/posed_field.h"

namespace gigaray::testing_support {
namespace {

constexpr int kHypotheses = 31;

DepthResult run(const LightField& light_field, const DepthOptions& options,
                const std::string& backend = "opencl") {
  const RunControl control;
  Reconstruction result = reconstruct(light_field, options, {backend, ""}, control);
  return all_of(result);
}

struct Job {
  const char* name;
  const char* preset;
  bool is_4d;
};

class PipelineBands : public testing::TestWithParam<Job> {};

TEST_P(PipelineBands, MemoryAndFilesDontChangeTheResult) {
  const AnalyticField field = GetParam().is_4d ? card_before_wall(grid_of_views(3, 3), 41, 231)
                                               : card_before_wall(irregular_row(), 93, 131);
  DepthOptions options = small_job(GetParam().preset, kHypotheses);
  const ScopedFolder work;
  options.work_folder = work.path;
  options.memory_bytes = 4e9;
  ASSERT_EQ(forecast(field.light_field, options).bands, 1);
  ASSERT_EQ(forecast(field.light_field, options).disk_bytes, 0);
  const DepthResult expected = run(field.light_field, options);

  // Every distinct plan between the least memory and plenty.
  std::set<std::pair<int, bool>> plans;
  bool on_disk = false;
  const double least = least_limit_by_trial(field.light_field, options);
  for (double more = 0; more < 16e6 && plans.size() < 5; more = more * 1.6 + 1e5) {
    options.memory_bytes = least + more;
    const Forecast plan = forecast(field.light_field, options);
    EXPECT_LE(plan.memory_bytes, options.memory_bytes);
    if (!plans.insert({plan.bands, plan.disk_bytes > 0}).second) continue;
    on_disk = on_disk || plan.disk_bytes > 0;
    expect_identical(
        expected, run(field.light_field, options),
        std::to_string(plan.bands) + " bands, disk " + std::to_string(plan.disk_bytes));
    EXPECT_TRUE(std::filesystem::is_empty(work.path));
  }
  EXPECT_GE(plans.size(), 3u);
  EXPECT_TRUE(on_disk) << "no limit made it use files";
}

TEST_P(PipelineBands, TwiceTheSameInputGivesTheSameBits) {
  const AnalyticField field = GetParam().is_4d ? card_before_wall(irregular_grid(), 47, 39)
                                               : card_before_wall(row_of_views(5), 77, 41, 16);
  const DepthOptions options = small_job(GetParam().preset, kHypotheses);
  expect_identical(run(field.light_field, options), run(field.light_field, options), "second run");
}

INSTANTIATE_TEST_SUITE_P(Jobs, PipelineBands,
                         testing::Values(Job{"Paper3D", "paper", false},
                                         Job{"Auto3D", "auto", false},
                                         Job{"Paper4D", "paper", true},
                                         Job{"Auto4D", "auto", true}),
                         [](const auto& info) { return info.param.name; });

void expect_bands_alike(const std::string& backend, const LightField& light_field,
                        const DepthOptions& options) {
  const ScopedFolder work;
  const PlannedRun expected(light_field, options, backend, {});
  EXPECT_GT(expected.tuples.size(), std::size_t(light_field.width) * light_field.height / 2);
  for (const int band_rows : {1, 5, 8, 19, 50}) {
    Cut cut{band_rows, band_rows == 8, band_rows != 19};
    if (band_rows == 19) cut.place = Place::kHost;
    if (band_rows == 5) cut.in_files(work.path);
    PlannedRun(light_field, options, backend, cut)
        .expect_same(expected, backend + " in bands of " + std::to_string(band_rows));
  }
}

TEST(PipelineBandHeight, ReferenceGivesTheSameBitsInAnyBands) {
  DepthOptions options = small_job("auto", kHypotheses);
  options.hypotheses = 13;
  options.support.radius = 2;
  expect_bands_alike("reference", card_before_wall(row_of_views(3), 27, 71).light_field, options);
  options.support.scanline = false;  // smaller bands
  expect_bands_alike("reference", card_before_wall(row_of_views(4), 37, 23).light_field, options);
  expect_bands_alike("reference", card_before_wall(grid_of_views(2, 2), 31, 27).light_field,
                     options);
  options = small_job("paper", kHypotheses);
  options.hypotheses = 17;
  expect_bands_alike("reference", card_before_wall(grid_of_views(2, 2), 31, 27, 16).light_field,
                     options);
}

TEST(PipelineBandHeight, OpenClGivesTheSameBitsInAnyBandsAndStrips) {
  for (const char* preset : {"paper", "auto"}) {
    DepthOptions options = small_job(preset, kHypotheses);
    expect_bands_alike("opencl", card_before_wall(irregular_row(), 35, 103).light_field, options);
    options.support.scanline = false;  // smaller bands
    expect_bands_alike("opencl", card_before_wall(row_of_views(4), 45, 37).light_field, options);
    if (options.support.choose_sides) {
      // Smaller windows: stages follow each other nearer.
      DepthOptions near = options;
      near.support.radius = 3;
      near.winner.median_radius = 1;
      expect_bands_alike("opencl", card_before_wall(row_of_views(4), 45, 67).light_field, near);
      near.support.half_planes = false;
      expect_bands_alike("opencl", card_before_wall(row_of_views(4), 45, 67).light_field, near);
    }
    expect_bands_alike("opencl", card_before_wall(irregular_grid(), 31, 33).light_field, options);
  }
}

/// Spots, each two rows high: a kept row beside a masked one is the last of some band.
std::shared_ptr<const PixelSource> spotted(std::shared_ptr<const PixelSource> pixels) {
  return std::make_shared<PicturesWithHoles>(std::move(pixels),
                                             [](int u, int v) { return u % 11 < 3 && v % 5 < 2; });
}

TEST(PipelineBandHeight, MaskedPixelsAreTheSameInAnyBands) {
  for (const char* preset : {"paper", "auto"}) {
    DepthOptions options = small_job(preset, kHypotheses);
    options.support.scanline = false;  // smaller bands
    LightField light_field = card_before_wall(irregular_grid(), 31, 53).light_field;
    light_field.pixels = spotted(light_field.pixels);
    expect_bands_alike("opencl", light_field, options);
    options.hypotheses = 13;
    light_field = card_before_wall(row_of_views(3), 27, 31).light_field;
    light_field.pixels = spotted(light_field.pixels);
    expect_bands_alike("reference", light_field, options);
  }
}

TEST(PipelineBandHeight, PosedViewsAreTheSameInAnyBands) {
  const std::vector<View> grid = grid_of_views(2, 2);
  LightField light_field = posed_field(cameras_around(grid, 45, 91), grid).light_field;
  for (const char* preset : {"paper", "auto"}) {
    DepthOptions options = small_job(preset, kHypotheses);
    options.disparity = DisparityRange{0, 1};
    options.support.scanline = false;  // smaller bands
    expect_bands_alike("opencl", light_field, options);
  }
  light_field.pixels = spotted(light_field.pixels);
  DepthOptions options = small_job("auto", kHypotheses);
  options.disparity = DisparityRange{0, 1};
  expect_bands_alike("opencl", light_field, options);
}

TEST(BandRing, LoadsWhatComesAndKeepsTheRest) {
  BandRing ring{{}, 50};
  EXPECT_EQ(ring.missing({0, 30}), (RowRange{0, 30}));
  EXPECT_EQ(ring.load({0, 30}, {0, 30}), (RowRange{0, 30}));
  EXPECT_EQ(ring.missing({5, 30}).size(), 0);
  // The last two rows anew, gradients of the last one.
  EXPECT_EQ(ring.missing({5, 45}), (RowRange{28, 45}));
  EXPECT_EQ(ring.load({5, 45}, {28, 45}), (RowRange{29, 45}));
  EXPECT_EQ(ring.rows, (RowRange{0, 45})) << "there is room for what is asked for no more";
  ring.load({40, 70}, ring.missing({40, 70}));
  EXPECT_EQ(ring.rows, (RowRange{20, 70}));
  for (const RowRange anew : {RowRange{69, 90}, RowRange{19, 60}, RowRange{25, 76}})
    EXPECT_EQ(ring.missing(anew), anew) << anew.begin;
  ring.load({30, 90}, {30, 90});
  EXPECT_EQ(ring.slots, 60);
}

}  // namespace
}  // namespace gigaray::testing_support
