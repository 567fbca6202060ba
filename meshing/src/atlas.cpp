// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "atlas.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <string>

#include "gigaray/core/error.h"
#include "gigaray/core/parallel.h"

namespace gigaray {
namespace {

using Corners = std::vector<std::array<Eigen::Vector2f, 3>>;

/// Pixels around a chart, so that neighbours of the atlas don't show when it is looked at from
/// farther away.
constexpr int kMargin = 2;
constexpr double kLeastScale = 0.05;

AtlasBox joined(const AtlasBox& a, const AtlasBox& b) {
  return {std::min(a.u0, b.u0), std::min(a.v0, b.v0), std::max(a.u1, b.u1), std::max(a.v1, b.v1)};
}

bool overlap(const AtlasBox& a, const AtlasBox& b) {
  return a.u0 < b.u1 && b.u0 < a.u1 && a.v0 < b.v1 && b.v0 < a.v1;
}

AtlasBox box_of(const std::array<Eigen::Vector2f, 3>& corners, const Camera& camera) {
  const auto [left, right] = std::minmax({corners[0].x(), corners[1].x(), corners[2].x()});
  const auto [top, bottom] = std::minmax({corners[0].y(), corners[1].y(), corners[2].y()});
  return {std::max(0, int(std::floor(left)) - kMargin), std::max(0, int(std::floor(top)) - kMargin),
          std::min(camera.width, int(std::ceil(right)) + kMargin + 1),
          std::min(camera.height, int(std::ceil(bottom)) + kMargin + 1)};
}

/// Boxes with the charts in them.
struct Group {
  AtlasBox box;
  std::vector<std::uint32_t> charts;
};

/// Joins those that overlap, until none do.
void join(std::vector<Group>& groups) {
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    std::ranges::sort(groups, {}, [](const Group& g) { return std::pair(g.box.u0, g.box.v0); });
    std::vector<Group> kept;
    std::size_t first_open = 0;  // those before end left of all that follow
    for (Group& group : groups) {
      while (first_open < kept.size() && kept[first_open].box.u1 <= group.box.u0) ++first_open;
      const auto found =
          std::find_if(kept.begin() + std::ptrdiff_t(first_open), kept.end(),
                       [&](const Group& other) { return overlap(other.box, group.box); });
      if (found == kept.end()) {
        kept.push_back(std::move(group));
        continue;
      }
      found->box = joined(found->box, group.box);
      found->charts.insert(found->charts.end(), group.charts.begin(), group.charts.end());
      has_changed = true;
    }
    groups = std::move(kept);
  }
}

struct Size {
  int width, height;
};

/// Shelves of boxes, the highest first: where each goes, and how high all are together.
int shelve(const std::vector<Size>& sizes, int width, std::vector<AtlasBox>& places) {
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::ranges::stable_sort(order, std::greater(), [&](std::size_t i) { return sizes[i].height; });
  places.assign(sizes.size(), {});
  int left = 0, top = 0, shelf = 0;
  for (const std::size_t i : order) {
    if (left + sizes[i].width > width) {
      top += shelf;
      left = shelf = 0;
    }
    shelf = std::max(shelf, sizes[i].height);
    places[i] = {left, top, left + sizes[i].width, top + sizes[i].height};
    left += sizes[i].width;
  }
  return top + shelf;
}

int scaled(int size, double scale) { return int(std::ceil(size * scale)); }

/// The smallest of some widths that is about as high as it is wide; false: none fits.
bool pack(Atlas& atlas, int most_px) {
  std::vector<Size> sizes;
  double area = 0;
  int widest = 1;
  for (const Crop& crop : atlas.crops)
    sizes.push_back(
        {scaled(crop.from.width(), atlas.scale), scaled(crop.from.height(), atlas.scale)});
  const int num_patches = int(atlas.patches.size());
  const int columns = int(std::ceil(std::sqrt(double(num_patches))));
  if (num_patches > 0)
    sizes.push_back(
        {columns * Atlas::kPatch, (num_patches + columns - 1) / columns * Atlas::kPatch});
  for (const Size& size : sizes) {
    area += double(size.width) * size.height;
    widest = std::max(widest, size.width);
  }
  std::vector<AtlasBox> places;
  for (double width = std::max<double>(widest, std::sqrt(area));; width *= 1.05) {
    atlas.width = std::min(most_px, int(std::ceil(width)));
    if (widest > atlas.width) return false;
    atlas.height = shelve(sizes, atlas.width, places);
    if (atlas.height <= std::min(most_px, int(1.05 * atlas.width))) break;
    if (atlas.width == most_px) return false;
  }
  for (std::size_t i = 0; i < atlas.crops.size(); ++i) atlas.crops[i].to = places[i];
  if (num_patches > 0) atlas.patch_box = places.back();
  return true;
}

/// The mean colour of the corners in steps of `step`, which divides 255.
Rgb8 rounded_colour(const SurfaceMesh& mesh, std::size_t face, int step) {
  Rgb8 result{};
  for (std::size_t k = 0; k < 3; ++k) {
    int sum = 0;
    for (const std::uint32_t corner : mesh.faces[face]) sum += mesh.colours[corner][k];
    result[k] = std::uint8_t((sum / 3 + step / 2) / step * step);
  }
  return result;
}

/// As many shades as fit into a quarter of the largest atlas.
void add_patches(const SurfaceMesh& mesh, const std::vector<int>& view_of_face, int most_px,
                 Atlas& atlas) {
  for (const int step : {17, 51, 85, 255}) {
    std::map<Rgb8, std::uint32_t> index;
    atlas.patches.clear();
    for (std::size_t face = 0; face < view_of_face.size(); ++face) {
      if (view_of_face[face] >= 0) continue;
      const auto [found, is_new] =
          index.emplace(rounded_colour(mesh, face, step), std::uint32_t(atlas.patches.size()));
      if (is_new) atlas.patches.push_back(found->first);
      atlas.place_of_face[face] = found->second;
    }
    const double area = double(atlas.patches.size()) * Atlas::kPatch * Atlas::kPatch;
    if (area <= 0.25 * most_px * most_px) break;
  }
}

void add_crops(const std::vector<Camera>& cameras, const std::vector<int>& view_of_face,
               const std::vector<std::uint32_t>& charts, const Corners& in_picture, Atlas& atlas) {
  std::vector<std::optional<AtlasBox>> boxes(std::size_t(std::ranges::max(charts)) + 1);
  std::vector<int> view_of_chart(boxes.size(), -1);
  for (std::size_t face = 0; face < charts.size(); ++face) {
    const int view = view_of_face[face];
    if (view < 0) continue;
    view_of_chart[charts[face]] = view;
    const AtlasBox box = box_of(in_picture[face], cameras[std::size_t(view)]);
    std::optional<AtlasBox>& all = boxes[charts[face]];
    all = all ? joined(*all, box) : box;
  }
  std::vector<std::vector<Group>> groups(cameras.size());
  for (std::uint32_t chart = 0; chart < boxes.size(); ++chart)
    if (boxes[chart]) groups[std::size_t(view_of_chart[chart])].push_back({*boxes[chart], {chart}});
  std::vector<std::uint32_t> crop_of_chart(boxes.size());
  for (int view = 0; view < int(cameras.size()); ++view) {
    join(groups[std::size_t(view)]);
    for (const Group& group : groups[std::size_t(view)]) {
      for (const std::uint32_t chart : group.charts)
        crop_of_chart[chart] = std::uint32_t(atlas.crops.size());
      atlas.crops.push_back({view, group.box, {}});
    }
  }
  for (std::size_t face = 0; face < charts.size(); ++face)
    if (view_of_face[face] >= 0) atlas.place_of_face[face] = crop_of_chart[charts[face]];
}

/// The mean of the picture over [u, u + 1 / scale) × [v, v + 1 / scale) of its pixels.
Eigen::Array3f mean_of(const DepthView& view, const ValueTable& table, double u, double v,
                       double step) {
  Eigen::Array3f sum = Eigen::Array3f::Zero();
  float weights = 0;
  const double right = std::min(u + step, double(view.picture.width())),
               bottom = std::min(v + step, double(view.picture.height()));
  for (int y = std::min(int(v), view.picture.height() - 1); y < bottom; ++y)
    for (int x = std::min(int(u), view.picture.width() - 1); x < right; ++x) {
      const double w = std::min(x + 1.0, right) - std::max<double>(x, u);
      const double h = std::min(y + 1.0, bottom) - std::max<double>(y, v);
      const float weight = float(std::max(w * h, 1e-6));
      sum += weight * Eigen::Array3f(table[0][view.byte(x, y, 0)], table[1][view.byte(x, y, 1)],
                                     table[2][view.byte(x, y, 2)]);
      weights += weight;
    }
  return weights > 0 ? Eigen::Array3f(sum / weights) : sum;
}

}  // namespace

Atlas plan_atlas(const SurfaceMesh& mesh, const std::vector<Camera>& cameras,
                 const std::vector<int>& view_of_face, const std::vector<std::uint32_t>& charts,
                 const Corners& in_picture, int most_px) {
  Atlas atlas;
  atlas.place_of_face.resize(view_of_face.size());
  add_crops(cameras, view_of_face, charts, in_picture, atlas);
  add_patches(mesh, view_of_face, most_px, atlas);
  while (!pack(atlas, most_px)) {
    atlas.scale *= 0.97;
    if (atlas.scale < kLeastScale)
      throw Error(ErrorCode::kBadInput, std::to_string(atlas.crops.size()) +
                                            " pieces of pictures don't fit into a texture of " +
                                            std::to_string(most_px) + " px; take a larger one");
  }
  return atlas;
}

void draw_crop(const Atlas& atlas, const Crop& crop, const DepthView& view, const ValueTable& table,
               Image<std::uint8_t>& into) {
  const double step = 1 / atlas.scale;
  parallel_for(
      crop.to.height(),
      [&](int row) {
        for (int column = 0; column < crop.to.width(); ++column) {
          const Eigen::Array3f mean =
              mean_of(view, table, crop.from.u0 + column * step, crop.from.v0 + row * step, step);
          for (int k = 0; k < 3; ++k)
            into(crop.to.u0 + column, crop.to.v0 + row, k) = std::uint8_t(mean[k] + 0.5f);
        }
      },
      [](int) {});
}

void draw_patches(const Atlas& atlas, Image<std::uint8_t>& into) {
  const int columns = atlas.patch_box.width() / Atlas::kPatch;
  for (int i = 0; i < int(atlas.patches.size()); ++i)
    for (int y = 0; y < Atlas::kPatch; ++y)
      for (int x = 0; x < Atlas::kPatch; ++x)
        std::ranges::copy(atlas.patches[std::size_t(i)],
                          &into(atlas.patch_box.u0 + i % columns * Atlas::kPatch + x,
                                atlas.patch_box.v0 + i / columns * Atlas::kPatch + y));
}

Corners corners_in(const Atlas& atlas, const std::vector<int>& view_of_face,
                   const Corners& in_picture) {
  Corners corners(in_picture.size());
  const Eigen::Array2d size(atlas.width, atlas.height);
  const int columns = std::max(1, atlas.patch_box.width() / Atlas::kPatch);
  for (std::size_t face = 0; face < corners.size(); ++face) {
    const std::uint32_t place = atlas.place_of_face[face];
    for (std::size_t i = 0; i < 3; ++i) {
      Eigen::Array2d at;
      if (view_of_face[face] >= 0) {
        const Crop& crop = atlas.crops[place];
        at = (in_picture[face][i].array().cast<double>() + 0.5 -
              Eigen::Array2d(crop.from.u0, crop.from.v0)) *
                 atlas.scale +
             Eigen::Array2d(crop.to.u0, crop.to.v0);
      } else {
        at = Eigen::Array2d(atlas.patch_box.u0, atlas.patch_box.v0) +
             (Eigen::Array2d(int(place) % columns, int(place) / columns) + 0.5) * Atlas::kPatch;
      }
      corners[face][i] = (at / size).max(0).min(1).cast<float>().matrix();
    }
  }
  return corners;
}

}  // namespace gigaray
