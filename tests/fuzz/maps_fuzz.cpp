// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Maps: PFM, OpenEXR, depth maps of COLMAP.
#include "file_of_bytes.h"
#include "fuzz.h"
#include "gigaray/adapters/colmap_maps.h"
#include "gigaray/adapters/maps.h"
#include "pictures/map_headers.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const gigaray::fuzz::Input input(data, size, 3);
  gigaray::fuzz::expect_result_or_one_line([&] {
    constexpr double kLimit = 1 << 26;
    gigaray::FloatMap map;
    if (input.choice == 0)
      map = gigaray::read_pfm(gigaray::fuzz::FileOfBytes(input.bytes).path());
    else if (input.choice == 1)
      map = gigaray::parse_exr(std::string(input.bytes), "fuzz", kLimit);
    else
      map = gigaray::read_colmap_depth_map(gigaray::fuzz::FileOfBytes(input.bytes).path());
    GIGARAY_CHECK(!map.empty() && map.size() * sizeof(float) <= kLimit);
  });
  return 0;
}
