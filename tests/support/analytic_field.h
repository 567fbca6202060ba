// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "gigaray/core/light_field.h"

namespace gigaray::testing_support {

/// A smooth colour pattern: a few plane waves of 7 … 30 px, so that its value is known everywhere
/// and linear interpolation between pixels is good. Values lie in (0, 1).
class WavePattern {
 public:
  explicit WavePattern(unsigned seed, double contrast = 1) : contrast_(contrast) {
    std::mt19937 random(seed);
    const auto uniform = [&] { return double(random()) / 4294967296.0; };
    for (Wave& wave : waves_) {
      const double angle = std::numbers::pi * uniform();
      const double k = 2 * std::numbers::pi / (7 + 23 * uniform());
      wave.ku = k * std::cos(angle);
      wave.kv = k * std::sin(angle);
      for (double& phase : wave.phase) phase = 2 * std::numbers::pi * uniform();
    }
  }
  double operator()(double x, double y, int c) const {
    double sum = 0;
    for (const Wave& wave : waves_) sum += std::sin(wave.ku * x + wave.kv * y + wave.phase[c]);
    return 0.5 + 0.45 * contrast_ * sum / kWaves;
  }

 private:
  static constexpr int kWaves = 5;
  struct Wave {
    double ku, kv, phase[3];
  };
  double contrast_;
  Wave waves_[kWaves];
};

/// Cameras at the positions of views, half turned away from each other in all three axes, that see
/// a depth of 8 … 12 units. size: px.
inline std::vector<Camera> cameras_around(const std::vector<View>& views, int width, int height) {
  std::vector<Camera> cameras;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const double angle = 0.03 * (double(i % 5) - 2), roll = 0.05 * (double(i % 3) - 1);
    Camera camera;
    camera.width = width;
    camera.height = height;
    camera.focal_u = 1.1 * std::max(width, height);
    camera.focal_v = 1.05 * std::max(width, height);
    camera.centre_u = 0.48 * width;
    camera.centre_v = 0.53 * height;
    camera.rotation = (Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()) *
                       Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()) *
                       Eigen::AngleAxisd(-0.7 * angle, Eigen::Vector3d::UnitX()))
                          .toRotationMatrix();
    const Eigen::Vector3d position(0.3 * views[i].s, 0.3 * views[i].t, 0.1 * double(i % 4));
    camera.translation = -camera.rotation * position;
    camera.inverse_depth = InverseDepthRange{1.0 / 12, 1.0 / (8 + 0.1 * double(i % 3))};
    cameras.push_back(camera);
  }
  return cameras;
}

/// A textured plane parallel to the views, cut to a rectangle: px of the view at (0, 0).
struct Layer {
  double disparity = 0;
  unsigned seed = 1;
  double contrast = 1;
  double left = -std::numeric_limits<double>::infinity();
  double right = std::numeric_limits<double>::infinity();
  double top = -std::numeric_limits<double>::infinity();
  double bottom = std::numeric_limits<double>::infinity();
};

struct AnalyticField {
  LightField light_field;
  std::vector<FloatMap> disparity;  ///< exact, one per view
};

/// Renders planes, point-sampled at pixel centres: a point (x, y) of the view at (0, 0) is at
/// (x - s d, y - t d) in view (s, t). One layer must cover everything.
inline AnalyticField analytic_field(int width, int height, std::vector<View> views,
                                    std::vector<Layer> layers, int bit_depth = 8,
                                    double noise = 0) {
  std::sort(layers.begin(), layers.end(),
            [](const Layer& a, const Layer& b) { return a.disparity > b.disparity; });
  std::vector<WavePattern> patterns;
  for (const Layer& layer : layers) patterns.emplace_back(layer.seed, layer.contrast);
  std::mt19937 random(17);
  std::normal_distribution<double> gauss;

  AnalyticField field;
  std::vector<Image<std::uint16_t>> pictures;
  const double most = (1 << bit_depth) - 1;
  for (const View& view : views) {
    Image<std::uint16_t> picture(width, height, 3);
    FloatMap disparity(width, height);
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u)
        for (std::size_t i = 0; i < layers.size(); ++i) {
          const Layer& layer = layers[i];
          const double x = u + view.s * layer.disparity, y = v + view.t * layer.disparity;
          if (x < layer.left || x > layer.right || y < layer.top || y > layer.bottom) continue;
          disparity(u, v) = float(layer.disparity);
          for (int c = 0; c < 3; ++c) {
            const double value = patterns[i](x, y, c) + (noise > 0 ? noise * gauss(random) : 0);
            picture(u, v, c) = std::uint16_t(std::lround(std::clamp(value, 0.0, 1.0) * most));
          }
          break;
        }
    pictures.push_back(std::move(picture));
    field.disparity.push_back(std::move(disparity));
  }
  field.light_field.kind = kind_from_positions(views);
  field.light_field.width = width;
  field.light_field.height = height;
  field.light_field.views = std::move(views);
  field.light_field.pixels = pixels_in_memory(std::move(pictures), bit_depth);
  field.light_field.format = "analytic";
  return field;
}

inline std::vector<View> named(std::vector<View> views) {
  for (std::size_t i = 0; i < views.size(); ++i) views[i].name = "view" + std::to_string(i);
  return views;
}

/// `count` views, one step apart, around s = 0.
inline std::vector<View> row_of_views(int count) {
  std::vector<View> views;
  for (int i = 0; i < count; ++i) views.push_back({"", i - (count - 1) / 2.0, 0});
  return named(std::move(views));
}

/// count_s times count_t views, one step apart, around (0, 0).
inline std::vector<View> grid_of_views(int count_s, int count_t) {
  std::vector<View> views;
  for (int j = 0; j < count_t; ++j)
    for (int i = 0; i < count_s; ++i)
      views.push_back({"", i - (count_s - 1) / 2.0, j - (count_t - 1) / 2.0});
  return named(std::move(views));
}

/// Positions as measured: irregular, unordered.
inline std::vector<View> irregular_row() {
  return named({{"", -3.9313, 0},
                {"", -2.0271, 0},
                {"", 0.0173, 0},
                {"", -1.1057, 0},
                {"", 0.9719, 0},
                {"", 2.2137, 0},
                {"", 4.0417, 0}});
}

/// A grid with a hole and measured positions.
inline std::vector<View> irregular_grid() {
  return named({{"", -1.0317, -0.9731},
                {"", 0.0121, -1.0173},
                {"", 1.0711, -0.9127},
                {"", -0.9377, 0.0319},
                {"", 0.0231, 0.0117},
                {"", -1.0133, 1.0713},
                {"", 0.9839, 1.9371}});
}

}  // namespace gigaray::testing_support
