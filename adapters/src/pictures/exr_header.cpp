// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// The header of an OpenEXR file, https://openexr.com/en/latest/OpenEXRFileLayout.html: magic,
// version and flags, attributes (name, type, size, value) up to an empty name, offsets of chunks.
#include <cstring>
#include <optional>
#include <utility>

#include "gigaray/adapters/input_file.h"
#include "pictures/map_headers.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

constexpr std::uint32_t kMagic = 20000630;
constexpr std::uint32_t kTiled = 0x200, kDeep = 0x800, kSeveralParts = 0x1000;
constexpr int kMostSize = 1 << 20;  // px per axis

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& where) : bytes_(bytes), where_(where) {}

  template <class T>
  T get() {
    T value;
    std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
    return value;
  }
  std::string_view take(std::size_t size) {
    if (size > bytes_.size()) bad("is cut short in its header");
    const std::string_view part = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return part;
  }
  std::string_view word() {
    constexpr std::size_t kLongest = 255;
    const auto end = bytes_.substr(0, kLongest + 1).find('\0');
    if (end == std::string_view::npos) bad("is cut short or damaged in its header");
    const std::string_view word = bytes_.substr(0, end);
    bytes_.remove_prefix(end + 1);
    return word;
  }
  std::size_t rest() const { return bytes_.size(); }
  [[noreturn]] void bad(const std::string& what) const {
    throw Error(ErrorCode::kBadInput, where_ + ": " + what);
  }

 private:
  std::string_view bytes_;
  const std::string& where_;
};

int rows_of_chunk(int compression) {
  switch (compression) {
    case 3:  // ZIP
    case 5:  // PXR24
      return 16;
    case 4:  // PIZ
    case 6:  // B44
    case 7:
    case 8:  // DWAA
      return 32;
    case 9:  // DWAB
      return 256;
    default:
      return 1;
  }
}

/// Bytes of a value of a type that has always as many; 0: of another one.
std::size_t fixed_size(std::string_view type) {
  struct Size {
    std::string_view type;
    std::size_t bytes;
  };
  static constexpr Size kSizes[] = {{"box2f", 16},      {"box2i", 16},    {"chromaticities", 32},
                                    {"compression", 1}, {"double", 8},    {"deepImageState", 1},
                                    {"envmap", 1},      {"float", 4},     {"int", 4},
                                    {"keycode", 28},    {"lineOrder", 1}, {"m33d", 72},
                                    {"m33f", 36},       {"m44d", 128},    {"m44f", 64},
                                    {"rational", 8},    {"tiledesc", 9},  {"timecode", 8},
                                    {"v2d", 16},        {"v2f", 8},       {"v2i", 8},
                                    {"v3d", 24},        {"v3f", 12},      {"v3i", 12}};
  for (const Size& size : kSizes)
    if (size.type == type) return size.bytes;
  return 0;
}

std::vector<ExrChannel> channels_of(std::string_view list, const std::string& where) {
  Reader reader(list, where);
  std::vector<ExrChannel> channels;
  for (std::string_view name = reader.word(); !name.empty(); name = reader.word()) {
    reader.take(8);  // type, is it linear
    const auto every_u = reader.get<std::int32_t>(), every_v = reader.get<std::int32_t>();
    channels.push_back({std::string(name), every_u == 1 && every_v == 1});
  }
  if (reader.rest() > 0) reader.bad("is damaged in its header");
  return channels;
}

/// The library reads values of some types without a look at their stated size: then what follows is
/// something else to it than to this file.
void check_size(std::string_view type, std::string_view value, const std::string& where) {
  Reader reader(value, where);
  if (const std::size_t size = fixed_size(type); size > 0 && value.size() != size)
    reader.bad("is damaged in its header");
  if (type == "chlist") channels_of(value, where);
  if (type == "preview") {
    const double width = reader.get<std::uint32_t>(), height = reader.get<std::uint32_t>();
    if (4 * width * height != double(reader.rest())) reader.bad("is damaged in its header");
  }
}

}  // namespace

ExrHeader parse_exr_header(std::string_view bytes, std::uint64_t file_size,
                           const std::string& where) {
  Reader file(bytes, where);
  if (bytes.size() < 8 || file.get<std::uint32_t>() != kMagic)
    file.bad("is damaged or no OpenEXR file");
  const auto flags = file.get<std::uint32_t>();
  if (flags & (kDeep | kSeveralParts))
    file.bad("has several parts or depths, which are not read; save it as one flat picture");

  struct Window {
    std::int32_t left, top, right, bottom;
  };
  struct Tile {
    std::uint32_t width, height;
  };
  std::optional<Window> window, shown;
  std::optional<Tile> tile;
  std::vector<ExrChannel> channels;
  int compression = 0;
  for (std::string_view name = file.word(); !name.empty(); name = file.word()) {
    const std::string_view type = file.word();
    const auto size = file.get<std::int32_t>();
    if (size < 0) file.bad("is damaged in its header");
    const std::string_view value = file.take(std::size_t(size));
    check_size(type, value, where);
    Reader attribute(value, where);
    if (name == "dataWindow") window = attribute.get<Window>();
    if (name == "displayWindow") shown = attribute.get<Window>();
    if (name == "channels") channels = channels_of(value, where);
    if (name == "compression") compression = attribute.get<std::uint8_t>();
    if (name == "tiles") tile = attribute.get<Tile>();
  }
  if (!window) file.bad("has no window of data");
  const auto check_window = [&](const Window& stated) {
    const std::int64_t width = std::int64_t(stated.right) - stated.left + 1;
    const std::int64_t height = std::int64_t(stated.bottom) - stated.top + 1;
    if (width < 1 || height < 1 || width > kMostSize || height > kMostSize ||
        std::abs(std::int64_t(stated.left)) > kMostSize ||
        std::abs(std::int64_t(stated.top)) > kMostSize)
      file.bad("states no valid size");
  };
  check_window(*window);
  if (!shown) shown = window;
  check_window(*shown);
  const std::int64_t width = std::int64_t(window->right) - window->left + 1;
  const std::int64_t height = std::int64_t(window->bottom) - window->top + 1;

  const bool tiled = (flags & kTiled) != 0;
  if (tiled && !tile) file.bad("is damaged: it has tiles but no size of them");
  const std::int64_t chunk_width = tiled ? tile->width : width;
  const std::int64_t chunk_height = tiled ? tile->height : rows_of_chunk(compression);
  if (chunk_width < 1 || chunk_height < 1 || chunk_width > kMostSize || chunk_height > kMostSize)
    file.bad("states no valid size of tiles");
  ExrHeader header;
  header.width = int(width);
  header.height = int(height);
  header.left = window->left;
  header.top = window->top;
  header.shown_left = shown->left;
  header.shown_top = shown->top;
  header.shown_width = shown->right - shown->left + 1;
  header.shown_height = shown->bottom - shown->top + 1;
  header.channels = std::move(channels);
  header.chunk_pixels = double(chunk_width) * double(chunk_height);
  const double chunks = double((width + chunk_width - 1) / chunk_width) *
                        double((height + chunk_height - 1) / chunk_height);
  constexpr double kLeastOfChunk = 16;  // its offset, its row and its size
  if (kLeastOfChunk * chunks > double(file_size) - double(bytes.size() - file.rest()))
    file.bad("is cut short: it states " + size_text(header.width, header.height) + " px and has " +
             std::to_string(file_size) + " bytes");
  return header;
}

}  // namespace gigaray
