// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>

namespace gigaray::cli {

/// A text of the library in the words of the command line: a field that it names, in backquotes
/// (`focal_px`) or with its structure (OpenOptions::grid), becomes the option that states it, if
/// there is one.
std::string with_flags(std::string message);

}  // namespace gigaray::cli
