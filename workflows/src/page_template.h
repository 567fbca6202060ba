// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>

namespace gigaray {

/// The page of viewer/ with its style and script, and `scene` (elements of HTML, may be empty)
/// where the page looks for it. Throws Error(kDevice) where has_view_page() is false.
std::string page_with(const std::string& title, const std::string& scene);

}  // namespace gigaray
