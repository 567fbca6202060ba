// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>
#include <vector>

namespace gigaray {

/// Names for views from the relative paths of their pictures: the stems if no two are alike, else
/// the paths with '_' for separators, without their extension if that is enough. They name folders:
/// none is empty, holds a separator or begins with a dot, no two are alike.
std::vector<std::string> view_names(const std::vector<std::string>& paths);

}  // namespace gigaray
