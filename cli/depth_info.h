// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "gigaray/core/image.h"
#include "gigaray/core/light_field.h"

namespace gigaray::cli {

/// What `gigaray info` tells of depth: "disparity" and "depth" (5 %, median, 95 % of the known
/// values, unit; null where there is none), "coverage".
nlohmann::ordered_json map_json(const FloatMap& disparity, const LightField& light_field);

/// Lines to type next, with the real path. disparity: of the view `top`.
nlohmann::ordered_json next_lines(const std::filesystem::path& result,
                                  const LightField& light_field, int top,
                                  const FloatMap& disparity);

/// Of an output folder of `gigaray depth`, see result_json().
nlohmann::ordered_json depth_json(const std::filesystem::path& folder);

/// "-0.9 … 0.1 … 0.9 px per view step" of an entry of map_json().
std::string range_text(const nlohmann::ordered_json& range);

}  // namespace gigaray::cli
