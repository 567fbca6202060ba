// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/view_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/path_text.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/adapters/shrunk.h"
#include "gigaray/core/arguments.h"
#include "gigaray/core/metric_depth.h"
#include "gigaray/core/ray_sampler.h"
#include "gigaray/core/scaled_camera.h"
#include "gigaray/workflows/scene_truth.h"
#include "gigaray/workflows/view_list.h"
#include "scene_maps.h"
#include "scene_scores.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// The last part of a path that may end with a slash.
std::string title_of(const std::string& name) {
  const fs::path whole = fs::absolute(name).lexically_normal();
  return path_text((whole.has_filename() ? whole : whole.parent_path()).filename());
}

/// `first`, and the views that stand farthest from all before them.
std::vector<int> spread_views(const LightField& light_field, const std::vector<int>& among,
                              int first, std::size_t most) {
  std::vector<int> chosen{first};
  const auto gap = [&](int view) {
    double least = INFINITY;
    for (const int other : chosen)
      least = std::min(least, std::hypot(light_field.views[view].s - light_field.views[other].s,
                                         light_field.views[view].t - light_field.views[other].t));
    return least;
  };
  while (chosen.size() < std::min(most, among.size())) {
    const int next = *std::ranges::max_element(among, {}, gap);
    if (!(gap(next) > 0)) break;
    chosen.push_back(next);
  }
  std::ranges::sort(chosen);
  return chosen;
}

ordered_json json_of_camera(const Camera& camera) {
  ordered_json rotation = ordered_json::array();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) rotation.push_back(camera.rotation(i, j));
  return {
      {"focal", {camera.focal_u, camera.focal_v}},
      {"centre", {camera.centre_u, camera.centre_v}},
      {"rotation", rotation},
      {"translation", {camera.translation.x(), camera.translation.y(), camera.translation.z()}}};
}

/// The picture of a view as far as its own camera shows it.
std::string jpeg_of_view(const LightField& light_field, int view, int width, int height,
                         int quality) {
  Image<std::uint16_t> picture = read_view(light_field, view);
  take_mask(picture);
  const int shift = light_field.pixels->bit_depth() - 8;
  Image<std::uint8_t> bytes(width, height, 3);
  for (int v = 0; v < height; ++v)
    std::transform(picture.row(v), picture.row(v) + 3 * width, bytes.row(v),
                   [&](std::uint16_t value) { return std::uint8_t(value >> shift); });
  return jpeg_bytes(bytes, quality);
}

/// Makes a scene: pictures of all views, maps of some.
class SceneMaker {
 public:
  /// depth: null where there is none.
  SceneMaker(const LightField& light_field, const RigCameras& rig, DepthScene* depth,
             const ViewSceneRequest& request, const TakeSceneFile& take, const RunControl& control)
      : full_(light_field),
        small_(shrunk(light_field, request.max_size)),
        rig_(rig),
        depth_(depth),
        request_(request),
        take_(take),
        control_(control) {
    require_argument(request.jpeg_quality >= 1 && request.jpeg_quality <= 100,
                     "`jpeg_quality` must be between 1 and 100");
    if (depth_) choose_views();
  }

  ordered_json scene(const std::string& name);

 private:
  struct ShownMaps {
    FloatMap values, confidence, error;
  };

  bool is_posed() const { return full_.kind == LightFieldKind::kUnstructured; }
  double scale() const { return double(small_.width) / full_.width; }
  /// Camera of what is shown of a view.
  Camera camera(int view) const {
    if (is_posed()) return small_.cameras[std::size_t(view)];
    Camera camera = scaled(rig_.camera(view), scale(), double(small_.height) / full_.height);
    camera.width = small_.width;
    camera.height = small_.height;
    return camera;
  }
  void choose_views();
  ShownMaps read_maps(DepthScene& scene, int view) const;
  FloatMap error_of(int view, const FloatMap& estimate) const;
  void read_all_maps();
  ordered_json take_value(const std::string& name, const FloatMap& map, const MapCodes& codes);
  ordered_json maps_json(const std::string& stem, const ShownMaps& maps);
  ordered_json depth_json() const;
  ordered_json inverse_depth_json() const;
  ordered_json views_json();
  ordered_json compare_json();
  ordered_json scores_json();
  void take_file(ordered_json& scene, const char* field, const fs::path& path,
                 const std::string& name);

  const LightField& full_;
  LightField small_;
  const RigCameras& rig_;
  DepthScene* depth_;
  const ViewSceneRequest& request_;
  const TakeSceneFile& take_;
  const RunControl& control_;
  std::vector<int> chosen_;
  std::map<int, ShownMaps> maps_, others_;
  MapCodes values_, errors_;
};

void SceneMaker::choose_views() {
  if (request_.views.empty()) {
    constexpr std::size_t kMost = 9;
    chosen_ = spread_views(full_, depth_->views(), depth_->top_view(), kMost);
    return;
  }
  chosen_ = parse_views(request_.views, full_);
  if (chosen_.empty()) chosen_ = depth_->views();  // all
  for (const int view : chosen_)
    if (std::ranges::count(depth_->views(), view) == 0)
      throw Error(ErrorCode::kInvalidArgument, fmt::format("`views`: {} has no depth in {}",
                                                           full_.views[view].name, depth_->name()));
}

SceneMaker::ShownMaps SceneMaker::read_maps(DepthScene& scene, int view) const {
  const Camera shown = camera(view);
  const FloatMap confidence = scene.confidence(view);
  return {picked(scene.disparity(view), shown.width, shown.height),
          confidence.empty() ? FloatMap() : picked(confidence, shown.width, shown.height),
          {}};
}

/// Estimate − truth, in the unit of the estimate; empty: the truth of this view is not known.
FloatMap SceneMaker::error_of(int view, const FloatMap& estimate) const {
  if (request_.truth.empty()) return {};
  fs::path path = request_.truth / "truth" / (full_.views[std::size_t(view)].name + ".pfm");
  std::error_code ignored;
  if (!fs::exists(path, ignored))
    path = view == depth_->top_view() ? find_truth(request_.truth) : fs::path();
  if (path.empty()) return {};
  const FloatMap truth = read_truth(path);
  const Camera& own = rig_.camera(view);
  if (truth.width() != own.width || truth.height() != own.height)
    throw Error(ErrorCode::kBadInput,
                fmt::format("{}: is {} × {} px, the pictures are {} × {} px", path_text(path),
                            truth.width(), truth.height(), own.width, own.height));
  FloatMap error = picked(truth, estimate.width(), estimate.height());
  for (std::size_t i = 0; i < error.size(); ++i) {
    // The truth of photographs is depth; where there is none it is 0.
    const float known = is_posed() ? 1 / error.data()[i] : error.data()[i];
    error.data()[i] = std::isfinite(known) ? estimate.data()[i] - known : kNoEstimate;
  }
  return error;
}

void SceneMaker::read_all_maps() {
  for (const int view : chosen_) {
    control_.progress("maps", double(maps_.size()), double(chosen_.size()));
    ShownMaps maps = read_maps(*depth_, view);
    maps.error = error_of(view, maps.values);
    values_.include(maps.values);
    errors_.include(maps.error);
    maps_[view] = std::move(maps);
    if (!request_.compare) continue;
    DepthScene& other = *request_.compare;
    const int twin = other.find(full_.views[std::size_t(view)].name);
    if (twin < 0 || std::ranges::count(other.views(), twin) == 0) continue;
    const Camera &a = rig_.camera(view), &b = other.rig().camera(twin);
    if (other.light_field().kind != full_.kind || a.width != b.width || a.height != b.height)
      throw Error(ErrorCode::kBadInput, fmt::format("{}: is of another kind or size than {}",
                                                    other.name(), depth_->name()));
    ShownMaps shown = read_maps(other, twin);
    values_.include(shown.values);
    others_[view] = std::move(shown);
  }
  if (request_.compare && others_.empty())
    throw Error(ErrorCode::kBadInput, fmt::format("{}: has no view that is shown of {}",
                                                  request_.compare->name(), depth_->name()));
  values_.settle();
  errors_.settle();
}

ordered_json SceneMaker::take_value(const std::string& name, const FloatMap& map,
                                    const MapCodes& codes) {
  take_(name, packed_values(map, codes));
  return name;
}

ordered_json SceneMaker::maps_json(const std::string& stem, const ShownMaps& maps) {
  ordered_json json{{"value", take_value(stem + ".value", maps.values, values_)}};
  if (!maps.confidence.empty()) {
    take_(stem + ".confidence", packed_shares(maps.confidence));
    json["confidence"] = stem + ".confidence";
  }
  if (!maps.error.empty()) json["error"] = take_value(stem + ".error", maps.error, errors_);
  return json;
}

ordered_json SceneMaker::depth_json() const {
  if (is_posed()) return {{"unit", full_.rig.unit}};
  if (!has_metric_depth(full_)) return nullptr;
  return {{"unit", full_.rig.unit},
          {"focal_times_baseline", rig_.disparity(1) - rig_.disparity(0)},
          {"disparity_at_infinity", rig_.disparity(0)}};
}

ordered_json SceneMaker::inverse_depth_json() const {
  const double scale = rig_.disparity(1) - rig_.disparity(0);
  return {{"per_value", 1 / scale}, {"at_zero", -rig_.disparity(0) / scale}};
}

ordered_json SceneMaker::views_json() {
  ordered_json views = ordered_json::array();
  for (int i = 0; i < full_.num_views(); ++i) {
    control_.progress("pictures", i, full_.num_views());
    const View& view = full_.views[std::size_t(i)];
    const Camera shown = camera(i);
    const std::string stem = fmt::format("view_{:04}", i);
    take_(stem + ".jpg", jpeg_of_view(small_, i, shown.width, shown.height, request_.jpeg_quality));
    const auto maps = maps_.find(i);
    views.push_back(
        {{"name", view.name},
         {"s", view.s},
         {"t", view.t},
         {"width", shown.width},
         {"height", shown.height},
         {"image", stem + ".jpg"},
         {"camera", json_of_camera(shown)},
         {"maps", maps == maps_.end() ? ordered_json(nullptr) : maps_json(stem, maps->second)}});
  }
  return views;
}

ordered_json SceneMaker::scores_json() {
  const int view = depth_ ? depth_->top_view() : centre_view(full_);
  const Camera shown = camera(view);
  return scene_scores(*request_.curves, view, full_.views[std::size_t(view)].name, shown.width,
                      shown.height, scale(), take_, control_);
}

ordered_json SceneMaker::compare_json() {
  ordered_json maps = ordered_json::object();
  for (const auto& [view, shown] : others_)
    maps[full_.views[std::size_t(view)].name] = maps_json(fmt::format("other_{:04}", view), shown);
  return {{"title", title_of(request_.compare->name())}, {"maps", maps}};
}

void SceneMaker::take_file(ordered_json& scene, const char* field, const fs::path& path,
                           const std::string& name) {
  scene[field] = nullptr;
  if (path.empty()) return;
  constexpr double kMost = 1e9;  // a page of more can't be opened
  take_(name, read_bytes(path, kMost));
  scene[field] = {{"blob", name}};
}

ordered_json SceneMaker::scene(const std::string& name) {
  if (depth_) {
    read_all_maps();
  } else if (full_.declared_range) {
    values_.least = full_.declared_range->min;
    values_.most = full_.declared_range->max;
  }
  const std::string& unit = full_.rig.unit;
  ordered_json scene{
      {"format", "gigaray scene"},
      {"version", 1},
      {"title", title_of(name)},
      {"kind", to_string(full_.kind)},
      {"value",
       {{"name", is_posed() ? "inverse depth" : "disparity"},
        {"unit", is_posed() ? "1/" + (unit.empty() ? "unit" : unit) : "px per view step"},
        {"min", values_.least},
        {"max", values_.most}}},
      {"scale", scale()},
      {"depth", depth_json()},
      {"inverse_depth", inverse_depth_json()},
      {"confidence",
       {{"meaning", is_posed() ? "probability of being within 1 % of the depth"
                               : "probability of being within 0.07 px"}}},
      {"top_view", depth_ ? depth_->top_view() : centre_view(full_)},
      {"views", views_json()},
      {"segment",
       depth_ ? ordered_json{{"result", shell_word(depth_->name())}} : ordered_json(nullptr)},
      {"scores", request_.curves ? scores_json() : ordered_json(nullptr)},
      {"compare", request_.compare ? compare_json() : ordered_json(nullptr)},
      {"live", request_.is_live}};
  if (!request_.truth.empty()) {
    if (std::ranges::all_of(maps_, [](const auto& maps) { return maps.second.error.empty(); }))
      throw Error(ErrorCode::kBadInput,
                  path_text(request_.truth) + ": has no truth of a view that is shown");
    scene["error"] = {{"min", errors_.least}, {"max", errors_.most}};
  }
  take_file(scene, "cloud", request_.cloud, "cloud.ply");
  take_file(scene, "mesh", request_.mesh, "mesh.glb");
  return scene;
}

std::string text_of(const ordered_json& json) {
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace

std::string view_scene(DepthScene& scene, const ViewSceneRequest& request,
                       const TakeSceneFile& take, const RunControl& control) {
  return text_of(SceneMaker(scene.light_field(), scene.rig(), &scene, request, take, control)
                     .scene(scene.name()));
}

std::string view_scene(const LightField& light_field, const std::string& name,
                       const ViewSceneRequest& request, const TakeSceneFile& take,
                       const RunControl& control) {
  require_argument(
      !request.compare && request.truth.empty() && request.views.empty(),
      "`compare`, `truth` and `views` go with depth; this is a light field without it");
  const double least = light_field.declared_range ? light_field.declared_range->min : 0;
  const RigCameras rig(light_field, least);
  return text_of(SceneMaker(light_field, rig, nullptr, request, take, control).scene(name));
}

}  // namespace gigaray
