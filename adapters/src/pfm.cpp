// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// PFM, https://www.pauldebevec.com/Research/HDR/PFM/: "Pf", width, height, scale as text, each
// followed by white space, then 32-bit floats; rows from bottom to top. A negative scale means
// little endian.
#include <bit>

#include "float_bytes.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/maps.h"
#include "text.h"

namespace gigaray {
namespace {

constexpr int kMaxSize = 1 << 20;  // px per axis, keeps a damaged header from asking for terabytes

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

}  // namespace

FloatMap read_pfm(const std::filesystem::path& path) {
  const std::string bytes = read_bytes(path);
  const auto bad = [&](const std::string& what) {
    return Error(ErrorCode::kBadInput, path.string() + ": " + what);
  };
  std::size_t position = 0;
  const auto word = [&]() -> std::string_view {
    while (position < bytes.size() && is_space(bytes[position])) ++position;
    const std::size_t begin = position;
    while (position < bytes.size() && !is_space(bytes[position])) ++position;
    return std::string_view(bytes).substr(begin, position - begin);
  };

  if (!bytes.starts_with("Pf")) {
    throw bad(bytes.starts_with("PF") ? "is a PFM with three channels; a map has one"
                                      : "is no PFM file");
  }
  word();
  const auto size = [&]() {
    const auto value = parse_number(word());
    if (!value || *value < 1 || *value > kMaxSize || *value != int(*value))
      throw bad("the header of the PFM states no valid size");
    return int(*value);
  };
  const int width = size();
  const int height = size();
  const auto scale = parse_number(word());
  if (!scale || !(*scale != 0)) throw bad("the header of the PFM states no valid scale");
  ++position;  // exactly one character of white space, then the floats

  const std::size_t count = std::size_t(width) * height;
  const std::size_t present = position <= bytes.size() ? bytes.size() - position : 0;
  if (present != count * sizeof(float))
    throw bad((present < count * sizeof(float) ? "is cut short: " : "is too long: ") +
              std::to_string(present) + " bytes of floats where its header states " +
              std::to_string(count * sizeof(float)));
  FloatMap map(width, height);
  const auto order = *scale < 0 ? std::endian::little : std::endian::big;
  for (int v = 0; v < height; ++v)
    load_floats(bytes.data() + position + sizeof(float) * width * (height - 1 - v), order,
                map.row(v), width);
  return map;
}

void write_pfm(const std::filesystem::path& path, const FloatMap& map) {
  GIGARAY_CHECK(map.channels() == 1 && !map.empty());
  std::string bytes =
      "Pf\n" + std::to_string(map.width()) + " " + std::to_string(map.height()) + "\n-1.0\n";
  for (int v = map.height() - 1; v >= 0; --v) append_floats(bytes, map.row(v), map.width());
  write_file_atomically(path, bytes);
}

}  // namespace gigaray
