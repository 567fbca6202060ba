// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "gigaray/adapters/colmap_model.h"

namespace gigaray {

/// Folders of models directly below one, such as sparse/0, sparse/1 …, by their numbers.
std::vector<std::filesystem::path> colmap_models_below(const std::filesystem::path& folder);

/// Folders of the models that an input may mean: itself, its sparse, sparse/0, dense/sparse, … One
/// with parts missing is better than none: read_colmap_model() says which.
std::vector<std::filesystem::path> colmap_models_of(const std::filesystem::path& input);

struct FoundColmapModel {
  std::filesystem::path folder;
  ColmapModel model;
};

/// Reads the model with the most images. Of several it notes their sizes and what can't be read.
/// Throws Error(kBadInput) when none can. folders: one or more. strict: as read_colmap_model.
FoundColmapModel largest_colmap_model(const std::vector<std::filesystem::path>& folders,
                                      std::vector<std::string>& notes, bool strict = true);

}  // namespace gigaray
