// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gigaray/adapters/lens.h"
#include "gigaray/core/api.h"
#include "gigaray/core/run_control.h"

namespace GIGARAY_API gigaray {

/// How closely COLMAP looks. Of medium the cameras are as good as of high on most photographs.
enum class ColmapQuality {
  kLow,     ///< 1000 px, 2048 features, 5 neighbours: a first try
  kMedium,  ///< 1600 px, 4096 features, 10 neighbours
  kHigh,    ///< 3200 px, 8192 features, 20 neighbours
};

struct ColmapRunOptions {
  ColmapQuality quality = ColmapQuality::kMedium;
  /// Masks of the photographs, black where nothing is to be looked at; names as OpenOptions::masks.
  std::filesystem::path masks;
  /// Known intrinsics of all photographs, for their size. Empty: found with the poses, from EXIF
  /// and a guess.
  std::optional<Lens> lens;
  /// px of the longer side that features are looked for in, at most. 0: as the quality has it.
  int max_size = 0;
  bool strict = false;  ///< a photograph that can't be read is an error, else it is left out
  /// Is a known lens refined all the same?
  bool refine_lens = false;
};

/// Name of the log in the work folder of run_colmap().
inline constexpr const char* kColmapLog = "colmap.log";

/// What COLMAP found.
struct ColmapRun {
  std::filesystem::path model;    ///< folder of the largest model; pictures are named as below
  int num_pictures = 0;           ///< in the folder of photographs
  int num_registered = 0;         ///< of them in the model, 2 or more
  std::vector<std::string> lost;  ///< names of the others, sorted
  std::filesystem::path log;      ///< everything that the program printed
};

/// Finds the cameras of a folder of unordered photographs with the program `colmap` (3.8 – 3.12):
/// SIFT on the CPU, matches of all pairs (of neighbours by name where there are more than a hundred
/// photographs, or more than thirty whose names differ by their number alone, as frames of a walk
/// do), incremental mapping. One camera is shared when all photographs have one size and
/// EXIF names one camera and focal length, or none at all. What COLMAP can't read (HEIF, 16 bit …)
/// is copied for it. No display is needed.
///
/// work: a folder for the database, the models and the log (colmap.log); created, and kept whatever
/// happens. Progress in three stages; how long they took, what was left out and the sizes of the
/// models, when the photographs fall apart into several, go to control.on_message. A cancelled run
/// kills the program and all that it started.
///
/// Throws Error(kIo) when the program is not installed (package `colmap`) or fails, naming the log;
/// Error(kBadInput) when there are fewer than two photographs that can be read or fewer than two
/// got a camera, with what to try, or has features; Error(kInvalidArgument) when the lens is for
/// another size, or `work` holds an earlier run; Error(kCancelled).
ColmapRun run_colmap(const std::filesystem::path& photographs, const std::filesystem::path& work,
                     const ColmapRunOptions& options, const RunControl& control);

}  // namespace gigaray
