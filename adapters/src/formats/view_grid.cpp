// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "formats/view_grid.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

namespace gigaray {
namespace {

/// Share of the middle view's mean encoded value that a view needs.
constexpr double kBrightEnough = 0.7;

std::string two_digits(int number) {
  const std::string text = std::to_string(number);
  return text.size() < 2 ? "0" + text : text;
}

double mean_value(const Image<std::uint16_t>& picture) {
  return std::accumulate(picture.begin(), picture.end(), 0.0) / double(picture.size());
}

double mean_of_seen(const Image<std::uint16_t>& picture, const Mask& seen) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen.data()[i] == 0) continue;
    sum += std::accumulate(picture.data() + 3 * i, picture.data() + 3 * i + 3, 0.0);
    count += 3;
  }
  return count > 0 ? sum / count : 0;
}

bool is_dark(double mean, double middle) { return mean < kBrightEnough * middle; }

void note_dark(LightField& light_field, std::size_t dark, std::size_t of) {
  light_field.notes.push_back(std::to_string(dark) + " of " + std::to_string(of) +
                              " views are left out: they are darker than 70 % of the middle one");
}

}  // namespace

std::vector<View> grid_views(int rows, int columns, const Directions& directions, double row_step) {
  std::vector<View> views;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      View view;
      view.name = "view_" + two_digits(row) + "_" + two_digits(column);
      directions.place(view, column - (columns - 1) / 2.0, row_step * (row - (rows - 1) / 2.0));
      views.push_back(view);
    }
  return views;
}

GridCell cell_of(int number, const GridSize& grid) {
  const int row = number / grid.columns, along = number % grid.columns;
  return {row, grid.snake && row % 2 == 1 ? grid.columns - 1 - along : along};
}

void assume_directions(LightField& light_field, const Directions& directions) {
  if (directions.stated()) return;
  light_field.sign_is_assumed = true;
  light_field.notes.push_back(
      "columns of views are assumed to go right and rows down (OpenOptions::direction states it)");
}

void attach_bright_views(LightField& light_field, std::vector<Image<std::uint16_t>> pictures,
                         int bit_depth) {
  GIGARAY_CHECK(pictures.size() == light_field.views.size() && !pictures.empty());
  const double middle = mean_value(pictures[centre_view(light_field)]);
  if (middle == 0) throw Error(ErrorCode::kBadInput, "the view in the middle is black");
  light_field.width = pictures.front().width();
  light_field.height = pictures.front().height();
  std::vector<View> bright;
  std::vector<Image<std::uint16_t>> kept;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const bool dark = is_dark(mean_value(pictures[i]), middle);
    (dark ? light_field.left_out : bright).push_back(light_field.views[i]);
    if (!dark) kept.push_back(std::move(pictures[i]));
  }
  light_field.views = std::move(bright);
  if (!light_field.left_out.empty())
    note_dark(light_field, light_field.left_out.size(), pictures.size());
  light_field.pixels = pixels_in_memory(std::move(kept), bit_depth);
}

void leave_out_dark_views(LightField& light_field) {
  if (light_field.kind != LightFieldKind::k4D) return;
  const auto mean = [&](int view) {
    Image<std::uint16_t> picture = read_view(light_field, view);
    const auto seen = take_mask(picture);
    return seen ? mean_of_seen(picture, *seen) : mean_value(picture);
  };
  const double middle = mean(centre_view(light_field));
  const std::vector<View>& views = light_field.views;
  bool is_vignetted = false;
  for (const std::pair<int, int>& way : {std::pair(-1, -1), {-1, 1}, {1, -1}, {1, 1}}) {
    const auto corner = std::ranges::max_element(
        views, {}, [&](const View& view) { return way.first * view.s + way.second * view.t; });
    is_vignetted = is_vignetted || is_dark(mean(int(corner - views.begin())), middle);
  }
  if (!is_vignetted) return;
  std::vector<int> dark;
  for (int view = 0; view < light_field.num_views(); ++view)
    if (is_dark(mean(view), middle)) dark.push_back(view);
  const std::size_t all = views.size();
  if (dark.size() + 2 > all) return;
  note_dark(light_field, dark.size(), all);
  light_field = without(std::move(light_field), dark);
}

}  // namespace gigaray
