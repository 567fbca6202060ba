// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/pictures.h"

#include <memory>
#include <string>

#include "gigaray/adapters/atomic_output.h"
#include "vips.h"

namespace gigaray {

std::string png_bytes(const Image<std::uint16_t>& picture, int bit_depth) {
  GIGARAY_CHECK(bit_depth == 8 || bit_depth == 16);
  GIGARAY_CHECK(!picture.empty() && (picture.channels() == 1 || picture.channels() == 3));
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
    const std::unique_ptr<VipsBlob, void (*)(VipsBlob*)> blob(
        image.pngsave_buffer(vips::VImage::option()->set("compression", 3)),
        [](VipsBlob* area) { vips_area_unref(VIPS_AREA(area)); });
    std::size_t size = 0;
    const auto* bytes = static_cast<const char*>(vips_blob_get(blob.get(), &size));
    return {bytes, size};
  } catch (const vips::VError& error) {
    throw Error(ErrorCode::kOutOfMemory, "a PNG can't be encoded (" + vips_reason(error) + ")");
  }
}

void write_png(const std::filesystem::path& path, const Image<std::uint16_t>& picture,
               int bit_depth) {
  write_file_atomically(path, png_bytes(picture, bit_depth));
}

}  // namespace gigaray
