// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace gigaray::opencl {

/// Folder of compiled kernels and of the user's tuning: $GIGARAY_CACHE_DIR, else
/// $XDG_CACHE_HOME/gigaray, else $HOME/.cache/gigaray. Empty when GIGARAY_CACHE=off or none of the
/// variables is set. Read from the environment at every call; the folder need not exist.
std::optional<std::filesystem::path> cache_folder();

inline constexpr std::string_view kProgramFolder = "gigaray-programs";  ///< <hash>.bin, not PoCL's
inline constexpr std::string_view kPoclFolder = "gigaray-pocl";         ///< PoCL's own cache
inline constexpr std::string_view kReadyFolder = "gigaray-ready";  ///< what is compiled already

/// Writes a file beside `path` and renames it, so that a reader sees the old or the new content
/// and nothing between; makes the folder. False when that is impossible, leaving no file behind.
bool write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// The content of a file, or empty when it can't be read.
std::optional<std::string> read_file(const std::filesystem::path& path);

/// Why a folder, which is made where it is missing, can't take so many bytes (not writable, full, a
/// quota), as one line; empty: it can.
std::string why_no_room(const std::filesystem::path& folder, std::uint64_t bytes);

/// Makes PoCL keep its compiled kernels under cache_folder(), see list_devices(). Call before the
/// first OpenCL call; only the first call of the process does something. Gives the reason why PoCL
/// can't be used, since no folder has room for its kernels; empty: it can.
const std::string& give_pocl_a_cache();

}  // namespace gigaray::opencl
