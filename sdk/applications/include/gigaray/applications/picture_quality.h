// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>

#include "gigaray/core/api.h"
#include "gigaray/core/image.h"

namespace GIGARAY_API gigaray {

/// How alike two pictures are; both RGB (v, u, c) of one size, 0 … 2^bit_depth − 1.
struct PictureQuality {
  double psnr = 0;  ///< dB, over all channels; infinite for equal pictures
  /// Structural similarity (Wang et al. 2004): 11×11 Gaussian of σ 1.5, mean of the channels.
  double ssim = 0;
};

/// shown: 0 where `truth` shows nothing of the scene; only the others count, for the similarity
/// those whose window has no such pixel. Empty: all.
PictureQuality picture_quality(const Image<std::uint16_t>& picture,
                               const Image<std::uint16_t>& truth, int bit_depth,
                               const Mask& shown = {});

}  // namespace gigaray
