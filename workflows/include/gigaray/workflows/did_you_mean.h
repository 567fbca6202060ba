// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>
#include <vector>

#include "gigaray/core/api.h"

namespace GIGARAY_API gigaray {

/// The known word that was probably meant: the nearest one by letters added, left out, changed or
/// swapped, or the only one that begins like it. Empty: none is near.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

/// "; did you mean depth?", or nothing.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known);

}  // namespace gigaray
