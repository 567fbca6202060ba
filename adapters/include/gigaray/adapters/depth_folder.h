// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/core/api.h"
#include "gigaray/core/image.h"
#include "gigaray/core/light_field.h"

namespace GIGARAY_API gigaray {

class ColmapDense;
class NerfstudioScene;

/// Value of "format" in the gigaray.json of an output folder of `gigaray depth`.
inline constexpr const char* kDepthFormat = "gigaray depth";

/// Formats of maps beside the PFM files.
enum class MapFormat {
  kExr,
  kNpy,
  kPng16,
  kColmap,  ///< unstructured: a dense workspace in the folder "colmap", for `colmap stereo_fusion`
  kNerfstudio,  ///< where depth is known: the folder "nerfstudio" with transforms.json
};

/// The output folder of `gigaray depth` (docs/formats.md): VIEW/disparity.pfm, VIEW/confidence.pfm
/// and VIEW/depth.png (and VIEW/depth.pfm in scene units, if the rig is known, and of unstructured
/// views VIEW/picture.png, the undistorted picture that the maps belong to) for every view, those
/// of the centre view also at top level, gigaray.json. Appears only when complete.
class DepthFolder {
 public:
  /// Make it before the work: throws like AtomicFolder when the place can't be used.
  DepthFolder(const std::filesystem::path& target, std::set<MapFormat> formats, OutputRules rules);
  ~DepthFolder();

  /// Before the first view. cameras: of 3D and 4D light fields, for kNerfstudio. Throws
  /// Error(kInvalidArgument) for a format that doesn't go with it.
  void describe(LightField light_field, std::vector<Camera> cameras = {});

  /// disparity, confidence: (v, u) of the view, NaN where there is no estimate. Cut to the size of
  /// the view's own picture. pictured: range of the colours of depth.png and of 16-bit PNGs.
  void write_view(int view_idx, FloatMap disparity, FloatMap confidence, DisparityRange pictured,
                  bool is_centre);

  /// Adds gigaray.json and puts the folder in its place, as AtomicFolder does.
  void commit(const std::string& json, const RunControl& control = RunControl());

 private:
  void write_maps(const std::filesystem::path& folder, const FloatMap& disparity,
                  const FloatMap& confidence, DisparityRange pictured) const;
  void write_picture(const std::filesystem::path& folder, int view_idx, const FloatMap& disparity,
                     bool is_centre);

  AtomicFolder folder_;
  std::set<MapFormat> formats_;
  LightField light_field_;
  std::vector<Camera> cameras_;
  std::unique_ptr<ColmapDense> colmap_;          ///< if asked for
  std::unique_ptr<NerfstudioScene> nerfstudio_;  ///< the same
};

}  // namespace gigaray
