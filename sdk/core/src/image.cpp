// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/image.h"

#include <string>

namespace gigaray {
namespace {

std::string picture_text(int width, int height, int channels) {
  return "a picture of " + std::to_string(width) + " × " + std::to_string(height) + " px with " +
         std::to_string(channels) + " channels";
}

}  // namespace

std::size_t image_size(int width, int height, int channels) {
  if (width < 0 || height < 0 || channels < 1)
    throw Error(ErrorCode::kInvalidArgument, picture_text(width, height, channels) +
                                                 ": width and height must not be negative, "
                                                 "there must be a channel");
  constexpr double kMost = 1ull << 60;  // beyond any memory, and the product fits
  if (double(width) * height * channels > kMost) throw_image_too_large(width, height, channels);
  return std::size_t(width) * height * channels;
}

void throw_image_too_large(int width, int height, int channels) {
  throw Error(ErrorCode::kOutOfMemory,
              picture_text(width, height, channels) + " does not fit into memory");
}

void throw_wrong_pixel_count(int width, int height, int channels, std::size_t given) {
  throw Error(ErrorCode::kInvalidArgument, picture_text(width, height, channels) + " can't have " +
                                               std::to_string(given) + " values");
}

}  // namespace gigaray
