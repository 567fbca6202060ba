// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>

#include "gigaray/core/image.h"
#include "pictures/picture_files.h"

namespace gigaray {

/// 1 where a picture with an alpha channel is at least half opaque, as the sensor saw it;
/// everywhere when that is nowhere. Throws Error(kBadInput) naming the file, also when it takes
/// more than `limit` bytes to decode. scale: of the colours.
Mask read_alpha(const std::filesystem::path& path, double limit, const ValueScale& scale);

}  // namespace gigaray
