// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/meshing/depth_view.h"

#include <algorithm>
#include <cmath>

#include "gigaray/core/arguments.h"
#include "gigaray/core/error.h"

namespace gigaray {
namespace {

/// Tangent of the steepest slope, 80°, that still counts as one surface.
constexpr double kSteepest = 5.67;
constexpr double kOutermost = 0.001;
/// Samples of a view that tell its range.
constexpr std::size_t kSamples = 20000;

}  // namespace

NearbyViews nearby(const DepthViews& views, double spacing) {
  constexpr double kFarInSpacings = 32768;  // 2^23 steps of a float there, by 256
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double farthest = 0;
  for (const Camera& camera : views.cameras) {
    sum += camera.position();
    farthest = std::max(farthest, camera.position().cwiseAbs().maxCoeff());
  }
  if (views.cameras.empty() || !(farthest > kFarInSpacings * spacing)) return {views};
  const double step = std::pow(10, std::floor(std::log10(kFarInSpacings / 4 * spacing)));
  const Eigen::Vector3d middle = sum / double(views.size());
  NearbyViews result;
  // + 0.0: never -0.
  result.origin = ((middle / step).array().round() * step + 0.0).matrix();
  const auto moved = [origin = result.origin](Camera camera) {
    camera.translation += camera.rotation * origin;
    return camera;
  };
  for (const Camera& camera : views.cameras) result.views.cameras.push_back(moved(camera));
  result.views.read = [read = views.read, moved](int view) {
    DepthView found = read(view);
    found.camera = moved(found.camera);
    return found;
  };
  return result;
}

SurfaceTolerance SurfaceTolerance::of(InverseDepthRange range) {
  const double span = range.max - range.min;
  SurfaceTolerance result;
  result.between_views = result.between_pixels = float(0.01 * span);
  return result;
}

float SurfaceTolerance::at(float inverse_depth, float finest) const {
  return std::min(between_views, std::max(finest, between_views_relative * inverse_depth));
}

Survey survey(const DepthViews& views, const RunControl& control) {
  require_argument(bool(views.read) && !views.cameras.empty(),
                   "views: cameras and a way to read them are needed");
  std::vector<float> seen, spacings;
  for (int view = 0; view < views.size(); ++view) {
    control.progress("survey", view, views.size());
    const FloatMap map = views.read(view).inverse_depth;
    const Camera& camera = views.cameras[view];
    const std::size_t every = std::max<std::size_t>(1, map.size() / kSamples);
    for (std::size_t i = 0; i < map.size(); i += every) {
      const float w = map.data()[i];
      if (!(w > 0) || !std::isfinite(w)) continue;
      seen.push_back(w);
      spacings.push_back(float(1 / (w * camera.focal_u)));
    }
  }
  if (seen.empty()) throw Error(ErrorCode::kBadInput, "no view has an estimate of depth");
  const auto at = [](std::vector<float>& values, double share) {
    const auto place = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
    std::nth_element(values.begin(), place, values.end());
    return double(*place);
  };
  Survey result;
  result.range = {at(seen, kOutermost), at(seen, 1 - kOutermost)};
  // One wall parallel to the pictures has no range of its own.
  if (result.range.max - result.range.min < 0.05 * result.range.max)
    result.range = {0.975 * result.range.max, 1.025 * result.range.max};
  result.spacing = at(spacings, 0.25);
  control.progress("survey", 1, 1);
  return result;
}

bool is_one_surface(float inverse_depth, float other, double focal_px, float between_pixels) {
  const double slope = kSteepest / focal_px * std::min(inverse_depth, other);
  return std::abs(inverse_depth - other) <= std::max(double(between_pixels), slope);
}

}  // namespace gigaray
