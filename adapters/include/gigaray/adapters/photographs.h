// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "gigaray/adapters/reader.h"
#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"
#include "gigaray/core/run_control.h"

namespace GIGARAY_API gigaray {

/// The input, or its folder "images" when no reader knows the input itself and pictures lie there.
std::filesystem::path folder_of_photographs(const std::filesystem::path& input);

/// Is the input a folder of pictures with nothing that says where they were taken?
bool is_plain_folder(const std::filesystem::path& input, const OpenOptions& options);

/// Why the pictures of a plain folder can't be views along a line, and are photographs from
/// anywhere: names without numbers, several series, upright ones and ones on their side. Empty:
/// they may be, or they should be and are damaged (one has another size). Throws Error(kBadInput)
/// naming an unreadable picture, or one that takes more than memory_bytes (OpenOptions).
std::string why_no_series(const std::filesystem::path& folder, double memory_bytes = 0);

/// Why a plain folder is neither one series nor photographs of one walk: it holds most pictures
/// twice, as JPEG and as PNG, or two series of similar length. Empty: it may be.
std::string why_twice(const std::filesystem::path& folder);

/// A note that names files that look like cameras, in the input or directly beside it, and that a
/// reader of `format` doesn't take. Empty: there are none.
std::string unused_cameras(const std::filesystem::path& input, const std::string& format);

/// Is a series of pictures what a 3D light field is, that is, do things move along the rows (or the
/// columns) of the pictures alone from one view to the next? The median displacement across that
/// direction of features matched between some neighbouring views, the largest of the views looked
/// at, in px of pictures shrunk to 1000 px at most. Rectified rows have some tenths, photographs
/// from the hand many px. Empty when too little matches to tell.
std::optional<double> displacement_across_rows(const LightField& light_field,
                                               const RunControl& control);

/// Above it pictures are no row.
inline constexpr double kMostAcrossRows = 1.5;

}  // namespace gigaray
