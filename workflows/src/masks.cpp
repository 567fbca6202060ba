// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/masks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "gigaray/applications/interval_around.h"
#include "gigaray/core/metric_depth.h"

namespace gigaray {
namespace {

Error bad(const std::string& what) { return Error(ErrorCode::kInvalidArgument, what); }

/// Where there is an estimate, for who pointed beside it.
std::string nearest_known(const FloatMap& map, int u, int v) {
  double nearest = std::numeric_limits<double>::infinity();
  std::string place;
  for (int row = 0; row < map.height(); ++row)
    for (int column = 0; column < map.width(); ++column) {
      const double away = std::hypot(column - u, row - v);
      if (!std::isfinite(map(column, row)) || away >= nearest) continue;
      nearest = away;
      place = fmt::format("; the nearest pixel with one is {} {}", column, row);
    }
  return place.empty() ? "; no pixel has one" : place;
}

/// Colours of a view without what its picture has beyond its own camera.
Image<std::uint16_t> colours(const LightField& light_field, int view, const Mask& mask) {
  const Image<std::uint16_t> picture = read_view(light_field, view);
  Image<std::uint16_t> rgb(mask.width(), mask.height(), 3);
  for (int v = 0; v < rgb.height(); ++v)
    for (int u = 0; u < rgb.width(); ++u) std::copy_n(&picture(u, v), 3, &rgb(u, v));
  return rgb;
}

}  // namespace

PixelInterval::PixelInterval(const DepthScene& scene, PixelPlace at,
                             std::optional<double> tolerance)
    : geometry_(scene.light_field()), view_(scene.top_view()), at_(at) {
  const auto [u, v] = at;
  const FloatMap disparity = scene.disparity(view_);
  const std::string& name = geometry_.views[view_].name;
  if (u < 0 || v < 0 || u >= disparity.width() || v >= disparity.height())
    throw bad(fmt::format("`at` {} {} is outside of view {}, which has {} × {} px", u, v, name,
                          disparity.width(), disparity.height()));
  const int steps = scene.hypotheses() - 1;
  const double step = steps > 0 ? (scene.range().max - scene.range().min) / steps : 0;
  const float jump = jump_of(disparity, float(step));
  const std::optional<float> value = value_around(disparity, u, v, jump);
  if (!value)
    throw bad(fmt::format("`at` {} {}: view {} has no estimate there{}", u, v, name,
                          nearest_known(disparity, u, v)));
  value_ = *value;
  const bool posed = geometry_.kind == LightFieldKind::kUnstructured;
  if (posed && !(value_ > 0))
    throw bad(fmt::format("`at` {} {}: what view {} sees there is at infinity", u, v, name));
  if (!tolerance) {
    values_ = interval_around(disparity, u, v, value_, jump);
    if (posed) values_.least = std::max(values_.least, 0.0f);
  } else if (posed) {
    if (*tolerance >= 1)
      throw bad(
          fmt::format("`tolerance` {}: of photographs with cameras it is a share of the inverse "
                      "depth, less than 1",
                      *tolerance));
    values_ = {float(value_ * (1 - *tolerance)), float(value_ * (1 + *tolerance))};
  } else {
    values_ = {float(value_ - *tolerance), float(value_ + *tolerance)};
  }
}

ValueInterval PixelInterval::values_in(int view) const {
  if (geometry_.kind != LightFieldKind::kUnstructured || view == view_) return values_;
  const Eigen::Vector3d point = geometry_.cameras[view_].back_project(at_.u, at_.v, 1 / value_);
  const double depth = geometry_.cameras[view].project(point).z();
  if (!(depth > 0)) return {1, 0};
  const double there = 1 / depth / value_;
  return {float(values_.least * there), float(values_.most * there)};
}

const char* to_string(IntervalUnit unit) {
  switch (unit) {
    case IntervalUnit::kDisparity:
      return "disparity";
    case IntervalUnit::kInverseDepth:
      return "inverse depth";
    case IntervalUnit::kDepth:
      return "depth";
  }
  return "?";
}

SceneMasks::SceneMasks(const DepthScene& scene, MaskRequest request)
    : scene_(scene), request_(std::move(request)) {
  if (!request_.between && !request_.at)
    throw bad("say what belongs to the mask: `at` U V, a pixel of it, or `near` A `far` B");
  // Of the maps.
  unit_ = scene.light_field().kind == LightFieldKind::kUnstructured ? IntervalUnit::kInverseDepth
                                                                    : IntervalUnit::kDisparity;
  if (request_.at) {
    pixel_.emplace(scene, *request_.at, request_.tolerance);
    values_ = pixel_->values();
  } else {
    take_near_far();
  }
}

/// Near is the larger disparity but the smaller depth, so the order of the two tells the unit.
void SceneMasks::take_near_far() {
  const auto [near, far] = *request_.between;
  if (near == far) throw bad("`near` and `far` are the same");
  const bool rises = near > far;
  if (request_.unit == "disparity" && !rises)
    throw bad("`unit` disparity: `near` must be larger than `far`, near things move more");
  if (request_.unit == "depth" && rises) throw bad("`unit` depth: `near` must be less than `far`");
  if (rises) {
    values_ = {float(far), float(near)};
    return;
  }
  if (!has_metric_depth(scene_.light_field()))
    throw bad(fmt::format(
        "`near` {} is less than `far` {}: these are distances, but {} has no depth in scene units; "
        "state disparities (disparity.pfm), of which the near one is larger, or the rig to "
        "`gigaray depth` with `focal_px` and `baseline`",
        near, far, scene_.name()));
  if (near < 0) throw bad("`near`: a distance can't be negative");
  unit_ = IntervalUnit::kDepth;
  values_ = {float(near), float(far)};
}

ViewMask SceneMasks::view(int view) const {
  const LightField& light_field = scene_.light_field();
  FloatMap map = scene_.disparity(view);
  if (unit_ == IntervalUnit::kDepth) map = depth_from_disparity(map, light_field);
  ViewMask result;
  segment(map, pixel_ ? pixel_->values_in(view) : values_, result.mask);
  if (request_.soft)
    result.matte = soft_matte(result.mask, colours(light_field, view, result.mask),
                              light_field.pixels->bit_depth(), request_.matte);
  return result;
}

}  // namespace gigaray
