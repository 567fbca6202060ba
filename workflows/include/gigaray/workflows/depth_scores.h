// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/run_control.h"
#include "gigaray/workflows/memory_budget.h"
#include "gigaray/workflows/scores.h"

namespace GIGARAY_API gigaray {

struct DepthChoice {
  std::optional<double> truth_scale;  ///< Scene units of a value of the truth; empty: 1.
  std::vector<double> kept{75};       ///< Percent, the most confident of the pixels.
  int border = 0;                     ///< px
};

/// Depth against depth. Estimates: depth maps; or folders with VIEW/depth.pfm (and confidence.pfm),
/// as `gigaray depth` writes them, or with maps VIEW.pfm, .exr or .npy. truth: a map, or a folder
/// with VIEW.pfm, .exr, .npy or 16-bit .png, itself or in its folder "truth"; 0 and what isn't
/// finite is unknown. A truth of another size and the same shape is read at the pixels' centres.
/// views: "all" that have both, "centre", or names separated by commas. Throws Error(kBadInput)
/// naming what is missing, damaged or of another shape, Error(kInvalidArgument) for a bad choice,
/// Error(kOutOfMemory) before the work.
ScoreTable score_depth(const std::vector<std::filesystem::path>& estimates,
                       const std::vector<std::string>& labels, const std::filesystem::path& truth,
                       const std::string& views, const DepthChoice& choice,
                       const MemoryBudget& memory, const RunControl& control);

}  // namespace gigaray
