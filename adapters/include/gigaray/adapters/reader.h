// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>

#include "gigaray/light_field.h"

namespace gigaray {

/// Which way the camera of an image sequence moves as the numbers of the pictures rise.
enum class Travel {
  kAuto,   ///< Right is assumed; LightField::sign_is_assumed tells the caller to check it.
  kRight,  ///< Stated: near things move to the left of the picture.
  kLeft,   ///< Stated: near things move to the right.
};

/// What the pictures alone don't say.
struct OpenOptions {
  /// Text file with the position of every picture of a folder: `right`, `right down` or
  /// `name right down` per line, any unit (docs/formats.md). Empty: from the input itself.
  std::filesystem::path positions;
  /// Only for an image sequence without a positions file.
  Travel direction = Travel::kAuto;
};

/// Recognises what `input` is (registry.h) and opens it. Reads the headers of the pictures, not
/// their pixels. Throws Error(kBadInput) when nothing fits, saying what is missing; when the format
/// is known but the data are damaged or contradictory; when it is a format that can't be read yet.
/// Throws Error(kInvalidArgument) when an option does not go with the format.
LightField open_light_field(const std::filesystem::path& input, const OpenOptions& options = {});

}  // namespace gigaray
