// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace gigaray::opencl {

/// The selection of a device as it is meant: GIGARAY_DEVICE where it is empty. See select_device().
std::string stated_device(const std::string& selection);

/// Has a run of this kind come to its end with the cache as it is? Then another one has little to
/// compile, which takes much memory. `job` is any text that names what the kernels depend on. False
/// without a cache. Touches no device.
bool kernels_are_ready(std::string_view job);

/// Remembers it.
void note_ready_kernels(std::string_view job);

/// Forgets all of it. cache: as cache_folder() gives it.
void forget_ready_kernels(const std::filesystem::path& cache);

}  // namespace gigaray::opencl
