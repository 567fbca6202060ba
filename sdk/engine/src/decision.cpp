// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <cmath>

#include "gigaray/reconstruct.h"
#include "reconstruction_impl.h"

namespace gigaray {

Decision Reconstruction::decision(int view_idx, int u, int v) const {
  const Impl& impl = *impl_;
  const auto active_index = [&](int view) {
    return std::size_t(std::find(impl.active.begin(), impl.active.end(), view) -
                       impl.active.begin());
  };
  const std::size_t active = active_index(view_idx);
  const LevelShape& picture = impl.levels.front().shape;
  if (active == impl.active.size() || u < 0 || v < 0 || u >= picture.width || v >= picture.height)
    throw Error(ErrorCode::kInvalidArgument,
                "pixel " + std::to_string(u) + " " + std::to_string(v) + " of view " +
                    std::to_string(view_idx) + " has no depth: it was not asked for");
  Decision decision;
  PackedEstimate estimate = 0;
  for (int level = 0; level < num_levels() && estimate == 0; ++level) {
    const LevelState& state = impl.levels[level];
    state.estimates.read(v >> level, (active * state.shape.width + (u >> level)) * sizeof estimate,
                         sizeof estimate, &estimate);
    if (estimate != 0) decision.level = level;
  }
  if (estimate == 0) return decision;
  const float hypothesis = hypothesis_of(estimate);
  decision.disparity = impl.disparity_of(view_idx, hypothesis);
  const int level = decision.level, at_u = u >> level, at_v = v >> level;

  // The tuple whose ray ends here with this hypothesis.
  double nearest = 0.75;  // px of the level: propagation rounds to the nearest pixel
  const float alike = 1e-4f * float(impl.hypotheses.max - impl.hypotheses.min);
  std::visit(
      [&](const auto& sampler) {
        const auto rays = sampler.at_level(level);
        impl.tuples.for_each([&](const RayTuple& tuple) {
          if (tuple.level != level) return;
          const auto here = rays.locate(tuple.view, view_idx,
                                        Ray{double(tuple.u), double(tuple.v), tuple.hypothesis});
          if (!here || !(std::abs(here->hypothesis - hypothesis) <= alike)) return;
          const double distance = std::max(std::abs(here->u - at_u), std::abs(here->v - at_v));
          if (distance >= nearest) return;
          nearest = distance;
          decision.view = tuple.view;
          decision.u = tuple.u;
          decision.v = tuple.v;
        });
      },
      *impl.sampler);

  decision.bounds = {impl.disparity_of(view_idx, float(impl.hypotheses.min)),
                     impl.disparity_of(view_idx, float(impl.hypotheses.max))};
  if (level == 0 || decision.view < 0) return decision;
  const LevelState& state = impl.levels[level];
  Search search;
  state.search.read(decision.v,
                    (active_index(decision.view) * state.shape.width + decision.u) * sizeof(Search),
                    sizeof(Search), &search);
  if (std::isnan(search.low)) return decision;
  const HypothesisBounds bounds = bounds_of(search, impl.hypotheses);
  decision.bounds = {impl.disparity_of(decision.view, float(impl.hypotheses.value(bounds.first))),
                     impl.disparity_of(decision.view, float(impl.hypotheses.value(bounds.last)))};
  return decision;
}

}  // namespace gigaray
