// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "pictures/picture_alpha.h"

#include <algorithm>
#include <cmath>

#include "formats/file_type.h"
#include "gigaray/core/error.h"
#include "pictures/exr_picture.h"
#include "pictures/picture_loading.h"

namespace gigaray {

namespace {

/// Half of full scale of integers of so many bits.
double half_of(int bits) { return std::exp2(bits - 1); }

/// 0 or 255.
Mask opaque_part(const std::filesystem::path& path, double limit, const ValueScale& scale) {
  if (is_exr(path)) {
    const Image<float> alpha = read_exr_alpha(path, limit);
    Mask mask(alpha.width(), alpha.height());
    std::ranges::transform(alpha, mask.begin(),
                           [](float value) { return std::uint8_t(value >= 0.5F ? 255 : 0); });
    return mask;
  }
  const vips::VImage picture = open_picture(path, limit);
  if (!picture.has_alpha())
    throw Error(ErrorCode::kBadInput,
                path.string() + ": has another kind of pixels than when it was opened");
  const VipsBandFormat format = picture.format();
  const double half = format == VIPS_FORMAT_UCHAR    ? half_of(8)
                      : format == VIPS_FORMAT_USHORT ? half_of(scale.bits_of_16)
                      : format == VIPS_FORMAT_UINT   ? half_of(scale.bits_of_32)
                                                     : 0.5;
  const vips::VImage opaque = picture.extract_band(picture.bands() - 1) >= half;
  Mask mask(opaque.width(), opaque.height());
  opaque.write(vips::VImage::new_from_memory(mask.data(), mask.size(), mask.width(), mask.height(),
                                             1, VIPS_FORMAT_UCHAR));
  return mask;
}

}  // namespace

Mask read_alpha(const std::filesystem::path& path, double limit, const ValueScale& scale) {
  try {
    Mask mask = opaque_part(path, limit, scale);
    const bool is_blank = std::none_of(mask.begin(), mask.end(), [](auto value) { return value; });
    for (std::uint8_t& value : mask) value = is_blank || value != 0;
    return mask;
  } catch (const vips::VError& error) {
    throw Error(ErrorCode::kBadInput,
                path.string() + ": is damaged or cut short (" + vips_reason(error) + ")");
  }
}

}  // namespace gigaray
