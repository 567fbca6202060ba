// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "picture_alpha.h"

#include <algorithm>
#include <vector>

#include "gigaray/error.h"
#include "picture_loading.h"

namespace gigaray {

Mask read_alpha(const std::filesystem::path& path, double limit) {
  try {
    const vips::VImage picture = open_picture(path, limit);
    if (!picture.has_alpha())
      throw Error(ErrorCode::kBadInput,
                  path.string() + ": has another kind of pixels than when it was opened");
    const bool is_deep = picture.format() == VIPS_FORMAT_USHORT;
    const double half = is_deep ? 32768 : 128;
    // 255 where the comparison holds.
    const vips::VImage opaque = picture.extract_band(picture.bands() - 1) >= half;
    Mask mask(opaque.width(), opaque.height());
    opaque.write(vips::VImage::new_from_memory(mask.data(), mask.size(), mask.width(),
                                               mask.height(), 1, VIPS_FORMAT_UCHAR));
    const bool is_blank = std::none_of(mask.begin(), mask.end(), [](auto value) { return value; });
    for (std::uint8_t& value : mask) value = is_blank || value != 0;
    return mask;
  } catch (const vips::VError& error) {
    throw Error(ErrorCode::kBadInput,
                path.string() + ": is damaged or cut short (" + vips_reason(error) + ")");
  }
}

}  // namespace gigaray
