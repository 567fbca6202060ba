// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/meshing/grid_mesh.h"

#include <algorithm>
#include <cmath>

#include "gigaray/core/error.h"
#include "gigaray/core/parallel.h"
#include "plain_ground.h"
#include "witness.h"

namespace gigaray {
namespace {

constexpr std::uint32_t kNoVertex = 0xffffffff;

/// A view that is part of the model: where it shows a surface.
struct Part {
  Camera camera;
  FloatMap inverse_depth;  ///< NaN where no triangle is
};

/// 1 for pixels whose point the model shows already.
Mask covered_by(const std::vector<Part>& parts, const DepthView& view, const Mask& keep,
                SurfaceTolerance tolerance) {
  Mask covered(keep.width(), keep.height());
  const auto shows = [&](const Part& part, const Eigen::Vector3d& point) {
    return look_at(part.camera, part.inverse_depth, point, tolerance.between_views,
                   tolerance.between_pixels)
               .sight == Sight::kSees;
  };
  parallel_for(
      keep.height(),
      [&](int v) {
        for (int u = 0; u < keep.width(); ++u) {
          if (!keep(u, v)) continue;
          const Eigen::Vector3d point =
              view.camera.back_project(u, v, 1 / double(view.inverse_depth(u, v)));
          covered(u, v) =
              std::ranges::any_of(parts, [&](const Part& part) { return shows(part, point); });
        }
      },
      [](int) {});
  return covered;
}

class Builder {
 public:
  Builder(const DepthView& view, const KeptPixels& kept, const Mask& covered,
          SurfaceTolerance tolerance, SurfaceMesh& mesh)
      : view_(view),
        kept_(kept),
        covered_(covered),
        tolerance_(tolerance),
        normals_(normals_of(view, tolerance)),
        vertices_(kept.keep.width(), kept.keep.height(), 1, kNoVertex),
        mesh_(mesh) {}

  /// Adds the triangles of all pixels; what the view shows of the model now. Without the rims, so
  /// that another view may close a hole of a single pixel.
  FloatMap add() {
    const int width = kept_.keep.width(), height = kept_.keep.height();
    for (int v = 0; v + 1 < height; ++v)
      for (int u = 0; u + 1 < width; ++u) {
        const Pixel a{u, v}, b{u + 1, v}, c{u, v + 1}, d{u + 1, v + 1};
        // Along the diagonal that depth changes less on.
        if (difference(a, d) <= difference(b, c) || !kept_.keep(b.u, b.v) ||
            !kept_.keep(c.u, c.v)) {
          add_triangle(a, c, d);
          add_triangle(a, d, b);
        } else {
          add_triangle(a, c, b);
          add_triangle(b, c, d);
        }
      }
    FloatMap shown(width, height, 1, kNoEstimate);
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u)
        if (is_surrounded(u, v)) shown(u, v) = view_.inverse_depth(u, v);
    return shown;
  }

 private:
  struct Pixel {
    int u, v;
  };

  bool is_surrounded(int u, int v) const {
    for (int y = std::max(v - 1, 0); y <= std::min(v + 1, vertices_.height() - 1); ++y)
      for (int x = std::max(u - 1, 0); x <= std::min(u + 1, vertices_.width() - 1); ++x)
        if (vertices_(x, y) == kNoVertex && !covered_(x, y)) return false;
    return true;
  }

  float difference(Pixel a, Pixel b) const {
    const float gap = std::abs(view_.inverse_depth(a.u, a.v) - view_.inverse_depth(b.u, b.v));
    return kept_.keep(a.u, a.v) && kept_.keep(b.u, b.v) ? gap
                                                        : std::numeric_limits<float>::infinity();
  }

  bool is_connected(Pixel a, Pixel b) const {
    return is_one_surface(view_.inverse_depth(a.u, a.v), view_.inverse_depth(b.u, b.v),
                          view_.camera.focal_u, tolerance_.between_pixels);
  }

  /// Counter-clockwise as the camera sees it with v downwards.
  void add_triangle(Pixel a, Pixel b, Pixel c) {
    if (!kept_.keep(a.u, a.v) || !kept_.keep(b.u, b.v) || !kept_.keep(c.u, c.v)) return;
    if (covered_(a.u, a.v) && covered_(b.u, b.v) && covered_(c.u, c.v)) return;
    if (!is_connected(a, b) || !is_connected(b, c) || !is_connected(c, a)) return;
    mesh_.faces.push_back({vertex(a), vertex(b), vertex(c)});
  }

  std::uint32_t vertex(Pixel p) {
    std::uint32_t& index = vertices_(p.u, p.v);
    if (index == kNoVertex) {
      index = std::uint32_t(mesh_.positions.size());
      const double z = 1 / double(view_.inverse_depth(p.u, p.v));
      mesh_.positions.push_back(view_.camera.back_project(p.u, p.v, z).cast<float>());
      mesh_.normals.emplace_back(&normals_(p.u, p.v, 0));
      mesh_.colours.push_back(
          {view_.byte(p.u, p.v, 0), view_.byte(p.u, p.v, 1), view_.byte(p.u, p.v, 2)});
    }
    return index;
  }

  const DepthView& view_;
  const KeptPixels& kept_;
  const Mask& covered_;
  SurfaceTolerance tolerance_;
  FloatMap normals_;
  Image<std::uint32_t> vertices_;
  SurfaceMesh& mesh_;
};

}  // namespace

std::vector<int> farthest_first(const std::vector<Camera>& cameras) {
  if (cameras.empty()) return {};
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Camera& camera : cameras) middle += camera.position() / double(cameras.size());
  std::vector<double> distance;
  for (const Camera& camera : cameras) distance.push_back((camera.position() - middle).norm());
  std::vector<int> order;
  int next = int(std::ranges::min_element(distance) - distance.begin());
  std::ranges::fill(distance, std::numeric_limits<double>::infinity());
  while (order.size() < cameras.size()) {
    order.push_back(next);
    distance[next] = -1;
    for (std::size_t i = 0; i < cameras.size(); ++i)
      distance[i] =
          std::min(distance[i], (cameras[i].position() - cameras[next].position()).norm());
    next = int(std::ranges::max_element(distance) - distance.begin());
  }
  return order;
}

SurfaceMesh grid_mesh(const DepthViews& all, const PointOptions& options, PointCounts* counts,
                      const RunControl& control) {
  const DepthViews in_scene = without_plain_ground(all, options.keeps_plain_ground, control);
  const Survey seen = survey(in_scene, control);
  const auto tolerance = SurfaceTolerance::of(seen.range);
  const auto [views, origin] = nearby(in_scene, seen.spacing);
  SurfaceMesh mesh;
  mesh.origin = origin;
  std::vector<Part> parts;
  for (const int view : farthest_first(views.cameras)) {
    control.throw_if_cancelled();
    control.progress("triangulate", double(parts.size()), views.size());
    std::vector<DepthView> witnesses;
    for (const int witness : witnesses_of(views.cameras, view, options.most_witnesses))
      witnesses.push_back(views.read(witness));
    DepthView own = views.read(view);
    KeptPixels kept = keep_pixels(own, witnesses, tolerance, options);
    own.inverse_depth = std::move(kept.inverse_depth);
    if (counts) *counts += kept.counts;
    const Mask covered = covered_by(parts, own, kept.keep, tolerance);
    if (mesh.positions.size() + kept.keep.size() >= kNoVertex)
      throw Error(ErrorCode::kInvalidArgument,
                  "a surface has less than 2^32 vertices; take fewer views");
    parts.push_back({own.camera, Builder(own, kept, covered, tolerance, mesh).add()});
  }
  if (mesh.faces.empty())
    throw Error(ErrorCode::kBadInput,
                "no surface: no three neighbouring pixels are sure and confirmed by other views");
  control.progress("triangulate", 1, 1);
  return mesh;
}

}  // namespace gigaray
