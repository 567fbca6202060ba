// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/region_metrics.h"
#include "gigaray/core/run_control.h"

namespace GIGARAY_API gigaray {

/// One view to score: its truth and the estimate of every candidate, as files.
struct ViewMaps {
  std::string view;  ///< Empty: the one view that was given, or the centre.
  std::filesystem::path truth;
  std::vector<std::filesystem::path> estimates;
};

/// The maps of the views that `views` means: "centre" (a map, or the map at the top of a folder),
/// "all" that have truth and an estimate of every candidate, or a comma-separated list of names.
/// Views without truth are told to `control`. Throws Error(kBadInput) naming what is missing.
std::vector<ViewMaps> find_view_maps(const std::vector<std::filesystem::path>& estimates,
                                     const std::filesystem::path& truth, const std::string& views,
                                     const RunControl& control);

/// The names of a list separated by commas. Throws Error(kInvalidArgument) when there is none.
std::vector<std::string> view_names_in(const std::string& list);

/// Where the true disparity of a scene's centre view is: `place` itself when it is a file, else in
/// the folder truth.pfm, gt_disp_lowres.pfm, or of a Middlebury stereo pair disp2.png or disp1.png,
/// of one with calib.txt disp0GT.pfm or disp0.pfm.
/// Empty: the folder has none. Throws Error(kBadInput) when there is no such place.
std::filesystem::path find_truth(const std::filesystem::path& place);

/// A float map; or a picture of a Middlebury stereo pair, whose grey is 4 times the disparity of
/// disp2 and disp6, of disp1 and disp5 as many times as its width of more than 1000, 500 or fewer
/// pixels has been divided by (1, 2, 3); 0: unknown. Throws what read_float_map throws.
FloatMap read_truth(const std::filesystem::path& path);

/// What is known about a scene beside its truth.
struct SceneParts {
  /// The masks of the scene by their name, as in mask_NAME_lowres.png, and those that were named.
  std::map<std::string, LabelMap> masks;
  std::vector<std::string> asked;  ///< Names of masks that were given, in their order.
  RigGeometry rig;                 ///< Of the light field in the folder; empty if there is none.
};

/// Reads the masks of a scene's folder and those of "NAME=FILE" options, which come first. Masks
/// are pictures or float maps. Throws Error(kInvalidArgument) for an option without a name,
/// Error(kBadInput) naming a mask that can't be read or is not width x height.
SceneParts read_scene_parts(const std::filesystem::path& truth,
                            const std::vector<std::string>& mask_options, int width, int height);

}  // namespace gigaray
