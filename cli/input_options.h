// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "gigaray/adapters/colmap_program.h"
#include "gigaray/adapters/reader.h"
#include "rig_options.h"

namespace gigaray::cli {

/// INPUT and the options that say how to read it; shared by the commands that take a light field.
struct InputOptions {
  std::filesystem::path input;
  OpenOptions open;
  int max_size = 0;     ///< px; larger pictures are shrunk; 0: none
  std::string without;  ///< list of views; empty: none
  RigOptions rig;
  bool find_cameras = false;  ///< of a folder of pictures, with COLMAP, even if they form a row
  ColmapQuality quality = ColmapQuality::kMedium;  ///< of such cameras

  void add_to(CLI::App& app);
  /// All that is read: no output may be there.
  std::vector<std::filesystem::path> places() const {
    return {input, open.positions, open.images, open.masks};
  }
  LightField open_light_field() const { return open_light_field(input, open); }
  /// The same of another place, with the options that don't name one.
  LightField open_light_field(const std::filesystem::path& place, const OpenOptions& options) const;
};

}  // namespace gigaray::cli
