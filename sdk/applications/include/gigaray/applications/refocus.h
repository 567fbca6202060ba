// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>

#include "gigaray/core/api.h"
#include "gigaray/core/image.h"
#include "gigaray/core/light_field.h"
#include "gigaray/core/run_control.h"

namespace GIGARAY_API gigaray {

/// What is sharp in a refocused picture: a plane, in the unit of ViewDepth::disparity, which is
/// linear over the picture of a plane.
struct FocalPlane {
  double value = 0;    ///< at the centre of the picture
  double along_u = 0;  ///< change per px to the right
  double along_v = 0;  ///< change per px downwards
};

/// The picture of a lens as wide as the rig (synthetic aperture, Isaksen et al. 2000; Levoy et al.
/// 2004): for every pixel of `view` the mean, in linear light, of what the views see at its point
/// of the focal plane; views whose picture does not have it don't count. Needs no depth. RGB (v, u,
/// c) as encoded as the pictures. aperture: views within so many view steps have a part; infinite:
/// all. Throws what the pictures throw, kCancelled.
Image<std::uint16_t> refocus(const LightField& light_field, int view, FocalPlane plane,
                             double aperture, const RunControl& control);

}  // namespace gigaray
