// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>

#include "gigaray/light_field.h"

namespace gigaray::baselines {

/// What inverse depth, 1/scene unit, is multiplied with to become disparity of an unstructured
/// view: its focal length times the median distance of neighbouring views, px · scene unit. So it
/// is what a parallel view one step beside it would see, and tolerances in px mean what they mean
/// on grids. 1 of 3D and 4D light fields.
double disparity_of_inverse_depth(const LightField& light_field, int view);

/// T of (U, V, Z) = T (u, v, 1, d): what `view` sees at (u, v) with disparity d, px per view step,
/// `other` sees at (U / Z, V / Z) if Z > 0 (equations 3, 9 and 10 of Kim et al. 2013).
Eigen::Matrix<double, 3, 4> transfer(const LightField& light_field, int view, int other);

}  // namespace gigaray::baselines
