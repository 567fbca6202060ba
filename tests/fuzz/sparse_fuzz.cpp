// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Sections of a .grl file whose checksums are right: directory, tuples, differences.
#include "fuzz.h"
#include "gigaray/sparse_coding.h"
#include "sparse_file_parts.h"

namespace {

gigaray::SparseShape small_shape() {
  gigaray::SparseShape shape;
  shape.width = 23;
  shape.height = 17;
  shape.band_rows = 10;
  shape.slope_bits = 6;
  shape.positions.resize(3);
  return shape;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const gigaray::fuzz::Input input(data, size, 3);
  gigaray::fuzz::expect_result_or_one_line([&] {
    if (input.choice == 0) {
      const auto directory =
          gigaray::decode_directory(gigaray::compressed(input.bytes), "fuzz");
      GIGARAY_CHECK(directory.differences.size() == directory.light_field.views.size());
    } else if (input.choice == 1) {
      const gigaray::SparseShape shape = small_shape();
      const gigaray::TupleBand band = gigaray::decode_tuples(shape, 1, input.bytes);
      for (const gigaray::SparseTuple& tuple : band.tuples)
        GIGARAY_CHECK(tuple.u < 23 && tuple.v >= 10 && tuple.v < 17 && tuple.view < 3);
    } else {
      const gigaray::Image<std::uint16_t> drawn(23, 7, 3, 100);
      GIGARAY_CHECK(gigaray::decode_difference(input.bytes, drawn, 8).size() == drawn.size());
    }
  });
  return 0;
}
