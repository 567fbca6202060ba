// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Light fields and truth in HDF5, also in MATLAB's order.
#include <filesystem>
#include <string>

#include "file_of_bytes.h"
#include "fuzz.h"
#include "gigaray/adapters/hci_old.h"
#include "gigaray/adapters/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace fs = std::filesystem;
  const gigaray::fuzz::Input input(data, size, 3);
  const gigaray::fuzz::FileOfBytes file(input.bytes);
  // The extension says how the axes lie.
  const fs::path link = fs::temp_directory_path() / ("gigaray-fuzz-" + std::to_string(getpid()) +
                                                     (input.choice == 0 ? ".mat" : ".h5"));
  fs::remove(link);
  fs::create_symlink(file.path(), link);
  gigaray::fuzz::expect_result_or_one_line([&] {
    if (input.choice == 2) {
      GIGARAY_CHECK(!gigaray::read_hci_old_truth(link).empty());
      return;
    }
    gigaray::OpenOptions options;
    options.memory_bytes = 1 << 26;
    const gigaray::LightField light_field = gigaray::open_light_field(link, options);
    gigaray::read_view(light_field, light_field.num_views() / 2);
  });
  fs::remove(link);
  return 0;
}
