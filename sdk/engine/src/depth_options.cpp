// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/engine/depth_options.h"

#include <algorithm>
#include <string>

#include "gigaray/core/error.h"
#include "gigaray/engine/option_table.h"

namespace gigaray {
namespace {

void needs(bool holds, const char* what) {
  if (!holds) throw Error(ErrorCode::kInvalidArgument, what);
}

/// least: what another field holds the value to.
void at_least(const char* field, int value, int least, int most) {
  if (value >= least) return;
  throw Error(ErrorCode::kInvalidArgument, std::string(field) + " is " + std::to_string(value) +
                                               "; it must be between " + std::to_string(least) +
                                               " and " + std::to_string(most));
}

}  // namespace

void DepthOptions::check() const {
  for (const DepthOption& option : depth_option_table()) option.check(*this);
  // What fields ask of each other.
  if (score.from_noise && support.radius > 0)
    at_least("support.radius_in_doubt", support.radius_in_doubt, support.radius, 8);
  needs(support.radius == 0 || score.min_views == 0,
        "support.radius above 0 needs score.min_views 0: every score must be a number");
  needs(!support.slanted || support.radius > 0, "support.slanted needs a support.radius above 0");
  needs(!support.scanline || support.radius > 0, "support.scanline needs a support.radius above 0");
  const bool robust = support.slanted && score.gradient;
  needs(!score.ray_mean || robust, "score.ray_mean needs support.slanted and score.gradient");
  needs(!support.half_planes || robust,
        "support.half_planes needs support.slanted and score.gradient");
  needs(!support.choose_sides || robust,
        "support.choose_sides needs support.slanted and score.gradient");
  needs(!support.fill_hidden || support.choose_sides,
        "support.fill_hidden needs support.choose_sides");
  at_least("winner.widest_peak", winner.widest_peak, winner.peak_width, 4096);
  needs(!propagation.consensus || winner.calibrated,
        "propagation.consensus needs winner.calibrated");
}

ScoreOptions against_means(ScoreOptions score) {
  constexpr float kNarrower = 0.75f;  // a little more than 1 / sqrt 2: the mean has some noise left
  score.bandwidth =
      std::max(kNarrower * score.bandwidth, std::min(score.bandwidth, kLeastBandwidth));
  score.gradient_bandwidth = std::max(kNarrower * score.gradient_bandwidth,
                                      std::min(score.gradient_bandwidth, kLeastGradientBandwidth));
  return score;
}

DepthOptions paper_options() {
  DepthOptions options;
  options.preset = "paper";
  options.hypotheses = 256;
  // Eq. 2 with plain distances and no discard by eq. 7: the reading that works, docs/accuracy.md.
  options.edge.squared = false;
  options.winner.min_confidence = 0;
  return options;
}

DepthOptions auto_options() {
  DepthOptions options;
  options.preset = "auto";
  options.edge.threshold = -1;
  options.unstructured_step = 1;
  options.score.linear_rgb = false;
  options.score.cubic = true;
  options.score.gradient = true;
  options.score.remove_jpeg_blocks = true;
  options.score.even_exposures = true;
  options.score.from_noise = true;
  options.score.gradient_share_in_doubt = 0.9f;
  options.score.ray_mean = true;
  options.score.mean_shift_iterations = 0;
  options.score.min_views = 0;
  options.score.floor_views = 0.25f;
  options.support.radius = 4;
  options.support.radius_in_doubt = 8;
  options.support.slanted = true;
  options.support.half_planes = true;
  options.support.choose_sides = true;
  options.support.fill_hidden = true;
  options.support.scanline = true;
  options.support.small_price = 0.12f;
  options.winner.refine = true;
  options.winner.median_radius = 2;
  options.winner.weigh_by_edge = false;
  options.winner.calibrated = true;
  options.winner.min_relief = 0.05f;
  options.propagation.finished_lead = 2;
  options.propagation.crack_width = 2;
  options.propagation.consensus = true;
  options.coarse_first = 400;
  options.propagation.final_median_radius = 0;  // its own median has been there
  return options;
}

DepthOptions preset_options(const std::string& name) {
  if (name == "paper") return paper_options();
  if (name == "auto") return auto_options();
  throw Error(ErrorCode::kInvalidArgument, "preset " + name + ": there are auto and paper");
}

}  // namespace gigaray
