// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/cameras.h"

#include <fmt/format.h>

#include <algorithm>

#include "depth_record.h"
#include "gigaray/samplers/unstructured_sampler.h"

namespace gigaray {

using nlohmann::ordered_json;

namespace {

bool depths_are_known(const LightField& light_field) {
  const std::vector<Camera>& cameras = light_field.cameras;
  return !cameras.empty() && std::all_of(cameras.begin(), cameras.end(), [](const Camera& camera) {
    return camera.inverse_depth.has_value();
  });
}

}  // namespace

ordered_json json_of(const Camera& camera) {
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

std::string camera_json(const Camera& camera) { return json_of(camera).dump(); }

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
      "distances are in the unit of the cameras, {}, not in metres (`unit` of `gigaray depth` "
      "names one where the cameras were scaled)",
      by_colmap ? "which COLMAP chose" : "which the input does not name");
}

}  // namespace gigaray
