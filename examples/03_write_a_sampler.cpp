// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// A sampler of one's own: a camera on a vertical rail, where rays move along columns. It is held
// against the laws of ray_sampler.h and against GridSampler, then it looks at a real light field.
//   03_write_a_sampler
#include <cmath>
#include <cstdio>

#include "gigaray/core/synthetic.h"
#include "gigaray/samplers/grid_sampler.h"

namespace {

using gigaray::Ray;

class VerticalSampler {
 public:
  static constexpr std::string_view kKernelFile = "vertical_sampler.cl";  // its OpenCL twin
  static constexpr int kRayTableWidth = 1;                                // t̂ − t
  static constexpr bool kRaysShiftAlike = true;  // all pixels of a view go the same way

  explicit VerticalSampler(const std::vector<gigaray::View>& views) {
    for (const gigaray::View& view : views) t_.push_back(view.t);
  }
  int num_views() const { return int(t_.size()); }
  std::optional<Ray> locate(int ref, int other, Ray ray) const {
    return Ray{ray.u, ray.v + (t_[ref] - t_[other]) * ray.hypothesis, ray.hypothesis};
  }
  std::vector<int> partners(int) const { return gigaray::all_views(num_views()); }
  gigaray::RowRange rows_needed(int, gigaray::RowRange rows, gigaray::HypothesisRange range,
                                int height) const {
    const auto [low, high] = std::minmax_element(t_.begin(), t_.end());
    const double farthest = std::max(std::abs(range.min), std::abs(range.max));
    return gigaray::grown(rows, int(std::ceil((*high - *low) * farthest)), height);
  }
  VerticalSampler at_level(int level) const {
    VerticalSampler scaled = *this;
    for (double& t : scaled.t_) t = std::ldexp(t, -level);
    return scaled;
  }
  VerticalSampler subset(const std::vector<int>& views) const {
    VerticalSampler some({});
    for (const int view : views) some.t_.push_back(t_[view]);
    return some;
  }
  std::vector<float> ray_table(int ref) const {
    std::vector<float> table;
    for (const double t : t_) table.push_back(float(t_[ref] - t));
    return table;
  }

 private:
  std::vector<double> t_;
};
static_assert(gigaray::RaySampler<VerticalSampler>);

bool same(const Ray& a, const Ray& b) {
  return std::abs(a.u - b.u) + std::abs(a.v - b.v) + std::abs(a.hypothesis - b.hypothesis) < 1e-9;
}

}  // namespace

int main() {
  gigaray::SyntheticOptions scene;
  scene.scene = "planes";
  scene.width = scene.height = 96;
  scene.views_s = 1;
  scene.views_t = 9;
  const auto [light_field, truth] = gigaray::render_synthetic(scene, gigaray::RunControl{});
  const VerticalSampler sampler(light_field.views);
  const gigaray::GridSampler grid(light_field.views);

  int broken = 0;
  const gigaray::HypothesisRange range{-1, 1, 9};
  for (int ref = 0; ref < sampler.num_views(); ++ref)
    for (int other = 0; other < sampler.num_views(); ++other)
      for (int i = 0; i < range.count; ++i) {
        const Ray ray{30, 40, range.value(i)};
        const Ray there = *sampler.locate(ref, other, ray);
        const auto rows = sampler.rows_needed(ref, {40, 41}, range, scene.height);
        broken += ref == other && !same(there, ray);               // itself
        broken += !same(*sampler.locate(other, ref, there), ray);  // there and back
        broken += !same(there, *grid.locate(ref, other, ray));     // another sampler, same rig
        broken += there.v < rows.begin || there.v > rows.end - 1;  // the rows it promised
      }
  std::printf("laws broken: %d\n", broken);

  // What all views see of one point of the centre view, at its true disparity.
  const int centre = gigaray::centre_view(light_field);
  const Ray ray{48, 48, truth[centre](48, 48)};
  for (int view = 0; view < sampler.num_views(); ++view) {
    const Ray there = *sampler.locate(centre, view, ray);
    const int u = int(std::lround(there.u)), v = int(std::lround(there.v));
    const auto picture = light_field.pixels->read(view);
    std::printf("view %d: row %.2f, colour %3d %3d %3d\n", view, there.v, picture(u, v, 0),
                picture(u, v, 1), picture(u, v, 2));
  }
  return broken == 0 ? 0 : 1;
}
