// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Sections of a .grl file whose checksums are right: directory, tuples, differences, and blocks
// that state other sizes than they have.
#include "formats/sparse_file_parts.h"
#include "fuzz.h"
#include "gigaray/sparse/sparse_coding.h"

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

void append_number(std::string& bytes, std::uint64_t value) {
  for (; value >= 0x80; value >>= 7) bytes += char(value | 0x80);
  bytes += char(value);
}

/// A count of tuples, and blocks whose stated sizes, before and in their frames, are of the input.
std::string lying_blocks(std::string_view input) {
  std::string bytes;
  const auto next = [&] {
    std::uint64_t value = 0;
    for (int i = 0; i < 3 && !input.empty(); ++i, input.remove_prefix(1))
      value = value << 8 | std::uint8_t(input.front());
    return value;
  };
  append_number(bytes, next());
  for (int column = 0; column < 7; ++column) {
    std::string block = gigaray::compressed(std::string(next() % 65536, char(column)));
    const auto stated = next();
    if (stated % 2 == 1) {
      std::string frame;
      append_number(frame, stated >> 1);
      std::size_t skip = 0;
      while (skip < block.size() && block[skip] & 0x80) ++skip;
      block = frame + block.substr(std::min(skip + 1, block.size()));
    }
    bytes += block;
  }
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const gigaray::fuzz::Input input(data, size, 6);
  gigaray::fuzz::expect_result_or_one_line([&] {
    if (input.choice == 0) {
      const auto directory =
          gigaray::decode_directory(gigaray::compressed(input.bytes), "fuzz", 1 << 28);
      GIGARAY_CHECK(directory.differences.size() == directory.light_field.views.size());
    } else if (input.choice == 1) {
      const gigaray::SparseShape shape = small_shape();
      const gigaray::TupleBand band = gigaray::decode_tuples(shape, 1, input.bytes, 1 << 28);
      for (const gigaray::SparseTuple& tuple : band.tuples)
        GIGARAY_CHECK(tuple.u < 23 && tuple.v >= 10 && tuple.v < 17 && tuple.view < 3);
    } else if (input.choice == 3) {
      constexpr std::size_t kMost = 1 << 20;
      GIGARAY_CHECK(gigaray::decompressed(input.bytes, kMost).size() <= kMost);
    } else if (input.choice == 4) {
      gigaray::decode_tuples(small_shape(), 0, lying_blocks(input.bytes), 1 << 20);
    } else if (input.choice == 5) {
      gigaray::decode_directory(input.bytes, "fuzz", 1 << 26);
    } else {
      const gigaray::Image<std::uint16_t> drawn(23, 7, 3, 100);
      GIGARAY_CHECK(gigaray::decode_difference(input.bytes, drawn, 8).size() == drawn.size());
    }
  });
  return 0;
}
