// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "pictures/vips.h"

namespace gigaray {

/// Opens a picture for reading from top to bottom: its header alone. Before anything is decoded,
/// what the header states is compared with the size of the file and, as what decoding takes, with
/// `limit` in bytes. Throws Error(kBadInput) naming the file, vips::VError.
vips::VImage open_picture(const std::filesystem::path& path, double limit);

/// The values of a picture, (v, u, c), whose samples are of the type T: 16 or 32 bit without a
/// sign, or float. Memory is taken as rows come, so that a header that promises more than follows
/// costs little. Throws vips::VError.
template <class T>
std::vector<T> values_of(const vips::VImage& image);

}  // namespace gigaray
