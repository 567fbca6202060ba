// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <array>

#include "gigaray/core/api.h"
#include "gigaray/core/point_cloud.h"

namespace GIGARAY_API gigaray {

/// The colours of depth pictures, from far (blue) to near (red): those of write_depth_picture().
std::array<Rgb8, 256> depth_colours();

}  // namespace gigaray
