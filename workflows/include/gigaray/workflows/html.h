// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>

#include "gigaray/core/api.h"

namespace GIGARAY_API gigaray {

/// A text as it stands in HTML, in an attribute too.
std::string html_text(const std::string& text);

/// Bytes as base64 with padding, for data: URLs and scripts of a page.
std::string base64(std::string bytes);

}  // namespace gigaray
