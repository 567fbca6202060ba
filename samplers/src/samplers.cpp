// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <cmath>

#include "gigaray/samplers/any_sampler.h"

namespace gigaray {

EpiSampler::EpiSampler(const std::vector<View>& views) {
  for (const View& view : views) {
    if (view.t != views.front().t)
      throw Error(
          ErrorCode::kBadInput,
          "view " + view.name + " is off the line: a 3D light field has one t for all views");
    s_.push_back(view.s);
  }
}

EpiSampler EpiSampler::at_level(int level) const {
  EpiSampler scaled = *this;
  for (double& s : scaled.s_) s = std::ldexp(s, -level);
  return scaled;
}

GridSampler::GridSampler(const std::vector<View>& views) {
  for (const View& view : views) positions_.push_back({view.s, view.t});
}

RowRange GridSampler::rows_needed(RowRange rows, HypothesisRange range, int height) const {
  const auto [low, high] =
      std::minmax_element(positions_.begin(), positions_.end(),
                          [](const Position& a, const Position& b) { return a.t < b.t; });
  const double reach = (high->t - low->t) * std::max(std::abs(range.min), std::abs(range.max));
  return grown(rows, int(std::ceil(std::min(reach, double(height)))), height);
}

GridSampler GridSampler::at_level(int level) const {
  GridSampler scaled = *this;
  for (Position& p : scaled.positions_) p = {std::ldexp(p.s, -level), std::ldexp(p.t, -level)};
  return scaled;
}

std::vector<float> GridSampler::view_table() const {
  std::vector<float> table;
  for (const Position& p : positions_) table.insert(table.end(), {float(p.s), float(p.t)});
  return table;
}

AnySampler make_sampler(const LightField& light_field) {
  switch (light_field.kind) {
    case LightFieldKind::k3D:
      return EpiSampler(light_field.views);
    case LightFieldKind::k4D:
      return GridSampler(light_field.views);
    case LightFieldKind::kUnstructured:
      break;
  }
  throw Error(ErrorCode::kBadInput, "unstructured light fields are not supported by this version");
}

}  // namespace gigaray
