// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>
#include <vector>

#include "formats/section_file.h"
#include "gigaray/core/light_field.h"
#include "gigaray/sparse/sparse_light_field.h"

namespace gigaray {

/// Tuples of a band.
struct TupleSection {
  Section section;
  std::int32_t least_slope = 0, largest_slope = 0;
};

/// What the directory of a .grl file says.
struct SparseDirectory {
  LightField light_field;  ///< without pixels
  SparseShape shape;
  int max_error = 0;
  std::vector<TupleSection> tuples;               ///< by band
  std::vector<std::vector<Section>> differences;  ///< [view][band]
};

std::string encode_directory(const SparseDirectory& directory);
/// limit: bytes that it may take. Throws Error(kBadInput) beginning with `where`.
SparseDirectory decode_directory(std::string_view bytes, const std::string& where, double limit);

/// Gives pixels that no tuple draws the colour of the nearest that one does, in their row.
void fill_undrawn(DrawnRows& drawn);

}  // namespace gigaray
