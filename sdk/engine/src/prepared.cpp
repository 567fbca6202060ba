// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "prepared.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <variant>

#include "few_views.h"
#include "gigaray/core/jpeg_blocks.h"
#include "gigaray/core/kept_pictures.h"
#include "gigaray/core/smoothing.h"
#include "gigaray/engine/exposures.h"
#include "gigaray/engine/scene_estimates.h"
#include "gigaray/samplers/any_sampler.h"
#include "inverse_depths.h"
#include "make_workspace.h"
#include "opencl/device.h"
#include "settle_direction.h"

namespace gigaray {
namespace {

/// Hypotheses for a range: as many as asked for, or one every step.
HypothesisRange sample_range(const DepthOptions& options, const LightField& light_field) {
  const DisparityRange& range = *options.disparity;
  const double farthest = std::max(std::abs(range.min), std::abs(range.max));
  std::ostringstream text;
  text << "disparity range " << range.min << " " << range.max;
  if (range.max - range.min < 1e-3)
    throw Error(ErrorCode::kInvalidArgument, text.str() + ": too narrow to be sampled");
  if (farthest >= light_field.width)
    throw Error(ErrorCode::kInvalidArgument, text.str() + ": wider than the pictures (" +
                                                 std::to_string(light_field.width) +
                                                 " px), neighbouring views share nothing then");
  double count = options.hypotheses;
  if (count == 0) {
    count = std::ceil((range.max - range.min) / options.hypothesis_step) + 1;
    if (options.score.from_noise && most_others(light_field) <= kMostFewViews)
      count = std::min(count, double(kMostOfFewViews));
  }
  if (count > 4096)
    throw Error(ErrorCode::kInvalidArgument,
                text.str() + ": takes " + std::to_string(long(count)) +
                    " hypotheses, 4096 is the most; give a narrower range or fewer hypotheses");
  return {range.min, range.max, std::max(int(count), 2)};
}

/// Smooths noisy pictures, as little as will do, and sets what the options derive from the noise.
/// Returns the view that told.
int adapt_to_noise(Prepared& run, const RunControl& control) {
  const LightField original = run.light_field;
  NoiseEstimate noise = estimate_noise(original, run.hypotheses, control);
  const double lead = noise.lead;
  run.options.score.ray_mean =
      run.options.score.ray_mean && lead < kLeadOfOwnPixel && noise.colour > kLeastNoise;
  run.options.score.smoothing = 0;
  for (const float sigma : {0.7f, 1.0f}) {
    if (noise.lead >= kLeadWithoutSmoothing) break;
    const LightField smooth = smoothed(original, sigma);
    const NoiseEstimate left = estimate_noise(smooth, run.hypotheses, control);
    if (left.lead <= noise.lead) break;  // it is not noise that hides the answer
    run.light_field = smooth;
    run.options.score.smoothing = sigma;
    noise = left;
  }
  if (run.options.score.smoothing > 0) {
    std::ostringstream text;
    text << "noisy pictures: smoothed by " << run.options.score.smoothing << " px";
    control.message(text.str());
  }
  apply_noise(noise, run.options);
  apply_doubt(ray_doubt(noise, lead, std::max(most_others(original), 1)), run.options);
  return noise.view;
}

std::string range_message(const DisparityRange& range) {
  std::ostringstream text;
  text << "disparity range " << range.min << " … " << range.max
       << " px per view step, estimated from the pictures";
  return text.str();
}

/// Range and hypotheses of parallel views.
void prepare_range(Prepared& run, const RunControl& control) {
  if (!run.options.disparity) run.options.disparity = run.light_field.declared_range;
  if (!run.options.disparity) {
    run.options.disparity = estimate_disparity_range(run.light_field, control).range;
    control.message(range_message(*run.options.disparity));
  }
  run.hypotheses = sample_range(run.options, run.light_field);
}

/// The same of unstructured views: each searches its own range of inverse depths.
void prepare_unstructured(Prepared& run, const RunControl& control) {
  run.light_field.most_partners = run.options.most_partners;
  set_inverse_depths(run.light_field, run.options, control);
  const InverseDepthRange all = all_inverse_depths(run.light_field.cameras);
  run.options.disparity = DisparityRange{all.min, all.max};
  check_partners(
      run.light_field,
      run.options.views.empty() ? all_views(run.light_field.num_views()) : run.options.views,
      control);
  const double travel = usual_travel(run.light_field);
  const int count =
      run.options.hypotheses > 0 ? run.options.hypotheses : count_hypotheses(travel, run.options);
  adapt_to_posed_views((count - 1) / std::max(travel, 1.0), run.options);
  run.hypotheses = {0, 1, count};
}

/// Takes out the exposures of posed photographs where they differ.
void even_exposures(Prepared& run, const RunControl& control) {
  const std::vector<Exposure> exposures = estimate_exposures(run.light_field, control);
  if (!differ(exposures)) return;
  float least = 0;
  for (const Exposure& exposure : exposures)
    least = std::min(least, *std::min_element(exposure.begin(), exposure.end()));
  std::ostringstream text;
  text.precision(2);
  text << "exposures differ, the darkest picture is " << std::exp(least)
       << " of the brightest: evened out before pictures are compared";
  control.message(text.str());
  run.light_field = evened(run.light_field, exposures);
}

}  // namespace

LightField kept_and_cleaned(const LightField& light_field, const DepthOptions& options,
                            const RunControl& control) {
  check(light_field);
  const auto keep = [&](const LightField& pictures) {
    return KeptPictures::over(std::make_shared<KeptPictures>(options.memory_bytes), pictures);
  };
  LightField kept = keep(light_field);
  if (!options.score.remove_jpeg_blocks) return kept;
  LightField cleaned = without_jpeg_blocks(kept);
  if (cleaned.pixels == kept.pixels) return kept;
  control.message("the pictures were JPEG: its blocks are removed before they are compared");
  return keep(cleaned);
}

double kept_picture_bytes(const LightField& light_field, const DepthOptions& options) {
  const double all = 3.0 * light_field.pixels->bit_depth() / 8 * light_field.width *
                     light_field.height * light_field.num_views();
  return std::min(all, KeptPictures::most_bytes(options.memory_bytes));
}

void require_direction(LightField& light_field, DepthOptions& options, const RunControl& control) {
  const auto settled = settle_direction(light_field, control);
  if (!settled) return;
  if (!settled->is_clear)
    throw Error(ErrorCode::kInvalidArgument,
                "which way the camera goes is only assumed, and disparities of both signs don't "
                "tell: state OpenOptions::direction, or take the assumption "
                "by sign_is_assumed = false");
  if (!settled->message.empty()) control.message(settled->message);
  if (options.disparity) return;
  options.disparity = settled->range;
  control.message(range_message(settled->range));
}

Prepared prepare(const LightField& light_field, const DepthOptions& wanted,
                 const RunControl& control) {
  check(light_field);
  wanted.check();
  Prepared run{light_field, wanted, {}};
  for (const int view : wanted.views)
    if (view < 0 || view >= light_field.num_views())
      throw Error(ErrorCode::kInvalidArgument, "view " + std::to_string(view) +
                                                   ": there are views 0 … " +
                                                   std::to_string(light_field.num_views() - 1));
  if (light_field.kind == LightFieldKind::kUnstructured) {
    prepare_unstructured(run, control);
  } else {
    prepare_range(run, control);
    run.options.propagation.consensus = false;
  }
  run.options.hypotheses = run.hypotheses.count;
  adapt_to_few_views(run.light_field, run.options);
  return run;
}

DepthOptions widest(DepthOptions options) {
  if (options.score.from_noise && options.support.radius > 0) apply_doubt(1, options);
  return options;
}

void adapt_to_pictures(Prepared& run, const RunControl& control) {
  if (run.options.score.even_exposures && run.light_field.kind == LightFieldKind::kUnstructured)
    even_exposures(run, control);
  if (run.options.score.from_noise) {
    const int view = adapt_to_noise(run, control);
    if (most_others(run.light_field) <= kMostFewViews)
      widen(estimate_window_noise(run.light_field, view, run.hypotheses, control), run.options);
  } else if (run.options.score.smoothing > 0)
    run.light_field = smoothed(run.light_field, run.options.score.smoothing);
}

std::unique_ptr<Workspace> make_workspace(const Prepared& run, const Device* device) {
  const WorkspaceSetup setup{run.options, run.hypotheses, run.light_field.kind,
                             run.light_field.pixels->bit_depth()};
  return std::visit(
      [&](const auto& sampler) {
        return device ? make_opencl_workspace(sampler, setup, device->opened())
                      : make_reference_workspace(sampler, setup);
      },
      make_sampler(run.light_field));
}

}  // namespace gigaray
