// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>
#include <vips/vips8>

namespace gigaray {

/// Starts libvips at the first call. Nothing is cached between calls and nothing is printed.
void use_vips();

/// The first line of what libvips says about an error.
std::string vips_reason(const vips::VError& error);

}  // namespace gigaray
