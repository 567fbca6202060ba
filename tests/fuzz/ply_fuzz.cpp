// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Points of a scene beside its cameras.
#include "fuzz.h"
#include "output/ply_points.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const gigaray::fuzz::Input input(data, size, 1);
  gigaray::fuzz::expect_result_or_one_line([&] {
    for (const auto& point : gigaray::parse_ply_points(input.bytes, "fuzz"))
      GIGARAY_CHECK(point.allFinite());
  });
  return 0;
}
