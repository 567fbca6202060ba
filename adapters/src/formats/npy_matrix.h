// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gigaray {

/// A NumPy array of two dimensions, float32 or float64, by rows.
struct NpyMatrix {
  int rows = 0, columns = 0;
  std::vector<double> values;
  double operator()(int row, int column) const {
    return values[std::size_t(row) * columns + column];
  }
};

/// Parses the bytes of a file. Throws Error(kBadInput) beginning with `where`: no such array, cut
/// short or too long.
NpyMatrix parse_npy_matrix(std::string_view bytes, const std::string& where);
/// The same of a file that fits into the memory that opening may take.
NpyMatrix read_npy_matrix(const std::filesystem::path& path);

}  // namespace gigaray
