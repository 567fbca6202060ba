// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <cmath>

#include "gigaray/core/arguments.h"
#include "gigaray/samplers/any_sampler.h"

namespace gigaray {
namespace {

void check_view(int view, int num_views) {
  require_argument(view >= 0 && view < num_views, "view: the sampler has no such view");
}

}  // namespace

EpiSampler::EpiSampler(const std::vector<View>& views) {
  for (const View& view : views) {
    if (view.t != views.front().t)
      throw Error(
          ErrorCode::kBadInput,
          "view " + view.name + " is off the line: a 3D light field has one t for all views");
    s_.push_back(view.s);
  }
}

EpiSampler EpiSampler::subset(const std::vector<int>& views) const {
  for (const int view : views) check_view(view, num_views());
  EpiSampler some;
  for (const int view : views) some.s_.push_back(s_[view]);
  return some;
}

std::vector<float> EpiSampler::ray_table(int ref) const {
  check_view(ref, num_views());
  std::vector<float> table;
  for (const double s : s_) table.push_back(float(s_[ref] - s));
  return table;
}

EpiSampler EpiSampler::at_level(int level) const {
  EpiSampler scaled = *this;
  for (double& s : scaled.s_) s = std::ldexp(s, -level);
  return scaled;
}

GridSampler::GridSampler(const std::vector<View>& views) {
  for (const View& view : views) positions_.push_back({view.s, view.t});
}

RowRange GridSampler::rows_needed(int ref, RowRange rows, HypothesisRange range, int height) const {
  check_view(ref, num_views());
  double farthest = 0;
  for (const Position& p : positions_)
    farthest = std::max(farthest, std::abs(p.t - positions_[ref].t));
  const double reach = farthest * std::max(std::abs(range.min), std::abs(range.max));
  return grown(rows, int(std::ceil(std::min(reach, double(height)))), height);
}

GridSampler GridSampler::at_level(int level) const {
  GridSampler scaled = *this;
  for (Position& p : scaled.positions_) p = {std::ldexp(p.s, -level), std::ldexp(p.t, -level)};
  return scaled;
}

GridSampler GridSampler::subset(const std::vector<int>& views) const {
  for (const int view : views) check_view(view, num_views());
  GridSampler some;
  for (const int view : views) some.positions_.push_back(positions_[view]);
  return some;
}

std::vector<float> GridSampler::ray_table(int ref) const {
  check_view(ref, num_views());
  const Position from = positions_[ref];
  std::vector<float> table;
  for (const Position& p : positions_)
    table.insert(table.end(), {float(from.s - p.s), float(from.t - p.t)});
  return table;
}

AnySampler make_sampler(const LightField& light_field) {
  switch (light_field.kind) {
    case LightFieldKind::k3D:
      return EpiSampler(light_field.views);
    case LightFieldKind::k4D:
      return GridSampler(light_field.views);
    case LightFieldKind::kUnstructured:
      return UnstructuredSampler(light_field.cameras, light_field.most_partners);
  }
  throw Error(ErrorCode::kInvalidArgument, "kind: names no kind of light field");
}

}  // namespace gigaray
