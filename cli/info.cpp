// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "command.h"
#include "depth_options_cli.h"
#include "gigaray/reconstruct.h"

namespace gigaray::cli {
namespace {

constexpr int kMaxDrawn = 64;      // views per axis of the drawn grid
constexpr double kMaxShift = 0.3;  // view steps from a point of the grid

using nlohmann::ordered_json;

struct InfoOptions {
  InputOptions input;
  std::string preset = "auto";
  double memory_gib = 0;
  bool json = false;
};

/// What `gigaray depth` of all views will take, or why it can't run.
struct DepthForecast {
  Forecast forecast;
  std::string refusal;  ///< Empty: it can run.
};

DepthForecast forecast_depth(const LightField& light_field, const InfoOptions& options) {
  DepthOptions depth = preset_options(options.preset);
  depth.memory_bytes = options.memory_gib * double(1 << 30);
  try {
    return {forecast(light_field, depth), ""};
  } catch (const Error& error) {
    return {{}, error.what()};
  }
}

double to_mib(double bytes) { return bytes / (1 << 20); }

struct Bounds {
  double min, max;
};

template <class Coordinate>
Bounds bounds(const std::vector<View>& views, Coordinate coordinate) {
  const auto [low, high] = std::minmax_element(
      views.begin(), views.end(),
      [&](const View& a, const View& b) { return coordinate(a) < coordinate(b); });
  return {coordinate(*low), coordinate(*high)};
}

// The camera plane seen from behind the cameras, one letter per view step; empty when the views are
// too many or too irregular for it.
std::vector<std::string> drawn_grid(const LightField& light_field) {
  const Bounds s = bounds(light_field.views, [](const View& view) { return view.s; });
  const Bounds t = bounds(light_field.views, [](const View& view) { return view.t; });
  const long columns = std::lround(s.max - s.min) + 1, rows = std::lround(t.max - t.min) + 1;
  if (columns > kMaxDrawn || rows > kMaxDrawn) return {};
  std::vector<std::string> grid(rows, std::string(2 * columns - 1, ' '));
  for (long row = 0; row < rows; ++row)
    for (long column = 0; column < columns; ++column) grid[row][2 * column] = '.';
  const int centre = centre_view(light_field);
  for (int i = 0; i < light_field.num_views(); ++i) {
    const View& view = light_field.views[i];
    const double column = view.s - s.min, row = view.t - t.min;
    if (std::abs(column - std::round(column)) > kMaxShift ||
        std::abs(row - std::round(row)) > kMaxShift)
      return {};
    char& cell = grid[std::lround(row)][2 * std::lround(column)];
    if (cell != '.') return {};
    cell = i == centre ? 'O' : 'x';
  }
  return grid;
}

std::string rig_text(const RigGeometry& rig) {
  std::vector<std::string> parts;
  const std::string unit = rig.unit.empty() ? "(unknown unit)" : rig.unit;
  if (rig.focal_px) parts.push_back(fmt::format("focal length {:.6g} px", *rig.focal_px));
  if (rig.baseline) parts.push_back(fmt::format("view step {:.6g} {}", *rig.baseline, unit));
  if (rig.focus_distance)
    parts.push_back(fmt::format("focus at {:.6g} {}", *rig.focus_distance, unit));
  return parts.empty() ? "unknown" : fmt::format("{}", fmt::join(parts, ", "));
}

std::string forecast_text(const DepthForecast& depth) {
  if (!depth.refusal.empty()) return "can't run: " + depth.refusal;
  const Forecast& forecast = depth.forecast;
  std::string text = fmt::format("takes {:.0f} MiB of memory", to_mib(forecast.memory_bytes));
  if (forecast.disk_bytes > 0)
    text += fmt::format(" and {:.0f} MiB of disk", to_mib(forecast.disk_bytes));
  if (forecast.bands > 1)
    text += fmt::format(", in {} bands of rows; {:.0f} MiB of memory would hold all",
                        forecast.bands, to_mib(forecast.memory_all_bytes));
  return text;
}

void print_text(const LightField& light_field, const DepthForecast& depth) {
  const auto line = [](const char* label, const std::string& text) {
    fmt::print("{:<11}{}\n", label, text);
  };
  const std::vector<View>& views = light_field.views;
  line("format", fmt::format("{}, {}", light_field.format, to_string(light_field.kind)));
  line("views", fmt::format("{}, {} … {}", views.size(), views.front().name, views.back().name));
  line("size", fmt::format("{} × {} px, {} bit", light_field.width, light_field.height,
                           light_field.pixels->bit_depth()));
  const Bounds s = bounds(views, [](const View& view) { return view.s; });
  const Bounds t = bounds(views, [](const View& view) { return view.t; });
  line("positions", light_field.kind == LightFieldKind::k3D
                        ? fmt::format("s {:.4g} … {:.4g} view steps", s.min, s.max)
                        : fmt::format("s {:.4g} … {:.4g}, t {:.4g} … {:.4g} view steps", s.min,
                                      s.max, t.min, t.max));
  if (light_field.kind == LightFieldKind::k4D)
    for (const std::string& row : drawn_grid(light_field)) line("", row);
  line("centre", views[centre_view(light_field)].name);
  line("rig", rig_text(light_field.rig));
  line("disparity",
       light_field.declared_range
           ? fmt::format("{:.4g} … {:.4g} px per view step, declared",
                         light_field.declared_range->min, light_field.declared_range->max)
           : "range not declared");
  line("depth", forecast_text(depth));
  for (const std::string& note : light_field.notes) line("note", note);
}

void print_json(const LightField& light_field, const DepthForecast& depth) {
  const auto number = [](const std::optional<double>& value) {
    return value ? ordered_json(*value) : ordered_json(nullptr);
  };
  ordered_json root;
  root["format"] = light_field.format;
  root["kind"] = to_string(light_field.kind);
  root["width"] = light_field.width;
  root["height"] = light_field.height;
  root["bit_depth"] = light_field.pixels->bit_depth();
  root["centre"] = light_field.views[centre_view(light_field)].name;
  root["sign_is_assumed"] = light_field.sign_is_assumed;
  root["disparity_range"] = nullptr;
  if (const auto& range = light_field.declared_range)
    root["disparity_range"] = {range->min, range->max};
  const RigGeometry& rig = light_field.rig;
  root["rig"] = {{"focal_px", number(rig.focal_px)},
                 {"baseline", number(rig.baseline)},
                 {"focus_distance", number(rig.focus_distance)},
                 {"unit", rig.unit}};
  const Forecast& forecast = depth.forecast;
  if (depth.refusal.empty())
    root["forecast"] = {{"memory_mib", to_mib(forecast.memory_bytes)},
                        {"disk_mib", to_mib(forecast.disk_bytes)},
                        {"memory_all_mib", to_mib(forecast.memory_all_bytes)},
                        {"bands", forecast.bands}};
  else
    root["forecast"] = {{"refusal", depth.refusal}};
  root["notes"] = light_field.notes;
  root["views"] = ordered_json::array();
  for (const View& view : light_field.views)
    root["views"].push_back({{"name", view.name}, {"s", view.s}, {"t", view.t}});
  fmt::print("{}\n", root.dump(2, ' ', false, ordered_json::error_handler_t::replace));
}

}  // namespace

Run info_command(CLI::App& app) {
  app.description("What an input is: kind, views, positions, rig, range; what depth of it takes");
  auto options = std::make_shared<InfoOptions>();
  options->input.add_to(app);
  add_preset_option(app, options->preset);
  add_memory_option(app, options->memory_gib);
  app.add_flag("--json", options->json, "Print JSON");
  return [options](const RunControl&) {
    const LightField light_field = options->input.open_light_field();
    const DepthForecast depth = forecast_depth(light_field, *options);
    if (options->json)
      print_json(light_field, depth);
    else
      print_text(light_field, depth);
  };
}

}  // namespace gigaray::cli
