// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gigaray/adapters/rail_rectification.h"
#include "gigaray/core/api.h"
#include "gigaray/core/run_control.h"
#include "gigaray/workflows/memory_budget.h"

namespace GIGARAY_API gigaray {

/// Where the poses that the calibration of a rail starts from come from.
enum class RailPoses {
  kAuto,    ///< a COLMAP workspace that is given; else COLMAP, and where it fails the order
  kColmap,  ///< COLMAP alone
  kOrder,   ///< the order of the photographs
};

struct RectifyRequest {
  std::filesystem::path path;  ///< Photographs along a rail, or a COLMAP workspace of them
  KnownLens lens = {};
  RailRotations rotations = RailRotations::kBest;
  RailPoses poses = RailPoses::kAuto;
  /// Where COLMAP's files go, see InputRequest::colmap_folder. Empty: it is not run.
  std::filesystem::path colmap_folder = {};
  bool replace = false;  ///< of colmap_folder
  MemoryBudget memory = MemoryBudget();
};

/// Calibrates a rail: finds cameras, lens and the rotation that makes rows of all pictures one.
/// rectified_light_field() makes views of it. Throws Error(kBadInput) where the photographs are no
/// rail, kOutOfMemory before the work, and what find_cameras() does.
RectifiedRail rectify(const RectifyRequest& request, const RunControl& control);

/// Distances of neighbouring views, in median steps.
struct ViewSpacing {
  double min = 0, median = 0, max = 0;
};
ViewSpacing spacing_of(const LightField& light_field);

/// A rectified light field that was written.
struct WrittenRail {
  std::string record;              ///< what gigaray.json says under "rectify"
  std::vector<std::string> files;  ///< of the views, in the folder
  ResidualStats vertical_after;    ///< by how much rows differ still, px
};

/// Writes the views as VIEW.png with their gigaray.json into a folder that is there, and looks at
/// what was written.
WrittenRail write_rectified(const RectifiedRail& rail, const LightField& light_field,
                            const std::filesystem::path& folder, const RunControl& control);

}  // namespace gigaray
