// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <optional>

#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"

namespace GIGARAY_API gigaray {

/// What JPEG rounds to: the DCT coefficients of every 8×8 block are multiples of these steps
/// (ITU-T T.81). Rows: vertical frequency, columns: horizontal; levels of 8 bit, ≥ 1.
using JpegTable = Eigen::Matrix<float, 8, 8>;

/// The rounding that a picture shows which was once a JPEG, whatever file it is in now.
struct JpegSteps {
  JpegTable luma;
  std::optional<JpegTable> chroma;  ///< Empty: chroma shows none, or is grey.
  /// Pixels that a sample of chroma covers, 1 or 2.
  int chroma_width = 1, chroma_height = 1;
};

/// Finds it in the pixels, (v, u, c) of 8 bit: the coefficients of blocks that begin at pixel (0,
/// 0) crowd around multiples. Empty where they don't: never a JPEG, resampled or cut since, or of a
/// quality whose steps are hidden by the rounding of the pixels.
std::optional<JpegSteps> find_jpeg_steps(const Image<std::uint16_t>& picture);

/// The picture in 16 bit without what its blocks left in it: the mean of eight pictures that are
/// rounded alike in blocks that begin elsewhere (A. Nosratinia, "Enhancement of JPEG-Compressed
/// Images by Re-application of JPEG", 2001). What the blocks leave stands at the same pixels in all
/// views, so to a matcher it is texture of disparity 0. A fourth channel stays as it is.
Image<std::uint16_t> without_jpeg_blocks(const Image<std::uint16_t>& picture,
                                         const JpegSteps& steps);

/// The light field with views of 16 bit that are cleaned as they are read, each by its own steps
/// (chroma that shows none by those of the centre view); as it is, where its centre view shows none
/// or where it has 16 bit already. Reads that view.
LightField without_jpeg_blocks(LightField light_field);

}  // namespace gigaray
