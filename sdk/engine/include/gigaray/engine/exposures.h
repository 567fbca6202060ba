// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <array>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"
#include "gigaray/core/run_control.h"

namespace GIGARAY_API gigaray {

/// How much brighter a picture shows the same than the brightest one does (0 or less, unless one
/// stands out): ln of the encoded value, by R, G, B. Encoded by a power a gain in linear light is
/// one here too. Relative to the brightest, since what is clipped there is clipped then in all.
using Exposure = std::array<float, 3>;

/// Exposures of posed photographs from windows of small versions that correlate between each view
/// and those that stand next to it: normalised cross-correlation does not see a gain. A view that
/// matches no other is taken for a usual one. Cameras have their ranges of inverse depth. Reads
/// every picture once. Throws Error(kCancelled) and what reading pictures throws.
std::vector<Exposure> estimate_exposures(const LightField& light_field, const RunControl& control);

/// Do they differ by more than their estimates scatter, 0.06, so that comparing pixels should know?
bool differ(const std::vector<Exposure>& exposures);

/// The same light field with the exposures taken out as a view is read. What is clipped, within a
/// fiftieth of the full range, stays as it is: nobody knows how bright it was.
LightField evened(LightField light_field, std::vector<Exposure> exposures);

}  // namespace gigaray
