// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>

namespace gigaray::cli {

/// Opens what is closed of the descriptors 0 to 2, so that no file of the program gets their
/// numbers and with them what is printed. What is printed to a closed one fails.
void secure_descriptors();

/// Prints on stderr, now. That it can't be printed changes nothing.
void to_stderr(const std::string& text);

}  // namespace gigaray::cli
