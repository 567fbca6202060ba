// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/core/api.h"
#include "gigaray/core/run_control.h"
#include "gigaray/core/synthetic_capture.h"

namespace GIGARAY_API gigaray {

/// Writes a light field with exact disparity: VIEW.png, truth/VIEW.pfm, truth.pfm of the centre
/// view, and gigaray.json, which also says how it was made. All or nothing. Returns it, without
/// pictures.
LightField write_synthetic_light_field(const std::filesystem::path& folder,
                                       const SyntheticOptions& options, const OutputRules& rules,
                                       const RunControl& control);

/// Writes images/VIEW.png, the exact depth truth/VIEW.pfm (z, scene units, of the pictures as they
/// are, with the lens's distortion), a COLMAP model sparse/0 of the exact cameras and points, and
/// how it was made, synthetic.json. All or nothing. Returns the number of photographs.
int write_synthetic_photographs(const std::filesystem::path& folder,
                                const SyntheticOptions& options, const SyntheticPath& path,
                                const OutputRules& rules, const RunControl& control);

}  // namespace gigaray
