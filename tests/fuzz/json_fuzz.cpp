// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// gigaray.json of light fields and of results, and transforms.json.
#include "formats/described_light_field.h"
#include "formats/stated_views.h"
#include "fuzz.h"
#include "gigaray/adapters/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const gigaray::fuzz::Input input(data, size, 3);
  gigaray::fuzz::expect_result_or_one_line([&] {
    constexpr double kLimit = 1 << 28;
    gigaray::check_json(input.bytes, "fuzz", kLimit);
    if (input.choice == 2) {
      const auto described = gigaray::parse_depth_json(input.bytes, "fuzz");
      GIGARAY_CHECK(!described.light_field.views.empty() && described.light_field.width > 0);
    } else if (input.choice == 0) {
      const auto described = gigaray::parse_light_field_json(input.bytes, "fuzz");
      GIGARAY_CHECK(described.files.size() == described.light_field.views.size());
    } else {
      for (const auto& view : gigaray::parse_transforms_json(input.bytes, "fuzz"))
        GIGARAY_CHECK(view.pose.rotation.allFinite() && view.pose.translation.allFinite());
    }
  });
  return 0;
}
