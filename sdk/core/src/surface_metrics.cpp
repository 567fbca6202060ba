// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "gigaray/core/region_metrics.h"
#include "scored_pixels.h"

namespace gigaray {
namespace {

using Field = Image<double>;

/// Scharr's difference of the right and the left (along u) or the lower and the upper neighbours
/// (along v), times two: the sum of its weights is one on either side. NaN at the rim.
Field scharr(const Field& f, bool along_u) {
  Field out(f.width(), f.height(), 1, std::nan(""));
  for (int v = 1; v < f.height() - 1; ++v) {
    for (int u = 1; u < f.width() - 1; ++u) {
      double sum = 0;
      for (int k = -1; k <= 1; ++k) {
        const double weight = k == 0 ? 10 / 16.0 : 3 / 16.0;
        sum += weight *
               (along_u ? f(u + 1, v + k) - f(u - 1, v + k) : f(u + k, v + 1) - f(u + k, v - 1));
      }
      out(u, v) = sum;
    }
  }
  return out;
}

struct Normal {
  double x, y, z;
};

/// Normals of the surface z(u, v) with x = u · scale · z and y = v · scale · z; not normalised, NaN
/// where a neighbour isn't known.
class Surface {
 public:
  Surface(const FloatMap& disparity, const RigGeometry& rig) {
    const double strength = *rig.focal_px * *rig.baseline;
    const double inverse_focus = rig.focus_distance ? 1 / *rig.focus_distance : 0;
    const int width = disparity.width(), height = disparity.height();
    const double side = std::max(width, height);
    const double scale_u = 0.5 * side / (width - 1) / *rig.focal_px;
    const double scale_v = 0.5 * side / (height - 1) / *rig.focal_px;
    Field x(width, height), y(width, height), z(width, height);
    for (int v = 0; v < height; ++v) {
      for (int u = 0; u < width; ++u) {
        z(u, v) = 1 / (double(disparity(u, v)) / strength + inverse_focus);
        x(u, v) = u * scale_u * z(u, v);
        y(u, v) = v * scale_v * z(u, v);
      }
    }
    for (const bool along_u : {true, false})
      for (const Field* field : {&x, &y, &z}) tangents_.push_back(scharr(*field, along_u));
  }

  Normal normal(int u, int v) const {
    const auto at = [&](int i) { return tangents_[i](u, v); };
    return {at(1) * at(5) - at(2) * at(4), at(2) * at(3) - at(0) * at(5),
            at(0) * at(4) - at(1) * at(3)};
  }

 private:
  std::vector<Field> tangents_;  // x, y, z along u, then along v
};

double dot(const Normal& a, const Normal& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

}  // namespace

double bumpiness(const FloatMap& estimate, const FloatMap& truth, int border, const Mask& mask) {
  constexpr double kLimit = 0.05;
  metrics::check_sizes(estimate, truth, border, mask);
  Field error(truth.width(), truth.height());
  for (std::size_t i = 0; i < error.size(); ++i)
    error.data()[i] = double(estimate.data()[i]) - double(truth.data()[i]);
  const Field du = scharr(error, true), dv = scharr(error, false);
  const Field duu = scharr(du, true), duv = scharr(du, false);
  const Field dvu = scharr(dv, true), dvv = scharr(dv, false);
  double sum = 0;
  long count = 0;
  for (int v = border; v < truth.height() - border; ++v) {
    for (int u = border; u < truth.width() - border; ++u) {
      if (!metrics::is_scored(truth, border, mask, u, v)) continue;
      const double norm = std::sqrt(duu(u, v) * duu(u, v) + duv(u, v) * duv(u, v) +
                                    dvu(u, v) * dvu(u, v) + dvv(u, v) * dvv(u, v));
      if (!std::isfinite(norm)) continue;
      sum += std::min(kLimit, norm);
      ++count;
    }
  }
  return 100 * sum / double(count);
}

double median_angular_error(const FloatMap& estimate, const FloatMap& truth, const RigGeometry& rig,
                            int border, const Mask& mask) {
  metrics::check_sizes(estimate, truth, border, mask);
  if (!rig.focal_px || !rig.baseline || truth.width() < 2 || truth.height() < 2)
    return std::nan("");
  const Surface estimated(estimate, rig), true_surface(truth, rig);
  std::vector<double> angles;
  for (int v = border; v < truth.height() - border; ++v) {
    for (int u = border; u < truth.width() - border; ++u) {
      if (!metrics::is_scored(truth, border, mask, u, v) || !std::isfinite(estimate(u, v)))
        continue;
      const Normal a = estimated.normal(u, v), b = true_surface.normal(u, v);
      const double cosine = dot(a, b) / std::sqrt(dot(a, a) * dot(b, b));
      if (std::isfinite(cosine))
        angles.push_back(std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi);
    }
  }
  return metrics::quantile(angles, 0.5);
}

}  // namespace gigaray
