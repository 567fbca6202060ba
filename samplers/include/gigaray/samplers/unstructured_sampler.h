// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>

#include "gigaray/core/api.h"
#include "gigaray/core/ray_sampler.h"

namespace GIGARAY_API gigaray {

/// Unstructured light fields: posed pinhole cameras anywhere. A ray is back-projected with the
/// reference camera at inverse depth w and re-projected with the other one (eq. 10):
///   (U, V, Z) = M (u, v, 1) + w m,  seen at (U / Z, V / Z), there at inverse depth w / Z
/// with M = K' R' Rᵀ K⁻¹ and m = K' (t' − R' Rᵀ t).
///
/// A hypothesis h is the inverse depth in the range of its own camera, w = min + h (max − min), so
/// that cameras that see different distances search each its own. h in [0, 1] is the range;
/// estimates carried over from another view may lie outside.
class UnstructuredSampler {
 public:
  static constexpr std::string_view kKernelFile = "unstructured_sampler.cl";
  static constexpr int kRayTableWidth = 16;  ///< M, m (both for h), inverse depths: see there
  static constexpr bool kRaysShiftAlike = false;
  /// A partner sees at least this share of the volume that the reference camera sees between its
  /// nearest and its farthest inverse depth, under an angle of at most so many degrees, in a
  /// scale at most so many times coarser or finer.
  static constexpr double kLeastOverlap = 0.3, kWidestAngle = 40, kMostScale = 3;

  /// Every camera has its range of inverse depths (Camera::inverse_depth). most_partners: of each
  /// view, itself not counted, the best ones by overlap and angle; 0: all that fit.
  explicit UnstructuredSampler(const std::vector<Camera>& cameras, int most_partners = 0);

  /// The way of rays of one view into another, for many of them: what locate() gives, but for the
  /// rounding of floating point.
  class Way {
   public:
    std::optional<Ray> operator()(Ray ray) const;

   private:
    friend UnstructuredSampler;
    Eigen::Matrix3d turn_;   // M, with the far end of the range
    Eigen::Vector3d shift_;  // m, over the range
    InverseDepthRange from_, to_;
  };

  int num_views() const { return int(cameras_.size()); }
  std::optional<Ray> locate(int ref, int other, Ray ray) const;
  Way way(int ref, int other) const;
  std::vector<int> partners(int ref) const { return partners_[ref]; }
  /// Those of them, `ref` left out, whose cameras stand nearest, at most so many, nearest first.
  std::vector<int> nearest_partners(int ref, std::size_t most) const;
  RowRange rows_needed(int ref, RowRange rows, HypothesisRange range, int height) const;
  UnstructuredSampler at_level(int level) const;
  UnstructuredSampler subset(const std::vector<int>& views) const;
  std::vector<float> ray_table(int ref) const;

  double inverse_depth(int view, double hypothesis) const;  ///< 1/scene unit
  double hypothesis(int view, double inverse_depth) const;
  /// Length of the way that partner `other` sees the centre of `ref` go as h goes from 0 to 1, px
  /// of level 0.
  double travel(int ref, int other) const;

 private:
  struct Pair {
    Eigen::Matrix3d turn;   // M
    Eigen::Vector3d shift;  // m
  };
  UnstructuredSampler() = default;
  Pair pair(int ref, int other) const;

  std::vector<Camera> cameras_;  // of the level
  std::vector<std::vector<int>> partners_;
};
static_assert(RaySampler<UnstructuredSampler>);

}  // namespace gigaray
