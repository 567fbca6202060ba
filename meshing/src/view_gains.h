// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "gigaray/core/surface_mesh.h"
#include "mesh_sight.h"

namespace gigaray {

/// Colours of points of a surface in the views that see them, and the gains that make them alike.
class ViewGains {
 public:
  /// Points are vertices of the mesh.
  ViewGains(const SurfaceMesh& mesh, int num_views);

  /// Looks at the view's points. Colours near black and white are left out.
  void look(int view, const MeshSight& sight, const DepthView& own);

  /// The factor of each view's linear light, per channel, > 0: least squares over the logarithms,
  /// robust. Their mean over the views is 1 where nothing else is known.
  std::vector<Eigen::Array3d> gains() const;

 private:
  struct Seen {
    int view = 0;
    std::array<float, 3> log_light{};
  };

  Eigen::VectorXd solve(int channel) const;

  int num_views_;
  std::size_t step_;  ///< every so many vertices there is a point
  std::vector<std::vector<Seen>> points_;
};

/// What 8-bit sRGB values become when their linear light is multiplied with the gain.
using ValueTable = std::array<std::array<std::uint8_t, 256>, 3>;
ValueTable table_of(const Eigen::Array3d& gain);

}  // namespace gigaray
