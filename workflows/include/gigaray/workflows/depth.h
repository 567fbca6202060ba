// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "gigaray/adapters/depth_folder.h"
#include "gigaray/core/api.h"
#include "gigaray/engine/reconstruct.h"
#include "gigaray/workflows/input.h"

namespace GIGARAY_API gigaray {

/// Two distances from a camera, scene units: 0 < near < far, which may be infinite.
struct DistanceRange {
  double near = 0;
  double far = 0;
};

/// How depth is to be computed. The defaults serve every light field.
struct DepthRequest {
  DepthOptions options = auto_options();
  /// What to search, in place of DepthOptions::disparity. Needs a rig or cameras that are known.
  std::optional<DistanceRange> distances = {};
  /// Views that get depth, as parse_views() takes them, where DepthOptions::views names none.
  std::string views = "all";
  BackendChoice backend = {};
};

/// The options that a run with this input takes: the views and the range that are meant; without
/// one, that of features or of the pictures. Holds what is stated or assumed of the input against
/// the pictures: poses, a grid, the way of the camera, which may turn the axes of the light field.
/// Says what it finds through `control`. Throws Error(kInvalidArgument) naming the field,
/// Error(kBadInput) for poses that don't fit, kOutOfMemory, kCancelled.
DepthOptions prepare_depth(OpenedInput& input, const DepthRequest& request,
                           const RunControl& control);

/// prepare_depth(), then reconstruct():
///
///   OpenedInput input = open_input({.path = "hci/cotton"}, control);
///   const Reconstruction result = compute_depth(input, {}, control);
///   write_pfm("disparity.pfm", result.view(centre_view(input.light_field)).disparity);
Reconstruction compute_depth(OpenedInput& input, const DepthRequest& request,
                             const RunControl& control);

/// What a run will take, or why it can't run.
struct DepthForecast {
  Forecast forecast;
  std::string refusal;  ///< empty: it can run
};

/// Prepares the input as prepare_depth() does, with what is found as notes of the light field, and
/// plans the run. Throws Error(kCancelled) alone.
DepthForecast forecast_depth(OpenedInput& input, const DepthRequest& request,
                             const RunControl& control);

/// A folder with maps of all views, see DepthFolder.
struct DepthFolderRequest {
  std::filesystem::path path;
  std::set<MapFormat> formats = {};  ///< beside PFM
  double min_confidence = 0;         ///< estimates that are less sure are left out (NaN)
  bool replace = false;              ///< see OutputRules::replace
};

/// What was written.
struct DepthReport {
  std::string record;  ///< gigaray.json
  int num_views = 0;   ///< that have depth
  std::string device;  ///< that computed it
  double seconds = 0;
  std::string note;  ///< note_on_scale()
};

/// Writes what compute_depth() gave. Appears only when complete; throws as DepthFolder does.
DepthReport write_depth_folder(const OpenedInput& input, const Reconstruction& result,
                               const DepthFolderRequest& folder, const RunControl& control);

/// All of it, from pictures to the folder: a place that can't be used shows before the work. What
/// the reader assumed goes to `control` too. `input.colmap_folder` that is empty is one beside the
/// folder where cameras must be found.
DepthReport compute_depth_folder(InputRequest input, const DepthRequest& request,
                                 const DepthFolderRequest& folder, const RunControl& control);

}  // namespace gigaray
