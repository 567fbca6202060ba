// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/option_value.h"
#include "gigaray/engine/depth_options.h"

namespace GIGARAY_API gigaray {

/// Sets options of the table (docs/options.md) by name. Throws Error(kInvalidArgument) naming one
/// that there is not, with what may have been meant, and a value that it can't have.
void set_options(const std::vector<NamedValue>& values, DepthOptions& options);

/// The same of a text, NAME=VALUE.
void set_option(const std::string& setting, DepthOptions& options);

/// The options that a JSON file states, or those that a result was asked for (its folder or its
/// gigaray.json), on top of the preset that it names, else of `preset`. preset_is_stated: then the
/// file may name no other. Throws Error(kBadInput) naming the file, Error(kInvalidArgument) for
/// the preset.
DepthOptions options_of_file(const std::filesystem::path& file, const std::string& preset = "auto",
                             bool preset_is_stated = false);

}  // namespace gigaray
