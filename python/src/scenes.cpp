// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Synthetic scenes with their exact disparity or depth.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "arrays.h"
#include "gigaray/core/metric_depth.h"
#include "gigaray/core/synthetic_capture.h"
#include "gigaray/workflows/synth.h"
#include "result.h"
#include "run.h"

namespace gigaray::python {
namespace {

/// What synth() of Python was given, by the names of its arguments.
struct Scene {
  SyntheticOptions options;
  std::optional<SyntheticPath> path;  ///< photographs from anywhere
};

SyntheticPath::Shape shape_of(const std::string& name) {
  if (name == "line") return SyntheticPath::Shape::kLine;
  if (name == "arc") return SyntheticPath::Shape::kArc;
  if (name == "walk") return SyntheticPath::Shape::kWalk;
  refuse("`path` is '" + name + "'; it must be line, arc or walk");
}

PyLightField rendered_rig(const SyntheticOptions& options, const RunControl& control) {
  SyntheticLightField rendered = render_synthetic(options, control);
  PyLightField result;
  result.input.light_field = std::move(rendered.light_field);
  result.truth = std::move(rendered.disparity);
  return result;
}

/// Photographs of a walk as an unstructured light field. Its truth is inverse depth.
PyLightField rendered_walk(const SyntheticOptions& options, const SyntheticPath& path,
                           const RunControl& control) {
  const SyntheticCapture capture = describe_synthetic_capture(options, path);
  PyLightField result;
  result.truth.resize(capture.cameras.size());
  std::vector<Image<std::uint16_t>> pictures(capture.cameras.size());
  render_synthetic_capture(options, path, control,
                           [&](int view, Image<std::uint16_t> picture, FloatMap depth) {
                             for (float& value : depth) value = 1 / value;
                             result.truth[std::size_t(view)] = std::move(depth);
                             pictures[std::size_t(view)] = std::move(picture);
                           });
  LightField& field = result.input.light_field;
  field.kind = LightFieldKind::kUnstructured;
  field.width = options.width;
  field.height = options.height;
  field.cameras = capture.cameras;
  field.format = "synthetic photographs";
  field.rig.unit = "m";
  for (const std::string& name : capture.names) field.views.push_back({name, 0, 0});
  field.pixels = pixels_in_memory(std::move(pictures), options.bit_depth);
  place_by_cameras(field);
  check(field);
  return result;
}

Scene scene_of(const std::string& name, const py::dict& values) {
  Scene scene;
  SyntheticOptions& options = scene.options;
  options.scene = name;
  const auto read = [&](const char* field, auto& target) {
    if (!values.contains(field) || py::object(values[field]).is_none()) return;
    try {
      target = py::cast<std::decay_t<decltype(target)>>(values[field]);
    } catch (const py::cast_error&) {
      refuse("`" + std::string(field) + "` is " + std::string(py::repr(values[field])) +
             ", which can't be meant");
    }
  };
  std::pair<int, int> views{options.views_s, options.views_t}, size{options.width, options.height};
  std::pair<double, double> disparity{options.disparity.min, options.disparity.max};
  std::string path;
  SyntheticPath way;
  read("views", views);
  read("size", size);
  read("disparity", disparity);
  read("noise", options.noise);
  read("outliers", options.outliers);
  read("seed", options.seed);
  read("bit_depth", options.bit_depth);
  read("path", path);
  read("extent", way.extent);
  read("step", way.step);
  std::tie(options.views_s, options.views_t) = views;
  std::tie(options.width, options.height) = size;
  options.disparity = {disparity.first, disparity.second};
  options.check();
  if (path.empty()) return scene;
  way.shape = shape_of(path);
  way.check();
  scene.path = way;
  return scene;
}

PyLightField synth(const std::string& name, const py::dict& values) {
  return run([scene = scene_of(name, values)](const RunControl& control) {
    return scene.path ? rendered_walk(scene.options, *scene.path, control)
                      : rendered_rig(scene.options, control);
  });
}

void synth_folder(const std::string& name, const py::dict& values,
                  const std::filesystem::path& folder, bool replace) {
  run([scene = scene_of(name, values), folder, replace](const RunControl& control) {
    const OutputRules rules{{}, replace};
    if (scene.path)
      write_synthetic_photographs(folder, scene.options, *scene.path, rules, control);
    else
      write_synthetic_light_field(folder, scene.options, rules, control);
  });
}

}  // namespace

void bind_scenes(py::module_& module) {
  module.def("scene_names", &synthetic_scene_names);
  module.def("synth", &synth, py::arg("scene"), py::arg("arguments"));
  module.def("synth_folder", &synth_folder, py::arg("scene"), py::arg("arguments"),
             py::arg("folder"), py::arg("replace"));
}

}  // namespace gigaray::python
