// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/pictures.h"

#include <algorithm>
#include <memory>
#include <string>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/core/arguments.h"
#include "pictures/vips.h"

namespace gigaray {

namespace {

std::string bytes_of(VipsBlob* saved) {
  const std::unique_ptr<VipsBlob, void (*)(VipsBlob*)> blob(
      saved, [](VipsBlob* area) { vips_area_unref(VIPS_AREA(area)); });
  std::size_t size = 0;
  const auto* bytes = static_cast<const char*>(vips_blob_get(blob.get(), &size));
  return {bytes, size};
}

}  // namespace

std::string png_bytes(const Image<std::uint16_t>& picture, int bit_depth) {
  require_argument(bit_depth == 8 || bit_depth == 16, "bit_depth: must be 8 or 16");
  require_argument(!picture.empty() && (picture.channels() == 1 || picture.channels() == 3),
                   "picture: one or three channels and pixels are needed");
  use_vips();
  const bool grey = picture.channels() == 1, deep = bit_depth == 16;
  const auto space = grey ? (deep ? VIPS_INTERPRETATION_GREY16 : VIPS_INTERPRETATION_B_W)
                          : (deep ? VIPS_INTERPRETATION_RGB16 : VIPS_INTERPRETATION_sRGB);
  try {
    const auto image =
        vips::VImage::new_from_memory(const_cast<std::uint16_t*>(picture.data()),
                                      picture.size() * sizeof(std::uint16_t), picture.width(),
                                      picture.height(), picture.channels(), VIPS_FORMAT_USHORT)
            .cast(deep ? VIPS_FORMAT_USHORT : VIPS_FORMAT_UCHAR)
            .copy(vips::VImage::option()->set("interpretation", space));
    return bytes_of(image.pngsave_buffer(vips::VImage::option()->set("compression", 3)));
  } catch (const vips::VError& error) {
    throw Error(ErrorCode::kOutOfMemory, "a PNG can't be encoded (" + vips_reason(error) + ")");
  }
}

std::string jpeg_bytes(const Image<std::uint8_t>& picture, int quality) {
  constexpr int kMostPx = 65500;
  require_argument(!picture.empty() && picture.channels() == 3,
                   "picture: three channels and pixels are needed");
  require_argument(quality >= 1 && quality <= 100, "quality: must be between 1 and 100");
  if (std::max(picture.width(), picture.height()) > kMostPx)
    throw Error(ErrorCode::kInvalidArgument, "a JPEG has 65,500 px on a side at most");
  use_vips();
  try {
    const auto image =
        vips::VImage::new_from_memory(const_cast<std::uint8_t*>(picture.data()), picture.size(),
                                      picture.width(), picture.height(), 3, VIPS_FORMAT_UCHAR)
            .copy(vips::VImage::option()->set("interpretation", VIPS_INTERPRETATION_sRGB));
    return bytes_of(image.jpegsave_buffer(vips::VImage::option()
                                              ->set("Q", quality)
                                              ->set("optimize_coding", true)
                                              ->set("subsample_mode", VIPS_FOREIGN_SUBSAMPLE_OFF)));
  } catch (const vips::VError& error) {
    throw Error(ErrorCode::kOutOfMemory, "a JPEG can't be encoded (" + vips_reason(error) + ")");
  }
}

void write_png(const std::filesystem::path& path, const Image<std::uint16_t>& picture,
               int bit_depth) {
  write_file_atomically(path, png_bytes(picture, bit_depth));
}

}  // namespace gigaray
