// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "gigaray/core/parallel.h"
#include "gigaray/core/run_control.h"
#include "reference/density_score.h"
#include "reference/edge_confidence.h"

namespace gigaray {

/// A pixel under its best hypothesis.
struct PixelMatch {
  int u = 0, v = 0;  // px of the small pictures
  float disparity = 0;
  float score = 0;
  float lead = 0;  ///< over the best hypothesis elsewhere
};

/// A match that is taken for right.
inline bool is_reliable(const PixelMatch& match) {
  constexpr float kReliableScore = 0.6f, kReliableLead = 0.15f;
  return match.score > kReliableScore && match.lead > kReliableLead;
}

/// The triangle kernel of colour alone.
inline ScoreOptions matching_score() {
  ScoreOptions score;
  score.gradient = true;
  score.gradient_share = 0;
  score.bandwidth = 0.08f;
  score.min_views = 0.6f;
  score.mean_shift_iterations = 0;
  return score;
}

/// A pixel and its edge confidence.
struct EdgePixel {
  float edge = 0;
  int u = 0, v = 0;
};

/// The pixels of view 0 of a band with the strongest edges, in no order: of those `step` apart and
/// `margin` px inside, a third and at most so many.
inline std::vector<EdgePixel> strongest_edges(const reference::Band& band, bool both_axes, int step,
                                              int margin, int most_pixels) {
  constexpr float kMostEdge = 100;  // more than any picture has: the border of a mask
  StripMap<float> edges(band.shape.width, band.rows);
  reference::edge_confidence(band, 0, band.rows, EdgeOptions{2, false, 0, false}, both_axes, edges);
  std::vector<EdgePixel> pixels;
  for (int v = margin; v < band.shape.height - margin; v += step)
    for (int u = margin; u < band.shape.width - margin; u += step)
      if (edges.row(v)[u] < kMostEdge) pixels.push_back({edges.row(v)[u], u, v});
  const std::size_t count = std::min<std::size_t>(pixels.size() / 3, most_pixels);
  std::nth_element(pixels.begin(), pixels.begin() + long(count), pixels.end(),
                   [](const EdgePixel& a, const EdgePixel& b) { return a.edge > b.edge; });
  pixels.resize(count);
  return pixels;
}

/// The best hypothesis of the pixels with the strongest edges of view 0 of a band, by the mean
/// score of a window around each. level0_sampler: of the views of the band. window: px on each
/// side.
template <RaySampler S>
std::vector<PixelMatch> match_edges(const reference::Band& band, const S& level0_sampler,
                                    bool is_4d, const HypothesisRange& range,
                                    const RunControl& control, int most_pixels, int window = 0) {
  const S sampler = level0_sampler.at_level(band.shape.level);
  constexpr float kLeastEdge = 0.1f;
  const std::vector<EdgePixel> pixels = strongest_edges(band, is_4d, 2, 2, most_pixels);
  const ScoreOptions score = matching_score();
  std::vector<std::optional<PixelMatch>> found(pixels.size());
  const auto match = [&](const EdgePixel& pixel) -> std::optional<PixelMatch> {
    // A flat picture tells nothing.
    if (pixel.edge < kLeastEdge) return std::nullopt;
    std::vector<float> scores(std::size_t(range.count));
    const RowRange rows = grown({pixel.v, pixel.v + 1}, window, band.shape.height);
    const RowRange columns = grown({pixel.u, pixel.u + 1}, window, band.shape.width);
    for (int i = 0; i < range.count; ++i) {
      for (int v = rows.begin; v < rows.end; ++v)
        for (int u = columns.begin; u < columns.end; ++u)
          scores[i] += reference::density_score(band, sampler, 0,
                                                Ray{double(u), double(v), range.value(i)}, score);
      scores[i] /= float(rows.size() * columns.size());
    }
    const int best = int(std::max_element(scores.begin(), scores.end()) - scores.begin());
    float elsewhere = 0;
    for (int i = 0; i < range.count; ++i)
      if (std::abs(i - best) > 6) elsewhere = std::max(elsewhere, scores[i]);
    return PixelMatch{pixel.u, pixel.v, float(range.value(best)), scores[best],
                      scores[best] - elsewhere};
  };
  constexpr std::size_t kTogether = 16;
  parallel_for(
      int((pixels.size() + kTogether - 1) / kTogether),
      [&](int job) {
        const std::size_t begin = std::size_t(job) * kTogether;
        for (std::size_t i = begin; i < std::min(begin + kTogether, pixels.size()); ++i)
          found[i] = match(pixels[i]);
      },
      [&](int) { control.throw_if_cancelled(); });
  std::vector<PixelMatch> matches;
  for (const auto& one : found)
    if (one) matches.push_back(*one);
  return matches;
}

}  // namespace gigaray
