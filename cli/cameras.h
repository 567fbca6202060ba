// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gigaray/core/light_field.h"

namespace gigaray::cli {

/// Lines about the cameras of unstructured views: label, text.
std::vector<std::pair<std::string, std::string>> describe_cameras(const LightField& light_field);

}  // namespace gigaray::cli
