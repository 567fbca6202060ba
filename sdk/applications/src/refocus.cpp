// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/applications/refocus.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "gigaray/core/arguments.h"
#include "gigaray/core/parallel.h"
#include "gigaray/core/srgb.h"
#include "gigaray/samplers/any_sampler.h"

namespace gigaray {
namespace {

/// Linear interpolation of the light of a picture; false outside and where the picture shows
/// nothing of the scene.
class LightAt {
 public:
  LightAt(Image<std::uint16_t> picture, const std::vector<float>& table)
      : picture_(std::move(picture)), mask_(take_mask(picture_)), table_(table) {}

  bool add(double u, double v, std::array<float, 3>& sum) const {
    if (!(u >= 0 && v >= 0 && u <= picture_.width() - 1 && v <= picture_.height() - 1))
      return false;
    const int u0 = std::min(int(u), std::max(0, picture_.width() - 2));
    const int v0 = std::min(int(v), std::max(0, picture_.height() - 2));
    const float part[2][2] = {
        {float((1 - (u - u0)) * (1 - (v - v0))), float((u - u0) * (1 - (v - v0)))},
        {float((1 - (u - u0)) * (v - v0)), float((u - u0) * (v - v0))}};
    std::array<float, 3> light{};
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        if (part[j][i] == 0) continue;
        if (mask_ && !(*mask_)(u0 + i, v0 + j)) return false;
        for (int c = 0; c < 3; ++c) light[c] += part[j][i] * table_[picture_(u0 + i, v0 + j, c)];
      }
    for (int c = 0; c < 3; ++c) sum[c] += light[c];
    return true;
  }

 private:
  Image<std::uint16_t> picture_;
  std::optional<Mask> mask_;
  const std::vector<float>& table_;
};

}  // namespace

Image<std::uint16_t> refocus(const LightField& light_field, int view, FocalPlane plane,
                             double aperture, const RunControl& control) {
  check(light_field);
  require_argument(view >= 0 && view < light_field.num_views(), "view: there is no such view");
  require_argument(
      std::isfinite(plane.value) && std::isfinite(plane.along_u) && std::isfinite(plane.along_v),
      "plane: finite numbers are needed");
  require_argument(aperture >= 0, "aperture: must be 0 or more");
  const int bit_depth = light_field.pixels->bit_depth();
  const int most = (1 << bit_depth) - 1;
  std::vector<float> table(most + 1);
  for (int i = 0; i <= most; ++i) table[i] = float(linear_from_srgb(double(i) / most));

  // With a range from 0 to 1 a hypothesis of the sampler is the inverse depth itself.
  LightField geometry = light_field;
  for (Camera& camera : geometry.cameras) camera.inverse_depth = InverseDepthRange{0, 1};
  const AnySampler sampler = make_sampler(geometry);

  const int width =
      light_field.cameras.empty() ? light_field.width : light_field.cameras[view].width;
  const int height =
      light_field.cameras.empty() ? light_field.height : light_field.cameras[view].height;
  struct Sum {
    std::array<float, 3> light{};
    int views = 0;
  };
  std::vector<Sum> sums(std::size_t(width) * height);
  const View& centre = light_field.views[view];
  for (int other = 0; other < light_field.num_views(); ++other) {
    control.progress("refocus", double(other), double(light_field.num_views()));
    const View& there = light_field.views[other];
    if (std::hypot(there.s - centre.s, there.t - centre.t) > aperture) continue;
    const LightAt light(read_view(light_field, other), table);
    parallel_for(
        height,
        [&](int v) {
          for (int u = 0; u < width; ++u) {
            const double value = plane.value + plane.along_u * (u - 0.5 * (width - 1)) +
                                 plane.along_v * (v - 0.5 * (height - 1));
            const auto place = std::visit(
                [&](const auto& rays) {
                  return rays.locate(view, other, Ray{double(u), double(v), value});
                },
                sampler);
            Sum& sum = sums[std::size_t(v) * width + u];
            if (place && light.add(place->u, place->v, sum.light)) ++sum.views;
          }
        },
        [](int) {});
  }
  Image<std::uint16_t> picture(width, height, 3);
  for (std::size_t i = 0; i < sums.size(); ++i)
    for (int c = 0; c < 3 && sums[i].views > 0; ++c)
      picture.data()[3 * i + c] = std::uint16_t(std::lround(
          most * std::clamp(srgb_from_linear(sums[i].light[c] / sums[i].views), 0.0, 1.0)));
  return picture;
}

}  // namespace gigaray
