// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "reference/estimates.h"

#include <cmath>

namespace gigaray::reference {

void take_winners(RowRange rows, const HypothesisRange& hypotheses, float min_relief,
                  bool is_last_level, MapView<const std::uint8_t> todo,
                  MapView<const HypothesisBounds> bounds, const Winners& winners,
                  MapView<float> disparity, MapView<float> confidence) {
  for (int v = rows.begin; v < rows.end; ++v)
    for (int u = 0; u < todo.width(); ++u) {
      if (!todo.row(v)[u]) continue;
      float h = winners.disparity.row(v)[u], contrast = winners.contrast.row(v)[u];
      // All hypotheses score alike: no information.
      if (winners.best && !(contrast > min_relief * winners.best->row(v)[u])) contrast = 0;
      // Too few views saw it under any hypothesis: on the last level the farther bound has to do.
      if (std::isnan(h) && is_last_level) h = float(hypotheses.value(bounds.row(v)[u].first));
      disparity.row(v)[u] = h;
      confidence.row(v)[u] = contrast * (winners.edges ? winners.edges->row(v)[u] : 1.0f);
    }
}

void step_back(RowRange rows, float farther, float lead, MapView<const float> winners,
               MapView<const float> contrast, MapView<const float> best, MapView<const float> own,
               MapView<float> disparity, MapView<float> confidence) {
  for (int v = rows.begin; v < rows.end; ++v)
    for (int u = 0; u < disparity.width(); ++u) {
      // NaN where there is nothing to do: no comparison holds.
      if (!(winners.row(v)[u] < disparity.row(v)[u] - farther)) continue;
      if (!(best.row(v)[u] >= own.row(v)[u] + lead)) continue;
      disparity.row(v)[u] = winners.row(v)[u];
      confidence.row(v)[u] = contrast.row(v)[u];
    }
}

void accept(RowRange rows, float threshold, MapView<const std::uint8_t> todo,
            MapView<const float> confidence, MapView<float> estimates) {
  for (int v = rows.begin; v < rows.end; ++v)
    for (int u = 0; u < todo.width(); ++u)
      if (!todo.row(v)[u] || !(confidence.row(v)[u] > threshold)) estimates.row(v)[u] = kNoEstimate;
}

std::vector<RayTuple> compact_tuples(int view, int level, RowRange rows,
                                     MapView<const float> disparity,
                                     MapView<const float> confidence,
                                     MapView<const Radiance> radiance) {
  std::vector<RayTuple> tuples;
  for (int v = rows.begin; v < rows.end; ++v)
    for (int u = 0; u < disparity.width(); ++u)
      if (const float h = disparity.row(v)[u]; !std::isnan(h))
        tuples.push_back({h, confidence.row(v)[u], radiance.row(v)[u], view, u, v, level});
  return tuples;
}

void fill_view(RowRange rows, int level, int view, const StoredRows<PackedEstimate>& estimates,
               const FilledMaps* coarse, const FilledMaps& maps) {
  for (int v = rows.begin; v < rows.end; ++v)
    for (int u = 0; u < estimates.width; ++u) {
      float h = kNoEstimate, confidence = kNoEstimate;
      std::int8_t decided = -1;
      if (const PackedEstimate own = estimates.at(v, view, u); own != 0) {
        h = hypothesis_of(own);
        confidence = confidence_of(own);
        decided = std::int8_t(level);
      } else if (coarse) {
        h = coarse->disparity.row(v / 2)[u / 2];
        confidence = coarse->confidence.row(v / 2)[u / 2];
        decided = coarse->level.row(v / 2)[u / 2];
      }
      maps.disparity.row(v)[u] = h;
      maps.confidence.row(v)[u] = confidence;
      maps.level.row(v)[u] = decided;
    }
}

}  // namespace gigaray::reference
