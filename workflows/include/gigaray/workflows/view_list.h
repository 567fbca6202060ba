// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"

namespace GIGARAY_API gigaray {

/// Views that a text means: "all" (empty list), "centre", or a comma-separated list of names,
/// indices and ranges of indices ("0,4-6,view_09"). Throws Error(kInvalidArgument) naming the part.
std::vector<int> parse_views(const std::string& text, const LightField& light_field);

/// One view by name, index or "centre".
int parse_view(const std::string& text, const LightField& light_field);

}  // namespace gigaray
