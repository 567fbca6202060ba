// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <cmath>
#include <tuple>

#include "gigaray/core/arguments.h"
#include "gigaray/core/parallel.h"
#include "tuple_ray.h"

namespace gigaray {
namespace {

/// A view and what the tuples draw of it.
struct DrawnView {
  Image<std::uint16_t> picture;  ///< three channels
  DrawnRows drawn;               ///< all rows
};

class TupleChoice {
 public:
  TupleChoice(const LightField& light_field, const SparseShape& shape,
              const DisparityOfView& disparity, const SparseOptions& options,
              const RunControl& control)
      : light_field_(light_field),
        shape_(shape),
        disparity_(disparity),
        options_(options),
        control_(control),
        tuples_(shape.num_bands()) {}

  SparseTuples run() {
    const std::vector<int> order = views_from_centre(light_field_);
    const double total = double(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      control_.progress("choose tuples", double(i), total);
      add_unexplained(order[i]);
    }
    for (TupleBand& band : tuples_)
      std::sort(band.tuples.begin(), band.tuples.end(),
                [](const SparseTuple& a, const SparseTuple& b) {
                  return std::tie(a.slope, a.view, a.v, a.u) < std::tie(b.slope, b.view, b.v, b.u);
                });
    for (int round = 0; round < options_.colour_rounds; ++round) {
      begin_colours();
      for (std::size_t i = 0; i < order.size(); ++i) {
        control_.progress("fit colours", double(round * order.size() + i),
                          total * options_.colour_rounds);
        collect_colours(order[i]);
      }
      end_colours();
    }
    return std::move(tuples_);
  }

 private:
  DrawnView draw(int view) const {
    DrawnView result{read_view(light_field_, view), {}};
    take_mask(result.picture);
    DrawnRows& all = result.drawn;
    all = {{0, shape_.height},
           Image<std::int32_t>(shape_.width, shape_.height),
           Image<std::uint16_t>(shape_.width, shape_.height, 3)};
    for_each_band([&](int band) {
      const RowRange rows = shape_.band(band);
      const DrawnRows part = draw_tuples(shape_, tuples_, view, rows);
      std::copy(part.slope.begin(), part.slope.end(), all.slope.row(rows.begin));
      std::copy(part.colour.begin(), part.colour.end(), all.colour.row(rows.begin));
    });
    return result;
  }

  template <class Job>
  void for_each_band(Job job) const {
    parallel_for(shape_.num_bands(), job, [&](int) { control_.throw_if_cancelled(); });
  }

  bool is_alike(const std::uint16_t* a, const std::uint16_t* b) const {
    double sum = 0;
    for (int c = 0; c < 3; ++c) sum += double(a[c] - b[c]) * double(a[c] - b[c]);
    const double scale = double((1 << shape_.bit_depth) - 1) * options_.tolerance;
    return sum <= scale * scale;
  }

  void add_unexplained(int view) {
    const DrawnView seen = draw(view);
    const FloatMap disparity = disparity_(view);
    require_argument(disparity.width() == shape_.width && disparity.height() == shape_.height,
                     "disparity: must be as large as the pictures");
    for_each_band([&](int index) {
      TupleBand& band = tuples_[index];
      for (int v = shape_.band(index).begin; v < shape_.band(index).end; ++v)
        for (int u = 0; u < shape_.width; ++u) {
          const float d = disparity(u, v);
          if (!std::isfinite(d)) continue;
          const std::int32_t slope = shape_.slope(d);
          const std::int32_t front = seen.drawn.slope(u, v);
          const std::uint16_t* colour = &seen.picture(u, v);
          const bool is_nearer = slope > front + shape_.slope_tolerance;
          if (front != DrawnRows::kNone &&
              !(is_nearer && !is_alike(colour, &seen.drawn.colour(u, v))))
            continue;
          band.tuples.push_back({slope, view, u, v, {colour[0], colour[1], colour[2]}});
          band.least_slope = std::min(band.least_slope, slope);
          band.largest_slope = std::max(band.largest_slope, slope);
        }
    });
  }

  void begin_colours() {
    misfits_.assign(shape_.num_bands(), {});
    for (int i = 0; i < shape_.num_bands(); ++i) misfits_[i].resize(tuples_[i].tuples.size());
  }

  /// How far each tuple that a view sees is from what the view shows.
  void collect_colours(int view) {
    const DrawnView seen = draw(view);
    for_each_band([&](int index) {
      const std::vector<SparseTuple>& tuples = tuples_[index].tuples;
      for (std::size_t i = 0; i < tuples.size(); ++i) {
        const TuplePlace place = place_in(shape_, tuples[i], view);
        const std::int64_t u = (place.u + kPlaceOne / 2) >> kPlaceBits;
        const std::int64_t v = (place.v + kPlaceOne / 2) >> kPlaceBits;
        if (u < 0 || u >= shape_.width || v < 0 || v >= shape_.height) continue;
        const std::int32_t front = seen.drawn.slope(int(u), int(v));
        if (front == DrawnRows::kNone ||
            std::abs(front - tuples[i].slope) > shape_.slope_tolerance ||
            !is_alike(&seen.picture(int(u), int(v)), &seen.drawn.colour(int(u), int(v))))
          continue;
        Misfit& misfit = misfits_[index][i];
        ++misfit.views;
        for (int c = 0; c < 3; ++c)
          misfit.sum[c] += seen.picture(int(u), int(v), c) - seen.drawn.colour(int(u), int(v), c);
      }
    });
  }

  void end_colours() {
    const int most = (1 << shape_.bit_depth) - 1;
    for (int index = 0; index < shape_.num_bands(); ++index)
      for (std::size_t i = 0; i < misfits_[index].size(); ++i) {
        const Misfit& misfit = misfits_[index][i];
        if (misfit.views == 0) continue;
        for (int c = 0; c < 3; ++c) {
          std::uint16_t& value = tuples_[index].tuples[i].colour[c];
          const double mean = double(misfit.sum[c]) / misfit.views;
          value = std::uint16_t(std::clamp(int(std::lround(value + mean)), 0, most));
        }
      }
  }

  struct Misfit {
    int views = 0;
    std::array<std::int64_t, 3> sum{};
  };

  const LightField& light_field_;
  const SparseShape& shape_;
  const DisparityOfView& disparity_;
  const SparseOptions& options_;
  const RunControl& control_;
  SparseTuples tuples_;
  std::vector<std::vector<Misfit>> misfits_;
};

}  // namespace

SparseTuples choose_tuples(const LightField& light_field, const SparseShape& shape,
                           const DisparityOfView& disparity, const SparseOptions& options,
                           const RunControl& control) {
  check(light_field);
  require_argument(bool(disparity), "disparity: is empty");
  require_argument(shape.band_rows >= 1 && shape.width == light_field.width &&
                       shape.height == light_field.height &&
                       shape.positions.size() == light_field.views.size(),
                   "shape: is of another light field");
  require_argument(options.tolerance > 0 && options.colour_rounds >= 0,
                   "options: tolerance must be above 0, colour_rounds 0 or more");
  return TupleChoice(light_field, shape, disparity, options, control).run();
}

std::size_t num_tuples(const SparseTuples& tuples) {
  std::size_t count = 0;
  for (const TupleBand& band : tuples) count += band.tuples.size();
  return count;
}

}  // namespace gigaray
