// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// gigaray.json, the program's own description of a light field; docs/formats.md.
#include <cmath>
#include <nlohmann/json.hpp>
#include <system_error>

#include "files/text.h"
#include "formats/camera_position.h"
#include "formats/described_light_field.h"
#include "formats/readers.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/light_field_json.h"
#include "gigaray/core/arguments.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kVersion = 1;
constexpr const char* kFileName = "gigaray.json";

fs::path json_of(const fs::path& input) {
  std::error_code ignored;
  return fs::is_directory(input, ignored) ? input / kFileName : input;
}

std::optional<double> optional_number(const json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || found->is_null()) return std::nullopt;
  return found->get<double>();
}

Error bad(const std::string& what) { return Error(ErrorCode::kBadInput, what); }

DescribedLightField parse(const json& root) {
  if (root.at("format") != kLightFieldFormat)
    throw bad("describes a " + in_quotes(root.at("format").get<std::string>()) +
              ", not a light field");
  if (root.at("version") != kVersion)
    throw bad("has version " + in_quotes(root.at("version").dump()) +
              "; this program reads version " + std::to_string(kVersion));
  DescribedLightField described{described_light_field(root), {}};
  for (const json& entry : root.at("views"))
    described.files.push_back(entry.at("file").get<std::string>());
  return described;
}

class GigarayJsonReader : public Reader {
 public:
  std::string name() const override { return kLightFieldFormat; }

  ProbeResult probe(const fs::path& input) const override {
    const fs::path path = json_of(input);
    std::error_code ignored;
    return {path.filename() == kFileName && fs::is_regular_file(path, ignored) ? 90 : 0, ""};
  }

  LightField open(const fs::path& input, const OpenOptions& options) const override {
    refuse_direction(options, "gigaray.json states");
    const fs::path path = json_of(input);
    auto [light_field, names] =
        parse_light_field_json(read_json_text(path, options.memory_bytes), path.string());
    std::vector<fs::path> files;
    for (const std::string& name : names) files.push_back(path.parent_path() / name);
    const int width = light_field.width, height = light_field.height;
    try {
      if (!files.empty()) attach_pictures(light_field, std::move(files), options);
    } catch (const Error& problem) {
      throw Error(problem.code(), path.string() + ": " + problem.what());
    }
    if (light_field.width != width || light_field.height != height)
      throw Error(ErrorCode::kBadInput,
                  path.string() + ": states another size than its pictures have");
    return light_field;
  }
};

}  // namespace

View view_of(const json& entry) {
  const View view{entry.at("name"), entry.at("s"), entry.at("t")};
  // It becomes the name of an output folder.
  if (view.name.empty() || view.name.find('/') != std::string::npos || view.name.starts_with('.'))
    throw bad(in_quotes(view.name) + " can't name a view");
  return view;
}

RigGeometry rig_of(const json& root) {
  const auto rig = root.find("rig");
  if (rig == root.end()) return {};
  RigGeometry result{optional_number(*rig, "focal_px"), optional_number(*rig, "baseline"),
                     optional_number(*rig, "focus_distance"), rig->value("unit", "")};
  const auto point = rig->find("principal_point_px");
  if (point != rig->end() && !point->is_null())
    result.principal_point = Eigen::Vector2d(point->at(0), point->at(1));
  return result;
}

int size_of(const json& entry, const char* key) {
  constexpr double kMost = 1 << 20;
  const double size = entry.at(key);
  if (!(size >= 1 && size <= kMost && size == std::floor(size)))
    throw bad(std::string("states no valid ") + key);
  return int(size);
}

Camera camera_of(const json& entry, const std::string& name) {
  Camera camera;
  camera.width = size_of(entry, "width");
  camera.height = size_of(entry, "height");
  camera.focal_u = entry.at("focal_px").at(0);
  camera.focal_v = entry.at("focal_px").at(1);
  camera.centre_u = entry.at("principal_point_px").at(0);
  camera.centre_v = entry.at("principal_point_px").at(1);
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column)
      camera.rotation(row, column) = entry.at("rotation").at(row).at(column);
    camera.translation[row] = entry.at("translation").at(row);
  }
  if (const auto range = entry.find("inverse_depth"); range != entry.end() && !range->is_null())
    camera.inverse_depth = InverseDepthRange{range->at(0), range->at(1)};
  check(camera, "view " + name);
  return camera;
}

LightField described_light_field(const json& root) {
  LightField light_field;
  for (const json& entry : root.at("views")) light_field.views.push_back(view_of(entry));
  light_field.kind = kind_from_positions(light_field.views);
  if (root.at("kind") != to_string(light_field.kind))
    throw bad("states the kind " + in_quotes(root.at("kind").dump()) + ", its positions are " +
              to_string(light_field.kind));
  light_field.width = size_of(root, "width");
  light_field.height = size_of(root, "height");
  if (const auto range = root.find("disparity_range"); range != root.end() && !range->is_null()) {
    light_field.declared_range = DisparityRange{range->at(0), range->at(1)};
    if (!(light_field.declared_range->min < light_field.declared_range->max))
      throw bad("its disparity_range is empty");
  }
  light_field.rig = rig_of(root);
  return light_field;
}

nlohmann::ordered_json description_of(const LightField& light_field) {
  nlohmann::ordered_json root;
  root["kind"] = to_string(light_field.kind);
  root["width"] = light_field.width;
  root["height"] = light_field.height;
  if (light_field.declared_range)
    root["disparity_range"] = {light_field.declared_range->min, light_field.declared_range->max};
  nlohmann::ordered_json rig = nlohmann::ordered_json::object();
  if (light_field.rig.focal_px) rig["focal_px"] = *light_field.rig.focal_px;
  if (light_field.rig.baseline) rig["baseline"] = *light_field.rig.baseline;
  if (light_field.rig.focus_distance) rig["focus_distance"] = *light_field.rig.focus_distance;
  if (!light_field.rig.unit.empty()) rig["unit"] = light_field.rig.unit;
  if (const auto& point = light_field.rig.principal_point)
    rig["principal_point_px"] = {point->x(), point->y()};
  root["rig"] = rig;
  for (const View& view : light_field.views)
    root["views"].push_back({{"name", view.name}, {"s", view.s}, {"t", view.t}});
  return root;
}

DescribedLightField parse_light_field_json(std::string_view text, const std::string& where) {
  const auto bad = [&](const std::string& what) {
    return Error(ErrorCode::kBadInput, where + ": " + what);
  };
  const json root = json::parse(text, nullptr, false);
  if (!root.is_object()) throw bad("is damaged or no JSON object");
  try {
    return parse(root);
  } catch (const json::exception& problem) {
    throw bad(std::string("an entry is missing or of the wrong type (") + problem.what() + ")");
  } catch (const Error& problem) {
    throw bad(problem.what());
  }
}

void write_light_field_json(const fs::path& path, const LightField& light_field,
                            const std::vector<std::string>& files) {
  require_argument(files.size() == light_field.views.size(), "files: one for each view is needed");
  nlohmann::ordered_json root;
  root["format"] = kLightFieldFormat;
  root["version"] = kVersion;
  root.update(description_of(light_field));
  for (std::size_t i = 0; i < files.size(); ++i) root["views"][i]["file"] = files[i];
  using Handler = nlohmann::ordered_json::error_handler_t;
  write_file_atomically(path, root.dump(2, ' ', false, Handler::replace) + "\n");
}

std::unique_ptr<const Reader> gigaray_json_reader() {
  return std::make_unique<GigarayJsonReader>();
}

}  // namespace gigaray
