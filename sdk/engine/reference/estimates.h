// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <vector>

#include "gigaray/core/ray_sampler.h"
#include "gigaray/engine/reconstruct.h"
#include "src/estimates.h"
#include "src/strip_map.h"

namespace gigaray::reference {

/// Rows of some views: [v - begin][stored view][width].
template <class T>
struct StoredRows {
  T* data = nullptr;
  int begin = 0;
  int stored_views = 0;
  int width = 0;
  T& at(int v, int view, int u) const {
    return data[(std::size_t(v - begin) * stored_views + view) * width + u];
  }
  explicit operator bool() const { return data != nullptr; }
};

/// Winners of a strip into maps. best, edges: null, as if all scores stood out and all edges
/// were 1.
struct Winners {
  MapView<const float> disparity, contrast;
  const MapView<const float>* best = nullptr;
  const MapView<const float>* edges = nullptr;
};
void take_winners(RowRange rows, const HypothesisRange& hypotheses, float min_relief,
                  bool is_last_level, MapView<const std::uint8_t> todo,
                  MapView<const HypothesisBounds> bounds, const Winners& winners,
                  MapView<float> disparity, MapView<float> confidence);

/// Winners that are `farther` than the estimate and whose score (best) leads that of the estimate
/// (own) by `lead` are taken.
void step_back(RowRange rows, float farther, float lead, MapView<const float> winners,
               MapView<const float> contrast, MapView<const float> best, MapView<const float> own,
               MapView<float> disparity, MapView<float> confidence);

/// Estimates that are not to do, or not more confident than the threshold, become NaN.
void accept(RowRange rows, float threshold, MapView<const std::uint8_t> todo,
            MapView<const float> confidence, MapView<float> estimates);

std::vector<RayTuple> compact_tuples(int view, int level, RowRange rows,
                                     MapView<const float> disparity,
                                     MapView<const float> confidence,
                                     MapView<const Radiance> radiance);

/// Maps of a level: own estimates of a view, else what the coarser level has above. coarse:
/// null, nothing.
struct FilledMaps {
  MapView<float> disparity, confidence;
  MapView<std::int8_t> level;
};
void fill_view(RowRange rows, int level, int view, const StoredRows<PackedEstimate>& estimates,
               const FilledMaps* coarse, const FilledMaps& maps);

}  // namespace gigaray::reference
