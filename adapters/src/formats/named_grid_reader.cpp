// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// A folder of pictures with two changing numbers in their names, the row and the column of the
// view: 03_05, view_r03_c05, lf_3_5, img_x3_y5, SAI_03_05.
#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "formats/camera_position.h"
#include "formats/numbered_names.h"
#include "formats/readers.h"
#include "formats/times_in_names.h"
#include "formats/view_grid.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

/// Which number of the name is which.
struct Places {
  std::size_t row = 0;
  std::size_t column = 0;
  bool named = false;  ///< the letters in front of them say so
};

/// Words for row and column, in pairs: one of a pair alone means nothing.
std::optional<Places> named_places(const std::vector<std::string>& labels) {
  static constexpr std::array<std::pair<const char*, const char*>, 6> kPairs{
      {{"r", "c"}, {"row", "col"}, {"row", "column"}, {"y", "x"}, {"t", "s"}, {"v", "u"}}};
  for (const auto& [row, column] : kPairs) {
    const auto r = std::find(labels.begin(), labels.end(), row);
    const auto c = std::find(labels.begin(), labels.end(), column);
    if (r != labels.end() && c != labels.end())
      return Places{std::size_t(r - labels.begin()), std::size_t(c - labels.begin()), true};
  }
  return std::nullopt;
}

std::size_t count_distinct(const NameGroup& group, std::size_t which) {
  std::set<std::uint64_t> values;
  for (const NumberedPicture& picture : group.pictures) values.insert(picture.numbers[which]);
  return values.size();
}

/// Nothing when the names don't form a grid: one number changes (a series), or every picture has
/// another value of one of them (a date and a time).
std::optional<Places> places_of(const NameGroup& group) {
  if (group.pictures.size() < 2) return std::nullopt;
  if (const auto named = named_places(group.pictures.front().labels)) {
    const std::set<std::size_t> both{named->row, named->column};
    if (!group.changing.empty() &&
        std::includes(both.begin(), both.end(), group.changing.begin(), group.changing.end()))
      return named;
  }
  if (group.changing.size() != 2) return std::nullopt;
  const std::set<std::size_t> times = time_columns(group);
  if (std::ranges::any_of(group.changing, [&](std::size_t i) { return times.contains(i); }))
    return std::nullopt;
  const Places places{*group.changing.begin(), *group.changing.rbegin(), false};
  const std::size_t views = group.pictures.size();
  if (count_distinct(group, places.row) == views || count_distinct(group, places.column) == views)
    return std::nullopt;
  return places;
}

/// Numbers of one axis: the lowest, the highest, and the common divisor of their distances.
struct Axis {
  std::uint64_t low = 0, high = 0, step = 0;
  double centred(std::uint64_t number, double unit) const {
    return (double(number - low) - double(high - low) / 2) / unit;
  }
};

Axis axis_of(const NameGroup& group, std::size_t which) {
  Axis axis{group.pictures.front().numbers[which], group.pictures.front().numbers[which], 0};
  for (const NumberedPicture& picture : group.pictures) {
    axis.low = std::min(axis.low, picture.numbers[which]);
    axis.high = std::max(axis.high, picture.numbers[which]);
  }
  for (const NumberedPicture& picture : group.pictures)
    axis.step = std::gcd(axis.step, picture.numbers[which] - axis.low);
  return axis;
}

class NamedGridReader : public Reader {
 public:
  std::string name() const override { return "grid of named views"; }

  ProbeResult probe(const fs::path& input) const override {
    return {places_of(largest_group(pictures_of(input))) ? 20 : 0, ""};
  }

  LightField open(const fs::path& input, const OpenOptions& options) const override {
    const auto bad = [&](const std::string& what) {
      return Error(ErrorCode::kBadInput, input.string() + ": " + what);
    };
    const std::vector<fs::path> pictures = pictures_of(input);
    const NameGroup group = largest_group(pictures);
    const Places places = places_of(group).value();
    if (!group.rival.empty())
      throw bad("holds more than one set of views, " + group.first_name() + " … and " +
                group.rival + " …; keep one per folder");
    const Directions directions = Directions::of_grid(options, Travel::kRight, Travel::kDown);
    const Axis rows = axis_of(group, places.row), columns = axis_of(group, places.column);
    const std::uint64_t unit = std::gcd(rows.step, columns.step);

    LightField light_field;
    std::vector<fs::path> files;
    std::map<std::pair<std::uint64_t, std::uint64_t>, std::string> taken;
    for (const NumberedPicture& picture : group.pictures) {
      const std::uint64_t row = picture.numbers[places.row];
      const std::uint64_t column = picture.numbers[places.column];
      const auto [other, is_new] =
          taken.emplace(std::pair(row, column), picture.path.filename().string());
      if (!is_new)
        throw bad(other->second + " and " + picture.path.filename().string() +
                  " have the same row and column");
      View view;
      view.name = picture.path.stem().string();
      directions.place(view, columns.centred(column, double(unit)),
                       rows.centred(row, double(unit)));
      light_field.views.push_back(view);
      files.push_back(picture.path);
    }
    const double cells =
        double((rows.high - rows.low) / unit + 1) * double((columns.high - columns.low) / unit + 1);
    if (double(files.size()) < cells)
      light_field.notes.push_back(std::to_string(files.size()) + " of " +
                                  std::to_string(std::uint64_t(cells)) +
                                  " views of the grid are there");
    if (group.pictures.size() < pictures.size())
      light_field.notes.push_back(std::to_string(pictures.size() - group.pictures.size()) +
                                  " other pictures in the folder are left out");
    if (!directions.stated()) {
      light_field.sign_is_assumed = true;
      light_field.notes.push_back(
          std::string(places.named ? "" : "the first number of the names is taken as the row; ") +
          "columns are assumed to go right and rows down (OpenOptions::direction states it)");
    }
    light_field.kind = kind_from_positions(light_field.views);
    attach_pictures(light_field, std::move(files), options);
    leave_out_dark_views(light_field);
    return light_field;
  }
};

}  // namespace

std::unique_ptr<const Reader> named_grid_reader() { return std::make_unique<NamedGridReader>(); }

}  // namespace gigaray
