// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/option_value.h"

namespace GIGARAY_API gigaray {

/// A JSON object with these values, in this order; names with dots become objects in objects. What
/// JSON has no number for (infinities) becomes words.
std::string options_json(const std::vector<NamedValue>& values);

/// The values of such an object, whether its names are nested, have dots, or both. Of the
/// gigaray.json of a result: the options that the run was asked for. Names are not looked at.
/// Throws Error(kBadInput) beginning with `where`, one line that names the entry.
std::vector<NamedValue> parse_options_json(std::string_view text, const std::string& where);

/// The same of a file, or of the result in a folder. Throws Error: kBadInput, kIo.
std::vector<NamedValue> read_options_file(const std::filesystem::path& path);

}  // namespace gigaray
