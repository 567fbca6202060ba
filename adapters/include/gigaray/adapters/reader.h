// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "gigaray/adapters/pose_convention.h"
#include "gigaray/core/api.h"
#include "gigaray/core/kept_pictures.h"
#include "gigaray/core/light_field.h"

namespace GIGARAY_API gigaray {

/// Which way a camera goes as a number of the input rises, as the pictures show it: when it goes
/// right, near things move to the left of the picture.
enum class Travel {
  kAuto,  ///< As the format has it, else assumed: LightField::sign_is_assumed asks for a check.
  kRight,
  kLeft,
  kDown,
  kUp,
};

/// Sub-aperture views behind one lens: pixels of the lenslet picture per view axis.
struct LensletGrid {
  int columns = 0;  ///< 0: from the name of the file
  int rows = 0;
};

/// Views in a grid.
struct GridSize {
  int rows = 0;  ///< 0: not stated
  int columns = 0;
  bool snake = false;  ///< the numbers go back along every second row
};

/// What the pictures alone don't say.
struct OpenOptions {
  /// Text file with the position of every picture of a folder: `right`, `right down` or
  /// `name right down` per line, any unit (docs/formats.md). Empty: from the input itself.
  std::filesystem::path positions;
  /// Way of the camera as the number of a series rises, or as the column (or x) of a grid rises.
  /// Not for formats that state positions.
  Travel direction = Travel::kAuto;
  /// Grids: way of the camera as the row (or y) rises. Stated together with `direction`.
  Travel row_direction = Travel::kAuto;
  /// Only for a lenslet picture.
  LensletGrid lenslet = {};
  /// Folder of the pictures, when they are not where a model of their cameras lies.
  std::filesystem::path images = {};
  /// Folder of masks, black where nothing is to be looked at: NAME.png for the picture NAME, or the
  /// name with .png as its extension, and more (docs/formats.md). Empty: none.
  std::filesystem::path masks = {};
  /// Most memory that opening the input and decoding one of its pictures may take, bytes. 0:
  /// default_memory_limit().
  double memory_bytes = 0;
  /// Makes pictures with one number in their names a grid: row by row as the number rises.
  GridSize grid = {};
  /// How the matrices of stated poses are meant. Empty: as the format has it.
  std::optional<PoseConvention> convention = {};
  /// A picture that is missing or damaged, whose pose holds a number that is not finite, or, in
  /// rows and grids, that has another size than nearly all is an error. Else it is left out, with a
  /// note.
  bool strict = false;
  /// Keeps the pictures that are decoded, so that none is decoded twice; opened again with the same
  /// options, files share them. Empty: each read decodes.
  std::shared_ptr<KeptPictures> kept = {};
};

/// Recognises what `input` is (registry.h) and opens it. Reads the headers of the pictures, not
/// their pixels. Throws Error(kBadInput) when nothing fits, saying what is missing; when the format
/// is known but the data are damaged or contradictory.
/// Before anything is decoded, what it states is held against options.memory_bytes.
/// Throws Error(kInvalidArgument) when an option does not go with the format.
LightField open_light_field(const std::filesystem::path& input, const OpenOptions& options = {});

}  // namespace gigaray
