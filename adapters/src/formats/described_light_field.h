// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "gigaray/adapters/reader.h"
#include "gigaray/core/light_field.h"

namespace gigaray {

/// What a gigaray.json says: a light field without pixels, and the picture of every view.
struct DescribedLightField {
  LightField light_field;
  std::vector<std::string> files;  ///< relative to the folder of the description
};

/// Kind, size, rig, range of disparities and views of a light field, without pixels: the common
/// part of the program's own formats.
nlohmann::ordered_json description_of(const LightField& light_field);
/// Parts of it, and a camera as `gigaray depth` writes it. These and the next function throw
/// Error(kBadInput) or an exception of the JSON library.
View view_of(const nlohmann::json& entry);
int size_of(const nlohmann::json& entry, const char* key);  ///< width or height, 1 … 2^20 px
RigGeometry rig_of(const nlohmann::json& description);
Camera camera_of(const nlohmann::json& entry, const std::string& name);
/// The light field that it describes.
LightField described_light_field(const nlohmann::json& description);

/// What the gigaray.json of a result of `gigaray depth` says.
struct DescribedDepth {
  LightField light_field;  ///< of the views with depth, without pixels
  std::filesystem::path input;
  OpenOptions opened_with;  ///< what the user said of the input
  DisparityRange searched;
  int hypotheses = 0;  ///< 0: not stated
  int top_view = 0;    ///< the one whose maps stand at top level
};
/// Parses its text. Throws Error(kBadInput) beginning with `where`.
DescribedDepth parse_depth_json(std::string_view text, const std::string& where);

/// Parses the text of a gigaray.json. Throws Error(kBadInput) beginning with `where`.
DescribedLightField parse_light_field_json(std::string_view text, const std::string& where);

}  // namespace gigaray
