// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// NumPy arrays: any, and poses_bounds.npy.
#include "formats/npy_matrix.h"
#include "formats/stated_views.h"
#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const gigaray::fuzz::Input input(data, size, 2);
  gigaray::fuzz::expect_result_or_one_line([&] {
    if (input.choice == 0) {
      const auto matrix = gigaray::parse_npy_matrix(input.bytes, "fuzz");
      GIGARAY_CHECK(matrix.values.size() == std::size_t(matrix.rows) * matrix.columns);
    } else {
      for (const auto& view : gigaray::parse_poses_bounds(input.bytes, "fuzz"))
        GIGARAY_CHECK(view.lens.width > 0 && view.pose.rotation.allFinite());
    }
  });
  return 0;
}
