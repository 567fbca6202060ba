// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>

#include "gigaray/core/api.h"
#include "gigaray/core/image.h"

namespace GIGARAY_API gigaray {

/// True disparity of the centre view of an HDF5 light field of the old HCI benchmark (Wanner et al.
/// 2013), from its GT_DEPTH: d = dH · focalLength / depth − shift. (v, u), px per view step; NaN
/// where GT_DEPTH has no positive depth or GT_DEPTH_MASK is 0. input: the file, or a folder with
/// lf.h5. Throws Error(kBadInput) naming what is missing or contradictory.
FloatMap read_hci_old_truth(const std::filesystem::path& input);

}  // namespace gigaray
