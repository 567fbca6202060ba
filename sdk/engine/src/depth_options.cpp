// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/depth_options.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "gigaray/error.h"

namespace gigaray {
namespace {

template <class T>
void in_range(const char* field, T value, T least, T most) {
  if (value >= least && value <= most) return;
  std::ostringstream text;
  text << field << " is " << value << "; it must be between " << least << " and " << most;
  throw Error(ErrorCode::kInvalidArgument, text.str());
}

}  // namespace

void DepthOptions::check() const {
  constexpr float kTiny = 1e-6f, kLarge = 100.0f;
  if (disparity) {
    std::ostringstream text;
    text << "disparity range " << disparity->min << " " << disparity->max;
    if (!std::isfinite(disparity->min) || !std::isfinite(disparity->max))
      throw Error(ErrorCode::kInvalidArgument, text.str() + ": not finite numbers");
    if (disparity->min >= disparity->max)
      throw Error(ErrorCode::kInvalidArgument, text.str() + ": the first must be the smaller one");
  }
  if (hypotheses != 0) in_range("hypotheses", hypotheses, 2, 4096);
  in_range("hypothesis_step", hypothesis_step, 1e-4, 100.0);
  in_range("unstructured_step", unstructured_step, 1e-3, 100.0);
  in_range("most_partners", most_partners, 0, 1000);
  in_range("edge.radius", edge.radius, 1, 16);
  if (std::isnan(edge.threshold))
    throw Error(ErrorCode::kInvalidArgument, "edge.threshold is not a number");
  if (std::isnan(winner.min_confidence))
    throw Error(ErrorCode::kInvalidArgument, "winner.min_confidence is not a number");
  in_range("score.smoothing", score.smoothing, 0.0f, 3.0f);
  in_range("score.bandwidth", score.bandwidth, kTiny, kLarge);
  in_range("score.gradient_bandwidth", score.gradient_bandwidth, kTiny, kLarge);
  in_range("score.gradient_share", score.gradient_share, 0.0f, 1.0f);
  in_range("score.gradient_share_in_doubt", score.gradient_share_in_doubt, 0.0f, 1.0f);
  in_range("score.mean_shift_iterations", score.mean_shift_iterations, 0, 100);
  in_range("score.min_views", score.min_views, 0.0f, 1.0f);
  in_range("score.floor_views", score.floor_views, 0.0f, 1.0f);
  in_range("score.unseen", score.unseen, 0.0f, 1.0f);
  in_range("score.colour_slack", score.colour_slack, 0.0f, kLarge);
  in_range("score.gradient_slack", score.gradient_slack, 0.0f, kLarge);
  in_range("support.radius", support.radius, 0, 8);
  if (score.from_noise && support.radius > 0)
    in_range("support.radius_in_doubt", support.radius_in_doubt, support.radius, 8);
  if (support.radius > 0 && score.min_views > 0)
    throw Error(ErrorCode::kInvalidArgument,
                "support.radius above 0 needs score.min_views 0: every score must be a number");
  in_range("support.sigma_colour", support.sigma_colour, kTiny, kLarge);
  in_range("support.sigma_space", support.sigma_space, kTiny, kLarge);
  in_range("support.max_slope", support.max_slope, 0.0f, kLarge);
  if (support.slanted && support.radius == 0)
    throw Error(ErrorCode::kInvalidArgument, "support.slanted needs a support.radius above 0");
  in_range("support.small_price", support.small_price, kTiny, kLarge);
  in_range("support.jump_price", support.jump_price, kTiny, kLarge);
  in_range("support.jump_sigma_colour", support.jump_sigma_colour, kTiny, kLarge);
  if (support.scanline && support.radius == 0)
    throw Error(ErrorCode::kInvalidArgument, "support.scanline needs a support.radius above 0");
  if (score.ray_mean && !(support.slanted && score.gradient))
    throw Error(ErrorCode::kInvalidArgument,
                "score.ray_mean needs support.slanted and score.gradient");
  if (support.half_planes && !(support.slanted && score.gradient))
    throw Error(ErrorCode::kInvalidArgument,
                "support.half_planes needs support.slanted and score.gradient");
  if (support.choose_sides && !(support.slanted && score.gradient))
    throw Error(ErrorCode::kInvalidArgument,
                "support.choose_sides needs support.slanted and score.gradient");
  if (support.fill_hidden && !support.choose_sides)
    throw Error(ErrorCode::kInvalidArgument, "support.fill_hidden needs support.choose_sides");
  in_range("winner.median_radius", winner.median_radius, 0, 8);
  in_range("winner.median_tolerance", winner.median_tolerance, kTiny, kLarge);
  in_range("winner.min_relief", winner.min_relief, 0.0f, 1.0f);
  in_range("winner.peak_share", winner.peak_share, 0.0f, 1.0f);
  in_range("winner.peak_width", winner.peak_width, 1, 4096);
  in_range("winner.widest_peak", winner.widest_peak, winner.peak_width, 4096);
  in_range("propagation.tolerance", propagation.tolerance, kTiny, kLarge);
  in_range("propagation.finished_lead", propagation.finished_lead, 0.0f, kLarge);
  in_range("propagation.crack_width", propagation.crack_width, 0, 8);
  if (propagation.consensus && !winner.calibrated)
    throw Error(ErrorCode::kInvalidArgument, "propagation.consensus needs winner.calibrated");
  in_range("propagation.final_median_radius", propagation.final_median_radius, 0, 8);
  if (memory_bytes < 0 || std::isnan(memory_bytes))
    throw Error(ErrorCode::kInvalidArgument, "memory must not be negative");
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
  options.propagation.final_median_radius = 0;  // its own median has been there
  return options;
}

DepthOptions preset_options(const std::string& name) {
  if (name == "paper") return paper_options();
  if (name == "auto") return auto_options();
  throw Error(ErrorCode::kInvalidArgument, "preset " + name + ": there are auto and paper");
}

}  // namespace gigaray
