// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <concepts>
#include <numeric>
#include <optional>
#include <string_view>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/image.h"
#include "gigaray/core/light_field.h"

namespace GIGARAY_API gigaray {

/// A ray of a view under a hypothesis about how near its scene point is.
struct Ray {
  double u = 0;  ///< px at the sampler's level; integers are pixel centres
  double v = 0;  ///< px
  /// Larger is nearer. 3D and 4D: disparity in level-0 px per view step. Unstructured: inverse
  /// depth in the camera of this view, 0 at the farthest and 1 at the nearest of its own range.
  double hypothesis = 0;
};

/// The hypotheses that are tested: `count` values from min to max, both included, equally spaced.
struct HypothesisRange {
  double min = 0;
  double max = 0;
  int count = 2;
  double step() const { return (max - min) / (count - 1); }
  double value(int index) const { return min + index * step(); }
};

/// The contract between a kind of light field and the engine. Everything that differs between 3D,
/// 4D and unstructured input is behind it; nothing in the engine asks which one it has.
///
/// A sampler is a small immutable value that knows the geometry of all views, no pixel. Its
/// members:
///   num_views()                     number of views
///   locate(ref, other, ray)         where the ray of view `ref` is in view `other`; empty when it
///   is
///                                   behind that camera. The result may lie outside the picture:
///                                   the engine tests that. The hypothesis is converted to the
///                                   frame of `other` (eq. 3, 9, 10).
///   partners(ref)                   the views that rays of `ref` are compared with, ascending,
///   `ref`
///                                   among them. 3D and 4D: all.
///   rows_needed(ref, rows, range, height) the rows of its partners that rays of `rows` of view
///                                   `ref` can reach for hypotheses in `range`, clipped to
///                                   [0, height). For 3D: `rows` itself. Makes bands possible.
///   at_level(level)                 the same sampler for pictures halved `level` times, where
///   pixel
///                                   i stands for pixel i·2^level of level 0; hypotheses keep their
///                                   level-0 unit.
///   subset(views)                   the same for some of the views, in that order
///   ray_table(ref)                  what the OpenCL twin needs to locate rays of `ref`:
///                                   kRayTableWidth floats for every view
///   kKernelFile                     name of the OpenCL twin, a file of samplers/kernels
///   kRaysShiftAlike                 do the rays of all pixels of a view shift alike under one
///                                   hypothesis? Then the twin works out one shift for a block of
///                                   pixels (block_shift), else a place for each (locate_lanes)
/// All members are const and safe to call from many threads.
///
/// Laws, tested for every sampler by tests/samplers/sampler_laws.h:
///   1. locate(a, a, ray) is the ray itself.
///   2. locate(b, a, locate(a, b, ray)) is the ray itself.
///   3. On a rectified rig Epi = Grid at t = t̂ = Unstructured.
///   4. rows_needed contains every row of a partner that locate reaches.
///   5. The OpenCL twin locates the same ray.
///
/// To add one: a header in samplers/include, its twin in samplers/kernels, a line in any_sampler.h,
/// one call of the law suite, one line each in the CMakeLists of samplers (see CONTRIBUTING.md).
template <class S>
concept RaySampler = std::copyable<S> &&
    requires(const S sampler, int view, Ray ray, RowRange rows, HypothesisRange range, int number,
             std::vector<int> views) {
  { sampler.num_views() } -> std::same_as<int>;
  { sampler.locate(view, view, ray) } -> std::same_as<std::optional<Ray>>;
  { sampler.partners(view) } -> std::same_as<std::vector<int>>;
  { sampler.rows_needed(view, rows, range, number) } -> std::same_as<RowRange>;
  { sampler.at_level(number) } -> std::same_as<S>;
  { sampler.subset(views) } -> std::same_as<S>;
  { sampler.ray_table(view) } -> std::same_as<std::vector<float>>;
  { S::kRayTableWidth } -> std::convertible_to<int>;
  { S::kRaysShiftAlike } -> std::convertible_to<bool>;
  { S::kKernelFile } -> std::convertible_to<std::string_view>;
};

/// 0, 1, … count − 1.
inline std::vector<int> all_views(int count) {
  std::vector<int> views(count);
  std::iota(views.begin(), views.end(), 0);
  return views;
}

}  // namespace gigaray
