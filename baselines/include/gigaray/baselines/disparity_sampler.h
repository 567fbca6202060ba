// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/core/light_field.h"
#include "gigaray/samplers/any_sampler.h"

namespace gigaray::baselines {

/// What inverse depth, 1/scene unit, is multiplied with to become disparity of an unstructured
/// view: its focal length times the median distance of neighbouring views, px · scene unit. So it
/// is what a parallel view one step beside it would see, and tolerances in px mean what they mean
/// on grids. 1 of 3D and 4D light fields.
double disparity_of_inverse_depth(const LightField& light_field, int view);

/// The sampler of the light field with the disparity of `view`, px per view step, as its
/// hypothesis, whatever the kind: locate(view, other, {u, v, d}).
AnySampler disparity_sampler(const LightField& light_field, int view);

}  // namespace gigaray::baselines
