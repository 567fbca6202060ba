// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace gigaray::cli {

/// What `gigaray info` tells of something that this program wrote and that is no light field: an
/// output folder of `depth`, `segment`, `render`, `probe` or `compare`, a cloud (.ply, .pcd) or a
/// surface (.ply, .glb).

/// The command that wrote it, as "gigaray depth"; empty: it is none of these. Never throws for what
/// a file contains.
std::string kind_of_result(const std::filesystem::path& place);

/// As JSON: "format" as above, "next" the lines to type next, and what there is to tell. Throws
/// Error(kBadInput) naming the file when something is missing or damaged.
nlohmann::ordered_json result_json(const std::filesystem::path& place);

/// For people: a line per entry.
void print_result(const nlohmann::ordered_json& result);

/// What a .grl file holds beside its light field, with "next"; and for people.
nlohmann::ordered_json sparse_json(const std::filesystem::path& file, double memory_bytes);
void print_sparse(const nlohmann::ordered_json& sparse);

}  // namespace gigaray::cli
