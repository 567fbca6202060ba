// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "seams.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "view_choice.h"

namespace gigaray {
namespace {

constexpr double kSeam = 10;               ///< weight of a seam against that of an edge
constexpr double kFade = 1.0 / (20 * 20);  ///< offsets fade over some 20 edges
/// Sides that differ by more show other things as a rule: exposures are alike already.
constexpr double kUsualJump = 12;
constexpr int kMostRounds = 400;
constexpr double kExact = 1e-3;

/// A vertex as one view shows it.
struct Node {
  std::uint32_t vertex = 0;
  int view = 0;
  std::uint32_t next = kNoFace;  ///< of the same vertex
  Eigen::Vector2f place = Eigen::Vector2f::Zero();
};

class Leveller {
 public:
  Leveller(const SurfaceMesh& mesh, const std::vector<int>& view_of_face, SurfaceTexture& texture)
      : mesh_(mesh),
        views_(view_of_face),
        texture_(texture),
        first_(mesh.positions.size(), kNoFace),
        node_of_corner_(mesh.faces.size()) {
    for (std::size_t face = 0; face < mesh.faces.size(); ++face)
      for (std::size_t i = 0; i < 3; ++i)
        node_of_corner_[face][i] =
            view_of_face[face] < 0 ? kNoFace : node_of(face, mesh.faces[face][i], i);
  }

  bool has_seams() const {
    return std::ranges::any_of(nodes_, [](const Node& node) { return node.next != kNoFace; });
  }

  /// Offsets of the nodes, in steps of 8 bit.
  std::vector<Eigen::Vector3f> solve(const RunControl& control) const {
    Eigen::MatrixX3d right = Eigen::MatrixX3d::Zero(Eigen::Index(nodes_.size()), 3);
    const Eigen::SparseMatrix<double> matrix = equations(right);
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
    solver.setMaxIterations(kMostRounds);
    solver.setTolerance(kExact);
    solver.compute(matrix);
    std::vector<Eigen::Vector3f> offsets(nodes_.size());
    for (int k = 0; k < 3; ++k) {
      control.throw_if_cancelled();
      const Eigen::VectorXd found = solver.solve(right.col(k));
      for (std::size_t i = 0; i < nodes_.size(); ++i) offsets[i][k] = float(found[Eigen::Index(i)]);
    }
    return offsets;
  }

  void apply(const std::vector<Eigen::Vector3f>& offsets) {
    // Where a texel is in no triangle the nearest one around reaches out for it.
    Image<std::int8_t> added(texture_.picture.width(), texture_.picture.height(), 3);
    Mask done(texture_.picture.width(), texture_.picture.height());
    for (const float reach : {1.5f, 0.0f})
      for (std::size_t face = 0; face < mesh_.faces.size(); ++face)
        if (views_[face] >= 0) spread(face, offsets, reach, added, done);
    std::transform(texture_.picture.begin(), texture_.picture.end(), added.begin(),
                   texture_.picture.begin(), [](std::uint8_t value, std::int8_t offset) {
                     return std::uint8_t(std::clamp(value + offset, 0, 255));
                   });
  }

 private:
  std::uint32_t node_of(std::size_t face, std::uint32_t vertex, std::size_t corner) {
    std::uint32_t* place = &first_[vertex];
    while (*place != kNoFace) {
      if (nodes_[*place].view == views_[face]) return *place;
      place = &nodes_[*place].next;
    }
    const auto index = std::uint32_t(nodes_.size());
    *place = index;  // before the nodes move
    nodes_.push_back({vertex, views_[face], kNoFace, texture_.corners[face][corner]});
    return index;
  }

  /// Mean over 3 × 3 texels.
  Eigen::Vector3d colour(const Node& node) const {
    const Image<std::uint8_t>& picture = texture_.picture;
    const int u = int(node.place.x() * float(picture.width())),
              v = int(node.place.y() * float(picture.height()));
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int y = v - 1; y <= v + 1; ++y)
      for (int x = u - 1; x <= u + 1; ++x) {
        const std::uint8_t* texel =
            &picture(std::clamp(x, 0, picture.width() - 1), std::clamp(y, 0, picture.height() - 1));
        sum += Eigen::Vector3d(texel[0], texel[1], texel[2]);
      }
    return sum / 9;
  }

  Eigen::SparseMatrix<double> equations(Eigen::MatrixX3d& right) const {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(nodes_.size() * 14);
    const auto tie = [&](std::uint32_t a, std::uint32_t b, double weight) {
      entries.emplace_back(a, a, weight);
      entries.emplace_back(b, b, weight);
      entries.emplace_back(a, b, -weight);
      entries.emplace_back(b, a, -weight);
    };
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      entries.emplace_back(i, i, kFade);
      for (std::uint32_t k = nodes_[i].next; k != kNoFace; k = nodes_[k].next) {
        const Eigen::Vector3d jump = colour(nodes_[k]) - colour(nodes_[i]);
        const double gap = jump.cwiseAbs().maxCoeff() / kUsualJump;
        const double weight = kSeam / (1 + gap * gap * gap * gap);
        tie(i, k, weight);
        right.row(i) += weight * jump.transpose();
        right.row(k) -= weight * jump.transpose();
      }
    }
    for (const auto& corners : node_of_corner_)
      if (corners[0] != kNoFace)
        for (std::size_t i = 0; i < 3; ++i) tie(corners[i], corners[(i + 1) % 3], 0.5);
    Eigen::SparseMatrix<double> matrix(right.rows(), right.rows());
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  /// reach: px beyond the triangle; what is there already stays.
  void spread(std::size_t face, const std::vector<Eigen::Vector3f>& offsets, float reach,
              Image<std::int8_t>& added, Mask& done) const {
    const auto& nodes = node_of_corner_[face];
    const Eigen::Vector3f &x = offsets[nodes[0]], &y = offsets[nodes[1]], &z = offsets[nodes[2]];
    const Eigen::Array2f size(float(added.width()), float(added.height()));
    std::array<Eigen::Array2f, 3> at;
    for (std::size_t i = 0; i < 3; ++i) at[i] = texture_.corners[face][i].array() * size - 0.5f;
    const Eigen::Array2f least = at[0].min(at[1]).min(at[2]) - reach,
                         most = at[0].max(at[1]).max(at[2]) + reach;
    const Eigen::Array2f e = at[1] - at[0], f = at[2] - at[0];
    const float area = e.x() * f.y() - e.y() * f.x();
    if (area == 0) return;
    for (int v = std::max(0, int(std::ceil(least.y())));
         v <= std::min(added.height() - 1, int(most.y())); ++v)
      for (int u = std::max(0, int(std::ceil(least.x())));
           u <= std::min(added.width() - 1, int(most.x())); ++u) {
        const Eigen::Array2f d = Eigen::Array2f(float(u), float(v)) - at[0];
        float q = (d.x() * f.y() - d.y() * f.x()) / area,
              r = (e.x() * d.y() - e.y() * d.x()) / area;
        const bool is_inside = q >= 0 && r >= 0 && q + r <= 1;
        if (!is_inside && (reach == 0 || done(u, v))) continue;
        q = std::clamp(q, 0.0f, 1.0f);
        r = std::clamp(r, 0.0f, 1 - q);
        const Eigen::Vector3f offset = (1 - q - r) * x + q * y + r * z;
        for (int k = 0; k < 3; ++k)
          added(u, v, k) = std::int8_t(std::clamp(std::lround(offset[k]), -127L, 127L));
        done(u, v) = 1;
      }
  }

  const SurfaceMesh& mesh_;
  const std::vector<int>& views_;
  SurfaceTexture& texture_;
  std::vector<std::uint32_t> first_;  ///< of each vertex
  std::vector<std::array<std::uint32_t, 3>> node_of_corner_;
  std::vector<Node> nodes_;
};

}  // namespace

void level_seams(const SurfaceMesh& mesh, const std::vector<int>& view_of_face,
                 SurfaceTexture& texture, const RunControl& control) {
  Leveller leveller(mesh, view_of_face, texture);
  if (leveller.has_seams()) leveller.apply(leveller.solve(control));
}

}  // namespace gigaray
