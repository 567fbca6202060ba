// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// The experiments themselves, in the order of the paper's figures.
#include <algorithm>
#include <cmath>

#include "experiments/experiments.h"

namespace gigaray::experiments {
namespace {

SyntheticOptions pictures(const Setup& setup, const std::string& scene, int views) {
  SyntheticOptions options;
  options.scene = scene;
  options.width = int(std::lround(352 * setup.size));
  options.height = int(std::lround(240 * setup.size));
  options.views_s = views;
  return options;
}

Scene scene_of(const Setup& setup, const std::string& synthetic, int views) {
  return setup.input ? scene_from(*setup.input)
                     : synthetic_scene(pictures(setup, synthetic, views));
}

std::string text(double value) {
  std::string result = std::to_string(value);
  result.erase(result.find_last_not_of('0') + 1);
  if (result.back() == '.') result.pop_back();
  return result;
}

/// Row of every view through the middle of the picture, the first at the top.
Image<std::uint16_t> middle_epi(const LightField& light_field) {
  Image<std::uint16_t> epi(light_field.width, light_field.num_views(), 3);
  for (int i = 0; i < light_field.num_views(); ++i) {
    Image<std::uint16_t> picture = read_view(light_field, i);
    take_mask(picture);
    std::copy_n(picture.row(light_field.height / 2), 3 * light_field.width, epi.row(i));
  }
  return epi;
}

/// So many views over the same way, the first and the last among them.
std::vector<int> all_but_even(int all, int kept) {
  std::vector<int> left_out;
  std::vector<bool> is_kept(all);
  for (int i = 0; i < kept; ++i) is_kept[std::lround(double(i) * (all - 1) / (kept - 1))] = true;
  is_kept[(all - 1) / 2] = true;  // the reference
  for (int i = 0; i < all; ++i)
    if (!is_kept[i]) left_out.push_back(i);
  return left_out;
}

void figure_4(const Setup& setup, Report& report) {
  SyntheticOptions made = pictures(setup, "rods", 51);
  made.noise = 0.02;  // Without, there are no speckles to remove.
  const Scene scene = setup.input ? scene_from(*setup.input) : synthetic_scene(made);
  DepthOptions options = paper_options();
  options.winner.median_radius = 0;
  options.propagation.final_median_radius = 0;
  report.run("no_median", scene, options);
  options.winner.median_radius = paper_options().winner.median_radius;
  options.winner.median_tolerance = 2;  // Any two colours are that near.
  report.run("plain_median", scene, options);
  options.winner.median_tolerance = paper_options().winner.median_tolerance;
  report.run("bilateral_median", scene, options);
}

void figure_5(const Setup& setup, Report& report) {
  const Scene scene = scene_of(setup, "plaster", 51);
  for (const char* preset : {"paper", "auto"}) {
    DepthOptions options = preset_options(preset);
    const ViewDepth whole = report.run(std::string(preset) + "_fine_to_coarse", scene, options);
    const int levels = 1 + *std::ranges::max_element(whole.level);
    std::vector<double> shares;
    for (int level = 0; level < levels; ++level) {
      FloatMap part = whole.disparity;
      std::size_t own = 0;
      for (std::size_t i = 0; i < part.size(); ++i) {
        own += whole.level.data()[i] == level;
        if (whole.level.data()[i] > level) part.data()[i] = kNoEstimate;
      }
      shares.push_back(double(own) / double(part.size()));
      report.write(std::string(preset) + "_up_to_level_" + std::to_string(level), part,
                   scene.range());
    }
    report.note("share_of_levels", shares);
    options.propagation.fine_to_coarse = false;
    report.run(std::string(preset) + "_finest_level_alone", scene, options);
  }
}

void figure_8a(const Setup& setup, Report& report) {
  SyntheticOptions made = pictures(setup, "garden", 101);
  made.disparity = {-0.2, 0.2};  // as much parallax from end to end as 50 views with ±0.4
  const Scene all = synthetic_scene(made);
  for (const char* preset : {"paper", "auto"})
    for (const int views : {3, 5, 10, 25, 50, 101}) {
      Scene scene = all;
      if (views < 101) scene.light_field = without(all.light_field, all_but_even(101, views));
      const std::string& name = all.light_field.views[all.view].name;
      scene.view = int(std::ranges::find(scene.light_field.views, name, &View::name) -
                       scene.light_field.views.begin());
      DepthOptions options = preset_options(preset);
      options.hypotheses = 256;
      report.run(std::string(preset) + "_" + std::to_string(scene.light_field.num_views()), scene,
                 options);
    }
}

void figure_8c(const Setup& setup, Report& report) {
  for (const char* preset : {"paper", "auto"})
    for (const double share : {0.0, 0.1, 0.2, 0.3, 0.5}) {
      SyntheticOptions made = pictures(setup, "garden", 51);
      made.outliers = share;
      const Scene scene = synthetic_scene(made);
      report.run(std::string(preset) + "_outliers_" + text(share), scene, preset_options(preset));
      report.note("outliers", share);
      if (preset == std::string("paper"))
        report.write("epi_outliers_" + text(share), middle_epi(scene.light_field));
    }
}

void kernels(const Setup& setup, Report& report) {
  const Scene scene = scene_of(setup, "garden", 51);
  report.run("paper", scene, paper_options());
  for (const float bandwidth : {0.005f, 0.01f, 0.04f, 0.08f}) {
    DepthOptions options = paper_options();
    options.score.bandwidth = bandwidth;
    report.run("bandwidth_" + text(bandwidth), scene, options);
  }
  DepthOptions encoded = paper_options();
  encoded.score.linear_rgb = false;
  report.run("encoded_colours", scene, encoded);
  DepthOptions cubic = paper_options();
  cubic.score.cubic = true;
  report.run("cubic_samples", scene, cubic);
  DepthOptions refined = paper_options();
  refined.winner.refine = true;
  report.run("refined_winner", scene, refined);
  DepthOptions triangle = paper_options();
  triangle.score.gradient = true;
  triangle.score.mean_shift_iterations = 0;
  report.run("triangle_kernel_with_gradient", scene, triangle);
  report.run("auto", scene, auto_options());
}

void iterations(const Setup& setup, Report& report) {
  const Scene scene = scene_of(setup, "garden", 51);
  for (const int count : {0, 1, 2, 5, 10, 20}) {
    DepthOptions options = paper_options();
    options.score.mean_shift_iterations = count;
    report.run("iterations_" + std::to_string(count), scene, options);
  }
}

void row_or_grid(const Setup& setup, Report& report) {
  Scene grid;
  if (setup.input) {
    grid = scene_from(*setup.input);
  } else {
    SyntheticOptions made = pictures(setup, "garden", 9);
    made.views_t = 9;
    grid = synthetic_scene(made);
  }
  const std::vector<View>& views = grid.light_field.views;
  const View middle = views[grid.view];
  const auto part = [&](auto is_kept) {
    std::vector<int> left_out;
    for (int i = 0; i < int(views.size()); ++i)
      if (!is_kept(views[i])) left_out.push_back(i);
    Scene scene = grid;
    scene.light_field = without(grid.light_field, left_out);
    scene.light_field.kind = kind_from_positions(scene.light_field.views);
    scene.view = int(std::ranges::find(scene.light_field.views, middle.name, &View::name) -
                     scene.light_field.views.begin());
    return scene;
  };
  const auto is_near = [](double a, double b) { return std::abs(a - b) < 0.25; };
  const Scene row = part([&](const View& view) { return is_near(view.t, middle.t); });
  const Scene cross = part(
      [&](const View& view) { return is_near(view.t, middle.t) || is_near(view.s, middle.s); });
  for (const char* preset : {"paper", "auto"}) {
    report.run(std::string(preset) + "_row", row, preset_options(preset));
    report.run(std::string(preset) + "_cross", cross, preset_options(preset));
    report.run(std::string(preset) + "_grid", grid, preset_options(preset));
  }
}

}  // namespace

const std::vector<Experiment>& all_experiments() {
  static const std::vector<Experiment> all{
      {"figure_4", "what the bilateral median keeps: none, plain, bilateral", figure_4},
      {"figure_5", "fine-to-coarse: with, without, and what each level decides", figure_5},
      {"figure_8a", "error and time against the number of views (8b: the map of 11 views)",
       figure_8a, false},
      {"figure_8c", "something walks through a share of the views", figure_8c, false},
      {"kernels", "bandwidth, colours, interpolation and kernel of the score", kernels},
      {"iterations", "number of mean-shift iterations", iterations},
      {"row_or_grid", "3D row, cross and 4D grid of the same scene", row_or_grid}};
  return all;
}

}  // namespace gigaray::experiments
