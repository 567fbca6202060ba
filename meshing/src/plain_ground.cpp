// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "plain_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace gigaray {
namespace {

struct Pixel {
  int u, v;
};

/// Levels of 255 in each channel: noise and what JPEG leaves of a plain colour.
constexpr int kLevels = 6;
/// Of the border, so that an object may reach out of the picture.
constexpr double kLeastShare = 0.5;

bool is_ground(const DepthView& view, int u, int v, const Rgb8& colour) {
  for (int c = 0; c < 3; ++c)
    if (std::abs(int(view.byte(u, v, c)) - int(colour[c])) > kLevels) return false;
  return true;
}

/// White or black: pictures tell nothing of what is there.
bool is_clipped(const Rgb8& colour) {
  const auto [least, most] = std::ranges::minmax(colour);
  return least >= 255 - kLevels || most <= kLevels;
}

std::vector<Pixel> border_of(const Image<std::uint16_t>& picture) {
  const int right = picture.width() - 1, bottom = picture.height() - 1;
  std::vector<Pixel> border;
  for (int u = 0; u <= right; ++u) border.insert(border.end(), {{u, 0}, {u, bottom}});
  for (int v = 1; v < bottom; ++v) border.insert(border.end(), {{0, v}, {right, v}});
  return border;
}

Rgb8 median_of(const DepthView& view, const std::vector<Pixel>& pixels) {
  Rgb8 median;
  for (int c = 0; c < 3; ++c) {
    std::vector<std::uint8_t> levels;
    for (const Pixel p : pixels) levels.push_back(view.byte(p.u, p.v, c));
    const auto middle = levels.begin() + std::ptrdiff_t(levels.size() / 2);
    std::nth_element(levels.begin(), middle, levels.end());
    median[std::size_t(c)] = *middle;
  }
  return median;
}

/// Pixels of the colour lose their depth.
void clear_ground(DepthView& view, const Rgb8& colour) {
  FloatMap& map = view.inverse_depth;
  Mask left(map.width(), map.height());  // of the colour, and not reached from the border
  for (int v = 0; v < map.height(); ++v)
    for (int u = 0; u < map.width(); ++u) left(u, v) = is_ground(view, u, v, colour);
  std::vector<Pixel> reached;
  const auto reach = [&](int u, int v) {
    if (u < 0 || v < 0 || u >= map.width() || v >= map.height() || !left(u, v)) return;
    left(u, v) = 0;
    if (!std::isnan(map(u, v))) map(u, v) = 0;  // what is masked says nothing
    reached.push_back({u, v});
  };
  for (const Pixel p : border_of(view.picture)) reach(p.u, p.v);
  while (!reached.empty()) {
    const Pixel p = reached.back();
    reached.pop_back();
    for (const auto& [du, dv] : {std::array{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
      reach(p.u + du, p.v + dv);
  }
  std::ranges::transform(map, left, map.begin(),
                         [](float w, std::uint8_t is_left) { return is_left ? kNoEstimate : w; });
}

}  // namespace

std::optional<Rgb8> plain_ground(const DepthViews& views, const RunControl& control) {
  if (views.size() < 2) return {};
  Rgb8 colour{};
  for (int view = 0; view < views.size(); ++view) {
    control.throw_if_cancelled();
    const DepthView own = views.read(view);
    std::vector<Pixel> border = border_of(own.picture);
    // Masked: beside what a lens without its distortion shows, for one.
    std::erase_if(border, [&](Pixel p) { return std::isnan(own.inverse_depth(p.u, p.v)); });
    if (border.empty()) return {};
    if (view == 0) colour = median_of(own, border);
    if (!is_clipped(colour)) return {};
    const auto plain =
        std::ranges::count_if(border, [&](Pixel p) { return is_ground(own, p.u, p.v, colour); });
    if (double(plain) < kLeastShare * double(border.size())) return {};
  }
  return colour;
}

DepthViews without_ground(const DepthViews& views, Rgb8 colour) {
  DepthViews result = views;
  result.read = [read = views.read, colour](int view) {
    DepthView found = read(view);
    clear_ground(found, colour);
    return found;
  };
  return result;
}

DepthViews without_plain_ground(const DepthViews& views, bool is_kept, const RunControl& control) {
  const std::optional<Rgb8> colour = is_kept ? std::nullopt : plain_ground(views, control);
  return colour ? without_ground(views, *colour) : views;
}

}  // namespace gigaray
