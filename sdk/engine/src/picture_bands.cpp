// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "picture_bands.h"

#include <algorithm>

#include "gigaray/core/parallel.h"
#include "reference/downsample.h"
#include "reference/unpack_channels.h"

namespace gigaray {
namespace {

using reference::Band;

constexpr int kSmallWidth = 320;  // px
constexpr int kLeastSide = 32;    // px; what is lower is not halved
constexpr int kStripRows = 16;    // of a halved picture

bool is_small(const LevelShape& shape) {
  return shape.width <= kSmallWidth || std::min(shape.width, shape.height) <= kLeastSide;
}

/// The next level of a band of one view. finer(rows): those rows of it.
template <class Finer>
Band halved(const LevelShape& shape, Finer finer, const RunControl& control) {
  constexpr int kReach = 3;  // rows of the finer level around a pixel of the coarser one
  const LevelShape half{shape.level + 1, (shape.width + 1) / 2, (shape.height + 1) / 2};
  Band next{half, {0, half.height}, 1, 3, {}};
  next.data.resize(std::size_t(half.width) * half.height * 3);
  parallel_for(
      (half.height + kStripRows - 1) / kStripRows,
      [&](int strip) {
        const RowRange rows{strip * kStripRows, std::min((strip + 1) * kStripRows, half.height)};
        const Band& band = finer(grown({2 * rows.begin, 2 * rows.end - 1}, kReach, shape.height));
        reference::downsample(band, rows, next.plane(0, rows.begin, 0));
      },
      [&](int) { control.throw_if_cancelled(); });
  return next;
}

}  // namespace

LightField subset(const LightField& light_field, const std::vector<int>& views) {
  LightField some = light_field;
  some.views.clear();
  some.cameras.clear();
  for (const int view : views) {
    some.views.push_back(light_field.views[view]);
    if (!light_field.cameras.empty()) some.cameras.push_back(light_field.cameras[view]);
  }
  some.pixels = pictures_of(light_field, views);
  return some;
}

int pictures_at_once(const LightField& light_field) {
  constexpr double kBytes = 128 * double(1 << 20);
  constexpr double kBytesPerPixel = 16;  // while it is decoded, and what is made of it
  const double pixels = double(light_field.width) * light_field.height;
  return int(std::clamp(kBytes / (kBytesPerPixel * pixels), 1.0, 1024.0));
}

EncodedView::EncodedView(const LightField& light_field, int view)
    : table_(std::size_t(1) << light_field.pixels->bit_depth()),
      picture_(read_view(light_field, view)),
      mask_(take_mask(picture_)) {
  for (std::size_t i = 0; i < table_.size(); ++i) table_[i] = float(i) / float(table_.size() - 1);
}

Band EncodedView::band(RowRange rows, int channels) const {
  const int width = picture_.width(), height = picture_.height();
  if (channels > 3) rows = grown(rows, 1, height);  // gradients look at the rows beside
  Band band{{0, width, height}, rows, 1, channels, {}};
  band.data.resize(std::size_t(rows.size()) * channels * width);
  // Values above 8 bits or not: the decoder always gives 16-bit integers.
  reference::unpack_channels(picture_.row(rows.begin), BandEncoding::kBits16, table_, band);
  if (mask_) reference::mask_pixels(mask_->row(rows.begin), rows, band);
  return band;
}

void place(const Band& view_rows, int view, Band& band) {
  for (int v = band.rows.begin; v < band.rows.end; ++v)
    for (int c = 0; c < band.channels; ++c)
      std::copy_n(view_rows.plane(0, v, c), band.shape.width, band.plane(view, v, c));
}

SmallViews::SmallViews(const LightField& light_field)
    : light_field_(light_field), known_(light_field.views.size()) {}

Band SmallViews::make(int view, const RunControl& control) const {
  const EncodedView picture(light_field_, view);
  const LevelShape full{0, light_field_.width, light_field_.height};
  if (is_small(full)) return picture.band({0, full.height}, 3);
  Band band = halved(
      full, [&](RowRange rows) { return picture.band(rows, 3); }, control);
  while (!is_small(band.shape))
    band = halved(
        band.shape, [&](RowRange) -> const Band& { return band; }, control);
  return band;
}

Band SmallViews::band(const std::vector<int>& views, const RunControl& control) {
  std::vector<int> missing;
  for (const int view : views)
    if (!known_.at(std::size_t(view))) missing.push_back(view);
  parallel_for(
      int(missing.size()),
      [&](int i) { known_[std::size_t(missing[i])] = make(missing[i], control); },
      [&](int) { control.throw_if_cancelled(); }, pictures_at_once(light_field_));
  const Band& first = *known_[std::size_t(views.front())];
  Band all{first.shape, first.rows, int(views.size()), 3, {}};
  all.data.resize(first.data.size() * views.size());
  for (std::size_t i = 0; i < views.size(); ++i) place(*known_[std::size_t(views[i])], int(i), all);
  return all;
}

}  // namespace gigaray
