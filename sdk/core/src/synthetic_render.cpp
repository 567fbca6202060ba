// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <cmath>
#include <vector>

#include "synthetic_noise.h"
#include "synthetic_scene.h"

namespace gigaray::synthetic {
namespace {

constexpr int kTile = 32;
constexpr std::uint16_t kFigure = 0xffff;
/// Rays per axis where one smooth surface fills the pixel; its texture has no wavelength below
/// three pixels, so more of them change nothing that 8 bits show …
constexpr int kInteriorSamples = 2;
/// … but on a panel seen at a slant, where a pixel is long: up to so many times as many.
constexpr int kMaxSlantedFactor = 4;
constexpr double kStretchPerFactor = 3;

/// Somebody who walks through the picture of one view: a silhouette in pixels of that view.
class Figure {
 public:
  Figure(const Rig& rig, std::uint64_t seed) : seed_(std::uint32_t(seed)) {
    size_ = rig.height * uniform(hash(seed, 1), 0.7, 0.95);
    u_ = rig.width * uniform(hash(seed, 2), 0.1, 0.9);
    v_ = rig.height * uniform(hash(seed, 3), 0.97, 1.1) - size_;
    for (int part = 0; part < 3; ++part)
      for (float* channel : {&colours_[part].x, &colours_[part].y, &colours_[part].z})
        *channel = float(uniform(hash(seed, 4, bits_++), 0.08, 0.95));
  }

  bool covers(double u, double v) const { return part_at((u - u_) / size_, (v - v_) / size_) >= 0; }

  Colour colour(double u, double v) const {
    const double x = (u - u_) / size_, y = (v - v_) / size_;
    const float cloth =
        fractal_noise({float(x), float(y), 0}, 0.12f, 0.7f, seed_, float(1 / size_));
    return (0.9f + 0.12f * cloth) * colours_[std::max(0, part_at(x, y))];
  }

 private:
  /// 0 head, 1 trunk and arms, 2 legs, -1 outside; the figure is 1 high, x = 0 is its middle.
  static int part_at(double x, double y) {
    if (near_segment(x, y, 0, 0.075, 0, 0.09, 0.07)) return 0;
    if (near_segment(x, y, 0, 0.27, 0, 0.45, 0.105) ||
        near_segment(x, y, -0.1, 0.23, -0.17, 0.5, 0.035) ||
        near_segment(x, y, 0.1, 0.23, 0.15, 0.5, 0.035))
      return 1;
    if (near_segment(x, y, -0.04, 0.5, -0.12, 0.96, 0.045) ||
        near_segment(x, y, 0.04, 0.5, 0.1, 0.96, 0.045))
      return 2;
    return -1;
  }

  static bool near_segment(double x, double y, double ax, double ay, double bx, double by,
                           double radius) {
    const double dx = bx - ax, dy = by - ay;
    const double k = std::clamp(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    const double ex = x - ax - k * dx, ey = y - ay - k * dy;
    return ex * ex + ey * ey <= radius * radius;
  }

  double u_, v_, size_;
  std::uint32_t seed_;
  std::uint64_t bits_ = 0;
  Colour colours_[3];
};

class ViewRenderer {
 public:
  ViewRenderer(const Scene& scene, const SyntheticOptions& options, const ViewTraits& view,
               const ViewRays& rays, const Figure* figure, const RunControl& control)
      : scene_(scene),
        options_(options),
        view_(view),
        rays_(rays),
        figure_(figure),
        control_(control),
        tiles_across_((options.width + kTile - 1) / kTile),
        tiles_(std::size_t(tiles_across_) * ((options.height + kTile - 1) / kTile)) {
    list_primitives();
  }

  RenderedView render(const std::function<double(Hit)>& truth_of) {
    const int width = options_.width, height = options_.height;
    RenderedView out{Image<std::uint16_t>(width, height, 3), FloatMap(width, height)};
    Image<std::uint16_t> seen(width, height);
    for (int v = 0; v < height; ++v) {
      control_.throw_if_cancelled();
      for (int u = 0; u < width; ++u) {
        const Hit hit = trace(tile(u, v), u, v);
        out.truth(u, v) = float(truth_of(hit));
        seen(u, v) = figure_ && figure_->covers(u, v) ? kFigure : std::uint16_t(hit.primitive);
      }
    }
    for (int v = 0; v < height; ++v) {
      control_.throw_if_cancelled();
      for (int u = 0; u < width; ++u) {
        const Colour colour =
            is_edge(seen, u, v) ? edge_pixel(u, v) : interior_pixel(u, v, seen(u, v));
        store(colour, u, v, out.picture);
      }
    }
    return out;
  }

 private:
  using Tile = std::vector<std::uint16_t>;

  void list_primitives() {
    const int tiles_down = int(tiles_.size()) / tiles_across_;
    for (std::size_t i = 0; i < scene_.primitives.size(); ++i) {
      const PixelBox box = bounds(scene_.primitives[i], scene_.rig, rays_);
      // One pixel more for the rays beside the pixel centres. What lies outside is in the tiles at
      // the border, where a lens looks further than a pinhole.
      const auto first = [](double x, int count) {
        return int(std::clamp(std::floor((x - 1) / kTile), 0.0, double(count - 1)));
      };
      const auto last = [](double x, int count) {
        return int(std::clamp(std::floor((x + 1) / kTile), 0.0, double(count - 1)));
      };
      for (int y = first(box.v0, tiles_down); y <= last(box.v1, tiles_down); ++y)
        for (int x = first(box.u0, tiles_across_); x <= last(box.u1, tiles_across_); ++x)
          tiles_[std::size_t(y) * tiles_across_ + x].push_back(std::uint16_t(i));
    }
  }

  const Tile& tile(int u, int v) const {
    const Vec3d at = rays_.undistorted(u, v);
    const int x = std::clamp(int(at.x), 0, options_.width - 1) / kTile;
    const int y = std::clamp(int(at.y), 0, options_.height - 1) / kTile;
    return tiles_[std::size_t(y) * tiles_across_ + x];
  }

  Hit trace(const Tile& tile, double u, double v) const {
    const Vec3d direction = rays_.direction(u, v);
    Hit nearest;
    for (const std::uint16_t i : tile) {
      const double z = intersect(scene_.primitives[i], scene_.rig, rays_.origin(), direction);
      if (z < nearest.z) nearest = {i, z};
    }
    GIGARAY_CHECK(nearest.primitive >= 0);
    return nearest;
  }

  bool is_edge(const Image<std::uint16_t>& seen, int u, int v) const {
    const std::uint16_t own = seen(u, v);
    for (int y = std::max(0, v - 1); y <= std::min(options_.height - 1, v + 1); ++y)
      for (int x = std::max(0, u - 1); x <= std::min(options_.width - 1, u + 1); ++x)
        if (seen(x, y) != own) return true;
    return false;
  }

  Colour colour(Hit hit, double u, double v) const {
    return shade_hit(scene_, hit, rays_.origin(), rays_.direction(u, v));
  }

  /// The mean of n × n rays, in the middles of as many equal parts of the pixel.
  template <class ColourAt>
  static Colour average(int n, int u, int v, ColourAt colour_at) {
    Colour sum;
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x)
        sum = sum + colour_at(u + (x + 0.5) / n - 0.5, v + (y + 0.5) / n - 0.5);
    return (1.0f / float(n * n)) * sum;
  }

  Colour edge_pixel(int u, int v) const {
    return average(options_.samples, u, v, [&](double x, double y) {
      if (figure_ && figure_->covers(x, y)) return figure_->colour(x, y);
      return colour(trace(tile(u, v), x, y), x, y);
    });
  }

  Colour interior_pixel(int u, int v, std::uint16_t seen) const {
    int n = std::min(options_.samples, kInteriorSamples);
    if (seen == kFigure)
      return average(n, u, v, [&](double x, double y) { return figure_->colour(x, y); });
    n *= slanted_factor(seen, u, v);
    return average(n, u, v, [&](double x, double y) {
      Hit hit{seen, intersect(scene_.primitives[seen], scene_.rig, rays_.origin(),
                              rays_.direction(x, y))};
      if (hit.z == kNoHit) hit = trace(tile(u, v), x, y);
      return colour(hit, x, y);
    });
  }

  int slanted_factor(std::uint16_t seen, int u, int v) const {
    const Primitive& primitive = scene_.primitives[seen];
    if (primitive.kind != Primitive::Kind::kPanel) return 1;
    const double cosine = std::abs(dot(primitive.normal, normalised(rays_.direction(u, v))));
    return int(std::clamp(1 / (kStretchPerFactor * cosine), 1.0, double(kMaxSlantedFactor)));
  }

  void store(Colour colour, int u, int v, Image<std::uint16_t>& picture) const {
    const float top = float((1 << options_.bit_depth) - 1);
    const float values[3] = {colour.x, colour.y, colour.z};
    for (int c = 0; c < 3; ++c) {
      float value = view_.gain * values[c];
      if (options_.noise > 0) {
        const std::uint64_t place = (std::uint64_t(v) * options_.width + u) * 3 + c;
        value += float(options_.noise) * gaussian(hash(options_.seed, view_.view_idx, place));
      }
      picture(u, v, c) = std::uint16_t(std::clamp(value, 0.0f, 1.0f) * top + 0.5f);
    }
  }

  const Scene& scene_;
  const SyntheticOptions& options_;
  ViewTraits view_;
  const ViewRays& rays_;
  const Figure* figure_;
  const RunControl& control_;
  int tiles_across_;
  std::vector<Tile> tiles_;
};

}  // namespace

bool is_void(const Scene& scene, Hit hit) {
  return scene.materials[scene.primitives[hit.primitive].material].is_void;
}

Colour shade_hit(const Scene& scene, Hit hit, Vec3d origin, Vec3d direction) {
  const Primitive& primitive = scene.primitives[hit.primitive];
  const Vec3d p = origin + hit.z * direction;
  return shade(scene.materials[primitive.material], texture_point(primitive, p),
               to_float(surface_normal(primitive, p, direction)),
               to_float(normalised(-1.0 * direction)), float(hit.z * scene.rig.pixel()));
}

RenderedView render_view(const Scene& scene, const SyntheticOptions& options,
                         const ViewTraits& view, const ViewRays& rays,
                         const std::function<double(Hit)>& truth_of, const RunControl& control) {
  constexpr std::uint64_t kFigureKey = 0x0f16;
  const Figure figure(scene.rig, hash(options.seed, kFigureKey, std::uint64_t(view.view_idx)));
  return ViewRenderer(scene, options, view, rays, view.has_outlier ? &figure : nullptr, control)
      .render(truth_of);
}

}  // namespace gigaray::synthetic
