// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Arguments that cannot be meant, at every public call of the layer that could trip over them: an
// Error of one line, never an abort or a number out of nowhere.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gigaray/core/camera.h"
#include "gigaray/core/jpeg_blocks.h"
#include "gigaray/core/kept_pictures.h"
#include "gigaray/core/light_field.h"
#include "gigaray/core/metric_depth.h"
#include "gigaray/core/metrics.h"
#include "gigaray/core/parallel.h"
#include "gigaray/core/point_cloud.h"
#include "gigaray/core/region_metrics.h"
#include "gigaray/core/scratch_file.h"
#include "gigaray/core/smoothing.h"
#include "gigaray/core/synthetic.h"
#include "gigaray/core/synthetic_capture.h"
#include "support/black_views.h"
#include "support/errors.h"

namespace gigaray {
namespace {

using testing_support::expect_mistake;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

LightField three_views() { return testing_support::black_views(3); }

TEST(MistakesOfCore, ACameraOrARangeThatIsNone) {
  expect_mistake("no size", [] { check(Camera(), "a"); });
  expect_mistake("no cameras", [] { all_inverse_depths({}); });
  expect_mistake("no range", [] { all_inverse_depths({Camera()}); });
}

TEST(MistakesOfCore, ALightFieldThatIsNone) {
  expect_mistake("empty", [] { check(LightField()); });
  expect_mistake("no views", [] { centre_view(LightField()); });
  expect_mistake("no pixels", [] {
    LightField field = three_views();
    field.pixels = nullptr;
    check(field);
  });
  expect_mistake("no pixels to read", [] {
    LightField field = three_views();
    field.pixels = nullptr;
    read_view(field, 0);
  });
  expect_mistake("NaN", [] {
    LightField field = three_views();
    field.views[1].s = kNan;
    check(field);
  });
  expect_mistake("no cameras", [] {
    LightField field = three_views();
    field.kind = LightFieldKind::kUnstructured;
    check(field);
  });
  for (const int view : {-1, 3, std::numeric_limits<int>::max()}) {
    expect_mistake("view", [&] { read_view(three_views(), view); });
    expect_mistake("pictures_of", [&] { pictures_of(three_views(), {view}); });
    expect_mistake("without", [&] { without(three_views(), {view}); });
    expect_mistake("in memory", [&] { three_views().pixels->read(view); });
  }
  expect_mistake("too few", [] { without(three_views(), {0, 1}); });
  expect_mistake("bits", [] { pixels_in_memory({}, 0); });
  expect_mistake("bits", [] { pixels_in_memory({}, 17); });
  std::vector<View> one{{"a", 0, 0}}, alike{{"a", 0, 0}, {"b", 0, 0}};
  expect_mistake("one", [&] { normalise_positions(one); });
  expect_mistake("alike", [&] { normalise_positions(alike); });
  LightField bare = three_views();
  expect_mistake("no cameras", [&] { place_by_cameras(bare); });
  expect_mistake("null",
                 [] { KeptPictures::over(std::make_shared<KeptPictures>(), LightField()); });
}

TEST(MistakesOfCore, DepthThatIsNotKnown) {
  const FloatMap map(3, 3);
  expect_mistake("rig", [&] { depth_from_disparity(map, RigGeometry()); });
  expect_mistake("rig", [&] { depth_from_disparity(map, three_views()); });
  expect_mistake("rig", [] { disparity_of_depth(1, three_views()); });
  LightField known = three_views();
  known.rig.focal_px = 100;
  known.rig.baseline = 1;
  for (const double depth : {0.0, -1.0, double(kNan)})
    expect_mistake("depth", [&] { disparity_of_depth(depth, known); });
}

TEST(MistakesOfCore, MapsOfDifferentSizes) {
  const FloatMap map(7, 5), other(5, 7), none;
  const Mask mask(7, 5), small(3, 3);
  expect_mistake("scores", [&] { score_disparity(map, other); });
  expect_mistake("scores", [&] { score_disparity(map, none); });
  expect_mistake("border", [&] { score_disparity(map, map, -1); });
  expect_mistake("mask", [&] { score_disparity(map, map, 0, small); });
  expect_mistake("middlebury", [&] { score_middlebury(map, other); });
  expect_mistake("depth", [&] { DepthErrors().add(map, other); });
  expect_mistake("depth", [&] { DepthErrors().add(map, map, other); });
  for (const double percent : {-1.0, 101.0, double(kNan)})
    expect_mistake("share", [&] { DepthErrors().most_confident(percent); });
  expect_mistake("bad_pix", [&] { bad_pix(map, other, 0.07, 0, {}); });
  expect_mistake("mse", [&] { mean_squared_error_x100(map, other, 0, {}); });
  expect_mistake("fattening", [&] { fine_fattening(map, other, 0, {}); });
  expect_mistake("thinning", [&] { fine_thinning(map, other, 0, {}); });
  expect_mistake("bumpiness", [&] { bumpiness(map, other, 0, {}); });
  expect_mistake("angles", [&] { median_angular_error(map, other, RigGeometry(), 0, {}); });
  expect_mistake("backgammon", [&] { backgammon_fattening(map, other, 0, {}); });
  expect_mistake("backgammon", [&] { backgammon_thinning(map, other, 0, {}); });
  expect_mistake("dots", [&] { missed_dots(map, other, LabelMap(7, 5), LabelMap(7, 5)); });
  expect_mistake("dots", [&] { missed_dots(map, map, LabelMap(3, 5), LabelMap(7, 5)); });
}

TEST(MistakesOfCore, NumbersOutOfRange) {
  expect_mistake("threads", [] { set_num_threads(-1); });
  for (const double sigma : {0.0, -1.0, double(kNan), double(INFINITY)}) {
    expect_mistake("sigma", [&] { smooth_picture(Image<std::uint16_t>(7, 5, 3), sigma); });
    expect_mistake("sigma", [&] { smoothed(three_views(), sigma); });
  }
  expect_mistake("null", [] { smoothed(LightField(), 1); });
  expect_mistake("folder", [] { ScratchFile("/nowhere/at all"); });
  PointCloud cloud, other;
  cloud.positions.emplace_back(0, 0, 0);
  other.positions.emplace_back(0, 0, 0);
  other.origin.x() = 1;
  expect_mistake("origins", [&] { append(cloud, other); });
}

TEST(MistakesOfCore, ASceneThatCannotBeRendered) {
  const auto refuse = [](auto change) {
    SyntheticOptions options;
    change(options);
    expect_mistake("scene", [&] { render_synthetic(options, RunControl()); });
    expect_mistake("scene", [&] { describe_synthetic(options); });
    expect_mistake("scene", [&] { render_synthetic_views(options, RunControl(), {}); });
    expect_mistake("scene", [&] { describe_synthetic_capture(options, SyntheticPath()); });
  };
  refuse([](auto& o) { o.scene = "nowhere"; });
  refuse([](auto& o) { o.width = -1; });
  refuse([](auto& o) { o.height = 0; });
  refuse([](auto& o) { o.views_s = 0; });
  refuse([](auto& o) { o.disparity = {1, -1}; });
  refuse([](auto& o) { o.disparity = {kNan, 1}; });
  refuse([](auto& o) { o.noise = kNan; });
  refuse([](auto& o) { o.bit_depth = 7; });
  refuse([](auto& o) { o.samples = 0; });
  SyntheticOptions small;
  small.width = small.height = 16;
  expect_mistake("sink", [&] { render_synthetic_views(small, RunControl(), {}); });
  expect_mistake("sink",
                 [&] { render_synthetic_capture(small, SyntheticPath(), RunControl(), {}); });
  SyntheticPath path;
  path.extent = kNan;
  expect_mistake("path", [&] { describe_synthetic_capture(SyntheticOptions(), path); });
}

}  // namespace
}  // namespace gigaray
