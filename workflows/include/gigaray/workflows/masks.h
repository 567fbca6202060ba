// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gigaray/applications/segmentation.h"
#include "gigaray/core/api.h"
#include "gigaray/workflows/result.h"

namespace GIGARAY_API gigaray {

/// A pixel, px; 0 0 is the top left one.
struct PixelPlace {
  int u = 0;
  int v = 0;
};

/// The interval of disparity (of photographs with cameras inverse depth) around a pixel of the top
/// view of a scene, and what it is in the other views.
class PixelInterval {
 public:
  /// tolerance: px per view step to both sides, of photographs a share of the inverse depth;
  /// empty: as far as the surface goes, see interval_around(). Throws Error(kInvalidArgument) for a
  /// pixel outside of the picture or without an estimate that is sure enough, and for a tolerance
  /// that reaches infinity.
  PixelInterval(const DepthScene& scene, PixelPlace at, std::optional<double> tolerance);

  int view() const { return view_; }
  PixelPlace at() const { return at_; }
  float value() const { return value_; }  ///< of the pixel
  /// In the view of the pixel.
  ValueInterval values() const { return values_; }
  /// In any view. Of photographs around the depth that the point has in that camera, by the same
  /// share; nothing where it lies behind the camera.
  ValueInterval values_in(int view) const;

 private:
  const LightField& geometry_;
  int view_;
  PixelPlace at_;
  float value_ = 0;
  ValueInterval values_;
};

/// What an interval is measured in.
enum class IntervalUnit { kDisparity, kInverseDepth, kDepth };
const char* to_string(IntervalUnit unit);  ///< "disparity", "inverse depth", "depth"

/// What belongs to a mask: what is between two values, or what is as far away as a pixel.
struct MaskRequest {
  struct NearFar {
    double near = 0, far = 0;
  };
  /// near > far: disparities, of photographs with cameras inverse depths; near < far: distances.
  std::optional<NearFar> between = {};
  std::optional<PixelPlace> at = {};     ///< of the top view, in place of `between`
  std::optional<double> tolerance = {};  ///< with `at`, see PixelInterval
  std::string unit = "auto";  ///< "disparity" or "depth": a pair in the other order is refused
  bool soft = false;          ///< mattes too; needs pictures
  MatteOptions matte = {};
};

struct ViewMask {
  Mask mask;       ///< (v, u), 1: belongs to it
  FloatMap matte;  ///< (v, u), opacity [0, 1]; with `soft`
};

/// Masks of a scene's views. The scene must outlive it.
class SceneMasks {
 public:
  /// Throws Error(kInvalidArgument) naming the field.
  SceneMasks(const DepthScene& scene, MaskRequest request);

  IntervalUnit unit() const { return unit_; }
  /// In that unit; in the top view where it is around a pixel.
  ValueInterval values() const { return values_; }
  const std::optional<PixelInterval>& pixel() const { return pixel_; }

  ViewMask view(int view) const;
  const DepthScene& scene() const { return scene_; }

 private:
  void take_near_far();

  const DepthScene& scene_;
  MaskRequest request_;
  IntervalUnit unit_ = IntervalUnit::kDisparity;
  ValueInterval values_;
  std::optional<PixelInterval> pixel_;
};

/// Kind of a folder with masks, for AtomicFolder.
inline constexpr const char* kSegmentFormat = "gigaray segment";

/// Writes VIEW/mask.png (and matte.png, 16 bit, where there are mattes; with as_exr the same as
/// EXR), those of the centre view at top level too, and gigaray.json, into a folder that is there.
/// views: as parse_views() takes them. Returns how many there are.
int write_masks(const SceneMasks& masks, const std::string& views, bool as_exr,
                const std::filesystem::path& folder, const RunControl& control);

}  // namespace gigaray
