// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string_view>

namespace gigaray {

/// A file that viewer/ builds, embedded: index.html, viewer.css, viewer.js. Empty: it was not
/// built.
std::string_view viewer_file(std::string_view file_name);

}  // namespace gigaray
