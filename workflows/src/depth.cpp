// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/depth.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "depth_range.h"
#include "depth_record.h"
#include "gigaray/adapters/feature_ranges.h"
#include "gigaray/adapters/pose_check.h"
#include "gigaray/applications/rig_cameras.h"
#include "gigaray/core/metric_depth.h"
#include "gigaray/engine/camera_order.h"
#include "gigaray/workflows/cameras.h"
#include "gigaray/workflows/memory_budget.h"
#include "gigaray/workflows/view_list.h"
#include "view_layout.h"

namespace gigaray {

using nlohmann::ordered_json;

namespace {

/// Finding direction and range looks at whole pictures, before the plan of the run: refuses large
/// ones that alone don't fit. Whether the run does is the plan's matter.
void require_memory_to_look(const LightField& light_field, const DepthOptions& options) {
  if (light_field.kind == LightFieldKind::kUnstructured) return;
  // A decoded picture, its planes of colours and gradients.
  const double picture = 26.0 * light_field.width * light_field.height;
  constexpr double kLarge = 128 * double(1 << 20);
  if (picture < kLarge) return;
  MemoryBudget{options.memory_bytes / double(1 << 30)}.require(
      2 * kProgramBytes + picture,
      views_text(light_field.num_views(), light_field.width, light_field.height));
}

double share_of_estimates(const ViewDepth& depth) {
  const auto known = std::count_if(depth.disparity.begin(), depth.disparity.end(),
                                   [](float d) { return !std::isnan(d); });
  return double(known) / double(depth.disparity.size());
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
                    "focus, and get no depth; `focus_distance` states what has disparity 0",
                    100 * share, view));
}

using Clock = std::chrono::steady_clock;

DepthFolder make_folder(const InputRequest& input, const DepthFolderRequest& folder) {
  std::vector<std::filesystem::path> places = input.places();
  std::erase_if(places, [](const std::filesystem::path& place) { return place.empty(); });
  return {folder.path, folder.formats, {std::move(places), folder.replace}};
}

void describe(const LightField& light_field, const DepthFolderRequest& request,
              DepthFolder& folder) {
  folder.describe(light_field, request.formats.contains(MapFormat::kNerfstudio)
                                   ? RigCameras(light_field).cameras()
                                   : std::vector<Camera>());
}

/// Into a folder that is described.
DepthReport write(const OpenedInput& input, const Reconstruction& result,
                  const DepthFolderRequest& request, DepthFolder& folder, Clock::time_point begin,
                  const RunControl& control) {
  const LightField& light_field = input.light_field;
  const std::vector<int>& active = result.views();
  const bool drops = request.min_confidence > 0;
  WrittenViews written{.all = Coverage(result.num_levels()),
                       .of_top = Coverage(result.num_levels()),
                       .min_confidence = request.min_confidence,
                       .kept = drops ? 0.0 : 1.0,
                       .top = top_view_of(light_field, active)};
  for (std::size_t i = 0; i < active.size(); ++i) {
    control.progress("write", double(i), double(active.size()));
    const View& view = light_field.views[active[i]];
    const bool is_top = active[i] == written.top;
    ViewDepth depth = result.view(active[i]);
    if (drops) {
      drop_unsure(float(request.min_confidence), depth);
      written.kept += share_of_estimates(depth) / double(active.size());
    }
    written.all.add(depth);
    if (is_top) written.of_top.add(depth);
    if (is_top) tell_of_infinity(depth.disparity, light_field, view.name, control);
    DisparityRange pictured{result.hypotheses().min, result.hypotheses().max};
    written.views.push_back({{"name", view.name}, {"s", view.s}, {"t", view.t}});
    if (!result.cameras().empty()) {
      const Camera& camera = result.cameras()[active[i]];
      written.views.back()["camera"] = json_of(camera);
      pictured = {camera.inverse_depth->min, camera.inverse_depth->max};
    }
    folder.write_view(active[i], std::move(depth.disparity), std::move(depth.confidence), pictured,
                      is_top);
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  const ordered_json record = depth_record(input, result, written, seconds);
  DepthReport report{record.dump(2, ' ', false, ordered_json::error_handler_t::replace),
                     int(active.size()), result.device(), seconds, note_on_scale(light_field)};
  folder.commit(report.record, control);
  control.progress("write", 1, 1);
  return report;
}

}  // namespace

DepthOptions prepare_depth(OpenedInput& input, const DepthRequest& request,
                           const RunControl& control) {
  LightField& light_field = input.light_field;
  DepthOptions options = request.options;
  if (request.distances) options.disparity = range_of(*request.distances, light_field);
  options.check();
  input.asked = options;
  check(light_field);
  if (options.disparity && !request.distances)
    check_inverse_depth(*options.disparity, light_field, control);
  require_memory_to_look(light_field, options);
  check_poses(light_field, input.request.open.convention.has_value(), control);
  if (!options.disparity) take_range_of_features(light_field, control);
  settle_layout(input.request, light_field, control);
  if (const auto range = check_direction(light_field, control); range && !options.disparity) {
    options.disparity = range;
    control.message(
        fmt::format("disparity range {:.4g} … {:.4g} px per view step, estimated from the pictures",
                    range->min, range->max));
  }
  if (options.views.empty()) options.views = parse_views(request.views, light_field);
  input.asked->views = options.views;
  return options;
}

Reconstruction compute_depth(OpenedInput& input, const DepthRequest& request,
                             const RunControl& control) {
  const DepthOptions options = prepare_depth(input, request, control);
  return reconstruct(input.light_field, options, request.backend, control);
}

DepthForecast forecast_depth(OpenedInput& input, const DepthRequest& request,
                             const RunControl& control) {
  RunControl listening;
  std::vector<std::string> messages;
  listening.on_progress = [&](const auto&...) { control.throw_if_cancelled(); };
  listening.on_message = [&](const std::string& text) { messages.push_back(text); };
  try {
    OpenedInput resolved = input;
    DepthRequest of_all = request;
    of_all.views = "all";
    DepthOptions options = prepare_depth(resolved, of_all, listening);
    // What the input says.
    resolved.light_field.sign_is_assumed = input.light_field.sign_is_assumed;
    input = std::move(resolved);
    std::vector<std::string>& notes = input.light_field.notes;
    for (const std::string& text : messages)
      if (std::ranges::find(notes, text) == notes.end()) notes.push_back(text);
    if (options.views.empty()) options.views = parse_views(request.views, input.light_field);
    return {forecast(input.light_field, options, request.backend), ""};
  } catch (const Error& error) {
    if (error.code() == ErrorCode::kCancelled) throw;
    return {{}, error.what()};
  }
}

DepthReport write_depth_folder(const OpenedInput& input, const Reconstruction& result,
                               const DepthFolderRequest& request, const RunControl& control) {
  const auto begin = Clock::now();
  DepthFolder folder = make_folder(input.request, request);
  describe(input.light_field, request, folder);
  return write(input, result, request, folder, begin, control);
}

DepthReport compute_depth_folder(InputRequest place, const DepthRequest& request,
                                 const DepthFolderRequest& target, const RunControl& control) {
  const auto begin = Clock::now();
  DepthFolder folder = make_folder(place, target);
  if (place.colmap_folder.empty()) {
    place.colmap_folder = colmap_folder_beside(target.path);
    place.replace = target.replace;
  }
  OpenedInput input = open_input(std::move(place), control);
  for (const std::string& note : input.light_field.notes) control.message(note);
  const DepthOptions options = prepare_depth(input, request, control);
  describe(input.light_field, target, folder);
  const Reconstruction result = reconstruct(input.light_field, options, request.backend, control);
  return write(input, result, target, folder, begin, control);
}

}  // namespace gigaray
