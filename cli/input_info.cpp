// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "input_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "cameras.h"
#include "flag_names.h"
#include "gigaray/workflows/cameras.h"

namespace gigaray::cli {
namespace {

using nlohmann::ordered_json;

constexpr int kMaxDrawn = 64;  // letters per axis of the drawn grid

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

/// The views of one axis in `count` equal places from the first to the last.
struct DrawnAxis {
  Bounds bounds;
  long count;

  DrawnAxis(Bounds extent, double step)
      : bounds(extent), count(std::lround((extent.max - extent.min) / step) + 1) {}
  double place(double position) const {
    if (count == 1) return 0;
    return (position - bounds.min) / (bounds.max - bounds.min) * double(count - 1);
  }
};

/// The camera plane seen from behind the cameras: O the centre, x views, - views left out, . places
/// without a view. A letter is one view step in a regular grid; measured positions go to the
/// nearest place of the coarsest grid that has one for each. Empty when that takes too many
/// letters.
std::vector<std::string> drawn_grid(const LightField& light_field) {
  constexpr double kRegular = 0.02;                                  // view steps
  constexpr double kCoarsest = 1.25, kFinest = 0.25, kFiner = 0.95;  // view steps per letter
  std::vector<View> all = light_field.views;
  all.insert(all.end(), light_field.left_out.begin(), light_field.left_out.end());
  const Bounds s = bounds(all, [](const View& view) { return view.s; });
  const Bounds t = bounds(all, [](const View& view) { return view.t; });
  const bool regular = std::all_of(all.begin(), all.end(), [&](const View& view) {
    return std::abs(std::remainder(view.s - s.min, 1)) < kRegular &&
           std::abs(std::remainder(view.t - t.min, 1)) < kRegular;
  });
  const int centre = centre_view(light_field);
  for (double step = regular ? 1 : kCoarsest; step >= kFinest; step *= kFiner) {
    const DrawnAxis columns(s, step), rows(t, step);
    if (columns.count > kMaxDrawn || rows.count > kMaxDrawn) return {};
    std::string row(2 * columns.count - 1, ' ');
    for (long column = 0; column < columns.count; ++column) row[2 * column] = '.';
    std::vector<std::string> grid(rows.count, row);
    bool shared = false;
    for (std::size_t i = 0; i < all.size(); ++i) {
      char& cell =
          grid[std::lround(rows.place(all[i].t))][2 * std::lround(columns.place(all[i].s))];
      shared |= cell != '.';
      cell = int(i) == centre ? 'O' : i < light_field.views.size() ? 'x' : '-';
    }
    if (!shared) return grid;
  }
  return {};
}

std::string rig_text(const RigGeometry& rig) {
  std::vector<std::string> parts;
  const std::string unit = rig.unit.empty() ? "(unknown unit)" : rig.unit;
  if (rig.focal_px) parts.push_back(fmt::format("focal length {:.6g} px", *rig.focal_px));
  if (rig.baseline) parts.push_back(fmt::format("view step {:.6g} {}", *rig.baseline, unit));
  if (rig.focus_distance)
    parts.push_back(fmt::format("focus at {:.6g} {}", *rig.focus_distance, unit));
  if (const auto& point = rig.principal_point)
    parts.push_back(fmt::format("optical axis at {:.6g} {:.6g} px", point->x(), point->y()));
  return parts.empty() ? "unknown" : fmt::format("{}", fmt::join(parts, ", "));
}

std::string forecast_text(const DepthForecast& depth) {
  if (!depth.refusal.empty()) return "can't run: " + with_flags(depth.refusal);
  const Forecast& forecast = depth.forecast;
  std::string text = fmt::format("takes {:.0f} MiB of memory", to_mib(forecast.memory_bytes));
  if (forecast.disk_bytes > 0)
    text += fmt::format(" and {:.0f} MiB of disk", to_mib(forecast.disk_bytes));
  if (forecast.bands > 1)
    text += fmt::format(", in {} bands of rows; {:.0f} MiB of memory would hold all",
                        forecast.bands, to_mib(forecast.memory_all_bytes));
  return text;
}

void line(const std::string& label, const std::string& text) {
  fmt::print("{:<11}{}\n", label, text);
}

}  // namespace

void print_text(const LightField& light_field, const DepthForecast& depth) {
  const std::vector<View>& views = light_field.views;
  line("format", fmt::format("{}, {}", light_field.format, to_string(light_field.kind)));
  line("views", fmt::format("{}, {} … {}", views.size(), views.front().name, views.back().name));
  line("size", fmt::format("{} × {} px, {} bit", light_field.width, light_field.height,
                           light_field.pixels->bit_depth()));
  const Bounds s = bounds(views, [](const View& view) { return view.s; });
  const Bounds t = bounds(views, [](const View& view) { return view.t; });
  const bool posed = light_field.kind == LightFieldKind::kUnstructured;
  line("positions", light_field.kind == LightFieldKind::k3D
                        ? fmt::format("s {:.4g} … {:.4g} view steps", s.min, s.max)
                        : fmt::format("s {:.4g} … {:.4g}, t {:.4g} … {:.4g} view steps", s.min,
                                      s.max, t.min, t.max));
  if (light_field.kind == LightFieldKind::k4D)
    for (const std::string& row : drawn_grid(light_field)) line("", row);
  if (!light_field.left_out.empty())
    line("left out", fmt::format("{}, drawn as -", light_field.left_out.size()));
  line("centre", views[centre_view(light_field)].name);
  if (posed) {
    for (const auto& [label, text] : describe_cameras(light_field)) line(label, text);
  } else {
    line("rig", rig_text(light_field.rig));
    line("disparity",
         light_field.declared_range
             ? fmt::format("{:.4g} … {:.4g} px per view step, declared",
                           light_field.declared_range->min, light_field.declared_range->max)
             : "range not declared");
  }
  line("depth", forecast_text(depth));
  for (const std::string& note : light_field.notes) line("note", with_flags(note));
}

void print_json(const LightField& light_field, const DepthForecast& depth,
                const ordered_json& sparse) {
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
  if (const auto& point = rig.principal_point)
    root["rig"]["principal_point_px"] = {point->x(), point->y()};
  const Forecast& forecast = depth.forecast;
  if (depth.refusal.empty())
    root["forecast"] = {{"memory_mib", to_mib(forecast.memory_bytes)},
                        {"disk_mib", to_mib(forecast.disk_bytes)},
                        {"memory_all_mib", to_mib(forecast.memory_all_bytes)},
                        {"bands", forecast.bands}};
  else
    root["forecast"] = {{"refusal", with_flags(depth.refusal)}};
  root["notes"] = ordered_json::array();
  for (const std::string& note : light_field.notes) root["notes"].push_back(with_flags(note));
  root["views"] = ordered_json::array();
  const std::vector<int> partners = count_partners(light_field);
  for (int i = 0; i < light_field.num_views(); ++i) {
    const View& view = light_field.views[i];
    root["views"].push_back({{"name", view.name}, {"s", view.s}, {"t", view.t}});
    if (!light_field.cameras.empty())
      root["views"].back()["camera"] = ordered_json::parse(camera_json(light_field.cameras[i]));
    if (!partners.empty()) root["views"].back()["partners"] = partners[i];
  }
  root["left_out"] = ordered_json::array();
  for (const View& view : light_field.left_out)
    root["left_out"].push_back({{"name", view.name}, {"s", view.s}, {"t", view.t}});
  if (!sparse.is_null()) root["sparse"] = sparse;
  fmt::print("{}\n", root.dump(2, ' ', false, ordered_json::error_handler_t::replace));
}

}  // namespace gigaray::cli
