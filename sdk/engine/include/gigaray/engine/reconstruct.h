// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"
#include "gigaray/core/ray_sampler.h"
#include "gigaray/core/run_control.h"
#include "gigaray/engine/depth_options.h"

namespace GIGARAY_API gigaray {

/// Mean radiance of an estimate, working colour space.
struct Radiance {
  float r = 0, g = 0, b = 0;
};

/// A line segment of the light field: an accepted estimate (section 3), an element of Γ.
struct RayTuple {
  /// Disparity, level-0 px per view step; the slope m of eq. 1 is its inverse. Unstructured:
  /// inverse depth in the camera of `view`.
  float hypothesis = 0;
  float confidence = 0;
  Radiance radiance;      ///< Mean radiance r̄ in the working colour space.
  std::int32_t view = 0;  ///< Where it was computed,
  std::int32_t u = 0;     ///< px of `level`
  std::int32_t v = 0;     ///< px of `level`
  std::int32_t level = 0;
};

/// Depth of one view.
struct ViewDepth {
  /// (v, u), level-0 px per view step; unstructured: inverse depth 1/z in the view's camera,
  /// 1/scene unit. NaN: no estimate
  FloatMap disparity;
  /// (v, u); NaN: no estimate. auto: probability of being right within 0.07 px, calibration.h;
  /// paper: eq. 7, 0 and above.
  FloatMap confidence;
  Image<std::int8_t> level;  ///< pyramid level that decided, −1: none
};

/// Takes back disparities with a confidence below `min_confidence`; confidence stays.
void drop_unsure(float min_confidence, ViewDepth& depth);

/// What a run will take.
struct Forecast {
  double memory_bytes = 0;      ///< Peak, with what memory_limit allows.
  double disk_bytes = 0;        ///< Intermediate data in the work folder; 0: all in memory.
  double memory_all_bytes = 0;  ///< What it would take to keep everything in memory.
  int bands = 1;                ///< Parts that level 0 is walked in.
};

/// Where the kernels run. "opencl" on the device that `device` means (see select_device), or
/// "reference", the plain loops that they are checked against: slow.
struct BackendChoice {
  std::string backend = "opencl";
  std::string device;
};

/// Where the estimate of a pixel comes from.
struct Decision {
  int level = -1;  ///< Pyramid level that decided; −1: none did
  /// View that it was found in, and the pixel of its level; −1: filled between the estimates
  /// around.
  int view = -1, u = -1, v = -1;
  float disparity = kNoEstimate;  ///< As found, before the final median; unit of ViewDepth
  /// What was searched there: a part of the range where estimates of finer levels bound it. All of
  /// the range without DepthOptions::keep_searches.
  DisparityRange bounds;
};

/// Result of a run: maps of all views that were asked for and tuples, in memory or on disk. Needs
/// no device. Movable; any number of threads may read.
class Reconstruction {
 public:
  struct Impl;
  explicit Reconstruction(std::unique_ptr<Impl> impl);
  Reconstruction(Reconstruction&&) noexcept;
  Reconstruction& operator=(Reconstruction&&) noexcept;
  ~Reconstruction();

  /// The options as they were used: range, number of hypotheses and bandwidths filled in.
  const DepthOptions& options() const;
  HypothesisRange hypotheses() const;  ///< unstructured: from the least to the largest of all views
  /// The light field that the maps belong to: the one given or, where the direction of the camera
  /// was only assumed and is another, with its axes turned.
  const LightField& light_field() const;
  /// Unstructured: the cameras, with the range of inverse depths that each searched. Else empty.
  const std::vector<Camera>& cameras() const;
  const std::vector<int>& views() const;  ///< Views that have depth.
  int num_levels() const;

  /// Maps of a view at level 0, with coarse estimates where finer levels have none (section 4.5).
  /// view_idx: one of views(). Throws Error(kInvalidArgument) for others.
  ViewDepth view(int view_idx) const;

  /// Why pixel (u, v) of one of views() has its estimate. Throws Error(kInvalidArgument) outside.
  Decision decision(int view_idx, int u, int v) const;

  /// All tuples in a fixed order: level, view as processed, v, u.
  void for_each_tuple(const std::function<void(const RayTuple&)>& visit) const;
  std::size_t num_tuples() const;

  const std::string& device() const;                     ///< Backend and device, for reports.
  const std::map<std::string, double>& seconds() const;  ///< Per stage.
  const Forecast& forecast() const;

 private:
  std::unique_ptr<Impl> impl_;
};

/// Depth for every view of a light field: the whole method of METHOD's steps 1–7 on all levels.
/// The result does not depend on memory, bands or threads; twice the same input gives the same
/// bits. A direction that is only assumed (LightField::sign_is_assumed) is checked as
/// check_direction() does, with a message; Reconstruction::light_field() has the positions that
/// were found. Opens the device for this one call; Estimator keeps it open. Throws Error:
/// kInvalidArgument (options; a direction that is only assumed and that
/// the pictures don't tell), kBadInput (light field), kDevice, kIo, kOutOfMemory, kCancelled.
Reconstruction reconstruct(const LightField& light_field, const DepthOptions& options,
                           const BackendChoice& backend, const RunControl& control);

/// Memory and disk of reconstruct() with these options. Reads pictures only where the input does
/// not state the range, which then is estimated as reconstruct() does. Throws what reconstruct()
/// would throw before its work, so the least memory that will do is the same.
Forecast forecast(const LightField& light_field, const DepthOptions& options,
                  const BackendChoice& backend = {});

/// Least DepthOptions::memory_bytes that reconstruct() runs with, as its refusal names it.
double least_memory_bytes(const LightField& light_field, const DepthOptions& options);

/// Scores of one pixel: why it has the disparity that it has.
struct ScoreCurve {
  std::vector<float> scores;  ///< One per hypothesis, as the winner is chosen from; −1: not tested
  HypothesisRange hypotheses;
  float disparity = 0;   ///< Winner; NaN if none
  float confidence = 0;  ///< Best score minus mean score
  /// Per view the pixel nearest to the winner's ray: encoded RGB in [0, 1]; NaN outside the
  /// picture.
  std::vector<Radiance> samples;
};

/// A pixel of a view, px; (0, 0) is the top left one.
struct PixelIndex {
  int u = 0;
  int v = 0;
};

/// The score curve of pixel (u, v) of a view at level 0, with all hypotheses. Checks a direction
/// that is only assumed as reconstruct() does.
ScoreCurve probe(const LightField& light_field, const DepthOptions& options,
                 const BackendChoice& backend, int view_idx, int u, int v,
                 const RunControl& control);

}  // namespace gigaray
