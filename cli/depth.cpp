// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cameras.h"
#include "command.h"
#include "depth_options_cli.h"
#include "did_you_mean.h"
#include "gigaray/adapters/depth_folder.h"
#include "gigaray/adapters/path_text.h"
#include "gigaray/metric_depth.h"
#include "gigaray/reconstruct.h"
#include "gigaray/rig_cameras.h"
#include "numbers.h"
#include "output_option.h"
#include "photographs.h"
#include "view_list.h"

namespace gigaray::cli {
namespace {

using nlohmann::ordered_json;

struct Settings {
  DepthRunOptions run;
  std::string views = "all";
  double min_confidence = 0;
  OutputOption output;
  std::vector<std::string> formats;
  bool json = false;
};

double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024.0;
}

/// Share of pixels that each level decided.
class Coverage {
 public:
  explicit Coverage(int levels) : counts_(levels + 1) {}
  void add(const ViewDepth& depth) {
    for (const std::int8_t level : depth.level) ++counts_[level + 1];
    total_ += double(depth.level.size());
  }
  ordered_json json() const {
    ordered_json shares = ordered_json::array();
    for (std::size_t level = 1; level < counts_.size(); ++level)
      shares.push_back(counts_[level] / total_);
    return {{"per_level", shares}, {"none", counts_[0] / total_}};
  }

 private:
  std::vector<double> counts_;  ///< [0]: no estimate
  double total_ = 0;
};

double share_of_estimates(const ViewDepth& depth) {
  const auto known = std::count_if(depth.disparity.begin(), depth.disparity.end(),
                                   [](float d) { return !std::isnan(d); });
  return double(known) / double(depth.disparity.size());
}

ordered_json options_json(const Reconstruction& result) {
  const DepthOptions& o = result.options();
  const HypothesisRange h = result.hypotheses();
  return {{"preset", o.preset},
          {"disparity_range", {h.min, h.max}},
          {"hypotheses", h.count},
          {"linear_rgb", o.score.linear_rgb},
          {"gradient", o.score.gradient},
          {"remove_jpeg_blocks", o.score.remove_jpeg_blocks},
          {"smoothing", o.score.smoothing},
          {"bandwidth", o.score.bandwidth},
          {"gradient_bandwidth", o.score.gradient_bandwidth},
          {"gradient_share", o.score.gradient_share},
          {"colour_slack", o.score.colour_slack},
          {"gradient_slack", o.score.gradient_slack},
          {"unseen", o.score.unseen},
          {"even_exposures", o.score.even_exposures},
          {"mean_shift_iterations", o.score.mean_shift_iterations},
          {"edge_threshold", o.edge.threshold},
          {"edge_squared", o.edge.squared},
          {"support_radius", o.support.radius},
          {"median_radius", o.winner.median_radius},
          {"accepted_above", o.winner.min_confidence},
          {"peak_share", o.winner.peak_share},
          {"peak_width", o.winner.peak_width},
          {"widest_peak", o.winner.widest_peak},
          {"calibrated_confidence", o.winner.calibrated},
          {"ray_mean", o.score.ray_mean},
          {"jump_price", o.support.jump_price},
          {"jump_sigma_colour", o.support.jump_sigma_colour},
          {"fill_hidden", o.support.fill_hidden},
          {"refine", o.winner.refine},
          {"propagation_tolerance", o.propagation.tolerance},
          {"consensus", o.propagation.consensus}};
}

ordered_json light_field_json(const LightField& light_field) {
  const auto number = [](const std::optional<double>& value) {
    return value ? ordered_json(*value) : ordered_json(nullptr);
  };
  const RigGeometry& rig = light_field.rig;
  ordered_json result{{"format", light_field.format},
                      {"kind", to_string(light_field.kind)},
                      {"width", light_field.width},
                      {"height", light_field.height},
                      {"num_views", light_field.num_views()},
                      {"rig",
                       {{"focal_px", number(rig.focal_px)},
                        {"baseline", number(rig.baseline)},
                        {"focus_distance", number(rig.focus_distance)},
                        {"unit", rig.unit}}}};
  if (const auto& point = rig.principal_point)
    result["rig"]["principal_point_px"] = {point->x(), point->y()};
  return result;
}

/// What was said of the input, for who opens it again.
ordered_json opened_with_json(const OpenOptions& options) {
  ordered_json root = ordered_json::object();
  for (const auto& [key, path] : {std::pair("positions", &options.positions),
                                  {"images", &options.images},
                                  {"masks", &options.masks}})
    if (!path->empty()) root[key] = path_text(std::filesystem::absolute(*path));
  if (options.grid.rows > 0)
    root["grid"] = {options.grid.rows, options.grid.columns, options.grid.snake};
  if (options.lenslet.columns > 0)
    root["lenslet"] = {options.lenslet.columns, options.lenslet.rows};
  if (options.convention) root["convention"] = name_of(*options.convention);
  return root;
}

/// Unit of depth.pfm; null when there is none.
ordered_json depth_unit(const LightField& light_field) {
  if (!has_metric_depth(light_field)) return nullptr;
  return light_field.rig.unit.empty() ? "unknown" : light_field.rig.unit;
}

const char* disparity_unit(const LightField& light_field) {
  return light_field.kind == LightFieldKind::kUnstructured
             ? "inverse depth, 1 / depth_unit; larger is nearer"
             : "level-0 px per view step; positive is nearer";
}

/// A rig that is focused, without a word of where, sees much beyond infinity.
void tell_of_infinity(const FloatMap& disparity, const LightField& light_field,
                      const std::string& view, const RunControl& control) {
  if (light_field.kind == LightFieldKind::kUnstructured || !has_metric_depth(light_field) ||
      light_field.rig.focus_distance)
    return;
  const auto beyond =
      std::count_if(disparity.begin(), disparity.end(), [](float d) { return d < 0; });
  constexpr double kMany = 0.02;
  const double share = double(beyond) / double(disparity.size());
  if (share > kMany)
    control.message(
        fmt::format("{:.0f} % of {} have a disparity below 0, that of nothing in a rig without "
                    "focus, and get no depth; --focus-distance states what has disparity 0",
                    100 * share, view));
}

void run(const Settings& settings, const RunControl& control) {
  const auto begin = std::chrono::steady_clock::now();
  const auto pictures = std::make_shared<KeptPictures>(settings.run.memory_gib * double(1 << 30));
  DepthRunOptions asked = settings.run;
  asked.input.open.kept = pictures;
  std::set<MapFormat> formats;
  for (const std::string& name : settings.formats)
    formats.insert(name == "exr"          ? MapFormat::kExr
                   : name == "npy"        ? MapFormat::kNpy
                   : name == "colmap"     ? MapFormat::kColmap
                   : name == "nerfstudio" ? MapFormat::kNerfstudio
                                          : MapFormat::kPng16);
  DepthFolder folder(settings.output.path, formats,
                     settings.output.rules(settings.run.input.places()));
  LightField light_field = open_or_find_cameras(asked.input, settings.output, control);
  for (const std::string& note : light_field.notes) control.message(note);
  DepthOptions options = asked.resolve(light_field, control);
  options.views = parse_views(settings.views, light_field);
  folder.describe(light_field, formats.contains(MapFormat::kNerfstudio)
                                   ? RigCameras(light_field).cameras()
                                   : std::vector<Camera>());

  Reconstruction result = reconstruct(light_field, options, asked.backend(), control);

  const int centre = views_from_centre(light_field).front();
  ordered_json views = ordered_json::array();
  Coverage all(result.num_levels()), of_centre(result.num_levels());
  const std::vector<int>& active = result.views();
  // Without the centre view, the one nearest to it stands at top level.
  int top = active.front();
  for (const int view : views_from_centre(light_field))
    if (std::find(active.begin(), active.end(), view) != active.end()) {
      top = view;
      break;
    }
  ordered_json left_out = ordered_json::array();
  for (const View& view : light_field.left_out)
    left_out.push_back({{"name", view.name}, {"s", view.s}, {"t", view.t}});
  double kept = settings.min_confidence > 0 ? 0 : 1;
  for (std::size_t i = 0; i < active.size(); ++i) {
    control.progress("write", double(i), double(active.size()));
    const View& view = light_field.views[active[i]];
    ViewDepth depth = result.view(active[i]);
    if (settings.min_confidence > 0) {
      drop_unsure(float(settings.min_confidence), depth);
      kept += share_of_estimates(depth) / double(active.size());
    }
    all.add(depth);
    if (active[i] == top) of_centre.add(depth);
    if (active[i] == top) tell_of_infinity(depth.disparity, light_field, view.name, control);
    DisparityRange pictured{result.hypotheses().min, result.hypotheses().max};
    views.push_back({{"name", view.name}, {"s", view.s}, {"t", view.t}});
    if (!result.cameras().empty()) {
      const Camera& camera = result.cameras()[active[i]];
      views.back()["camera"] = camera_json(camera);
      pictured = {camera.inverse_depth->min, camera.inverse_depth->max};
    }
    folder.write_view(active[i], std::move(depth.disparity), std::move(depth.confidence), pictured,
                      active[i] == top);
  }

  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  ordered_json root{{"format", kDepthFormat},
                    {"version", 1},
                    {"program", "gigaray " GIGARAY_VERSION},
                    {"input", path_text(std::filesystem::absolute(settings.run.input.input))},
                    {"opened_with", opened_with_json(settings.run.input.open)},
                    {"light_field", light_field_json(light_field)},
                    {"options", options_json(result)},
                    {"unit", disparity_unit(light_field)},
                    {"depth_unit", depth_unit(light_field)},
                    {"centre", light_field.views[centre].name},
                    {"top_level_view", light_field.views[top].name},
                    {"views", views},
                    {"left_out", left_out},
                    {"device", result.device()},
                    {"coverage", {{"top_level_view", of_centre.json()}, {"all", all.json()}}},
                    {"min_confidence", settings.min_confidence},
                    {"kept", kept},
                    {"tuples", result.num_tuples()},
                    {"pictures_decoded", pictures->num_decoded()},
                    {"seconds", result.seconds()},
                    {"seconds_total", seconds},
                    {"peak_memory_mib", peak_memory_mib()},
                    {"bands", result.forecast().bands},
                    {"forecast_memory_mib", result.forecast().memory_bytes / (1 << 20)},
                    {"disk_mib", result.forecast().disk_bytes / (1 << 20)}};
  const std::string text = root.dump(2, ' ', false, ordered_json::error_handler_t::replace);
  folder.commit(text, control);
  control.progress("write", 1, 1);
  if (settings.json)
    fmt::print("{}\n", text);
  else
    fmt::print("{}: {} views in {:.1f} s on {}\n", settings.output.path.string(), active.size(),
               seconds, result.device());
  if (const std::string note = note_on_scale(light_field); !note.empty()) control.message(note);
}

/// How closely COLMAP looks at photographs.
void add_quality_option(CLI::App& app, ColmapQuality& quality) {
  const std::map<std::string, ColmapQuality> qualities{{"low", ColmapQuality::kLow},
                                                       {"medium", ColmapQuality::kMedium},
                                                       {"high", ColmapQuality::kHigh}};
  app.add_option_function<std::string>(
         "--quality",
         [&quality, qualities](const std::string& name) { quality = qualities.at(name); },
         "How closely COLMAP looks at photographs for their cameras: low (1000 px, 2048 features), "
         "medium (1600 px, 4096) or high (3200 px, 8192); default: medium")
      ->check(one_of({"low", "medium", "high"}))
      ->option_text("low|medium|high");
}

}  // namespace

Run depth_command(CLI::App& app) {
  app.description("Depth for every view of a light field");
  auto settings = std::make_shared<Settings>();
  settings->run.add_to(app);
  settings->run.add_depth_to(app);
  app.add_flag("--find-cameras", settings->run.input.find_cameras,
               "Find the cameras of a folder of pictures with COLMAP even if they look like a row "
               "(default: when they don't)");
  add_quality_option(app, settings->run.input.quality);
  settings->output.add_to(app, "Folder for the result")->required();
  app.add_option("--views", settings->views,
                 "all, centre, or a list of names, indices and ranges: 0,4-6,view_09")
      ->capture_default_str();
  app.add_option(
         "--min-confidence", settings->min_confidence,
         "Leave out (NaN) what is less sure; with auto the probability of being right within "
         "0.07 px")
      ->check(zero_or_more())
      ->type_name("C");
  app.add_option("--format", settings->formats,
                 "Maps in these formats too: exr, npy, png16; colmap: a dense workspace for "
                 "`colmap stereo_fusion`; nerfstudio: transforms.json with pictures, depth and "
                 "points")
      ->check(one_of({"exr", "npy", "png16", "colmap", "nerfstudio"}))
      ->delimiter(',');
  app.add_flag("--json", settings->json, "Print gigaray.json to stdout");
  return [settings](const RunControl& control) { run(*settings, control); };
}

}  // namespace gigaray::cli
