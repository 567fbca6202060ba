// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// NumPy arrays, https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html: magic,
// version, length of the header, a Python dictionary as text, then the values. Shape (v, u).
#include <algorithm>
#include <bit>
#include <regex>

#include "files/text.h"
#include "formats/npy_matrix.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/core/arguments.h"
#include "pictures/float_bytes.h"

namespace gigaray {
namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::size_t kAlignment = 64;    // of the first value
constexpr double kMaxSize = 1 << 20;      // per axis
constexpr std::size_t kMaxHeader = 4096;  // of a plain array it is some 100 bytes

struct Header {
  int rows = 0, columns = 0;
  std::size_t value_size = sizeof(float);
  std::endian order = std::endian::little;
  std::size_t size = 0;  ///< bytes before the values

  std::size_t count() const { return std::size_t(rows) * std::size_t(columns); }
};

/// bytes: the first ones of a file of file_size, which must be what the header states.
Header parse_header(std::string_view bytes, std::uint64_t file_size, const std::string& where) {
  const auto bad = [&](const std::string& what) {
    return Error(ErrorCode::kBadInput, where + ": " + what);
  };
  if (!bytes.starts_with(kMagic) || bytes.size() < 12) throw bad("is no NumPy file");
  const auto byte = [&](std::size_t i) {
    return std::size_t(static_cast<unsigned char>(bytes[i]));
  };
  const bool version_1 = byte(6) == 1;
  const std::size_t begin = version_1 ? 10 : 12;
  const std::size_t length =
      byte(8) | byte(9) << 8 | (version_1 ? 0 : byte(10) << 16 | byte(11) << 24);
  if (length > file_size - begin) throw bad("is cut short in its header");
  if (length > kMaxHeader) throw bad("has no header of a plain array");
  const std::string text(bytes.substr(begin, length));

  std::smatch type, shape;
  static const std::regex kType(R"('descr'\s*:\s*'([<>])f([48])')");
  static const std::regex kShape(R"('shape'\s*:\s*\(\s*(\d{1,9})\s*,\s*(\d{1,9})\s*,?\s*\))");
  if (!std::regex_search(text, type, kType))
    throw bad("holds another type than float32 or float64");
  if (text.find("'fortran_order': False") == std::string::npos)
    throw bad("is stored in Fortran order; save it with numpy.ascontiguousarray");
  if (!std::regex_search(text, shape, kShape)) throw bad("has not two dimensions");
  const double rows = *parse_number(shape[1].str()), columns = *parse_number(shape[2].str());
  if (rows < 1 || columns < 1 || rows > kMaxSize || columns > kMaxSize)
    throw bad("has no valid size");
  Header header;
  header.rows = int(rows);
  header.columns = int(columns);
  header.value_size = type[2] == "8" ? sizeof(double) : sizeof(float);
  header.order = type[1] == "<" ? std::endian::little : std::endian::big;
  header.size = begin + length;
  if (file_size - header.size != header.count() * header.value_size)
    throw bad("is cut short or too long for its shape");
  return header;
}

}  // namespace

NpyMatrix parse_npy_matrix(std::string_view bytes, const std::string& where) {
  const Header header = parse_header(bytes, bytes.size(), where);
  NpyMatrix matrix{header.rows, header.columns, std::vector<double>(header.count())};
  const char* values = bytes.data() + header.size;
  if (header.value_size == sizeof(double))
    load_floats<double>(values, header.order, matrix.values.data(), header.count());
  else
    load_floats<float>(values, header.order, matrix.values.data(), header.count());
  return matrix;
}

NpyMatrix read_npy_matrix(const std::filesystem::path& path) {
  // The bytes, and doubles of float32.
  constexpr double kBytesPerByte = 1 + 2 + 1;
  const double limit = opening_limit();
  const InputFile file(path);
  parse_header(file.read(0, kMaxHeader + 12), file.size(), path.string());
  hold_against_limit(path.string(), "has " + std::to_string(file.size()) + " bytes",
                     kBytesPerByte * double(file.size()), limit);
  return parse_npy_matrix(file.read(0, file.size()), path.string());
}

FloatMap read_npy(const std::filesystem::path& path) {
  const NpyMatrix matrix = read_npy_matrix(path);
  FloatMap map(matrix.columns, matrix.rows);
  std::transform(matrix.values.begin(), matrix.values.end(), map.data(),
                 [](double value) { return float(value); });
  return map;
}

void write_npy(const std::filesystem::path& path, const FloatMap& map) {
  require_argument(map.channels() == 1 && !map.empty(), "map: one channel and pixels are needed");
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (" +
                       std::to_string(map.height()) + ", " + std::to_string(map.width()) + "), }";
  const std::size_t used = kMagic.size() + 4 + header.size() + 1;
  header.append((kAlignment - used % kAlignment) % kAlignment, ' ');
  header += '\n';
  std::string bytes(kMagic);
  bytes += {'\x01', '\x00', char(header.size() & 0xff), char(header.size() >> 8)};
  bytes += header;
  append_floats(bytes, map.data(), map.size());
  write_file_atomically(path, bytes);
}

}  // namespace gigaray
