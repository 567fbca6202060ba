// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"

namespace GIGARAY_API gigaray {

/// The light field with pictures of at most max_size px, by area averages, on both sides. Cameras,
/// focal length and a declared range follow; disparities are then px of the small pictures. A pixel
/// that any masked one has part in is masked. Pictures that are small enough already stay as they
/// are. max_size: 16 or more, else Error(kInvalidArgument).
LightField shrunk(LightField light_field, int max_size);

}  // namespace gigaray
