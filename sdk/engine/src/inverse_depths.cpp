// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "inverse_depths.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "gigaray/engine/scene_estimates.h"
#include "gigaray/samplers/unstructured_sampler.h"

namespace gigaray {
namespace {

/// More cost time and memory in proportion and find hardly more.
constexpr int kMostHypotheses = 512, kLeastHypotheses = 32;

std::string range_text(const InverseDepthRange& range) {
  std::ostringstream text;
  text << "depth " << 1 / range.max << " … ";
  if (range.min > 0)
    text << 1 / range.min;
  else
    text << "infinity";
  return text.str();
}

}  // namespace

void set_inverse_depths(LightField& light_field, const DepthOptions& options,
                        const RunControl& control) {
  std::vector<Camera>& cameras = light_field.cameras;
  std::string origin = "as the input states it";
  if (options.disparity) {
    if (options.disparity->min < 0)
      throw Error(ErrorCode::kInvalidArgument,
                  "the disparity of unstructured views is inverse depth, it can't be negative");
    for (Camera& camera : cameras)
      camera.inverse_depth = InverseDepthRange{options.disparity->min, options.disparity->max};
    return;
  }
  const auto lacks = [](const Camera& camera) { return !camera.inverse_depth.has_value(); };
  if (std::any_of(cameras.begin(), cameras.end(), lacks)) {
    estimate_inverse_depths(light_field, control, true);
    origin = "estimated from the pictures where the input does not state it";
  }
  const std::string unit = light_field.rig.unit.empty() ? "" : " " + light_field.rig.unit;
  control.message(range_text(all_inverse_depths(cameras)) + unit + ", each view its own part, " +
                  origin);
}

void check_partners(const LightField& light_field, const std::vector<int>& views,
                    const RunControl& control) {
  const UnstructuredSampler sampler(light_field.cameras, light_field.most_partners);
  std::vector<std::string> alone;
  for (const int view : views)
    if (sampler.partners(view).size() < 2) alone.push_back(light_field.views[view].name);
  if (alone.empty()) return;
  std::ostringstream why;
  why << "sees less than " << std::lround(100 * UnstructuredSampler::kLeastOverlap)
      << " % of what any other view sees under less than " << UnstructuredSampler::kWidestAngle
      << " degrees";
  if (alone.size() == views.size())
    throw Error(ErrorCode::kBadInput,
                "no depth: each of the views " + why.str() + "; take more pictures in between");
  for (const std::string& name : alone)
    control.message("view " + name + " gets no depth: it " + why.str());
}

double usual_travel(const LightField& light_field) {
  const UnstructuredSampler sampler(light_field.cameras, light_field.most_partners);
  std::vector<double> medians;
  for (int ref = 0; ref < sampler.num_views(); ++ref) {
    std::vector<double> travels;
    for (const int other : sampler.partners(ref))
      if (other != ref) travels.push_back(sampler.travel(ref, other));
    if (travels.empty()) continue;
    std::nth_element(travels.begin(), travels.begin() + travels.size() / 2, travels.end());
    medians.push_back(travels[travels.size() / 2]);
  }
  if (medians.empty()) return 0;
  const auto most = medians.begin() + long(0.9 * double(medians.size() - 1));
  std::nth_element(medians.begin(), most, medians.end());
  return *most;
}

int count_hypotheses(double travel, const DepthOptions& options) {
  return int(std::clamp(std::ceil(travel / options.unstructured_step) + 1, double(kLeastHypotheses),
                        double(kMostHypotheses)));
}

void adapt_to_posed_views(double per_pixel, DepthOptions& options) {
  options.score.cubic = false;
  // Surfaces come nearer and turn from view to view: what is carried over has wider cracks.
  constexpr int kCrackWidth = 4;
  if (options.propagation.crack_width > 0) options.propagation.crack_width = kCrackWidth;
  if (!options.score.gradient) return;
  options.score.unseen = 0.1f;
  options.score.colour_slack = 1;
  options.score.gradient_slack = 0.5f;
  options.winner.peak_share = 0.3f;
  // Window and interpolation make a peak a few pixels wide, and no less than three hypotheses.
  constexpr double kPeak = 4, kWidestPeak = 20;  // px
  options.winner.peak_width = std::max(int(std::lround(kPeak * per_pixel)), 3);
  options.winner.widest_peak = std::max(int(std::lround(kWidestPeak * per_pixel)), 9);
}

}  // namespace gigaray
