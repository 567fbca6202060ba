// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/core/api.h"
#include "gigaray/core/image.h"
#include "gigaray/core/light_field.h"

namespace GIGARAY_API gigaray {

/// Is enough known about the rig for depth in scene units: focal length and baseline? Without a
/// focus distance disparity 0 is at infinity.
bool has_metric_depth(const RigGeometry& rig);

/// Distance from the camera plane along the optical axis, scene units (RigGeometry::unit), from
/// disparity in level-0 px per view step: z = f · B / (d + f · B / F). NaN where there is no
/// estimate, and where the disparity is that of infinity or beyond. Example: f = 1000 px, B = 0.025
/// m, F = 5 m: d = 0 is at 5 m, d = 5 at 2.5 m. Throws
/// Error(kInvalidArgument) where the rig has no metric depth.
FloatMap depth_from_disparity(const FloatMap& disparity, const RigGeometry& rig);

/// The same for a light field. Unstructured: disparity is inverse depth and depth its inverse,
/// along the optical axis of the view; always known. NaN where it is 0 or less.
bool has_metric_depth(const LightField& light_field);
FloatMap depth_from_disparity(const FloatMap& disparity, const LightField& light_field);

/// The disparity (unstructured: inverse depth) of what is at a distance > 0, which may be infinite.
/// Throws Error(kInvalidArgument) where depth is not known or the distance is none.
double disparity_of_depth(double depth, const LightField& light_field);

}  // namespace gigaray
