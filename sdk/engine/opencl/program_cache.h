// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "opencl/device.h"

namespace gigaray::opencl {

/// One file of a program: compiler messages name it.
struct SourcePart {
  std::string_view name;
  std::string_view text;
};

/// Text of an embedded file of the engine ("density_score.cl"), by its name without folders. An
/// unknown name gives nothing. The definition is made by gigaray_embed_files().
std::string_view kernel_source(std::string_view file_name);

/// The program of all parts joined in order, compiled as OpenCL C 1.2 with `options` (defines).
/// Taken from memory or else from the disk cache when source, options, platform, device and driver
/// are the same; compiled otherwise. A damaged cache file is compiled anew and replaced; a cache
/// folder that can't be written is done without. PoCL always gets the source: what it compiled
/// before it finds in a cache of its own (pocl_cache.h). Throws Error(kDevice) with the compiler's
/// messages when the source doesn't compile. Thread-safe: one at a time on a device, so that
/// nothing is compiled twice.
cl::Program build_program(const Device& device, std::span<const SourcePart> parts,
                          const std::string& options = "");

}  // namespace gigaray::opencl
