// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "depth_info.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "flag_names.h"
#include "gigaray/adapters/depth_folder.h"
#include "gigaray/adapters/depth_result.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/path_text.h"
#include "gigaray/core/metric_depth.h"
#include "gigaray/workflows/cameras.h"
#include "gigaray/workflows/map_statistics.h"

namespace gigaray::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr double kLow = 0.05, kHigh = 0.95;

ordered_json range_json(const SortedValues& values, const std::string& unit) {
  if (values.empty()) return nullptr;
  return {{"low", values.quantile(kLow)},
          {"median", values.quantile(0.5)},
          {"high", values.quantile(kHigh)},
          {"unit", unit}};
}

struct Pixel {
  int u = 0, v = 0;
};

/// The pixel with an estimate that is nearest to the middle; empty: there is none.
std::optional<Pixel> known_pixel(const FloatMap& map) {
  std::optional<Pixel> best;
  double nearest = std::numeric_limits<double>::infinity();
  for (int v = 0; v < map.height(); ++v)
    for (int u = 0; u < map.width(); ++u) {
      const double away = std::hypot(u - map.width() / 2, v - map.height() / 2);
      if (std::isnan(map(u, v)) || away >= nearest) continue;
      nearest = away;
      best = Pixel{u, v};
    }
  return best;
}

/// A place beside the top view that all views know how to reach.
std::string pose_beside(const LightField& light_field, int top) {
  const View& view = light_field.views[top];
  if (light_field.kind != LightFieldKind::kUnstructured)
    return fmt::format("--pose {:.6g},{:.6g}", view.s + 0.5, view.t);
  LightField placed = light_field;
  const double step = place_by_cameras(placed);
  return fmt::format("--pose {}", shell_word(fmt::format("{}+{:.3g},0,0", view.name, step / 2)));
}

bool stand_apart(const LightField& light_field) {
  return std::ranges::any_of(light_field.cameras, [&](const Camera& camera) {
    return camera.position() != light_field.cameras.front().position();
  });
}

std::vector<std::string> commands() {
  return {
#define GIGARAY_COMMAND(name) #name,
#include "commands.inc"
#undef GIGARAY_COMMAND
  };
}

std::string unit_of(const LightField& light_field) {
  if (!light_field.rig.unit.empty()) return light_field.rig.unit;
  return light_field.kind == LightFieldKind::kUnstructured ? "units of the cameras" : "scene units";
}

double number_at(const ordered_json& root, const char* key) {
  const auto found = root.find(key);
  return found != root.end() && found->is_number() ? found->get<double>() : 0.0;
}

}  // namespace

ordered_json map_json(const FloatMap& disparity, const LightField& light_field) {
  const SortedValues values(disparity);
  const bool posed = light_field.kind == LightFieldKind::kUnstructured;
  const std::string unit = unit_of(light_field);
  ordered_json result;
  result["disparity"] =
      range_json(values, posed ? "inverse depth, 1 / " + unit : "px per view step");
  result["depth"] = nullptr;
  if (has_metric_depth(light_field))
    result["depth"] = range_json(SortedValues(depth_from_disparity(disparity, light_field)), unit);
  result["coverage"] = values.share();
  return result;
}

ordered_json next_lines(const fs::path& result, const LightField& light_field, int top,
                        const FloatMap& disparity) {
  const std::vector<std::string> known = commands();
  const std::string place = shell_word(result);
  ordered_json lines = ordered_json::array();
  const auto add = [&](const std::string& command, const std::string& rest) {
    if (std::ranges::find(known, command) != known.end())
      lines.push_back(fmt::format("gigaray {} {} {}", command, place, rest));
  };
  // Points are confirmed by two other views as a rule.
  constexpr int kWitnesses = 2;
  const int others = light_field.num_views() - 1;
  const std::string support =
      others < kWitnesses ? fmt::format(" --min-support {}", others) : std::string();
  add("cloud", "-o scene.ply" + support);
  add("mesh", "-o scene.glb" + support);
  const std::optional<Pixel> pixel = known_pixel(disparity);
  if (pixel && fs::is_directory(result))
    add("segment", fmt::format("--at {} {} -o masks", pixel->u, pixel->v));
  if (light_field.kind != LightFieldKind::kUnstructured || stand_apart(light_field))
    add("render", pose_beside(light_field, top) + " -o novel");
  return lines;
}

ordered_json depth_json(const fs::path& folder) {
  const DepthResult depth(folder);
  const LightField& light_field = depth.light_field();
  const int top = depth.top_view();
  const FloatMap disparity = depth.disparity(top);
  const fs::path path = folder / "gigaray.json";
  const auto about = ordered_json::parse(read_json_text(path), nullptr, false);
  ordered_json root{{"format", kDepthFormat}};
  root["program"] = about.value("program", ordered_json("an older gigaray"));
  root["folder"] = path_text(folder);
  root["input"] = path_text(depth.input());
  std::error_code ignored;
  root["input_exists"] = fs::exists(depth.input(), ignored);
  root["input_format"] = light_field.format;
  root["kind"] = to_string(light_field.kind);
  root["views"] = light_field.num_views();
  root["first_view"] = light_field.views.front().name;
  root["last_view"] = light_field.views.back().name;
  root["top_level_view"] = light_field.views[top].name;
  root["width"] = disparity.width();
  root["height"] = disparity.height();
  root.update(map_json(disparity, light_field));
  root["searched"] = {depth.searched().min, depth.searched().max};
  root["hypotheses"] = depth.hypotheses();
  const SortedValues confidence(depth.confidence(top));
  root["confidence"] = nullptr;
  if (!confidence.empty())
    root["confidence"] = {{"median", confidence.quantile(0.5)},
                          {"above_half", confidence.share_above(0.5)}};
  root["min_confidence"] = number_at(about, "min_confidence");
  root["device"] = about.value("device", ordered_json("unknown"));
  root["seconds"] = number_at(about, "seconds_total");
  root["peak_memory_mib"] = number_at(about, "peak_memory_mib");
  if (const std::string note = note_on_scale(light_field); !note.empty())
    root["note"] = with_flags(note);
  root["next"] = next_lines(folder, light_field, top, disparity);
  return root;
}

std::string range_text(const ordered_json& range) {
  if (range.is_null()) return "none";
  const auto number = [&](const char* key) { return range.at(key).get<double>(); };
  return fmt::format("{:.4g} … {:.4g} … {:.4g} {}", number("low"), number("median"), number("high"),
                     range.at("unit").get<std::string>());
}

}  // namespace gigaray::cli
