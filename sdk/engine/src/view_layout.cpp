// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/engine/view_layout.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>

#include "gigaray/core/arguments.h"
#include "gigaray/engine/scene_estimates.h"

namespace gigaray {
namespace {

constexpr std::size_t kViewsTried = 9;

/// Pictures of a light field brought below 320 px, kept once read.
class SmallPictures : public PixelSource {
 public:
  explicit SmallPictures(LightField light_field) : light_field_(std::move(light_field)) {
    for (int width = light_field_.width, height = light_field_.height;
         width > kSmallWidth && std::min(width, height) > kLeastHeight; width /= 2, height /= 2)
      factor_ *= 2;
  }
  Image<std::uint16_t> read(int view) const override {
    {
      const std::lock_guard lock(mutex_);
      const auto found = known_.find(view);
      if (found != known_.end()) return found->second;
    }
    Image<std::uint16_t> small = reduced(read_view(light_field_, view));
    const std::lock_guard lock(mutex_);
    return known_.emplace(view, std::move(small)).first->second;
  }
  bool is_held() const override { return true; }
  bool has_mask() const override { return light_field_.pixels->has_mask(); }
  int bit_depth() const override { return light_field_.pixels->bit_depth(); }
  int width() const { return light_field_.width / factor_; }
  int height() const { return light_field_.height / factor_; }

 private:
  static constexpr int kSmallWidth = 320, kLeastHeight = 64;

  Image<std::uint16_t> reduced(const Image<std::uint16_t>& picture) const {
    Image<std::uint16_t> small(width(), height(), picture.channels());
    for (int v = 0; v < small.height(); ++v)
      for (int u = 0; u < small.width(); ++u)
        for (int c = 0; c < small.channels(); ++c) {
          long sum = 0;
          for (int y = 0; y < factor_; ++y)
            for (int x = 0; x < factor_; ++x) sum += picture(u * factor_ + x, v * factor_ + y, c);
          small(u, v, c) = std::uint16_t(sum / (long(factor_) * factor_));
        }
    return small;
  }

  LightField light_field_;
  int factor_ = 1;
  mutable std::mutex mutex_;
  mutable std::map<int, Image<std::uint16_t>> known_;
};

struct Place {
  int view;
  double s, t;
};

/// A light field of these views at these places.
LightField placed(const LightField& light_field, const std::vector<Place>& places) {
  LightField some = light_field;
  some.views.clear();
  std::vector<int> which;
  for (const Place& place : places) {
    some.views.push_back({light_field.views[std::size_t(place.view)].name, place.s, place.t});
    which.push_back(place.view);
  }
  some.kind = kind_from_positions(some.views);
  some.pixels = pictures_of(light_field, which);
  return some;
}

class Trials {
 public:
  Trials(const LightField& light_field, const std::vector<int>& cells, const RunControl& control)
      : light_field_(light_field), cells_(cells), control_(control) {
    check(light_field);
    require_argument(std::ranges::all_of(cells, [](int cell) { return cell >= 0; }),
                     "cells: must be 0 or more");
    require_argument(cells.size() == light_field.views.size(),
                     "cells: one for each view is needed");
    const auto pictures = std::make_shared<SmallPictures>(light_field);
    light_field_.width = pictures->width();
    light_field_.height = pictures->height();
    light_field_.pixels = pictures;
    light_field_.left_out.clear();
  }

  LayoutTrial run(const ViewLayout& layout) const {
    return {layout, in_grid(layout), on_line(layout)};
  }

 private:
  /// The views nearest to the middle of the grid, under the best of its axes.
  double in_grid(const ViewLayout& layout) const {
    std::vector<Place> places;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const int row = cells_[i] / layout.columns, along = cells_[i] % layout.columns;
      const bool goes_back = layout.alternating && row % 2 == 1;
      const int column = goes_back ? layout.columns - 1 - along : along;
      places.push_back(
          {int(i), double(column - layout.columns / 2), double(row - layout.rows / 2)});
    }
    keep_nearest(places, [](const Place& place) { return std::hypot(place.s, place.t); });
    double best = 0;
    for (const bool swapped : {false, true})
      for (const int sign : {1, -1}) {
        std::vector<Place> turned = places;
        for (Place& place : turned) {
          place.t *= sign;
          if (swapped) std::swap(place.s, place.t);
        }
        best = std::max(best, measure_agreement(placed(light_field_, turned), control_));
      }
    return best;
  }

  /// The views nearest to the end of a run in the middle.
  double on_line(const ViewLayout& layout) const {
    const double end = (layout.rows / 2) * layout.columns - 0.5;
    std::vector<Place> places;
    for (std::size_t i = 0; i < cells_.size(); ++i) places.push_back({int(i), cells_[i] - end, 0});
    keep_nearest(places, [](const Place& place) { return std::abs(place.s); });
    return measure_agreement(placed(light_field_, places), control_);
  }

  template <class Distance>
  static void keep_nearest(std::vector<Place>& places, Distance distance) {
    std::ranges::stable_sort(places, {}, distance);
    places.resize(std::min(places.size(), kViewsTried));
  }

  LightField light_field_;
  std::vector<int> cells_;
  const RunControl& control_;
};

}  // namespace

std::vector<LayoutTrial> try_layouts(const LightField& light_field, const std::vector<int>& cells,
                                     int num_cells, const RunControl& control) {
  require_argument(num_cells >= 1, "num_cells: must be 1 or more");
  constexpr int kFewCells = 16;
  const Trials trials(light_field, cells, control);
  const int least = num_cells <= kFewCells ? 2 : 3;
  std::vector<ViewLayout> layouts;
  for (int columns = least; columns <= num_cells / least; ++columns)
    if (num_cells % columns == 0)
      for (const bool alternating : {false, true})
        layouts.push_back({num_cells / columns, columns, alternating});
  std::vector<LayoutTrial> tried;
  for (const ViewLayout& layout : layouts) {
    control.progress("layout", double(tried.size()), double(layouts.size()));
    control.throw_if_cancelled();
    tried.push_back(trials.run(layout));
  }
  std::ranges::stable_sort(tried, std::ranges::greater(), &LayoutTrial::agreement);
  return tried;
}

LayoutTrial try_layout(const LightField& light_field, const std::vector<int>& cells,
                       const ViewLayout& layout, const RunControl& control) {
  require_argument(layout.rows >= 1 && layout.columns >= 1, "layout: must have a row and a column");
  return Trials(light_field, cells, control).run(layout);
}

}  // namespace gigaray
