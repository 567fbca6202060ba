// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "output/ply_points.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>

#include "files/text.h"
#include "gigaray/core/error.h"

namespace gigaray {
namespace {

struct Property {
  char kind = 'f';  ///< i: signed, u: unsigned, f: floating-point
  std::size_t size = 4;
  std::size_t offset = 0;  ///< bytes, in a binary vertex
};

struct Header {
  enum class Format { kText, kLittle, kBig } format = Format::kText;
  std::size_t num_vertices = 0;
  std::vector<Property> properties;
  std::array<std::optional<std::size_t>, 3> axes;  ///< which property is x, y, z
  std::size_t vertex_bytes = 0;
  std::size_t length = 0;  ///< bytes
};

std::optional<Property> property_of(const std::string& type) {
  using Type = std::pair<const char*, Property>;
  static const std::array<Type, 16> kTypes{{{"char", {'i', 1}},
                                            {"int8", {'i', 1}},
                                            {"uchar", {'u', 1}},
                                            {"uint8", {'u', 1}},
                                            {"short", {'i', 2}},
                                            {"int16", {'i', 2}},
                                            {"ushort", {'u', 2}},
                                            {"uint16", {'u', 2}},
                                            {"int", {'i', 4}},
                                            {"int32", {'i', 4}},
                                            {"uint", {'u', 4}},
                                            {"uint32", {'u', 4}},
                                            {"float", {'f', 4}},
                                            {"float32", {'f', 4}},
                                            {"double", {'f', 8}},
                                            {"float64", {'f', 8}}}};
  for (const auto& [name, property] : kTypes)
    if (type == name) return property;
  return std::nullopt;
}

[[noreturn]] void bad(const std::string& where, const std::string& what) {
  throw Error(ErrorCode::kBadInput, where + ": " + what);
}

void add_property(const std::vector<std::string>& words, const std::string& where, Header& header) {
  auto property = words.size() == 3 ? property_of(words[1]) : std::nullopt;
  if (!property) bad(where, "has a property of its vertices that can't be read");
  property->offset = header.vertex_bytes;
  header.vertex_bytes += property->size;
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (words[2] == std::string(1, char('x' + axis))) header.axes[axis] = header.properties.size();
  header.properties.push_back(*property);
}

Header header_of(std::string_view bytes, const std::string& where) {
  if (!bytes.starts_with("ply")) bad(where, "is no PLY file");
  Header header;
  bool in_vertices = false, seen = false;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t end = bytes.find('\n', at);
    if (end == std::string_view::npos) break;
    const std::vector<std::string> words = split_words(bytes.substr(at, end - at));
    at = end + 1;
    if (words.empty()) continue;
    if (words[0] == "end_header") {
      header.length = at;
      if (!seen || !header.axes[0] || !header.axes[1] || !header.axes[2])
        bad(where, "has no vertices with x, y and z");
      return header;
    }
    if (words[0] == "format" && words.size() > 1)
      header.format = words[1] == "ascii"                  ? Header::Format::kText
                      : words[1] == "binary_little_endian" ? Header::Format::kLittle
                                                           : Header::Format::kBig;
    if (words[0] == "element" && words.size() == 3) {
      in_vertices = words[1] == "vertex";
      if (!in_vertices && !seen) bad(where, "has other elements before its vertices");
      if (in_vertices) {
        seen = true;
        const auto count = parse_number(words[2]);
        if (!count || !(*count >= 0 && *count < 1e12)) bad(where, "states no number of vertices");
        header.num_vertices = std::size_t(*count);
      }
    }
    if (in_vertices && words[0] == "property") add_property(words, where, header);
  }
  bad(where, "is cut short: its header has no end");
}

template <class T>
double number_at(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return double(value);
}

double read(const char* vertex, const Property& property, bool swap) {
  char own[8];
  std::memcpy(own, vertex + property.offset, property.size);
  if (swap) std::reverse(own, own + property.size);
  if (property.kind == 'f')
    return property.size == 8 ? number_at<double>(own) : number_at<float>(own);
  const bool has_sign = property.kind == 'i';
  switch (property.size) {
    case 1:
      return has_sign ? number_at<std::int8_t>(own) : number_at<std::uint8_t>(own);
    case 2:
      return has_sign ? number_at<std::int16_t>(own) : number_at<std::uint16_t>(own);
    default:
      return has_sign ? number_at<std::int32_t>(own) : number_at<std::uint32_t>(own);
  }
}

}  // namespace

std::vector<Eigen::Vector3d> parse_ply_points(std::string_view bytes, const std::string& where) {
  static_assert(std::endian::native == std::endian::little);
  const Header header = header_of(bytes, where);
  const std::string_view data = bytes.substr(header.length);
  const auto cut_short = [&] {
    bad(where, "is cut short: " + std::to_string(header.num_vertices) + " vertices are stated");
  };
  const bool is_text = header.format == Header::Format::kText;
  // A vertex of text takes a digit and a space per number.
  const std::size_t least = is_text ? 2 * header.properties.size() - 1 : header.vertex_bytes;
  if (header.num_vertices > data.size() / least) cut_short();
  std::vector<Eigen::Vector3d> points;
  points.reserve(header.num_vertices);
  const auto add = [&](const Eigen::Vector3d& point) {
    if (point.allFinite()) points.push_back(point);
  };
  Eigen::Vector3d point;
  if (!is_text) {
    for (std::size_t i = 0; i < header.num_vertices; ++i) {
      const char* vertex = data.data() + i * header.vertex_bytes;
      for (int axis = 0; axis < 3; ++axis)
        point[axis] = read(vertex, header.properties[*header.axes[std::size_t(axis)]],
                           header.format == Header::Format::kBig);
      add(point);
    }
    return points;
  }
  std::size_t at = 0;
  for (std::size_t i = 0; i < header.num_vertices; ++i) {
    if (at >= data.size()) cut_short();
    const std::size_t end = std::min(data.find('\n', at), data.size());
    const std::vector<std::string> words = split_words(data.substr(at, end - at));
    at = end + 1;
    if (words.size() < header.properties.size()) cut_short();
    for (int axis = 0; axis < 3; ++axis) {
      const auto number = parse_number(words[*header.axes[std::size_t(axis)]]);
      if (!number) bad(where, "vertex " + std::to_string(i) + " has a word that is no number");
      point[axis] = *number;
    }
    add(point);
  }
  return points;
}

}  // namespace gigaray
