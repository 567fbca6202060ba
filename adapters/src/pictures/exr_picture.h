// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>

#include "gigaray/core/image.h"
#include "pictures/picture_files.h"

namespace gigaray {

// OpenEXR files as pictures: the window that is shown, black where there are no data. Colours are
// the channels R, G and B, or Y, else those of the first layer that has them; A is alpha.
// Everything throws Error(kBadInput) naming the file: damaged, without colours, more than `limit`
// bytes.

/// What the header says.
PictureSpec exr_spec(const std::filesystem::path& path, double limit);

/// One channel or three.
Image<float> read_exr_colours(const std::filesystem::path& path, double limit);

/// One channel, 0 where there are no data. The file has one.
Image<float> read_exr_alpha(const std::filesystem::path& path, double limit);

}  // namespace gigaray
