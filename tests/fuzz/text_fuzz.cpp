// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Text: parameters.cfg of HCI scenes, Middlebury's par and calib files, Strecha's .camera files,
// MVSNet's cam files, positions.
#include "formats/hci_parameters.h"
#include "formats/positions_file.h"
#include "formats/stated_views.h"
#include "formats/stereo_calibration.h"
#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const gigaray::fuzz::Input input(data, size, 7);
  gigaray::fuzz::expect_result_or_one_line([&] {
    if (input.choice == 0) {
      const gigaray::HciParameters parameters(input.bytes, "fuzz");
      for (const char* key : {"disp_min", "focal_length_mm", "baseline_mm"}) parameters.number(key);
      const int cameras = parameters.cameras("num_cams_x", 9);
      GIGARAY_CHECK(cameras >= 1 && cameras <= 1000);
    } else if (input.choice == 1) {
      for (const auto& view : gigaray::parse_middlebury_par(input.bytes, "fuzz"))
        GIGARAY_CHECK(!view.picture.empty() && view.pose.rotation.allFinite());
    } else if (input.choice == 3) {
      const auto view = gigaray::parse_mvsnet_camera(input.bytes, "fuzz");
      GIGARAY_CHECK(view.inverse_depth && view.pose.translation.allFinite());
    } else if (input.choice == 4) {
      const auto pair = gigaray::parse_stereo_calibration(input.bytes, "fuzz");
      GIGARAY_CHECK(pair.focal_px > 0 && pair.baseline > 0);
    } else if (input.choice >= 5) {
      const std::size_t count = input.choice == 5 ? 2 : 5;
      const std::vector<std::filesystem::path> pictures{"a.png", "b.png", "c 1.png", "d.png", "e"};
      const auto positions = gigaray::parse_positions(input.bytes, "fuzz",
                                                      {pictures.begin(), pictures.begin() + count});
      GIGARAY_CHECK(positions.size() == count);
    } else {
      const auto view = gigaray::parse_strecha_camera(input.bytes, "fuzz");
      GIGARAY_CHECK(view.lens.width > 0 && view.pose.translation.allFinite());
    }
  });
  return 0;
}
