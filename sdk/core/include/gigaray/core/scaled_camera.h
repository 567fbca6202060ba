// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/core/api.h"
#include "gigaray/core/camera.h"

namespace GIGARAY_API gigaray {

/// The camera of a picture scaled by these factors, > 0, whose corner stays where it is. Sizes are
/// rounded down, to 1 at least.
Camera scaled(const Camera& camera, double by_u, double by_v);

}  // namespace gigaray
