// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <cmath>
#include <vector>

#include "gigaray/engine/reconstruct.h"
#include "reconstruction_impl.h"
#include "reference/search_bounds.h"
#include "view_consensus.h"

namespace gigaray {

Decision Reconstruction::decision(int view_idx, int u, int v) const {
  const Impl& impl = *impl_;
  if (std::find(impl.active.begin(), impl.active.end(), view_idx) == impl.active.end() || u < 0 ||
      v < 0 || u >= impl.maps.width() || v >= impl.maps.height())
    throw Error(ErrorCode::kInvalidArgument,
                "pixel " + std::to_string(u) + " " + std::to_string(v) + " of view " +
                    std::to_string(view_idx) + " has no depth: it was not asked for");
  std::vector<float> hypotheses(impl.maps.width());
  std::vector<std::int8_t> levels(impl.maps.width());
  impl.maps.read(impl.active_index(view_idx), v, hypotheses.data(), nullptr, levels.data());
  Decision decision;
  decision.level = levels[u];
  if (decision.level < 0) return decision;
  const float hypothesis = hypotheses[u];
  decision.disparity = impl.disparity_of(view_idx, hypothesis);
  const int level = decision.level, at_u = u >> level, at_v = v >> level;

  // The tuple whose ray ends here with this hypothesis.
  double nearest = 0.75;  // px of the level: propagation rounds to the nearest pixel
  // Where views were held against each other, the mean of what some of them say.
  const float alike = impl.agreed ? kSameEstimate * float(impl.hypotheses.step())
                                  : 1e-4f * float(impl.hypotheses.max - impl.hypotheses.min);
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
  if (level == 0 || decision.view < 0 || impl.searches.empty()) return decision;
  const LevelSearch& searched = impl.searches[level - 1];
  Search search;
  searched.rows.read(
      decision.v,
      (impl.active_index(decision.view) * std::size_t(searched.shape.width) + decision.u) *
          sizeof(Search),
      sizeof(Search), &search);
  if (std::isnan(search.low)) return decision;
  const HypothesisBounds bounds = bounds_of(search, impl.hypotheses);
  decision.bounds = {impl.disparity_of(decision.view, float(impl.hypotheses.value(bounds.first))),
                     impl.disparity_of(decision.view, float(impl.hypotheses.value(bounds.last)))};
  return decision;
}

}  // namespace gigaray
