// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/colmap_program.h"
#include "gigaray/adapters/reader.h"
#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"
#include "gigaray/core/run_control.h"
#include "gigaray/engine/depth_options.h"
#include "gigaray/workflows/stated_rig.h"

namespace GIGARAY_API gigaray {

/// A light field to open and what is said of it. {.path = "hci/cotton"} is enough for most.
struct InputRequest {
  std::filesystem::path path;  ///< Folder or file, see docs/formats.md
  OpenOptions open = {};
  int max_size = 0;          ///< px; larger pictures are shrunk; 0: none. 16 and above
  std::string without = {};  ///< Views to leave out, as parse_views() takes them; empty: none
  StatedRig rig = {};
  /// Find the cameras of a folder of pictures with COLMAP even if they form a row.
  bool find_cameras = false;
  ColmapQuality quality = ColmapQuality::kMedium;  ///< of cameras that are found
  /// Where COLMAP's files go, and are taken from the next time, when photographs from anywhere need
  /// cameras. Empty: none are found; such photographs are an error.
  std::filesystem::path colmap_folder = {};
  bool replace = false;  ///< of colmap_folder, see OutputRules::replace
  /// Keep decoded pictures in a third of OpenOptions::memory_bytes, so that none is decoded twice;
  /// OpenOptions::kept then need not be stated.
  bool keep_pictures = true;

  /// All that is read: no output may be there.
  std::vector<std::filesystem::path> places() const {
    return {path, open.positions, open.images, open.masks};
  }
};

/// A light field and where it came from.
struct OpenedInput {
  LightField light_field;
  InputRequest request;  ///< as it was stated; `open.kept` is there when pictures are kept
  /// What prepare_depth() was last asked for, for the record of a result.
  std::optional<DepthOptions> asked = {};
};

/// Opens an input. The cameras of photographs from anywhere, that is, of pictures that form no row,
/// are found with COLMAP, see find_cameras(). What the reader assumed are LightField::notes; what
/// was decided here goes to `control`. Pictures are decoded when they are first read.
///
/// Where the views stand is held against the pictures by prepare_depth().
/// Throws what open_light_field() and find_cameras() do, and Error(kInvalidArgument) naming the
/// field for what doesn't go with the input.
OpenedInput open_input(InputRequest request, const RunControl& control);

/// OUTPUT.colmap, a folder beside an output: where the program has COLMAP's files.
std::filesystem::path colmap_folder_beside(const std::filesystem::path& output);

/// Finds the cameras of a folder of photographs with COLMAP: the workspace `work`. One of an
/// earlier run with the same photographs and options is taken as it is, with a message; another is
/// replaced like an output. Throws as run_colmap and AtomicFolder do; of a run that fails the log
/// is kept.
void find_cameras(const std::filesystem::path& photographs, const std::filesystem::path& work,
                  const ColmapRunOptions& options, const OutputRules& rules,
                  const RunControl& control);

}  // namespace gigaray
