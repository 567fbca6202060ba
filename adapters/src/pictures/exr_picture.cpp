// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "pictures/exr_picture.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "files/text.h"
#include "gigaray/adapters/input_file.h"
#include "pictures/map_headers.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostHeader = 4 << 20;

[[noreturn]] void bad(const fs::path& path, const std::string& what) {
  throw Error(ErrorCode::kBadInput, path.string() + ": " + what);
}

struct Channels {
  std::vector<std::string> colours;
  std::string alpha;  ///< empty: none
};

/// Of "layer.part.R" what stands before "R".
std::string layer_of(const std::string& name) {
  const auto dot = name.rfind('.');
  return dot == std::string::npos ? "" : name.substr(0, dot + 1);
}

Channels channels_of(const ExrHeader& header, const fs::path& path) {
  std::vector<std::string> names, layers{""};
  std::string all;
  for (const ExrChannel& channel : header.channels) {
    constexpr std::size_t kMostNamed = 8;
    if (names.size() < kMostNamed) all += (all.empty() ? "" : ", ") + channel.name;
    if (!channel.is_full) continue;
    names.push_back(channel.name);
    if (std::ranges::find(layers, layer_of(channel.name)) == layers.end())
      layers.push_back(layer_of(channel.name));
  }
  const auto has = [&](const std::string& name) {
    return std::ranges::find(names, name) != names.end();
  };
  // Of many passes of a renderer the finished picture.
  std::stable_partition(layers.begin(), layers.end(), [](const std::string& layer) {
    const std::string name = lower(layer);
    return name.empty() || name.ends_with("combined.") || name.ends_with("beauty.") ||
           name.ends_with("rgba.");
  });
  for (const std::string& layer : layers)
    for (const auto& [red, green, blue, alpha] :
         {std::array{"R", "G", "B", "A"}, std::array{"r", "g", "b", "a"},
          std::array{"red", "green", "blue", "alpha"}})
      if (has(layer + red) && has(layer + green) && has(layer + blue))
        return {{layer + red, layer + green, layer + blue},
                has(layer + alpha) ? layer + alpha : ""};
  static constexpr const char* kGrey[] = {"Y", "y", "L", "R", "r", "grey", "gray", "luminance"};
  for (const std::string& layer : layers)
    for (const char* grey : kGrey)
      // X, Y and Z are a direction.
      if (has(layer + grey) && !has(layer + "X"))
        return {{layer + grey}, has(layer + "A") ? layer + "A" : ""};
  bad(path,
      "has no colours, its channels are " + in_quotes(all) + "; a view needs R, G and B, or Y");
}

ExrHeader header_of(const InputFile& file) {
  return parse_exr_header(file.read(0, kMostHeader), file.size(), file.path().string());
}

/// Channels of the window that is shown.
Image<float> read_shown(const fs::path& path, double limit, bool is_alpha) {
  const InputFile file(path);
  const ExrHeader header = header_of(file);
  const Channels channels = channels_of(header, path);
  const std::vector<std::string> wanted =
      is_alpha ? std::vector<std::string>{channels.alpha} : channels.colours;
  hold_against_limit(path.string(), "has " + std::to_string(file.size()) + " bytes",
                     double(file.size()), limit);
  const Image<float> data =
      parse_exr_channels(file.read(0, file.size()), header, wanted, path.string(), limit);
  const int left = header.shown_left - header.left, top = header.shown_top - header.top;
  if (left == 0 && top == 0 && header.shown_width == header.width &&
      header.shown_height == header.height)
    return data;
  Image<float> shown(header.shown_width, header.shown_height, data.channels());
  for (int v = std::max(0, -top); v < std::min(shown.height(), data.height() - top); ++v)
    for (int u = std::max(0, -left); u < std::min(shown.width(), data.width() - left); ++u)
      for (int c = 0; c < data.channels(); ++c) shown(u, v, c) = data(u + left, v + top, c);
  return shown;
}

}  // namespace

PictureSpec exr_spec(const fs::path& path, double limit) {
  const InputFile file(path);
  const ExrHeader header = header_of(file);
  const Channels channels = channels_of(header, path);
  // Both windows as floats, all bytes of the file, a chunk as it is packed and unpacked; 16 bit.
  const double shown = double(header.shown_width) * header.shown_height;
  const double data = double(header.width) * header.height;
  hold_against_limit(path.string(),
                     "states " + size_text(header.shown_width, header.shown_height) + " px",
                     12 * (shown + data) + 6 * shown + double(file.size()) +
                         16 * header.chunk_pixels * double(header.channels.size()),
                     limit);
  PictureSpec spec;
  spec.width = header.shown_width;
  spec.height = header.shown_height;
  spec.bit_depth = 16;
  spec.samples = Samples::kLight;
  spec.is_grey = channels.colours.size() == 1;
  spec.has_alpha = !channels.alpha.empty();
  return spec;
}

Image<float> read_exr_colours(const fs::path& path, double limit) {
  return read_shown(path, limit, false);
}

Image<float> read_exr_alpha(const fs::path& path, double limit) {
  return read_shown(path, limit, true);
}

}  // namespace gigaray
