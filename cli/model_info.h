// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace gigaray::cli {

/// "gigaray cloud" or "gigaray mesh" of a .ply, .pcd or .glb file, whoever wrote it; else empty.
/// Never throws for what a file contains.
std::string kind_of_model(const std::filesystem::path& file);

/// "format", "file", "bytes", "vertices", "faces", and where the file states it "origin" and "box"
/// (least and largest coordinates). Reads heads alone. Throws Error(kBadInput) naming the file.
nlohmann::ordered_json model_json(const std::filesystem::path& file);
void print_model(const nlohmann::ordered_json& model);

}  // namespace gigaray::cli
