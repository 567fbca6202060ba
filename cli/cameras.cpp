// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "cameras.h"

#include <fmt/format.h>

#include <algorithm>

#include "gigaray/samplers/unstructured_sampler.h"

namespace gigaray::cli {

using nlohmann::ordered_json;

namespace {

bool depths_are_known(const LightField& light_field) {
  const std::vector<Camera>& cameras = light_field.cameras;
  return !cameras.empty() && std::all_of(cameras.begin(), cameras.end(), [](const Camera& camera) {
    return camera.inverse_depth.has_value();
  });
}

std::string depths_text(const LightField& light_field) {
  const InverseDepthRange range = all_inverse_depths(light_field.cameras);
  const std::string unit = light_field.rig.unit.empty() ? "" : " " + light_field.rig.unit;
  return fmt::format("{:.4g} … {}{}, each view a part of it", 1 / range.max,
                     range.min > 0 ? fmt::format("{:.4g}", 1 / range.min) : "infinity", unit);
}

}  // namespace

ordered_json camera_json(const Camera& camera) {
  ordered_json rotation = ordered_json::array();
  for (int row = 0; row < 3; ++row)
    rotation.push_back({camera.rotation(row, 0), camera.rotation(row, 1), camera.rotation(row, 2)});
  ordered_json range = nullptr;
  if (camera.inverse_depth) range = {camera.inverse_depth->min, camera.inverse_depth->max};
  return {{"width", camera.width},
          {"height", camera.height},
          {"focal_px", {camera.focal_u, camera.focal_v}},
          {"principal_point_px", {camera.centre_u, camera.centre_v}},
          {"rotation", rotation},
          {"translation", {camera.translation.x(), camera.translation.y(), camera.translation.z()}},
          {"inverse_depth", range}};
}

std::vector<int> count_partners(const LightField& light_field) {
  if (!depths_are_known(light_field)) return {};
  const UnstructuredSampler sampler(light_field.cameras);
  std::vector<int> counts;
  for (int view = 0; view < sampler.num_views(); ++view)
    counts.push_back(int(sampler.partners(view).size()) - 1);
  return counts;
}

std::string note_on_scale(const LightField& light_field) {
  if (light_field.kind != LightFieldKind::kUnstructured || !light_field.rig.unit.empty()) return {};
  // Structure from motion can't know the scale; other files may hold metres without saying so.
  const bool by_colmap = light_field.format == "COLMAP workspace";
  return fmt::format(
      "distances are in the unit of the cameras, {}, not in metres (--unit of `gigaray depth` "
      "names "
      "one where the cameras were scaled)",
      by_colmap ? "which COLMAP chose" : "which the input does not name");
}

std::vector<std::pair<std::string, std::string>> describe_cameras(const LightField& light_field) {
  std::vector<double> focals;
  for (const Camera& camera : light_field.cameras) focals.push_back(camera.focal_u);
  const auto [least, most] = std::minmax_element(focals.begin(), focals.end());
  std::vector<std::pair<std::string, std::string>> lines{
      {"cameras", *least == *most
                      ? fmt::format("focal length {:.6g} px", *least)
                      : fmt::format("focal lengths {:.6g} … {:.6g} px", *least, *most)}};
  const std::vector<int> partners = count_partners(light_field);
  if (partners.empty()) {
    lines.emplace_back("depths", "not known of every view: estimated, or stated by --disparity");
    return lines;
  }
  lines.emplace_back("depths", depths_text(light_field));
  const auto [fewest, all] = std::minmax_element(partners.begin(), partners.end());
  lines.emplace_back("compared", *fewest == *all
                                     ? fmt::format("each view with {} others", *all)
                                     : fmt::format("each view with {} … {} others", *fewest, *all));
  return lines;
}

}  // namespace gigaray::cli
