// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <chrono>
#include <cmath>

#include "experiments/experiments.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/adapters/reader.h"
#include "gigaray/core/metrics.h"
#include "gigaray/core/region_metrics.h"

namespace gigaray::experiments {
namespace {

/// Mean |error| over the range of the truth: the paper's normalised sum of absolute differences.
double mean_error_of_range(const FloatMap& estimate, const Scene& scene) {
  double sum = 0;
  long count = 0;
  for (std::size_t i = 0; i < scene.truth.size(); ++i) {
    const double error = double(estimate.data()[i]) - double(scene.truth.data()[i]);
    if (!std::isfinite(error)) continue;
    sum += std::abs(error);
    ++count;
  }
  return sum / double(count) / (scene.range().max - scene.range().min);
}

bool is_same(const FloatMap& a, const FloatMap& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

}  // namespace

DisparityRange Scene::range() const {
  DisparityRange range{INFINITY, -INFINITY};
  for (const float d : truth)
    if (std::isfinite(d)) range = {std::min(range.min, double(d)), std::max(range.max, double(d))};
  return range;
}

Scene synthetic_scene(const SyntheticOptions& options) {
  SyntheticLightField made = render_synthetic(options, {});
  Scene scene{options.scene, std::move(made.light_field), 0, {}};
  scene.view = centre_view(scene.light_field);
  scene.truth = std::move(made.disparity[scene.view]);
  return scene;
}

Scene scene_from(const std::filesystem::path& folder) {
  const std::filesystem::path whole = std::filesystem::absolute(folder / "").parent_path();
  Scene scene{whole.filename().string(), open_light_field(folder), 0, {}};
  scene.view = centre_view(scene.light_field);
  for (const char* name : {"truth.pfm", "gt_disp_lowres.pfm"})
    if (std::filesystem::exists(folder / name)) {
      scene.truth = read_pfm(folder / name);
      return scene;
    }
  throw Error(ErrorCode::kBadInput, folder.string() + ": has no truth.pfm, no gt_disp_lowres.pfm");
}

ViewDepth Report::run(const std::string& label, const Scene& scene, DepthOptions options) {
  options.views = {scene.view};
  ViewDepth depth;
  std::vector<double> seconds;
  Forecast memory;
  for (int i = 0; i <= repeats_; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    Reconstruction result = reconstruct(scene.light_field, options, {}, {});
    ViewDepth again = result.view(scene.view);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    if (i == 0) {
      depth = std::move(again);
      device_ = result.device();
      memory = result.forecast();
      continue;
    }
    if (!is_same(again.disparity, depth.disparity))
      throw Error(ErrorCode::kDevice, label + ": another map when it is run again");
    seconds.push_back(time.count());
  }
  std::ranges::sort(seconds);
  const DisparityScores scores = score_disparity(depth.disparity, scene.truth);
  rows_.push_back(
      {{"label", label},
       {"scene", scene.name},
       {"preset", options.preset},
       {"views", scene.light_field.num_views()},
       {"BadPix0.07", scores.bad_pix_007},
       {"BadPix0.03", scores.bad_pix_003},
       {"MSEx100", scores.mse_x100},
       {"NearJumps", bad_pix(depth.disparity, scene.truth, 0.07, 15, mask_near_jumps(scene.truth))},
       {"SAD", mean_error_of_range(depth.disparity, scene)},
       {"filled", scores.filled},
       {"seconds", seconds[seconds.size() / 2]},
       {"memory_mib", memory.memory_bytes / (1 << 20)}});
  write(label, depth.disparity, scene.range());
  return depth;
}

void Report::note(const std::string& name, nlohmann::ordered_json value) {
  rows_.back()[name] = std::move(value);
}

void Report::write(const std::string& name, const Image<std::uint16_t>& picture) {
  write_png(folder_ / (name + ".png"), picture, 8);
}

void Report::write(const std::string& name, const FloatMap& map, DisparityRange range) {
  write_depth_picture(folder_ / (name + ".png"), map, range);
}

}  // namespace gigaray::experiments
