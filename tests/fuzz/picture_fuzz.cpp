// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Pictures of any format that libvips may open here: header and pixels.
#include "file_of_bytes.h"
#include "fuzz.h"
#include "pictures/picture_files.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const gigaray::fuzz::Input input(data, size, 2);
  gigaray::fuzz::expect_result_or_one_line([&] {
    constexpr double kLimit = 1 << 24;
    const gigaray::fuzz::FileOfBytes file(input.bytes);
    const auto orientation =
        input.choice == 0 ? gigaray::Orientation::kApplied : gigaray::Orientation::kIgnored;
    const auto stated = gigaray::read_picture_spec(file.path(), orientation, kLimit);
    gigaray::PictureSpec spec;
    const auto picture = gigaray::decode_picture(file.path(), orientation, spec, kLimit);
    GIGARAY_CHECK(picture.width() == stated.width && picture.height() == stated.height);
    GIGARAY_CHECK(picture.channels() == 3);
  });
  return 0;
}
