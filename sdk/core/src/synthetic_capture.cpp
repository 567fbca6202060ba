// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/synthetic_capture.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "gigaray/core/arguments.h"
#include "gigaray/core/light_field.h"
#include "gigaray/core/parallel.h"
#include "synthetic_noise.h"
#include "synthetic_options.h"
#include "synthetic_scene.h"

namespace gigaray {
namespace {

using synthetic::Vec3d;

constexpr std::uint64_t kPathKey = 0x9a74;
constexpr std::uint64_t kPointKey = 0x9017;
constexpr int kNumPoints = 4000;
/// Of the encoding: what a gain in linear light does to an encoded value.
constexpr double kGamma = 2.2;

Eigen::Vector3d to_eigen(Vec3d a) { return {a.x, a.y, a.z}; }

/// Rises from -1 to 1 and falls back, once per unit of x.
double triangle_wave(double x) { return 4 * std::abs(x - std::floor(x + 0.5)) - 1; }

/// Looks from a place at another, with the rows of the picture level.
Eigen::Matrix3d looking_at(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d ahead = (to - from).normalized();
  const Eigen::Vector3d right = Eigen::Vector3d::UnitY().cross(ahead).normalized();
  Eigen::Matrix3d rotation;
  rotation << right.transpose(), ahead.cross(right).transpose(), ahead.transpose();
  return rotation;
}

class PathNoise {
 public:
  explicit PathNoise(std::uint64_t seed) : seed_(seed) {}
  double operator()(int view_idx, int what) const {
    return synthetic::gaussian(
        synthetic::hash(seed_, kPathKey, std::uint64_t(view_idx) * 16 + what));
  }

 private:
  std::uint64_t seed_;
};

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// Angle between the first and the last camera, or 0 for a straight path.
double whole_turn(const SyntheticOptions& options, const SyntheticPath& path, double radius) {
  if (path.step > 0) return radians(path.step) * (options.views_s - 1);
  return path.shape == SyntheticPath::Shape::kArc ? path.extent / radius : 0;
}

/// Stops of a photograph.
double exposure_of(const SyntheticOptions& options, const SyntheticPath& path, int view_idx) {
  constexpr int kExposureKey = 6;
  return path.exposure_noise * PathNoise(options.seed)(view_idx, kExposureKey);
}

std::vector<Camera> cameras_along(const SyntheticOptions& options, const SyntheticPath& path) {
  const synthetic::Rig rig(options);
  const PathNoise noise(options.seed);
  // The middle of the inverse depths.
  const Eigen::Vector3d target(0, 0, rig.z(0.5));
  const double spacing = 1.0 / (options.views_s - 1);
  const double turn = whole_turn(options, path, target.z());
  // A wide walk stays as level as the middling one: it doesn't dive through the floor.
  constexpr double kWidestSway = 0.5;
  const double sway = std::min(turn > 0 ? turn * target.z() : path.extent, kWidestSway);
  std::vector<Camera> cameras;
  for (int i = 0; i < options.views_s; ++i) {
    const double along = i * spacing - 0.5 + path.spacing_noise * spacing * noise(i, 0);
    Eigen::Vector3d position(along * path.extent, 0, 0);
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    if (turn > 0) {
      const double angle = along * turn;
      position = target + target.z() * Eigen::Vector3d(std::sin(angle), 0, -std::cos(angle));
    }
    if (path.shape == SyntheticPath::Shape::kWalk) {
      // Waves without a common period, so that no two stretches are alike.
      position.y() = 0.25 * sway * triangle_wave(along * std::numbers::pi);
      const double nearer = 0.125 * sway * triangle_wave(along * std::numbers::e + 0.3);
      position += nearer * Eigen::Vector3d(-std::sin(along * turn), 0, std::cos(along * turn));
    }
    for (int axis = 0; axis < 3; ++axis)
      if (axis != 0) position[axis] += path.off_line * noise(i, axis);
    if (path.shape != SyntheticPath::Shape::kLine) rotation = looking_at(position, target);
    for (int axis = 0; axis < 3; ++axis) {
      const double angle = radians(path.rotation_noise) * noise(i, 3 + axis);
      rotation =
          Eigen::AngleAxisd(angle, Eigen::Vector3d::Unit(axis)).toRotationMatrix() * rotation;
    }
    Camera camera;
    camera.width = options.width;
    camera.height = options.height;
    camera.focal_u = camera.focal_v = rig.focal;
    camera.centre_u = rig.cx;
    camera.centre_v = rig.cy;
    camera.rotation = rotation;
    camera.translation = -rotation * position;
    cameras.push_back(camera);
  }
  return cameras;
}

/// Follows single rays through a scene.
class Photographs {
 public:
  Photographs(const SyntheticOptions& options, const SyntheticPath& path)
      : path_(path),
        cameras_(cameras_along(options, path)),
        scene_(synthetic::build_scene(options)) {
    for (const Camera& camera : cameras_) rays_.emplace_back(camera, path.distortion);
  }

  const std::vector<Camera>& cameras() const { return cameras_; }

  /// What a pixel shows; without sights where it shows nothing.
  SyntheticCapture::Point point_at(int view_idx, const Eigen::Vector2d& pixel) const {
    const Vec3d direction = rays_[view_idx].direction(pixel.x(), pixel.y());
    const Vec3d origin = rays_[view_idx].origin();
    const synthetic::Hit hit = first_hit(origin, direction);
    const Vec3d place = origin + hit.z * direction;
    SyntheticCapture::Point point;
    if (synthetic::is_void(scene_, hit)) return point;
    point.position = to_eigen(place);
    const synthetic::Colour colour = synthetic::shade_hit(scene_, hit, origin, direction);
    const float linear[3] = {colour.x, colour.y, colour.z};
    for (int c = 0; c < 3; ++c)
      point.rgb[c] = std::uint8_t(std::clamp(255 * linear[c] + 0.5f, 0.f, 255.f));
    for (int i = 0; i < int(cameras_.size()); ++i)
      if (const auto seen = seen_in(i, place)) point.sights.push_back({i, *seen});
    return point;
  }

 private:
  synthetic::Hit first_hit(Vec3d origin, Vec3d direction) const {
    synthetic::Hit nearest;
    for (std::size_t i = 0; i < scene_.primitives.size(); ++i) {
      const double k = intersect(scene_.primitives[i], scene_.rig, origin, direction);
      if (k < nearest.z) nearest = {int(i), k};
    }
    GIGARAY_CHECK(nearest.primitive >= 0);
    return nearest;
  }

  std::optional<Eigen::Vector2d> seen_in(int view_idx, Vec3d place) const {
    const Camera& camera = cameras_[view_idx];
    const auto [u, v, z] = rays_[view_idx].project(place);
    if (!(z > 0)) return std::nullopt;
    const double x = (u - camera.centre_u) / camera.focal_u;
    const double y = (v - camera.centre_v) / camera.focal_v;
    const double k = 1 + path_.distortion * (x * x + y * y);
    const Eigen::Vector2d pixel(camera.centre_u + camera.focal_u * k * x,
                                camera.centre_v + camera.focal_v * k * y);
    const bool is_inside =
        pixel.minCoeff() >= 0 && pixel.x() <= camera.width - 1 && pixel.y() <= camera.height - 1;
    if (!is_inside) return std::nullopt;
    constexpr double kRounding = 1e-6;
    const Vec3d origin = rays_[view_idx].origin();
    const bool is_hidden = first_hit(origin, place - origin).z < 1 - kRounding;
    return is_hidden ? std::nullopt : std::optional(pixel);
  }

  const SyntheticPath& path_;
  std::vector<Camera> cameras_;
  synthetic::Scene scene_;
  std::vector<synthetic::ViewRays> rays_;
};

void check(const SyntheticOptions& options, const SyntheticPath& path) {
  options.check();
  path.check();
  synthetic::require_range("views_t", options.views_t, 1, 1);
  if (path.step > 0)
    synthetic::require_range("step * (views_s - 1)", path.step * (options.views_s - 1), 0,
                             synthetic::widest_turn_deg(options.scene));
}

}  // namespace

void SyntheticPath::check() const {
  constexpr double kSmallest = 1e-6;
  synthetic::require_range("extent", extent, kSmallest, 2);
  synthetic::require_range("spacing_noise", spacing_noise, 0, 0.3);
  synthetic::require_range("off_line", off_line, 0, 0.1);
  synthetic::require_range("rotation_noise", rotation_noise, 0, 10);
  synthetic::require_range("exposure_noise", exposure_noise, 0, 1);
  synthetic::require_range("distortion", distortion, -0.2, 0.2);
  synthetic::require_range("step", step, 0, kWidestStepDeg);
  synthetic::require(step == 0 || shape != Shape::kLine, "step", "stated",
                     "left out on a line, which has an extent");
}

SyntheticCapture describe_synthetic_capture(const SyntheticOptions& options,
                                            const SyntheticPath& path) {
  check(options, path);
  const Photographs photographs(options, path);
  SyntheticCapture capture;
  capture.cameras = photographs.cameras();
  for (const View& view : synthetic::make_views(options)) capture.names.push_back(view.name);
  for (int i = 0; i < options.views_s; ++i)
    capture.exposures.push_back(exposure_of(options, path, i));
  for (int i = 0; i < kNumPoints; ++i) {
    const auto draw = [&](int what, double high) {
      return synthetic::uniform(
          synthetic::hash(options.seed, kPointKey, std::uint64_t(i) * 4 + what), 0, high);
    };
    const Eigen::Vector2d pixel(draw(0, options.width - 1), draw(1, options.height - 1));
    SyntheticCapture::Point point = photographs.point_at(i % options.views_s, pixel);
    if (point.sights.size() >= 2) capture.points.push_back(std::move(point));
  }
  return capture;
}

void render_synthetic_capture(const SyntheticOptions& options, const SyntheticPath& path,
                              const RunControl& control, const SyntheticPhotographSink& sink) {
  require_argument(bool(sink), "sink: is empty");
  check(options, path);
  const std::vector<Camera> cameras = cameras_along(options, path);
  const synthetic::Scene scene = synthetic::build_scene(options);
  const std::vector<bool> has_outlier = synthetic::choose_outliers(options, options.views_s);
  control.progress("rendering", 0, options.views_s);
  parallel_for(
      options.views_s,
      [&](int i) {
        const double gain = std::exp2(exposure_of(options, path, i) / kGamma);
        auto [picture, depth] = synthetic::render_view(
            scene, options, {i, has_outlier[i], float(gain)},
            synthetic::ViewRays(cameras[i], path.distortion),
            [&](synthetic::Hit hit) {
              return synthetic::is_void(scene, hit) ? synthetic::kNoHit : hit.z;
            },
            control);
        sink(i, std::move(picture), std::move(depth));
      },
      [&](int done) { control.progress("rendering", done, options.views_s); });
}

}  // namespace gigaray
