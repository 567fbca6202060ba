// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// PFM, https://www.pauldebevec.com/Research/HDR/PFM/: "Pf", width, height, scale as text, each
// followed by white space, then 32-bit floats; rows from bottom to top. A negative scale means
// little endian.
#include <bit>

#include "files/text.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/core/arguments.h"
#include "pictures/float_bytes.h"
#include "pictures/map_headers.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

constexpr int kMaxSize = 1 << 20;  // px per axis, keeps a damaged header from asking for terabytes

constexpr std::size_t kMostHeader = 4096;

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

}  // namespace

PfmHeader parse_pfm_header(std::string_view bytes, std::uint64_t file_size,
                           const std::string& where) {
  const auto bad = [&](const std::string& what) {
    return Error(ErrorCode::kBadInput, where + ": " + what);
  };
  std::size_t position = 0;
  const auto word = [&]() -> std::string_view {
    while (position < bytes.size() && is_space(bytes[position])) ++position;
    const std::size_t begin = position;
    while (position < bytes.size() && !is_space(bytes[position])) ++position;
    return bytes.substr(begin, position - begin);
  };

  if (!bytes.starts_with("Pf")) {
    throw bad(bytes.starts_with("PF") ? "is a PFM with three channels; a map has one"
                                      : "is no PFM file");
  }
  word();
  const auto size = [&]() {
    const auto value = parse_number(word());
    if (!value || !(*value >= 1 && *value <= kMaxSize) || *value != int(*value))
      throw bad("the header of the PFM states no valid size");
    return int(*value);
  };
  PfmHeader header;
  header.width = size();
  header.height = size();
  const auto scale = parse_number(word());
  if (!scale || !(*scale != 0)) throw bad("the header of the PFM states no valid scale");
  header.order = *scale < 0 ? std::endian::little : std::endian::big;
  header.size = position + 1;  // exactly one character of white space, then the floats

  const std::uint64_t stated = std::uint64_t(header.width) * header.height * sizeof(float);
  const std::uint64_t present = header.size <= file_size ? file_size - header.size : 0;
  if (present != stated)
    throw bad((present < stated ? "is cut short: " : "is too long: ") + std::to_string(present) +
              " bytes of floats where its header states " + std::to_string(stated));
  return header;
}

FloatMap read_pfm(const std::filesystem::path& path) {
  const InputFile file(path);
  const PfmHeader header = parse_pfm_header(file.read(0, kMostHeader), file.size(), path.string());
  hold_against_limit(path.string(), "states " + size_text(header.width, header.height) + " px",
                     double(sizeof(float)) * header.width * header.height, opening_limit());
  FloatMap map(header.width, header.height);
  const std::size_t row = sizeof(float) * map.width();
  for (int v = 0; v < map.height(); ++v) {
    const std::string bytes = file.read(header.size + row * (map.height() - 1 - v), row);
    if (bytes.size() != row)
      throw Error(ErrorCode::kIo, path.string() + ": can't be read to its end");
    load_floats(bytes.data(), header.order, map.row(v), map.width());
  }
  return map;
}

void write_pfm(const std::filesystem::path& path, const FloatMap& map) {
  require_argument(map.channels() == 1 && !map.empty(), "map: one channel and pixels are needed");
  std::string bytes =
      "Pf\n" + std::to_string(map.width()) + " " + std::to_string(map.height()) + "\n-1.0\n";
  for (int v = map.height() - 1; v >= 0; --v) append_floats(bytes, map.row(v), map.width());
  write_file_atomically(path, bytes);
}

}  // namespace gigaray
