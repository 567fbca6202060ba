// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// gigaray.json of an output folder of `gigaray depth`; docs/formats.md.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "files/text.h"
#include "formats/described_light_field.h"
#include "gigaray/adapters/depth_folder.h"
#include "gigaray/adapters/path_text.h"

namespace gigaray {
namespace {

using nlohmann::json;

LightField parse(const json& root) {
  LightField light_field;
  const json& about = root.at("light_field");
  light_field.format = about.at("format");
  light_field.width = size_of(about, "width");
  light_field.height = size_of(about, "height");
  light_field.rig = rig_of(about);
  for (const json& entry : root.at("views")) {
    light_field.views.push_back(view_of(entry));
    if (entry.contains("camera"))
      light_field.cameras.push_back(camera_of(entry["camera"], light_field.views.back().name));
  }
  if (const auto left_out = root.find("left_out"); left_out != root.end())
    for (const json& entry : *left_out) light_field.left_out.push_back(view_of(entry));
  const std::string kind = about.at("kind");
  if (kind == to_string(LightFieldKind::kUnstructured)) {
    light_field.kind = LightFieldKind::kUnstructured;
    if (light_field.cameras.size() != light_field.views.size())
      throw Error(ErrorCode::kBadInput, "has not a camera for every view");
  } else {
    // Some views of a grid may lie on a line; the result stays what it was computed as.
    light_field.kind =
        kind == to_string(LightFieldKind::k3D) ? LightFieldKind::k3D : LightFieldKind::k4D;
  }
  return light_field;
}

OpenOptions options_of(const json& root) {
  OpenOptions options;
  const auto found = root.find("opened_with");
  if (found == root.end()) return options;
  const auto path = [&](const char* key) { return path_of_text(found->value(key, std::string())); };
  options.positions = path("positions");
  options.images = path("images");
  options.masks = path("masks");
  if (const auto grid = found->find("grid"); grid != found->end())
    options.grid = {grid->at(0), grid->at(1), grid->at(2)};
  if (const auto views = found->find("lenslet"); views != found->end())
    options.lenslet = {views->at(0), views->at(1)};
  options.convention = parse_pose_convention(found->value("convention", std::string()));
  return options;
}

int top_view_of(const json& root, const LightField& light_field) {
  const std::string name = root.value("top_level_view", "");
  const auto found = std::ranges::find(light_field.views, name, &View::name);
  if (found != light_field.views.end()) return int(found - light_field.views.begin());
  return light_field.views.empty() ? 0 : centre_view(light_field);
}

}  // namespace

DescribedDepth parse_depth_json(std::string_view text, const std::string& where) {
  const auto bad = [&](const std::string& what) {
    return Error(ErrorCode::kBadInput, where + ": " + what);
  };
  const json root = json::parse(text, nullptr, false);
  if (!root.is_object()) throw bad("is damaged or no JSON object");
  if (root.value("format", json()) != kDepthFormat)
    throw bad("describes no result of `gigaray depth`; give its output folder");
  DescribedDepth described;
  try {
    described.light_field = parse(root);
    described.input = path_of_text(root.at("input").get<std::string>());
    described.opened_with = options_of(root);
    const json& range = root.at("options").at("disparity_range");
    described.searched = {range.at(0), range.at(1)};
    described.hypotheses = root.at("options").value("hypotheses", 0);
    described.top_view = top_view_of(root, described.light_field);
  } catch (const json::exception& problem) {
    throw bad(std::string("an entry is missing or of the wrong type (") + problem.what() + ")");
  } catch (const Error& problem) {
    throw Error(problem.code(), where + ": " + problem.what());
  }
  if (described.light_field.views.empty()) throw bad("names no view");
  return described;
}

}  // namespace gigaray
