// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "gigaray/core/surface_mesh.h"
#include "gigaray/meshing/depth_view.h"

namespace gigaray {

/// Where the vertices of a mesh are in a view: (u, v) in px and inverse depth; that is 0 for what
/// is not before the camera.
std::vector<Eigen::Vector3f> projected(const SurfaceMesh& mesh, const Camera& camera);

/// What a view sees of a mesh. Looks at the mesh and the view as long as it lives.
class MeshSight {
 public:
  /// tolerance: inverse depths that are nearer to each other are one surface.
  MeshSight(const SurfaceMesh& mesh, const DepthView& view, float tolerance);

  /// How well each face is seen: px² that it takes in the picture, a part of that where it is near
  /// a silhouette, where the view's depth shows something else or nothing, or where a part of it is
  /// hidden. 0: not seen.
  std::vector<float> qualities() const;

  /// Is the vertex there in the picture, by the mesh and by the view's depth, clear of silhouettes?
  bool sees_vertex(std::uint32_t vertex) const;
  /// Places of the vertices as `projected` gives them.
  const std::vector<Eigen::Vector3f>& places() const { return places_; }

 private:
  struct Sample {
    bool is_inside = false, is_hidden = false, is_at_rim = false;
    bool is_unknown = false, is_contradicted = false;  ///< by the view's depth
  };

  void draw(int begin_row, int end_row);
  Sample sample(const Eigen::Vector3f& place, float tolerance) const;
  float quality(std::size_t face) const;

  const SurfaceMesh& mesh_;
  const DepthView& view_;
  float tolerance_;
  std::vector<Eigen::Vector3f> places_;
  FloatMap nearest_;  ///< inverse depth of the mesh (v, u); 0: nothing
  FloatMap around_;   ///< the nearest of 3 × 3 px
};

}  // namespace gigaray
