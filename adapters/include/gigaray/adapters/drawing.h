// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/image.h"
#include "gigaray/core/light_field.h"

namespace GIGARAY_API gigaray {

// Pictures that explain an estimate to a human eye. All are 8-bit RGB (v, u, c) for write_png.

/// An epipolar-plane image and the line that a scene point draws in it.
struct EpiDrawing {
  /// 8-bit RGB, one row per view, in the order of s, the smallest at the top.
  Image<std::uint16_t> pixels;
  int first_u = 0;           ///< Column of the pictures that `pixels` begins with.
  std::vector<double> s;     ///< Position of every row's view, view steps.
  std::vector<double> line;  ///< Column of the pictures that sees the point; NaN: no line there.
  int reference_row = 0;     ///< Row of the view that the pixel was chosen in, and
  int reference_u = 0;       ///< its column of the pictures: framed.
};

/// Enlarges the rows, draws the line as a pair of rails so that the pixels on it stay visible, and
/// adds ticks of u and s.
Image<std::uint16_t> draw_epi(const EpiDrawing& epi);

/// The colour in which one view sees a point.
struct SampleCell {
  double s = 0, t = 0;            ///< view steps
  std::array<float, 3> colour{};  ///< encoded RGB in [0, 1]; NaN: the view doesn't see the point
  bool is_reference = false;      ///< framed
};

/// The colours as patches at the positions of their views: s to the right, t downwards, ticks in
/// view steps; a crossed patch is a view that doesn't see the point. cells: not empty.
Image<std::uint16_t> draw_samples(std::span<const SampleCell> cells);

/// A mark on a score curve: a vertical line with its name and disparity.
struct ScoreMark {
  std::string name;  ///< ASCII
  double disparity = 0;
};

/// The score curve over the tested range, its mean as a dashed line, and marks, the first of them
/// emphasised. scores: two or more, equally spaced over `range`; negative or NaN: not tested, a
/// gap.
Image<std::uint16_t> draw_scores(std::span<const float> scores, DisparityRange range, double mean,
                                 std::span<const ScoreMark> marks);

}  // namespace gigaray
