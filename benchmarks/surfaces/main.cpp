// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Surfaces of solids of known shape by all methods, from exact, disturbed and computed depth: how
// far they are from the truth, how much of it they have, and their topology. Prints a table.
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <chrono>
#include <cstdio>

#include "gigaray/meshing/cloud.h"
#include "gigaray/meshing/cloud_mesh.h"
#include "gigaray/meshing/grid_mesh.h"
#include "gigaray/meshing/mesh_processing.h"
#include "gigaray/meshing/mesh_report.h"
#include "surfaces/photographed_solid.h"

namespace gigaray::benchmarks {
namespace {

using namespace solids;

constexpr double kCameraDistance = 3.2;
constexpr int kSize = 160;  // px

/// Points spread evenly over the triangles.
std::vector<Eigen::Vector3f> samples_of(const SurfaceMesh& mesh, int count) {
  std::vector<double> areas;
  double total = 0;
  const auto corner = [&](std::size_t face, int k) { return mesh.positions[mesh.faces[face][k]]; };
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    total += (corner(i, 1) - corner(i, 0)).cross(corner(i, 2) - corner(i, 0)).norm();
    areas.push_back(total);
  }
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform;
  std::vector<Eigen::Vector3f> samples;
  for (int i = 0; i < count; ++i) {
    const auto face =
        std::size_t(std::ranges::upper_bound(areas, total * uniform(random)) - areas.begin());
    float a = float(uniform(random)), b = float(uniform(random));
    if (a + b > 1) a = 1 - a, b = 1 - b;
    const std::size_t inside = std::min(face, mesh.faces.size() - 1);
    samples.push_back(corner(inside, 0) + a * (corner(inside, 1) - corner(inside, 0)) +
                      b * (corner(inside, 2) - corner(inside, 0)));
  }
  return samples;
}

/// Points of the true surface that three cameras or more see.
std::vector<Eigen::Vector3d> truth_of(const DepthViews& exact) {
  constexpr int kStep = 5;
  std::vector<DepthView> views;
  for (int i = 0; i < exact.size(); ++i) views.push_back(exact.read(i));
  const auto sees = [](const DepthView& view, const Eigen::Vector3d& point) {
    const Eigen::Vector3d at = view.camera.project(point);
    if (!view.camera.sees(point)) return false;
    const float w = view.inverse_depth(int(std::lround(at.x())), int(std::lround(at.y())));
    return std::abs(w * at.z() - 1) < 0.02;
  };
  std::vector<Eigen::Vector3d> points;
  for (const DepthView& view : views)
    for (int v = 0; v < view.inverse_depth.height(); v += kStep)
      for (int u = 0; u < view.inverse_depth.width(); u += kStep) {
        const float w = view.inverse_depth(u, v);
        if (!(w > 0)) continue;
        const Eigen::Vector3d point = view.camera.back_project(u, v, 1 / double(w));
        if (std::ranges::count_if(views,
                                  [&](const DepthView& other) { return sees(other, point); }) >= 3)
          points.push_back(point);
      }
  return points;
}

/// Share of the true surface that is nearer to the mesh than a hundredth of the depth.
double completeness(const SurfaceMesh& mesh, const std::vector<Eigen::Vector3d>& truth) {
  using K = CGAL::Simple_cartesian<double>;
  using Triangles = std::vector<K::Triangle_3>;
  using Primitive = CGAL::AABB_triangle_primitive<K, Triangles::iterator>;
  const auto point = [](const auto& p) { return K::Point_3(p.x(), p.y(), p.z()); };
  Triangles triangles;
  for (const auto& face : mesh.faces)
    triangles.emplace_back(point(mesh.positions[face[0]]), point(mesh.positions[face[1]]),
                           point(mesh.positions[face[2]]));
  const CGAL::AABB_tree<CGAL::AABB_traits<K, Primitive>> tree(triangles.begin(), triangles.end());
  const double near = 0.01 * kCameraDistance;
  const auto found = std::ranges::count_if(truth, [&](const Eigen::Vector3d& place) {
    return tree.squared_distance(point(place)) < near * near;
  });
  return double(found) / double(truth.size());
}

SurfaceMesh surface_by(const std::string& method, const DepthViews& views) {
  if (method == "grid") return grid_mesh(views, {}, nullptr, {});
  PointCloud cloud;
  build_cloud(views, {}, [&](const PointCloud& tile) { append(cloud, tile); }, {});
  return method == "poisson" ? poisson_mesh(cloud, {}, {}) : advancing_front_mesh(cloud, {}, {});
}

struct Trial {
  Solid solid;
  std::vector<Camera> cameras;
};

void measure(const Trial& trial, const std::string& depth, const DepthViews& views) {
  const std::vector<Eigen::Vector3d> truth = truth_of(views_of(trial.solid, trial.cameras));
  for (const char* method : {"grid", "poisson", "front"}) {
    const auto begin = std::chrono::steady_clock::now();
    const SurfaceMesh mesh = cleaned(surface_by(method, views), {}, nullptr);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const Distances gaps = distances_to(trial.solid, samples_of(mesh, 100'000));
    const MeshReport report = report_of(mesh);
    std::printf("| %s | %s | %s | %zu | %.3f | %.3f | %.1f | %zu | %zu | %s | %.1f |\n",
                trial.solid.name.c_str(), depth.c_str(), method, report.faces,
                100 * gaps.mean / kCameraDistance, 100 * gaps.most / kCameraDistance,
                100 * completeness(mesh, truth), report.components, report.genus,
                report.is_watertight ? "yes" : "no", seconds);
    std::fflush(stdout);
  }
}

void run() {
  std::printf(
      "| solid | depth | method | faces | distance, mean, %% of depth | 95 %% of it within | "
      "complete, %% | pieces | genus | watertight | s |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n");
  const auto around = cameras_all_around(72, kSize), arc = cameras_on_an_arc(9, kSize);
  for (const Trial& trial : {Trial{sphere(), around}, Trial{box(), around},
                             Trial{tilted_planes(), arc}, Trial{rod(), arc}}) {
    measure(trial, "exact", views_of(trial.solid, trial.cameras));
    measure(trial, "noise 0.2 %, outliers 2 %",
            views_of(trial.solid, trial.cameras, {.noise = 0.002, .outliers = 0.02}));
    measure(trial, "computed", computed_views(trial.solid, trial.cameras));
  }
}

}  // namespace
}  // namespace gigaray::benchmarks

int main() {
  try {
    gigaray::benchmarks::run();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
