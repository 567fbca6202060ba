// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <nlohmann/json.hpp>

#include "gigaray/workflows/depth.h"

namespace gigaray::cli {

/// What `info` says of a light field, on stdout: a table for people.
void print_text(const LightField& light_field, const DepthForecast& depth);

/// The same as JSON. sparse: what a .grl file holds beside it; null: it is none.
void print_json(const LightField& light_field, const DepthForecast& depth,
                const nlohmann::ordered_json& sparse);

}  // namespace gigaray::cli
