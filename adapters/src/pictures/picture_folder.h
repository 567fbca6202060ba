// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gigaray {

/// The folder that the names of pictures are relative to: of `folders` the one that holds most.
/// model: the file or folder that names the pictures, for messages. Throws Error(kBadInput) when
/// fewer than `least` of them are there, naming the first that is missing and how many.
std::filesystem::path folder_of_pictures(const std::filesystem::path& model,
                                         const std::vector<std::filesystem::path>& folders,
                                         const std::vector<std::string>& names, std::size_t least);

}  // namespace gigaray
