// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/scene_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/adapters/reader.h"
#include "gigaray/core/error.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}
bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

void require(const fs::path& path) {
  if (!is_there(path))
    throw Error(ErrorCode::kBadInput, path.string() + ": no such file or folder");
}

constexpr std::initializer_list<const char*> kTruthNames{
    "truth.pfm", "gt_disp_lowres.pfm", "disp2.png", "disp1.png", "disp0GT.pfm", "disp0.pfm"};

/// The path itself, or the first of `names` that the folder has, or nothing.
fs::path look_for_map(const fs::path& path, std::initializer_list<const char*> names) {
  require(path);
  if (!is_folder(path)) return path;
  for (const char* name : names)
    if (is_there(path / name)) return path / name;
  return {};
}

fs::path find_map(const fs::path& path, std::initializer_list<const char*> names) {
  const fs::path found = look_for_map(path, names);
  if (found.empty())
    throw Error(ErrorCode::kBadInput, fmt::format("{}: the folder has no {}; name a disparity map",
                                                  path.string(), fmt::join(names, " and no ")));
  return found;
}

void require_folder(const fs::path& path, const char* content) {
  require(path);
  if (!is_folder(path))
    throw Error(ErrorCode::kBadInput,
                fmt::format("{}: `views` needs a folder with {}", path.string(), content));
}

/// Without the centre view `gigaray depth` puts another one at the top of its folder.
void refuse_another_view(const fs::path& estimate) {
  if (!is_folder(estimate)) return;
  const fs::path file = estimate / "gigaray.json";
  if (!is_there(file)) return;
  const auto root = nlohmann::json::parse(read_json_text(file), nullptr, false);
  if (!root.is_object()) return;
  const auto name = [&](const char* key) {
    return root.contains(key) && root[key].is_string() ? root[key].get<std::string>() : "";
  };
  if (name("top_level_view") != name("centre"))
    throw Error(
        ErrorCode::kBadInput,
        fmt::format("{}: holds view {} and not the centre {}; use `views` {}", estimate.string(),
                    name("top_level_view"), name("centre"), name("top_level_view")));
}

/// truth/VIEW.pfm as `gigaray synth` writes it, or the HCI benchmark's map of that camera.
fs::path truth_of_view(const fs::path& truth, const std::string& view) {
  const fs::path own = truth / "truth" / (view + ".pfm");
  constexpr std::string_view kHciPrefix = "input_";
  if (view.starts_with(kHciPrefix)) {
    const fs::path hci = truth / ("gt_disp_lowres_" + view.substr(kHciPrefix.size()) + ".pfm");
    if (is_there(hci)) return hci;
  }
  return own;
}

fs::path estimate_of_view(const fs::path& estimate, const std::string& view) {
  return estimate / view / "disparity.pfm";
}

std::set<std::string> views_with_estimate(const fs::path& estimate) {
  std::set<std::string> views;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(estimate, ignored))
    if (is_there(entry.path() / "disparity.pfm")) views.insert(entry.path().filename().string());
  return views;
}

std::vector<std::string> all_views(const std::vector<fs::path>& estimates, const fs::path& truth,
                                   const RunControl& control) {
  std::vector<std::string> views;
  int without = 0;
  for (const std::string& view : views_with_estimate(estimates.front())) {
    const bool in_all = std::all_of(estimates.begin(), estimates.end(), [&](const fs::path& path) {
      return is_there(estimate_of_view(path, view));
    });
    if (in_all && is_there(truth_of_view(truth, view)))
      views.push_back(view);
    else
      ++without;
  }
  if (views.empty())
    throw Error(ErrorCode::kBadInput,
                fmt::format("{}: no view has an estimate and a truth {}; compare one map instead",
                            estimates.front().string(), (truth / "truth/VIEW.pfm").string()));
  if (without > 0)
    control.message(fmt::format("left out, for want of a truth or an estimate: {} views", without));
  return views;
}

LabelMap read_labels(const fs::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".pfm" || extension == ".npy" || extension == ".exr") {
    const FloatMap map = read_float_map(path);
    LabelMap labels(map.width(), map.height());
    std::transform(map.begin(), map.end(), labels.begin(), [](float value) -> std::uint16_t {
      if (!std::isfinite(value) || value == 0) return 0;
      return std::uint16_t(std::clamp(std::round(value), 1.0f, 65535.0f));
    });
    return labels;
  }
  const Image<std::uint16_t> picture = read_picture(path);
  LabelMap labels(picture.width(), picture.height());
  for (int v = 0; v < picture.height(); ++v)
    for (int u = 0; u < picture.width(); ++u)
      for (int c = 0; c < picture.channels(); ++c)
        labels(u, v) = std::max(labels(u, v), picture(u, v, c));
  return labels;
}

LabelMap read_mask(const fs::path& path, int width, int height) {
  LabelMap labels = read_labels(path);
  if (labels.width() != width || labels.height() != height)
    throw Error(ErrorCode::kBadInput,
                fmt::format("{}: the mask is {} x {}, the truth {} x {}", path.string(),
                            labels.width(), labels.height(), width, height));
  return labels;
}

}  // namespace

std::vector<std::string> view_names_in(const std::string& list) {
  std::vector<std::string> names;
  std::istringstream parts(list);
  for (std::string part; std::getline(parts, part, ',');)
    if (!part.empty()) names.push_back(part);
  if (names.empty()) throw Error(ErrorCode::kInvalidArgument, "`views`: no view is named");
  return names;
}

fs::path find_truth(const fs::path& place) { return look_for_map(place, kTruthNames); }

FloatMap read_truth(const fs::path& path) {
  const std::string stem = path.stem().string();
  const bool is_quarter = stem == "disp2" || stem == "disp6";
  const bool is_stereo = is_quarter || stem == "disp1" || stem == "disp5";
  if (path.extension() != ".png" || !is_stereo) return read_float_map(path);
  const Image<std::uint16_t> grey = read_picture(path);
  const int scale = is_quarter ? 4 : grey.width() > 1000 ? 1 : grey.width() > 500 ? 2 : 3;
  FloatMap map(grey.width(), grey.height(), 1, kNoEstimate);
  for (int v = 0; v < grey.height(); ++v)
    for (int u = 0; u < grey.width(); ++u)
      if (grey(u, v, 0) > 0) map(u, v) = float(grey(u, v, 0)) / float(scale);
  return map;
}

std::vector<ViewMaps> find_view_maps(const std::vector<fs::path>& estimates, const fs::path& truth,
                                     const std::string& views, const RunControl& control) {
  if (views == "centre") {
    ViewMaps maps{"", find_map(truth, kTruthNames), {}};
    for (const fs::path& estimate : estimates) {
      maps.estimates.push_back(find_map(estimate, {"disparity.pfm"}));
      refuse_another_view(estimate);
    }
    return {maps};
  }
  for (const fs::path& path : estimates) require_folder(path, "VIEW/disparity.pfm");
  require_folder(truth, "truth/VIEW.pfm");
  const std::vector<std::string> names =
      views == "all" ? all_views(estimates, truth, control) : view_names_in(views);
  std::vector<ViewMaps> result;
  for (const std::string& view : names) {
    ViewMaps maps{view, truth_of_view(truth, view), {}};
    if (!is_there(maps.truth))
      throw Error(ErrorCode::kBadInput, maps.truth.string() + ": there is no truth of this view");
    for (const fs::path& estimate : estimates) {
      maps.estimates.push_back(estimate_of_view(estimate, view));
      if (!is_there(maps.estimates.back()))
        throw Error(ErrorCode::kBadInput,
                    maps.estimates.back().string() + ": there is no estimate of this view");
    }
    result.push_back(std::move(maps));
  }
  return result;
}

SceneParts read_scene_parts(const fs::path& truth, const std::vector<std::string>& mask_options,
                            int width, int height) {
  SceneParts parts;
  for (const std::string& option : mask_options) {
    const auto equals = option.find('=');
    if (equals == 0 || equals == std::string::npos || equals + 1 == option.size())
      throw Error(ErrorCode::kInvalidArgument,
                  "`mask` is '" + option + "'; write NAME=FILE, for example trees=trees.png");
    const std::string name = option.substr(0, equals);
    if (!parts.masks.emplace(name, read_mask(option.substr(equals + 1), width, height)).second)
      throw Error(ErrorCode::kInvalidArgument, "`mask` names '" + name + "' twice");
    parts.asked.push_back(name);
  }
  if (!is_folder(truth)) return parts;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(truth, ignored)) {
    const std::string file = entry.path().filename().string();
    constexpr std::string_view kHead = "mask_", kTail = "_lowres.png";
    if (!file.starts_with(kHead) || !file.ends_with(kTail)) continue;
    const std::string name = file.substr(kHead.size(), file.size() - kHead.size() - kTail.size());
    if (!parts.masks.contains(name))
      parts.masks.emplace(name, read_mask(entry.path(), width, height));
  }
  // A Middlebury stereo pair says what both of its pictures show.
  constexpr const char* kSeenByBoth = "nonocc";
  if (is_there(truth / "occl.png") && !parts.masks.contains(kSeenByBoth)) {
    parts.masks.emplace(kSeenByBoth, read_mask(truth / "occl.png", width, height));
    parts.asked.push_back(kSeenByBoth);
  }
  // One of the newer sets has three values there: 255 both show it, 128 one does, 0 unknown.
  constexpr std::uint16_t kBoth = 255;
  if (is_there(truth / "mask0nocc.png") && !parts.masks.contains(kSeenByBoth)) {
    LabelMap mask = read_mask(truth / "mask0nocc.png", width, height);
    for (std::uint16_t& value : mask) value = value >= kBoth;
    parts.masks.emplace(kSeenByBoth, std::move(mask));
    parts.asked.push_back(kSeenByBoth);
  }
  try {
    parts.rig = open_light_field(truth).rig;
  } catch (const Error&) {
    // A folder of maps alone is fine; what needs the rig has no score then.
  }
  return parts;
}

}  // namespace gigaray
