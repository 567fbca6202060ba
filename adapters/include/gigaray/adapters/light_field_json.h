// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"

namespace GIGARAY_API gigaray {

/// Value of "format" in a gigaray.json that describes a light field (docs/formats.md).
inline constexpr const char* kLightFieldFormat = "gigaray light field";

/// Writes the description of a light field, whole or not at all. files: path of the picture of each
/// view, relative to the folder of `path`. Throws Error(kIo) when the place can't be written.
void write_light_field_json(const std::filesystem::path& path, const LightField& light_field,
                            const std::vector<std::string>& files);

}  // namespace gigaray
