// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gigaray/light_field.h"

namespace gigaray {

/// What a gigaray.json says: a light field without pixels, and the picture of every view.
struct DescribedLightField {
  LightField light_field;
  std::vector<std::string> files;  ///< relative to the folder of the description
};

/// Parses the text of a gigaray.json. Throws Error(kBadInput) beginning with `where`.
DescribedLightField parse_light_field_json(std::string_view text, const std::string& where);

}  // namespace gigaray
