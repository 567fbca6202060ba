// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "depth_record.h"
#include "gigaray/version.h"

#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "gigaray/adapters/depth_folder.h"
#include "gigaray/adapters/options_file.h"
#include "gigaray/adapters/path_text.h"
#include "gigaray/core/metric_depth.h"
#include "gigaray/engine/option_table.h"

namespace gigaray {

using nlohmann::ordered_json;

namespace {

double peak_memory_mib() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024.0;
}

ordered_json main_options_json(const Reconstruction& result) {
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

ordered_json json_of(const DepthOptions& options) {
  return ordered_json::parse(options_json(option_values(options)));
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

/// Empty: pictures that lie in memory.
std::string place_of(const std::filesystem::path& input) {
  return input.empty() ? "" : path_text(std::filesystem::absolute(input));
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

ordered_json places_left_out(const LightField& light_field) {
  ordered_json left_out = ordered_json::array();
  for (const View& view : light_field.left_out)
    left_out.push_back({{"name", view.name}, {"s", view.s}, {"t", view.t}});
  return left_out;
}

}  // namespace

void Coverage::add(const ViewDepth& depth) {
  for (const std::int8_t level : depth.level) ++counts_[level + 1];
  total_ += double(depth.level.size());
}

ordered_json Coverage::json() const {
  ordered_json shares = ordered_json::array();
  for (std::size_t level = 1; level < counts_.size(); ++level)
    shares.push_back(counts_[level] / total_);
  return {{"per_level", shares}, {"none", counts_[0] / total_}};
}

int top_view_of(const LightField& light_field, const std::vector<int>& active) {
  for (const int view : views_from_centre(light_field))
    if (std::find(active.begin(), active.end(), view) != active.end()) return view;
  return active.front();
}

ordered_json depth_record(const OpenedInput& input, const Reconstruction& result,
                          const WrittenViews& written, double seconds) {
  const LightField& light_field = input.light_field;
  const int centre = views_from_centre(light_field).front();
  const auto& kept = input.request.open.kept;
  return {{"format", kDepthFormat},
          {"version", 1},
          {"program", "gigaray " GIGARAY_VERSION},
          {"input", place_of(input.request.path)},
          {"opened_with", opened_with_json(input.request.open)},
          {"light_field", light_field_json(light_field)},
          {"options", main_options_json(result)},
          {"options_asked", json_of(input.asked.value_or(result.options()))},
          {"options_used", json_of(result.options())},
          {"unit", disparity_unit(light_field)},
          {"depth_unit", depth_unit(light_field)},
          {"centre", light_field.views[centre].name},
          {"top_level_view", light_field.views[written.top].name},
          {"views", written.views},
          {"left_out", places_left_out(light_field)},
          {"device", result.device()},
          {"coverage", {{"top_level_view", written.of_top.json()}, {"all", written.all.json()}}},
          {"min_confidence", written.min_confidence},
          {"kept", written.kept},
          {"tuples", result.num_tuples()},
          {"pictures_decoded", kept ? kept->num_decoded() : 0},
          {"seconds", result.seconds()},
          {"seconds_total", seconds},
          {"peak_memory_mib", peak_memory_mib()},
          {"bands", result.forecast().bands},
          {"forecast_memory_mib", result.forecast().memory_bytes / (1 << 20)},
          {"disk_mib", result.forecast().disk_bytes / (1 << 20)}};
}

}  // namespace gigaray
