// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/synthetic.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "gigaray/core/arguments.h"
#include "gigaray/core/parallel.h"
#include "synthetic_noise.h"
#include "synthetic_options.h"
#include "synthetic_scene.h"

namespace gigaray {
namespace {

constexpr int kMaxSide = 16384;
constexpr int kMaxViews = 4096;
constexpr int kMaxSamples = 16;

std::string to_text(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", x);
  return text;
}

}  // namespace

namespace synthetic {

void require(bool holds, const std::string& field, const std::string& value,
             const std::string& wanted) {
  if (!holds)
    throw Error(ErrorCode::kInvalidArgument,
                "synthetic scene: " + field + " is " + value + "; it must be " + wanted);
}

void require_range(const std::string& field, double value, double low, double high) {
  require(value >= low && value <= high, field, to_text(value),
          "from " + to_text(low) + " to " + to_text(high));
}

bool has_room_around(const std::string& scene) { return scene == "room" || scene == "figure"; }

double widest_turn_deg(const std::string& scene) {
  if (scene == "figure") return 360;
  return scene == "room" ? 120 : 90;
}

std::vector<bool> choose_outliers(const SyntheticOptions& options, int num_views) {
  constexpr std::uint64_t kChoiceKey = 0xc401ce;
  std::vector<std::pair<std::uint64_t, int>> order;
  for (int i = 0; i < num_views; ++i)
    order.emplace_back(hash(options.seed, kChoiceKey, std::uint64_t(i)), i);
  std::sort(order.begin(), order.end());
  std::vector<bool> chosen(num_views, false);
  const int count = int(options.outliers * num_views + 0.5);
  for (int i = 0; i < count; ++i) chosen[order[i].second] = true;
  return chosen;
}

std::vector<View> make_views(const SyntheticOptions& options) {
  std::vector<View> views;
  const bool is_row = options.views_t == 1;
  for (int t = 0; t < options.views_t; ++t) {
    for (int s = 0; s < options.views_s; ++s) {
      char name[48];
      if (is_row)
        std::snprintf(name, sizeof name, "view_%03d", s);
      else
        std::snprintf(name, sizeof name, "view_%02d_%02d", t, s);
      views.push_back({name, s - (options.views_s - 1) / 2.0, t - (options.views_t - 1) / 2.0});
    }
  }
  return views;
}

}  // namespace synthetic

void SyntheticOptions::check() const {
  using synthetic::require;
  using synthetic::require_range;
  const auto& names = synthetic_scene_names();
  std::string known;
  for (const std::string& name : names) known += (known.empty() ? "" : ", ") + name;
  require(std::find(names.begin(), names.end(), scene) != names.end(), "scene", "'" + scene + "'",
          "one of " + known);
  require_range("width", width, 16, kMaxSide);
  require_range("height", height, 16, kMaxSide);
  require_range("views_s", views_s, 1, kMaxViews);
  require_range("views_t", views_t, 1, kMaxViews);
  const double num_views = double(views_s) * views_t;
  require(num_views >= 2 && num_views <= kMaxViews, "views_s * views_t", to_text(num_views),
          "from 2 to " + to_text(kMaxViews));
  require(
      std::isfinite(disparity.min) && std::isfinite(disparity.max) && disparity.min < disparity.max,
      "disparity", to_text(disparity.min) + " " + to_text(disparity.max),
      "two finite numbers, the smaller one first");
  // A surface point that crosses the picture in less than one view step is seen once: no light
  // field.
  const double widest = std::max(width, height);
  require(std::max(std::abs(disparity.min), std::abs(disparity.max)) <= widest, "disparity",
          to_text(disparity.min) + " " + to_text(disparity.max),
          "within -" + to_text(widest) + " and " + to_text(widest) + ", the size of the picture");
  require_range("noise", noise, 0, 1);
  require_range("outliers", outliers, 0, 1);
  require(bit_depth == 8 || bit_depth == 16, "bit_depth", to_text(bit_depth), "8 or 16");
  require_range("samples", samples, 1, kMaxSamples);
}

const std::vector<std::string>& synthetic_scene_names() {
  static const std::vector<std::string> names = {"planes",   "rods",    "sphere",      "wall",
                                                 "specular", "plaster", "silhouettes", "wedges",
                                                 "room",     "figure",  "garden"};
  return names;
}

LightField describe_synthetic(const SyntheticOptions& options) {
  options.check();
  LightField light_field;
  light_field.width = options.width;
  light_field.height = options.height;
  light_field.views = synthetic::make_views(options);
  light_field.kind = kind_from_positions(light_field.views);
  light_field.rig = synthetic::Rig(options).geometry();
  light_field.declared_range = options.disparity;
  light_field.format = "synthetic scene " + options.scene;
  return light_field;
}

void render_synthetic_views(const SyntheticOptions& options, const RunControl& control,
                            const SyntheticViewSink& sink) {
  require_argument(bool(sink), "sink: is empty");
  options.check();
  const std::vector<View> views = synthetic::make_views(options);
  const synthetic::Scene scene = synthetic::build_scene(options);
  const std::vector<bool> has_outlier = synthetic::choose_outliers(options, int(views.size()));
  const double total = double(views.size());
  control.progress("rendering", 0, total);
  parallel_for(
      int(views.size()),
      [&](int i) {
        auto [picture, disparity] = synthetic::render_view(
            scene, options, {i, has_outlier[i]}, synthetic::ViewRays(scene.rig, views[i]),
            [&](synthetic::Hit hit) { return scene.rig.disparity(hit.z); }, control);
        sink(i, std::move(picture), std::move(disparity));
      },
      [&](int done) { control.progress("rendering", done, total); });
}

SyntheticLightField render_synthetic(const SyntheticOptions& options, const RunControl& control) {
  SyntheticLightField out{describe_synthetic(options), {}};
  const std::size_t num_views = out.light_field.views.size();
  out.disparity.resize(num_views);
  std::vector<Image<std::uint16_t>> pictures(num_views);
  render_synthetic_views(options, control,
                         [&](int i, Image<std::uint16_t> picture, FloatMap disparity) {
                           pictures[i] = std::move(picture);
                           out.disparity[i] = std::move(disparity);
                         });
  out.light_field.pixels = pixels_in_memory(std::move(pictures), options.bit_depth);
  return out;
}

}  // namespace gigaray
