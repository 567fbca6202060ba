// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>

#include "gigaray/core/api.h"
#include "gigaray/core/image.h"
#include "gigaray/core/light_field.h"

namespace GIGARAY_API gigaray {

// Metrics of the HCI 4D light field benchmark for parts of a scene, after Honauer et al. 2016 and
// the public evaluation toolkit of the benchmark (https://github.com/lightfield-analysis). The
// parts come as masks (non-zero: scored); the benchmark ships them with its scenes and takes some
// metrics on truth of ten times the resolution, here all are taken on the maps as they are.
//
// For all of them: pixels whose truth is not finite and `border` px on each side are ignored; NaN
// when nothing is left to score. Where a percentage of pixels is asked for, a pixel without an
// estimate counts as bad (the benchmark doesn't say; its maps are dense). They throw
// Error(kBadInput) when sizes differ.

/// Percentage of pixels with |error| > threshold.
double bad_pix(const FloatMap& estimate, const FloatMap& truth, double threshold, int border,
               const Mask& mask);

/// Mean squared error times 100 over pixels with an estimate (background of the scene dots).
double mean_squared_error_x100(const FloatMap& estimate, const FloatMap& truth, int border,
                               const Mask& mask);

/// Around fine structures: percentage of pixels estimated nearer than the truth by more than 0.15.
double fine_fattening(const FloatMap& estimate, const FloatMap& truth, int border,
                      const Mask& mask);
/// On fine structures: percentage of pixels estimated farther than the truth by more than 0.15.
double fine_thinning(const FloatMap& estimate, const FloatMap& truth, int border, const Mask& mask);

/// 100 times the mean of min(0.05, Frobenius norm of the Hessian of estimate - truth). Derivatives
/// are Scharr filters with weights 3, 10, 3 over 16 and no division by the distance of two pixels,
/// as in the toolkit, so the norm is four times that of the second derivatives per px². Pixels
/// whose 5 × 5 neighbourhood isn't known are left out.
double bumpiness(const FloatMap& estimate, const FloatMap& truth, int border, const Mask& mask);

/// Median angle in degrees between the surface normals of estimate and truth, over pixels whose
/// 3 × 3 neighbourhood is known. As in the toolkit, a pixel (u, v) lies in the direction
/// (u, v) · 0.5 side / (width - 1) / focal length, with the origin at the corner of the picture;
/// true angles on the sensor would be twice as wide. NaN unless the rig states focal length and
/// baseline.
double median_angular_error(const FloatMap& estimate, const FloatMap& truth, const RigGeometry& rig,
                            int border, const Mask& mask);

/// Scene backgammon: percentage of pixels beside a wedge that are estimated closer to the
/// foreground than to the background, which is the truth there. The foreground of a row is its
/// truth in column 14.
double backgammon_fattening(const FloatMap& estimate, const FloatMap& truth, int border,
                            const Mask& mask);
/// Percentage of pixels on a wedge that are estimated closer to the background than to the truth.
/// The background of a row is its truth in the eleventh column from the right.
double backgammon_thinning(const FloatMap& estimate, const FloatMap& truth, int border,
                           const Mask& mask);

/// Values of a mask that tells several parts apart; 0 is none of them.
using LabelMap = Image<std::uint16_t>;

/// Scene dots: percentage of dots of which half or more is off by more than 0.4. boxes: number of
/// the box that a pixel is in; dots_by_size: 1 … 8, the size of the dot that a pixel is on, one of
/// each per box. No border is left out.
double missed_dots(const FloatMap& estimate, const FloatMap& truth, const LabelMap& boxes,
                   const LabelMap& dots_by_size);

/// Pixels within 4 px (a disc) of two neighbours whose truth differs by more than 0.15. For scenes
/// without a mask of their discontinuities; of HCI's cotton it meets 90 % of the pixels that are
/// in this mask or in the benchmark's.
Mask mask_near_jumps(const FloatMap& truth);

}  // namespace gigaray
