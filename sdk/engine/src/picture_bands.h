// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <optional>
#include <vector>

#include "gigaray/core/light_field.h"
#include "gigaray/core/run_control.h"
#include "reference/band.h"

namespace gigaray {

/// A few views of a light field as a light field of its own.
LightField subset(const LightField& light_field, const std::vector<int>& views);

/// How many pictures are looked at side by side: as many as a small part of any memory holds.
int pictures_at_once(const LightField& light_field);

/// A view as it is read, rows of which become bands.
class EncodedView {
 public:
  EncodedView(const LightField& light_field, int view);

  /// A band of this view alone: encoded RGB and, with 5 channels, gradients, the same as in a band
  /// of all rows.
  reference::Band band(RowRange rows, int channels) const;

 private:
  std::vector<float> table_;  ///< encoded integer → 0 … 1
  Image<std::uint16_t> picture_;
  std::optional<Mask> mask_;
};

/// Copies the rows of `band` from a view's own band to its place.
void place(const reference::Band& view_rows, int view, reference::Band& band);

/// Small versions of pictures of a light field, each made once. Not for several threads.
class SmallViews {
 public:
  /// The pixels of `light_field` decide; where its views stand may change meanwhile.
  explicit SmallViews(const LightField& light_field);

  /// Some views in this order, halved until they are no wider than 320 px; channels R, G, B.
  reference::Band band(const std::vector<int>& views, const RunControl& control);

 private:
  reference::Band make(int view, const RunControl& control) const;

  LightField light_field_;
  std::vector<std::optional<reference::Band>> known_;
};

}  // namespace gigaray
