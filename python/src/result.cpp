// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "result.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "arrays.h"
#include "gigaray/core/metric_depth.h"
#include "gigaray/workflows/view_list.h"
#include "run.h"

namespace gigaray::python {
namespace {

ResultPointer reconstruct(const PyLightField& light_field, const py::dict& values) {
  return run([input = light_field.input,
              request = depth_request(values)](const RunControl& control) mutable {
    auto result = std::make_shared<PyResult>();
    auto computed = std::make_shared<Reconstruction>(compute_depth(input, request, control));
    result->scene = std::make_shared<DepthScene>(input, computed);
    result->computed = std::move(computed);
    result->input = std::move(input);
    return result;
  });
}

ResultPointer load(const std::filesystem::path& path, const std::filesystem::path& input,
                   double min_confidence) {
  return run([=](const RunControl&) {
    auto result = std::make_shared<PyResult>();
    ResultRequest request{path, input, min_confidence};
    try {
      result->scene = std::make_shared<DepthScene>(request);
    } catch (const Error& error) {
      // Maps are there without the pictures that they were made of.
      request.with_pictures = false;
      result->scene = std::make_shared<DepthScene>(request);
      result->without_pictures = error.what();
    }
    return result;
  });
}

/// What is known of a view at once: a Reconstruction makes all of it together.
struct ViewMaps {
  FloatMap disparity, confidence;
  Image<std::int8_t> level;  ///< empty: not known
};

ViewMaps maps_of(const PyResult& result, int view) {
  // A view of photographs may be smaller than the light field: the scene cuts it.
  if (result.computed && result.field().kind != LightFieldKind::kUnstructured) {
    ViewDepth depth = result.computed->view(view);
    return {std::move(depth.disparity), std::move(depth.confidence), std::move(depth.level)};
  }
  return {result.scene->disparity(view), result.scene->confidence(view), {}};
}

py::dict maps(const ResultPointer& result, int index) {
  const int view = result->view(index);
  ViewMaps found = run([result, view](const RunControl&) {
    const std::lock_guard lock(*result->turn);
    return maps_of(*result, view);
  });
  py::dict arrays;
  arrays["disparity"] = array_of(std::move(found.disparity));
  arrays["confidence"] =
      found.confidence.empty() ? py::object(py::none()) : array_of(std::move(found.confidence));
  arrays["level"] = found.level.empty() ? py::object(py::none()) : array_of(std::move(found.level));
  return arrays;
}

py::array_t<float> depth(const ResultPointer& result, int index) {
  const int view = result->view(index);
  if (!has_metric_depth(result->field()))
    refuse(
        "`depth`: focal length and view step are not known; state `focal_px` and `baseline`, or "
        "use `disparity`");
  return array_of(run([result, view](const RunControl&) {
    const std::lock_guard lock(*result->turn);
    return depth_from_disparity(result->scene->disparity(view), result->field());
  }));
}

py::array_t<double> points(const ResultPointer& result, int index) {
  const int view = result->view(index);
  return array_of(run([result, view](const RunControl&) {
    const std::lock_guard lock(*result->turn);
    const RigCameras& rig = result->scene->rig();
    const FloatMap inverse = rig.inverse_depth(result->scene->disparity(view));
    const Camera& camera = rig.camera(view);
    Image<double> places(inverse.width(), inverse.height(), 3, double(kNoEstimate));
    for (int v = 0; v < inverse.height(); ++v)
      for (int u = 0; u < inverse.width(); ++u) {
        if (!(inverse(u, v) > 0)) continue;
        const Eigen::Vector3d place = camera.back_project(u, v, 1 / double(inverse(u, v)));
        for (int c = 0; c < 3; ++c) places(u, v, c) = place[c];
      }
    return places;
  }));
}

std::set<MapFormat> formats_of(const std::vector<std::string>& names) {
  static const std::map<std::string, MapFormat> known{{"exr", MapFormat::kExr},
                                                      {"npy", MapFormat::kNpy},
                                                      {"png16", MapFormat::kPng16},
                                                      {"colmap", MapFormat::kColmap},
                                                      {"nerfstudio", MapFormat::kNerfstudio}};
  std::set<MapFormat> formats;
  for (const std::string& name : names) {
    const auto found = known.find(name);
    if (found == known.end())
      refuse("`formats` has '" + name + "'; there are exr, npy, png16, colmap and nerfstudio");
    formats.insert(found->second);
  }
  return formats;
}

void save(const ResultPointer& result, const std::filesystem::path& path,
          const std::vector<std::string>& formats, double min_confidence, bool replace) {
  if (!result->computed) refuse("`save`: this result is already in " + result->scene->name());
  const DepthFolderRequest folder{path, formats_of(formats), min_confidence, replace};
  run([result, folder](const RunControl& control) {
    const DepthReport report =
        write_depth_folder(result->input, *result->computed, folder, control);
    if (!report.note.empty()) control.message(report.note);
  });
}

PyLightField light_field_of(const ResultPointer& result) {
  PyLightField light_field{result->input};
  light_field.input.light_field = result->field();
  return light_field;
}

py::object seconds(const ResultPointer& result) {
  return result->computed ? py::cast(result->computed->seconds()) : py::object(py::none());
}

}  // namespace

void PyResult::require_pictures() const {
  if (!without_pictures.empty()) throw Error(ErrorCode::kBadInput, without_pictures);
}

int PyResult::view(int index) const {
  const int view = view_index(field(), index);
  if (std::ranges::find(scene->views(), view) == scene->views().end())
    throw py::index_error("view " + field().views[std::size_t(view)].name +
                          " has no depth: `views` left it out");
  return view;
}

void bind_result(py::module_& module) {
  py::class_<PyResult, ResultPointer>(module, "Result")
      .def_property_readonly("views", [](const PyResult& self) { return self.scene->views(); })
      .def_property_readonly("top_view",
                             [](const PyResult& self) { return self.scene->top_view(); })
      .def_property_readonly("name", [](const PyResult& self) { return self.scene->name(); })
      .def_property_readonly("light_field", &light_field_of)
      .def_property_readonly("has_pictures",
                             [](const PyResult& self) { return self.without_pictures.empty(); })
      .def_property_readonly("has_depth",
                             [](const PyResult& self) { return has_metric_depth(self.field()); })
      .def_property_readonly("range",
                             [](const PyResult& self) {
                               const DisparityRange range = self.scene->range();
                               return std::make_tuple(range.min, range.max);
                             })
      .def_property_readonly(
          "device",
          [](const PyResult& self) { return self.computed ? self.computed->device() : ""; })
      .def_property_readonly("seconds", &seconds)
      .def("camera",
           [](const PyResult& self, int view) {
             return self.scene->rig().camera(view_index(self.field(), view));
           })
      .def("maps", &maps, py::arg("view"))
      .def("depth", &depth, py::arg("view"))
      .def("points", &points, py::arg("view"))
      .def("save", &save, py::arg("path"), py::arg("formats"), py::arg("min_confidence"),
           py::arg("replace"));
  module.def("reconstruct", &reconstruct, py::arg("light_field"), py::arg("arguments"));
  module.def("load", &load, py::arg("path"), py::arg("input"), py::arg("min_confidence"));
}

}  // namespace gigaray::python
