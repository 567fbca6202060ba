// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/synth.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/colmap_model.h"
#include "gigaray/adapters/light_field_json.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/pictures.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr const char* kDescription = "synthetic.json";
constexpr const char* kFormat = "gigaray synthetic photographs";

std::string file_of(const std::string& view) { return view + ".png"; }

ColmapModel colmap_model(const SyntheticCapture& capture, double distortion) {
  // COLMAP's pixels have their corner, not their centre, at integers.
  constexpr double kCorner = 0.5;
  constexpr std::uint32_t kCameraId = 1;
  ColmapModel model;
  const Camera& camera = capture.cameras.front();
  Lens& lens = model.cameras[kCameraId] = pinhole_lens(camera);
  if (distortion != 0) {
    lens.model = "SIMPLE_RADIAL";
    lens.params = {lens.params[0], lens.params[2], lens.params[3], distortion};
  }
  for (std::size_t i = 0; i < capture.cameras.size(); ++i) {
    ColmapModel::Image image;
    image.id = std::uint32_t(i + 1);
    image.rotation = Eigen::Quaterniond(capture.cameras[i].rotation).normalized();
    image.translation = capture.cameras[i].translation;
    image.camera_id = kCameraId;
    image.name = file_of(capture.names[i]);
    model.images.push_back(std::move(image));
  }
  for (const SyntheticCapture::Point& seen : capture.points) {
    ColmapModel::Point point;
    point.id = model.points.size() + 1;
    point.position = seen.position;
    point.rgb = seen.rgb;
    point.error = 0;
    for (const SyntheticCapture::Sight& sight : seen.sights) {
      ColmapModel::Image& image = model.images[sight.view_idx];
      point.track.push_back({image.id, std::uint32_t(image.features.size())});
      image.features.push_back({sight.pixel.x() + kCorner, sight.pixel.y() + kCorner, point.id});
    }
    model.points.push_back(std::move(point));
  }
  return model;
}

std::string description(const SyntheticOptions& options, const SyntheticPath& path,
                        const SyntheticCapture& capture) {
  const char* shapes[] = {"line", "arc", "walk"};
  ordered_json root = {{"format", kFormat},
                       {"unit", "m"},
                       {"scene", options.scene},
                       {"seed", options.seed},
                       {"noise", options.noise},
                       {"outliers", options.outliers},
                       {"bit_depth", options.bit_depth},
                       {"samples", options.samples},
                       {"path", shapes[int(path.shape)]},
                       {"spacing_noise", path.spacing_noise},
                       {"off_line", path.off_line},
                       {"rotation_noise", path.rotation_noise},
                       {"exposure_noise", path.exposure_noise},
                       {"exposures", capture.exposures},
                       {"distortion", path.distortion}};
  if (path.step > 0)
    root["step"] = path.step;
  else
    root["extent"] = path.extent;
  return root.dump(2) + "\n";
}

/// Adds how the scene was made to the description; readers of the light field skip it.
void add_origin(const fs::path& description, const SyntheticOptions& scene) {
  ordered_json root;
  std::ifstream(description) >> root;
  root["synthetic"] = {{"scene", scene.scene},         {"seed", scene.seed},
                       {"noise", scene.noise},         {"outliers", scene.outliers},
                       {"bit_depth", scene.bit_depth}, {"samples", scene.samples},
                       {"truth", "truth.pfm"}};
  write_file_atomically(description, root.dump(2) + "\n");
}

}  // namespace

int write_synthetic_photographs(const fs::path& folder, const SyntheticOptions& options,
                                const SyntheticPath& path, const OutputRules& rules,
                                const RunControl& control) {
  const SyntheticCapture capture = describe_synthetic_capture(options, path);
  AtomicFolder out(folder, kFormat, rules);
  for (const char* name : {"images", "truth"}) fs::create_directory(out.path() / name);
  render_synthetic_capture(
      options, path, control, [&](int view_idx, Image<std::uint16_t> picture, FloatMap depth) {
        const std::string& view = capture.names[view_idx];
        write_png(out.path() / "images" / file_of(view), picture, options.bit_depth);
        write_pfm(out.path() / "truth" / (view + ".pfm"), depth);
      });
  write_colmap_model(out.path() / "sparse" / "0", colmap_model(capture, path.distortion),
                     ColmapFormat::kText);
  write_file_atomically(out.path() / kDescription, description(options, path, capture));
  out.commit(control);
  return int(capture.names.size());
}

LightField write_synthetic_light_field(const fs::path& folder, const SyntheticOptions& options,
                                       const OutputRules& rules, const RunControl& control) {
  LightField light_field = describe_synthetic(options);
  AtomicFolder out(folder, kLightFieldFormat, rules);
  const fs::path truth = out.path() / "truth";
  fs::create_directory(truth);
  const int centre = centre_view(light_field);
  std::vector<std::string> files;
  for (const View& view : light_field.views) files.push_back(view.name + ".png");
  render_synthetic_views(
      options, control, [&](int view_idx, Image<std::uint16_t> picture, FloatMap disparity) {
        write_png(out.path() / files[view_idx], picture, options.bit_depth);
        write_pfm(truth / (light_field.views[view_idx].name + ".pfm"), disparity);
        if (view_idx == centre) write_pfm(out.path() / "truth.pfm", disparity);
      });
  const fs::path description = out.path() / "gigaray.json";
  write_light_field_json(description, light_field, files);
  add_origin(description, options);
  out.commit(control);
  return light_field;
}

}  // namespace gigaray
