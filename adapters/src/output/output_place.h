// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>

#include "gigaray/adapters/atomic_output.h"

namespace gigaray {

[[noreturn]] void cannot_write(const std::filesystem::path& path, const std::error_code& why);

/// Where an output really goes: absolute, without links and "." parts, for the name is changed
/// there. Throws Error(kInvalidArgument) for an empty path and for a link that leads nowhere,
/// Error(kIo) for one that can't exist (too long, a file in place of a folder).
std::filesystem::path output_place(const std::filesystem::path& path);

/// Refuses a folder that the process is in, that is a mount point, or that overlaps an input.
void check_folder_place(const std::filesystem::path& place, const std::filesystem::path& named,
                        const OutputRules& rules);
/// Refuses a folder, and a file that is an input.
void check_file_place(const std::filesystem::path& place, const std::filesystem::path& named,
                      const OutputRules& rules);

/// The first of NAME.old-1, NAME.old-2 … that isn't there.
std::filesystem::path free_old_name(const std::filesystem::path& place);

/// Renames; throws Error(kIo) naming `to` when that is there already, or can't be written.
void rename_to_free(const std::filesystem::path& from, const std::filesystem::path& to);
/// Exchanges two names at once. False where the file system can't.
bool exchange_names(const std::filesystem::path& a, const std::filesystem::path& b);
/// Writes what was changed in a folder's list of names to disk.
void sync_names(const std::filesystem::path& folder);

}  // namespace gigaray
