// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "mesh_sight.h"

#include <algorithm>
#include <cmath>

#include "gigaray/core/parallel.h"

namespace gigaray {
namespace {

constexpr int kRowsAtOnce = 64;
constexpr std::size_t kPiece = 8192;
/// Samples of a triangle are so far apart, px, and it has so many along an edge at most.
constexpr float kSampleStep = 4;
constexpr int kMostSteps = 24;
/// What a face that is seen under these conditions counts.
constexpr float kAtRim = 0.25f, kUnknown = 0.2f, kContradicted = 0.05f, kPartlyHidden = 0.02f;
/// Of a face that is partly hidden so much must be seen.
constexpr float kLeastSeen = 0.5f;

/// Calls job(begin, end) for pieces of [0, count).
template <class Job>
void in_pieces(std::size_t count, const Job& job) {
  parallel_for(
      int((count + kPiece - 1) / kPiece),
      [&](int i) { job(i * kPiece, std::min(count, (i + 1) * kPiece)); }, [](int) {});
}

float cross(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// How much the inverse depth of a triangle changes per px.
float slope(const Eigen::Vector3f& a, const Eigen::Vector3f& b, const Eigen::Vector3f& c,
            float twice_area) {
  const Eigen::Vector3f p = b - a, q = c - a;
  const float du = p.z() * q.y() - q.z() * p.y(), dv = q.z() * p.x() - p.z() * q.x();
  return std::hypot(du, dv) / std::abs(twice_area);
}

FloatMap most_around(const FloatMap& map) {
  const int width = map.width(), height = map.height();
  FloatMap result(width, height);
  parallel_for(
      height,
      [&](int v) {
        for (int u = 0; u < width; ++u) {
          float most = 0;
          for (int y = std::max(v - 1, 0); y <= std::min(v + 1, height - 1); ++y)
            for (int x = std::max(u - 1, 0); x <= std::min(u + 1, width - 1); ++x)
              most = std::max(most, map(x, y));
          result(u, v) = most;
        }
      },
      [](int) {});
  return result;
}

}  // namespace

std::vector<Eigen::Vector3f> projected(const SurfaceMesh& mesh, const Camera& camera) {
  std::vector<Eigen::Vector3f> places(mesh.positions.size());
  in_pieces(places.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d place = camera.project(mesh.positions[i].cast<double>() + mesh.origin);
      places[i] = place.z() > 0
                      ? Eigen::Vector3f(float(place.x()), float(place.y()), float(1 / place.z()))
                      : Eigen::Vector3f::Zero();
    }
  });
  return places;
}

MeshSight::MeshSight(const SurfaceMesh& mesh, const DepthView& view, float tolerance)
    : mesh_(mesh),
      view_(view),
      tolerance_(tolerance),
      places_(projected(mesh, view.camera)),
      nearest_(view.camera.width, view.camera.height) {
  const int height = nearest_.height();
  parallel_for((height + kRowsAtOnce - 1) / kRowsAtOnce,
               [&](int i) { draw(i * kRowsAtOnce, std::min(height, (i + 1) * kRowsAtOnce)); },
               [](int) {});
  around_ = most_around(nearest_);
}

void MeshSight::draw(int begin_row, int end_row) {
  const float last_column = float(nearest_.width() - 1);
  for (const auto& face : mesh_.faces) {
    const Eigen::Vector3f &a = places_[face[0]], &b = places_[face[1]], &c = places_[face[2]];
    if (a.z() <= 0 || b.z() <= 0 || c.z() <= 0) continue;
    const auto [top, bottom] = std::minmax({a.y(), b.y(), c.y()});
    if (bottom < float(begin_row) || top > float(end_row - 1)) continue;
    const auto [left, right] = std::minmax({a.x(), b.x(), c.x()});
    if (right < 0 || left > last_column) continue;
    const float area = cross(a, b, c);
    if (area == 0) continue;
    const int v0 = std::max(begin_row, int(std::ceil(top)));
    const int v1 = int(std::min(float(end_row - 1), bottom));
    const int u0 = int(std::ceil(std::max(0.0f, left))), u1 = int(std::min(last_column, right));
    for (int v = v0; v <= v1; ++v)
      for (int u = u0; u <= u1; ++u) {
        const Eigen::Vector3f here(float(u), float(v), 0);
        const float p = cross(here, b, c) / area, q = cross(a, here, c) / area, r = 1 - p - q;
        if (p < 0 || q < 0 || r < 0) continue;
        float& nearest = nearest_(u, v);
        nearest = std::max(nearest, p * a.z() + q * b.z() + r * c.z());
      }
  }
}

MeshSight::Sample MeshSight::sample(const Eigen::Vector3f& place, float tolerance) const {
  Sample result;
  result.is_inside = place.z() > 0 && place.x() >= 0 && place.y() >= 0 &&
                     place.x() <= float(nearest_.width() - 1) &&
                     place.y() <= float(nearest_.height() - 1);
  if (!result.is_inside) return result;
  const int u = int(std::lround(place.x())), v = int(std::lround(place.y()));
  result.is_hidden = nearest_(u, v) > place.z() + tolerance;
  result.is_at_rim = around_(u, v) > place.z() + 2 * tolerance;
  const float own = view_.inverse_depth(u, v);
  result.is_unknown = !(own > 0);
  // Masked pixels, as beside what a lens without its distortion shows, are black and tell nothing.
  const int light = view_.byte(u, v, 0) | view_.byte(u, v, 1) | view_.byte(u, v, 2);
  if (std::isnan(own) && light == 0) return {};
  result.is_contradicted = std::abs(own - place.z()) > 2 * tolerance;
  return result;
}

float MeshSight::quality(std::size_t face) const {
  const auto& corners = mesh_.faces[face];
  const Eigen::Vector3f &a = places_[corners[0]], &b = places_[corners[1]],
                        &c = places_[corners[2]];
  if (a.z() <= 0 || b.z() <= 0 || c.z() <= 0) return 0;
  const float area = cross(a, b, c);
  if (!(area < 0)) return 0;  // v points down, so what is seen from its front turns this way
  const float tolerance = tolerance_ + std::min(slope(a, b, c, area), 10 * tolerance_);
  const float longest =
      std::max({(b - a).head<2>().norm(), (c - b).head<2>().norm(), (a - c).head<2>().norm()});
  const int steps = std::clamp(int(std::ceil(longest / kSampleStep)), 1, kMostSteps);
  int seen = 0, all = 0;
  float weight = 1;
  const auto look = [&](float p, float q) {
    const Sample found = sample(a + p * (b - a) + q * (c - a), tolerance);
    ++all;
    seen += found.is_inside && !found.is_hidden;
    if (found.is_at_rim) weight = std::min(weight, kAtRim);
    if (found.is_unknown) weight = std::min(weight, kUnknown);
    if (found.is_contradicted) weight = std::min(weight, kContradicted);
    return found.is_inside;
  };
  for (int i = 0; i <= steps; ++i)
    for (int k = 0; i + k <= steps; ++k)
      if (!look(float(i) / float(steps), float(k) / float(steps))) return 0;
  look(1.0f / 3, 1.0f / 3);
  if (seen < all) {
    const float share = float(seen) / float(all);
    weight = share < kLeastSeen ? 0 : std::min(weight, kPartlyHidden * share);
  }
  return -0.5f * area * weight;
}

std::vector<float> MeshSight::qualities() const {
  std::vector<float> result(mesh_.faces.size());
  in_pieces(result.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t face = begin; face < end; ++face) result[face] = quality(face);
  });
  return result;
}

bool MeshSight::sees_vertex(std::uint32_t vertex) const {
  const Sample found = sample(places_[vertex], tolerance_);
  return found.is_inside && !found.is_hidden && !found.is_at_rim && !found.is_unknown &&
         !found.is_contradicted;
}

}  // namespace gigaray
