// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pictures/picture_files.h"

namespace gigaray {

/// A picture as its file has it, (v, u, c) with one channel or three: one of the images, by its
/// Samples.
struct StoredPicture {
  Image<std::uint16_t> whole;  ///< k8, k16
  Image<std::uint32_t> deep;   ///< k32
  Image<float> light;          ///< kLight; may hold anything
};

/// Throws as decode_picture().
StoredPicture read_stored(const std::filesystem::path& path, Orientation orientation,
                          PictureSpec& spec, double limit);

/// RGB of 16 bit, of 8 bit if that is what is stored. What is brighter than full scale is clipped;
/// light that is not finite or below 0 is black.
Image<std::uint16_t> colours_of_16_bit(StoredPicture stored, Samples samples,
                                       const ValueScale& scale);

/// Full scale of the pictures of a light field, noted where it is not that of the type: bits of
/// integers that no picture uses, the brightness of light. A few pictures are decoded, unless all
/// have 8 bit; of those that can't be nothing is said. specs: of the files, in their order.
ValueScale scale_of(const std::vector<std::filesystem::path>& files,
                    const std::vector<PictureSpec>& specs, double limit,
                    std::vector<std::string>& notes);

}  // namespace gigaray
