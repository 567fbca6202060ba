// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Arguments that cannot be meant, at every public call of the layer that could trip over them: an
// Error of one line, never an abort or a number out of nowhere.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gigaray/applications/interval_around.h"
#include "gigaray/applications/novel_view.h"
#include "gigaray/applications/picture_quality.h"
#include "gigaray/applications/refocus.h"
#include "gigaray/applications/rig_cameras.h"
#include "gigaray/applications/segmentation.h"
#include "support/black_views.h"
#include "support/errors.h"

namespace gigaray {
namespace {

using testing_support::expect_mistake;

LightField two_views() { return testing_support::black_views(2); }

TEST(MistakesOfApplications, APixelOutsideTheMap) {
  const FloatMap map(7, 5);
  for (const auto& [u, v] : {std::pair(-1, 0), {0, -1}, {7, 0}, {0, 5}}) {
    expect_mistake("value", [&, u = u, v = v] { value_around(map, u, v, 1); });
    expect_mistake("interval", [&, u = u, v = v] { interval_around(map, u, v, 0, 1); });
  }
  expect_mistake("empty", [] { value_around(FloatMap(), 0, 0, 1); });
  expect_mistake("NaN", [&] { interval_around(map, 1, 1, NAN, 1); });
  expect_mistake("NaN", [&] { interval_around(map, 1, 1, 0, NAN); });
}

TEST(MistakesOfApplications, PicturesOfDifferentSizes) {
  const Image<std::uint16_t> picture(16, 16, 3), other(16, 15, 3), grey(16, 16, 1);
  expect_mistake("size", [&] { picture_quality(picture, other, 8); });
  expect_mistake("channels", [&] { picture_quality(grey, grey, 8); });
  expect_mistake("bits", [&] { picture_quality(picture, picture, 0); });
  expect_mistake("shown", [&] { picture_quality(picture, picture, 8, Mask(3, 3)); });
  expect_mistake("empty", [] { picture_quality({}, {}, 8); });
  MatteOptions options;
  expect_mistake("size", [&] { soft_matte(Mask(3, 3), picture, 8, options); });
  options.radius = 0;
  expect_mistake("radius", [&] { soft_matte(Mask(16, 16), picture, 8, options); });
  options = {4, NAN};
  expect_mistake("contrast", [&] { soft_matte(Mask(16, 16), picture, 8, options); });
  Mask mask;
  expect_mistake("channels", [&] { segment(FloatMap(7, 5, 2), {0, 1}, mask); });
}

TEST(MistakesOfApplications, AViewThatCannotBeMade) {
  const RunControl control;
  const auto render = [&](const Camera& camera, const std::vector<DepthView>& sources, int bits,
                          NovelViewOptions options) {
    render_view(camera, sources, bits, options, control);
  };
  const LightField field = two_views();
  const Camera camera = RigCameras(field).camera(0);
  DepthView source{camera, Image<std::uint16_t>(7, 5, 3), FloatMap(7, 5)};
  DepthView small = source;
  small.inverse_depth = FloatMap(3, 3);
  NovelViewOptions none;
  none.blend.most_views = 0;
  expect_mistake("sources", [&] { render(camera, {}, 8, {}); });
  expect_mistake("size", [&] { render(camera, {small}, 8, {}); });
  expect_mistake("blend", [&] { render(camera, {source}, 8, none); });
  expect_mistake("bits", [&] { render(camera, {source}, 0, {}); });
  expect_mistake("camera", [&] { render(Camera(), {source}, 8, {}); });
  EXPECT_TRUE(nearest_cameras({}, camera, 4).empty());
  for (const int view : {-1, 2, std::numeric_limits<int>::max()})
    expect_mistake("view", [&] { refocus(field, view, {}, 1, control); });
  expect_mistake("plane", [&] { refocus(field, 0, {NAN, 0, 0}, 1, control); });
  expect_mistake("aperture", [&] { refocus(field, 0, {}, NAN, control); });
  expect_mistake("empty", [&] { refocus({}, 0, {}, 1, control); });
}

TEST(MistakesOfApplications, CamerasOfALightFieldThatHasNone) {
  expect_mistake("empty", [] { RigCameras{LightField()}; });
  expect_mistake("NaN", [] { RigCameras(two_views(), NAN); });
  LightField posed;
  posed.kind = LightFieldKind::kUnstructured;
  expect_mistake("unstructured", [&] { RigCameras(posed).camera_at(0, 0); });
}

}  // namespace
}  // namespace gigaray
