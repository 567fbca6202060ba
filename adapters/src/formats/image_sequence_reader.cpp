// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// A folder of numbered pictures, taken along a line at equal steps or at stated positions.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

#include "files/text.h"
#include "formats/camera_position.h"
#include "formats/file_type.h"
#include "formats/numbered_names.h"
#include "formats/positions_file.h"
#include "formats/readers.h"
#include "formats/times_in_names.h"
#include "formats/view_grid.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/photographs.h"
#include "pictures/picture_faults.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void bad(const fs::path& input, const std::string& what) {
  throw Error(ErrorCode::kBadInput, input.string() + ": " + what);
}

struct Series {
  std::vector<fs::path> files;
  std::vector<std::uint64_t> numbers;  // rising
  std::vector<std::string> notes;
};

// The largest group of pictures whose names differ in numbers only, and the one number that
// changes.
Series series_of(const fs::path& input, const std::vector<fs::path>& pictures) {
  const NameGroup group = largest_group(pictures);
  if (group.pictures.empty())
    bad(input,
        "the pictures have no numbers in their names; state their places with "
        "OpenOptions::positions");
  if (!group.rival.empty())
    bad(input, "holds more than one series of pictures, " + group.first_name() + " … and " +
                   group.rival + " …; keep one per folder");
  const std::set<std::size_t> times = time_columns(group);
  const bool is_ordered = group.changing.size() > 1 || std::ranges::includes(times, group.changing);
  const std::optional<NamesInOrder> order =
      is_ordered && !group.changing.empty() ? names_in_order(group) : std::nullopt;
  if (group.changing.size() > 1 && !order)
    bad(input,
        "more than one number changes in the names (" + group.first_name() + " … " +
            group.pictures.back().path.filename().string() +
            ") and they form no grid; state the places of the views with OpenOptions::positions");
  const std::size_t which = group.changing.empty() ? 0 : *group.changing.begin();

  Series series;
  for (std::size_t i = 0; order && i < group.pictures.size(); ++i) {
    series.files.push_back(group.pictures[i].path);
    series.numbers.push_back(order->numbers[i]);
  }
  if (order && order->are_times)
    series.notes.push_back(
        "the names hold times: the pictures are taken in their order, at equal steps "
        "(OpenOptions::positions "
        "states others)");
  for (const NumberedPicture& picture : group.pictures) {
    if (order) break;
    if (!series.numbers.empty() && series.numbers.back() == picture.numbers[which])
      bad(input, series.files.back().filename().string() + " and " +
                     picture.path.filename().string() + " have the same number");
    series.files.push_back(picture.path);
    series.numbers.push_back(picture.numbers[which]);
  }
  if (group.pictures.size() < pictures.size())
    series.notes.push_back(std::to_string(pictures.size() - group.pictures.size()) +
                           " other pictures in the folder are left out");
  return series;
}

// Steps from the first view. Numbers with gaps, like those left when bad pictures are deleted,
// place the views; numbers without a common step, like times, don't.
std::vector<double> steps_from_numbers(const std::vector<std::uint64_t>& numbers,
                                       std::vector<std::string>& notes) {
  std::vector<std::uint64_t> gaps;
  for (std::size_t i = 1; i < numbers.size(); ++i) gaps.push_back(numbers[i] - numbers[i - 1]);
  std::vector<std::uint64_t> sorted = gaps;
  std::sort(sorted.begin(), sorted.end());
  const std::uint64_t step = sorted.front(), median = sorted[sorted.size() / 2];
  const bool multiples =
      std::all_of(gaps.begin(), gaps.end(), [&](std::uint64_t gap) { return gap % step == 0; });
  const bool by_number = median == step && multiples;

  std::vector<double> steps{0};
  for (const std::uint64_t gap : gaps)
    steps.push_back(steps.back() + (by_number ? double(gap / step) : 1));
  if (!by_number)
    notes.push_back(
        "the numbers of the pictures are irregular: equal steps are assumed, state the "
        "places with OpenOptions::positions if they are not");
  else if (sorted.back() != step)
    notes.push_back("numbers are missing in the sequence: the views are placed by their numbers");
  return steps;
}

/// Where the pictures are instead, when the folder itself holds none.
std::string pictures_inside(const fs::path& input) {
  constexpr std::size_t kMostNamed = 3;
  std::error_code error;
  std::vector<fs::path> inside;
  for (auto entry = fs::directory_iterator(input, error);
       !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code ignored;
    if (entry->is_directory(ignored) && !pictures_of(entry->path()).empty())
      inside.push_back(entry->path());
  }
  if (inside.empty()) return " (folders inside it are not searched)";
  std::ranges::sort(inside);
  std::string text = inside.size() == 1 ? "; one inside it holds pictures, name that: "
                                        : "; folders inside it hold pictures, name one: ";
  for (std::size_t i = 0; i < std::min(inside.size(), kMostNamed); ++i)
    text += (i > 0 ? ", " : "") + inside[i].string();
  return text + (inside.size() > kMostNamed ? " …" : "");
}

class ImageSequenceReader : public Reader {
 public:
  std::string name() const override { return "image sequence"; }

  ProbeResult probe(const fs::path& input) const override {
    std::error_code ignored;
    if (!fs::is_directory(input, ignored)) {
      const std::string why = why_unread(input);
      if (!why.empty()) return {0, why};
      return {0, is_picture(input)
                     ? "is one picture; name the folder of the light field, or "
                       "state the views of a lenslet picture with OpenOptions::lenslet"
                     : "is no light field that this program knows"};
    }
    if (pictures_of(input).empty()) {
      const std::string why = why_no_pictures(input);
      return {0,
              "no pictures in this folder" + (why.empty() ? pictures_inside(input) : ": " + why)};
    }
    return {10, ""};
  }

  LightField open(const fs::path& input, const OpenOptions& options) const override {
    const std::vector<fs::path> pictures = pictures_of(input);
    if (pictures.size() < 2) {
      const std::string why = why_no_pictures(input);
      bad(input, "only one picture, " + pictures.front().filename().string() +
                     "; a light field needs two or more" + (why.empty() ? "" : "; " + why));
    }
    if (options.grid.rows > 0) return open_grid(input, pictures, options);
    return options.positions.empty() ? open_numbered(input, pictures, options)
                                     : open_placed(pictures, options);
  }

 private:
  static LightField open_numbered(const fs::path& input, const std::vector<fs::path>& pictures,
                                  const OpenOptions& options) {
    const Directions directions = Directions::of_series(options, Travel::kRight);
    Series series = series_of(input, pictures);
    if (series.files.size() < 2) bad(input, "only one numbered picture; a light field needs two");
    const std::vector<double> steps = steps_from_numbers(series.numbers, series.notes);

    LightField light_field;
    light_field.notes = std::move(series.notes);
    const double middle = steps.back() / 2;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      View view;
      view.name = series.files[i].stem().string();
      directions.place(view, steps[i] - middle, 0);
      light_field.views.push_back(view);
    }
    light_field.kind = kind_from_positions(light_field.views);
    if (!directions.stated()) {
      light_field.sign_is_assumed = true;
      light_field.notes.push_back(
          "the camera is assumed to move to the right as the "
          "numbers rise (OpenOptions::direction states it)");
    }
    attach_pictures(light_field, std::move(series.files), options);
    return light_field;
  }

  /// Row by row as the number rises.
  static LightField open_grid(const fs::path& input, const std::vector<fs::path>& pictures,
                              const OpenOptions& options) {
    const auto refuse = [](const std::string& what) {
      throw Error(ErrorCode::kInvalidArgument, "OpenOptions::grid: " + what);
    };
    if (!options.positions.empty())
      refuse("OpenOptions::positions states where the pictures stand");
    const int rows = options.grid.rows, columns = options.grid.columns;
    const Directions directions = Directions::of_grid(options, Travel::kRight, Travel::kDown);
    Series series = series_of(input, pictures);
    if (series.files.size() < 2) bad(input, "only one numbered picture; a light field needs two");
    const std::vector<double> steps = steps_from_numbers(series.numbers, series.notes);
    const double cells = steps.back() + 1;
    if (cells > double(rows) * columns || cells <= double(rows - 1) * columns)
      refuse("the " + std::to_string(series.files.size()) + " pictures of " + input.string() +
             " are no grid of " + std::to_string(rows) + " rows and " + std::to_string(columns) +
             " columns");

    LightField light_field;
    light_field.notes = std::move(series.notes);
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const GridCell cell = cell_of(int(std::lround(steps[i])), options.grid);
      View view;
      view.name = series.files[i].stem().string();
      directions.place(view, cell.column - (columns - 1) / 2.0, cell.row - (rows - 1) / 2.0);
      light_field.views.push_back(view);
    }
    light_field.kind = kind_from_positions(light_field.views);
    assume_directions(light_field, directions);
    attach_pictures(light_field, std::move(series.files), options);
    leave_out_dark_views(light_field);
    return light_field;
  }

  static LightField open_placed(const std::vector<fs::path>& pictures, const OpenOptions& options) {
    refuse_direction(options, "OpenOptions::positions states");
    std::vector<fs::path> files;
    for (const NumberedPicture& picture : numbered_pictures(pictures))
      files.push_back(picture.path);
    const std::vector<CameraPosition> positions = read_positions(options.positions, files);
    LightField light_field;
    for (std::size_t i = 0; i < files.size(); ++i) {
      View view;
      view.name = files[i].stem().string();
      place_camera(view, positions[i].right, positions[i].down);
      light_field.views.push_back(view);
    }
    try {
      light_field.rig.baseline = normalise_positions(light_field.views);
    } catch (const Error& problem) {
      throw Error(problem.code(), options.positions.string() + ": " + problem.what());
    }
    light_field.kind = kind_from_positions(light_field.views);
    attach_pictures(light_field, std::move(files), options);
    return light_field;
  }
};

}  // namespace

std::string why_no_series(const fs::path& folder, double memory_bytes) {
  const std::vector<fs::path> pictures = pictures_of(folder);
  const double limit = opening_limit(memory_bytes);
  std::optional<PictureSpec> first;
  for (const fs::path& picture : pictures) {
    PictureSpec spec;
    if (!fault_of_picture(picture, Orientation::kApplied, limit, &spec).empty()) continue;
    if (!first) first = spec;
    if (spec.width != first->width && spec.width == first->height && spec.height == first->width)
      return folder.string() + ": some pictures are upright, some on their side";
  }
  try {
    series_of(folder, pictures);
  } catch (const Error& problem) {
    return problem.what();
  }
  return {};
}

std::string why_twice(const fs::path& folder) {
  const std::vector<fs::path> pictures = pictures_of(folder);
  std::map<std::string, std::vector<std::string>> copies;
  for (const fs::path& path : pictures)
    copies[lower(path.stem().string())].push_back(path.filename().string());
  std::size_t num_copies = 0;
  const std::vector<std::string>* first = nullptr;
  for (const auto& [stem, names] : copies) {
    if (names.size() < 2) continue;
    num_copies += names.size();
    if (!first) first = &names;
  }
  if (first && 2 * num_copies > pictures.size())
    return folder.string() + ": holds pictures twice, such as " + first->at(0) + " and " +
           first->at(1) + "; keep one of each";

  constexpr std::size_t kLeastOfSeries = 3;
  std::vector<fs::path> rest = pictures;
  NameGroup series[2];
  for (NameGroup& one : series) {
    one = largest_group(rest);
    if (one.pictures.size() < kLeastOfSeries || one.changing.size() != 1) return {};
    std::erase_if(rest, [&](const fs::path& path) {
      return std::ranges::any_of(one.pictures,
                                 [&](const auto& picture) { return picture.path == path; });
    });
  }
  if (2 * series[1].pictures.size() <= series[0].pictures.size()) return {};
  return folder.string() + ": holds more than one series of pictures, " + series[0].first_name() +
         " … and " + series[1].first_name() +
         " …; keep one per folder (`find_cameras` takes them as photographs of "
         "one place)";
}

std::unique_ptr<const Reader> image_sequence_reader() {
  return std::make_unique<ImageSequenceReader>();
}

}  // namespace gigaray
