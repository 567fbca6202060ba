// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

#include "gigaray/adapters/reader.h"

namespace gigaray::cli {

/// INPUT and the options that say how to read it; shared by the commands that take a light field.
struct InputOptions {
  std::filesystem::path input;
  OpenOptions open;
  bool find_cameras = false;  ///< of a folder of pictures, with COLMAP, even if they form a row

  void add_to(CLI::App& app);
  LightField open_light_field() const { return gigaray::open_light_field(input, open); }
};

}  // namespace gigaray::cli
