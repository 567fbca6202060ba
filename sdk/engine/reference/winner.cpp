// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "winner.h"

namespace gigaray::reference {

void winner(RowRange rows, const Scores& chosen_by, const Scores& scores, int search,
            const HypothesisRange& hypotheses, const WinnerOptions& options,
            MapView<const std::uint8_t> todo, MapView<const HypothesisBounds> bounds,
            MapView<float> disparity, MapView<float> contrast) {
  for (int v = rows.begin; v < rows.end; ++v) {
    for (int u = 0; u < scores.width; ++u) {
      disparity.row(v)[u] = kNoEstimate;
      contrast.row(v)[u] = 0;
      if (!todo.row(v)[u]) continue;
      const auto [first, last] = bounds.row(v)[u];
      int best = -1, tested = 0;
      float sum = 0;
      for (int i = first; i <= last; ++i) {
        const float score = scores.at(u, v, i);
        if (score < 0) continue;
        sum += score;
        ++tested;
        if (best < 0 || chosen_by.at(u, v, i) > chosen_by.at(u, v, best)) best = i;
      }
      if (best < 0) continue;
      const int chosen = best;
      for (int i = std::max<int>(chosen - search, first); i <= std::min<int>(chosen + search, last);
           ++i)
        if (scores.at(u, v, i) > scores.at(u, v, best)) best = i;
      const float peak = scores.at(u, v, best);
      const float lead = peak - sum / tested;
      contrast.row(v)[u] = lead;
      if (options.peak_share > 0) {
        int width = 0;
        for (int i = first; i <= last; ++i)
          width += scores.at(u, v, i) >= peak - options.peak_share * lead;
        contrast.row(v)[u] = width > options.widest_peak
                                 ? 0
                                 : lead * std::min(float(options.peak_width) / width, 1.0f);
      }
      float h = float(hypotheses.min) + best * float(hypotheses.step());
      if (options.refine && best > first && best < last) {
        const float before = scores.at(u, v, best - 1), after = scores.at(u, v, best + 1);
        const float curve = before - 2 * peak + after;
        if (before >= 0 && after >= 0 && curve < 0)
          h += float(hypotheses.step()) * std::clamp(0.5f * (before - after) / curve, -0.5f, 0.5f);
      }
      disparity.row(v)[u] = h;
    }
  }
}

void score_of_estimate(RowRange rows, const Scores& scores, const HypothesisRange& hypotheses,
                       MapView<const std::uint8_t> todo, MapView<const float> disparity,
                       MapView<float> out) {
  for (int v = rows.begin; v < rows.end; ++v)
    for (int u = 0; u < scores.width; ++u) {
      out.row(v)[u] = kNoEstimate;
      const float h = disparity.row(v)[u];
      if (!todo.row(v)[u] || std::isnan(h)) continue;
      const float at = (h - float(hypotheses.min)) / float(hypotheses.step());
      out.row(v)[u] = scores.at(u, v, std::clamp(int(std::nearbyint(at)), 0, hypotheses.count - 1));
    }
}

}  // namespace gigaray::reference
