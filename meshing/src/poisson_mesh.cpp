// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Implicit_surface_3.h>
#include <CGAL/Poisson_reconstruction_function.h>
#include <CGAL/Random.h>
#include <CGAL/Surface_mesh_default_triangulation_3.h>
#include <CGAL/Surface_mesher/Standard_criteria.h>
#include <CGAL/make_surface_mesh.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <unordered_map>

#include "cgal_mesh.h"
#include "cloud_mesh.h"
#include "gigaray/core/error.h"
#include "gigaray/meshing/cloud_mesh.h"

namespace gigaray {
namespace {

using Oriented = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Function = CGAL::Poisson_reconstruction_function<Kernel>;
using Triangulation = CGAL::Surface_mesh_default_triangulation_3;
using Complex = CGAL::Complex_2_in_triangulation_3<Triangulation>;
using Criterion = CGAL::Surface_mesher::Refine_criterion<Triangulation>;

constexpr double kLeastAngle = 20;  ///< of triangles, degrees
/// Of triangles, in distances of neighbouring points: radius of the ball around them, and how far
/// they are from the surface.
constexpr double kRadius = 1, kDistance = 0.3;

/// Distance of neighbouring points anywhere; where there are none, the distance to them.
class Spacing {
 public:
  explicit Spacing(const Neighbours& neighbours)
      : neighbours_(neighbours), at_points_(neighbours.spacing()) {
    // Points at the same place don't ask for triangles without a size.
    std::vector<float> sorted = at_points_;
    const auto usual = sorted.begin() + std::ptrdiff_t(sorted.size() / 2);
    std::nth_element(sorted.begin(), usual, sorted.end());
    least_ = *usual / 100;
    for (float& spacing : at_points_) spacing = std::max(spacing, least_);
  }
  float of_point(std::size_t index) const { return at_points_[index]; }
  float at(const Eigen::Vector3f& place) const {
    const Neighbours::Found near = neighbours_.nearest(place, 1).front();
    return std::max(at_points_[near.index], near.distance);
  }
  /// Whether points are no farther from a place than so many times their distance.
  bool supports(const Eigen::Vector3f& place, double times) const {
    const Neighbours::Found near = neighbours_.nearest(place, 1).front();
    return near.distance <= times * at_points_[near.index];
  }
  float least() const { return least_; }

 private:
  const Neighbours& neighbours_;
  std::vector<float> at_points_;
  float least_ = 0;
};

/// Triangles as large as the points there are apart. Stops the work when it is cancelled.
class LocalSize : public Criterion {
 public:
  LocalSize(const Spacing& spacing, double scale, const RunControl& control)
      : spacing_(spacing), scale_(scale), control_(control) {}

  bool is_bad(const Facet& facet, Quality& quality) const override {
    control_.throw_if_cancelled();
    const auto& middle = facet.first->get_facet_surface_center(facet.second);
    const double size =
        scale_ * spacing_.at({float(middle.x()), float(middle.y()), float(middle.z())});
    const CGAL::Surface_mesher::Uniform_size_criterion<Triangulation> radius(kRadius * size);
    const CGAL::Surface_mesher::Curvature_size_criterion<Triangulation> distance(kDistance * size);
    return radius.is_bad(facet, quality) || distance.is_bad(facet, quality);
  }

 private:
  const Spacing& spacing_;
  double scale_;
  const RunControl& control_;
};

struct StopWhenCancelled {
  const RunControl* control;
  void before_insertion() const { control->throw_if_cancelled(); }
};

/// Places on the surface near some of the points, so that no piece of it is missed.
std::vector<Kernel::Point_3> starts(const Function& function, const std::vector<Oriented>& points,
                                    const Spacing& spacing) {
  constexpr std::size_t kStarts = 2000;
  constexpr int kHalvings = 30;
  std::vector<Kernel::Point_3> found;
  for (std::size_t i = 0; i < points.size();
       i += std::max<std::size_t>(1, points.size() / kStarts)) {
    const auto& [point, normal] = points[i];
    const Kernel::Vector_3 way = 2 * double(spacing.of_point(i)) * normal;
    Kernel::Point_3 inside = point - way, outside = point + way;
    const bool is_positive = function(inside) > 0;
    if (is_positive == (function(outside) > 0)) continue;
    for (int k = 0; k < kHalvings; ++k) {
      const Kernel::Point_3 middle = CGAL::midpoint(inside, outside);
      ((function(middle) > 0) == is_positive ? inside : outside) = middle;
    }
    found.push_back(inside);
  }
  return found;
}

/// Sorted, since CGAL's order of facets, and the side they are seen from, depend on addresses.
SurfaceMesh triangles_of(const Complex& complex, const Triangulation& triangulation) {
  SurfaceMesh mesh;
  std::unordered_map<Triangulation::Vertex_handle, std::uint32_t> places;
  for (const Triangulation::Vertex_handle vertex : triangulation.finite_vertex_handles()) {
    places[vertex] = std::uint32_t(mesh.positions.size());
    const auto& p = vertex->point();
    mesh.positions.emplace_back(float(p.x()), float(p.y()), float(p.z()));
  }
  for (auto facet = complex.facets_begin(); facet != complex.facets_end(); ++facet) {
    std::array<std::uint32_t, 3> face;
    for (int k = 0; k < 3; ++k)
      face[k] =
          places.at(facet->first->vertex(Triangulation::vertex_triple_index(facet->second, k)));
    std::ranges::sort(face);
    mesh.faces.push_back(face);
  }
  std::ranges::sort(mesh.faces);
  return mesh;
}

/// The surface where the implicit function of the points is zero; no triangle if there is none.
/// Not as CGAL's poisson_surface_reconstruction_delaunay: that asks for a manifold, and where the
/// function branches it refines without end; its triangles have one size everywhere. The random
/// start is fixed, so is the result.
SurfaceMesh zero_set(const std::vector<Oriented>& points, const Spacing& spacing, double scale,
                     const RunControl& control) {
  using Solver = CGAL::Eigen_solver_traits<
      Eigen::ConjugateGradient<CGAL::Eigen_sparse_symmetric_matrix<double>::EigenType>>;
  CGAL::get_default_random() = CGAL::Random(0);
  const StopWhenCancelled visitor{&control};
  const CGAL::First_of_pair_property_map<Oriented> place;
  const CGAL::Second_of_pair_property_map<Oriented> normal;
  Function function(points.begin(), points.end(), place, normal, visitor);
  if (!function.compute_implicit_function(Solver(), visitor)) return {};
  const double radius = 5 * std::sqrt(function.bounding_sphere().squared_radius());
  using Surface = CGAL::Implicit_surface_3<Triangulation::Geom_traits, Function>;
  const Surface surface(
      function, Triangulation::Geom_traits::Sphere_3(function.get_inner_point(), radius * radius),
      kDistance * scale * spacing.least() / 1000 / radius);
  Triangulation triangulation;
  const std::vector<Kernel::Point_3> on_surface = starts(function, points, spacing);
  triangulation.insert(on_surface.begin(), on_surface.end());
  Complex complex(triangulation);
  CGAL::Surface_mesher::Aspect_ratio_criterion<Triangulation> angle(kLeastAngle);
  LocalSize size(spacing, scale, control);
  CGAL::make_surface_mesh(complex, surface,
                          CGAL::Surface_mesher::Standard_criteria<Criterion>({&angle, &size}),
                          CGAL::Non_manifold_tag());
  return triangles_of(complex, triangulation);
}

/// Drops triangles with a corner or the middle farther from all points than so many times their
/// distance.
void trim(SurfaceMesh& mesh, const Spacing& spacing, double times) {
  std::vector<std::uint8_t> is_supported;
  for (const Eigen::Vector3f& place : mesh.positions)
    is_supported.push_back(spacing.supports(place, times));
  std::erase_if(mesh.faces, [&](const auto& face) {
    Eigen::Vector3f middle = Eigen::Vector3f::Zero();
    for (const std::uint32_t corner : face) {
      if (!is_supported[corner]) return true;
      middle += mesh.positions[corner] / 3;
    }
    return !spacing.supports(middle, times);
  });
}

}  // namespace

SurfaceMesh poisson_mesh(const PointCloud& cloud, const PoissonOptions& options,
                         const RunControl& control) {
  if (!(options.spacing > 0) || !(options.trim >= 0))
    throw Error(ErrorCode::kInvalidArgument,
                "a Poisson surface needs a spacing above 0 and a trim of 0 or more, not " +
                    std::to_string(options.spacing) + " and " + std::to_string(options.trim));
  check_cloud(cloud);
  std::vector<Oriented> points;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f &p = cloud.positions[i], &n = cloud.normals[i];
    points.emplace_back(Kernel::Point_3(p.x(), p.y(), p.z()),
                        Kernel::Vector_3(n.x(), n.y(), n.z()));
  }
  const Neighbours neighbours(cloud.positions);
  const Spacing spacing(neighbours);
  SurfaceMesh mesh;
  if (spacing.least() > 0) mesh = zero_set(points, spacing, options.spacing, control);
  if (mesh.faces.empty())
    throw Error(ErrorCode::kBadInput, "the points and their normals give no surface");

  mesh = surface_mesh_of(cgal_mesh_of(mesh));
  mesh.origin = cloud.origin;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    mesh.colours[i] = colour_at(mesh.positions[i], cloud, neighbours);
  if (options.trim > 0) trim(mesh, spacing, options.trim);
  turn_to_normals(mesh, cloud, neighbours);
  return mesh;
}

}  // namespace gigaray
