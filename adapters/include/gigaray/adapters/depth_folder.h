// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/image.h"
#include "gigaray/light_field.h"

namespace gigaray {

/// Value of "format" in the gigaray.json of an output folder of `gigaray depth`.
inline constexpr const char* kDepthFormat = "gigaray depth";

/// Formats of maps beside the PFM files.
enum class MapFormat { kExr, kNpy, kPng16 };

/// The output folder of `gigaray depth` (docs/formats.md): VIEW/disparity.pfm, VIEW/confidence.pfm
/// and VIEW/depth.png (and VIEW/depth.pfm in scene units, if the rig is known, and of unstructured
/// views VIEW/picture.png, the undistorted picture that the maps belong to) for every view, those
/// of the centre view also at top level, gigaray.json. Appears only when complete.
class DepthFolder {
 public:
  /// Make it before the work: throws like AtomicFolder when the place can't be used.
  DepthFolder(const std::filesystem::path& target, std::set<MapFormat> formats,
              LightField light_field)
      : folder_(target, kDepthFormat),
        formats_(std::move(formats)),
        light_field_(std::move(light_field)) {}

  /// Range of the colours of depth.png and of 16-bit PNGs; before the first view.
  void set_pictured(DisparityRange range) { pictured_ = range; }

  /// disparity, confidence: (v, u) of the view, NaN where there is no estimate. Cut to the size of
  /// the view's own picture.
  void write_view(int view_idx, FloatMap disparity, FloatMap confidence, bool is_centre);

  /// Adds gigaray.json and puts the folder in its place.
  void commit(const std::string& json);

 private:
  void write_maps(const std::filesystem::path& folder, const FloatMap& disparity,
                  const FloatMap& confidence) const;
  void write_picture(const std::filesystem::path& folder, int view_idx) const;

  AtomicFolder folder_;
  std::set<MapFormat> formats_;
  DisparityRange pictured_{-1, 1};
  LightField light_field_;
};

}  // namespace gigaray
