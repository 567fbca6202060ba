// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Masks, novel views and refocused views of a result.
#include <pybind11/stl.h>

#include <optional>
#include <utility>

#include "arrays.h"
#include "gigaray/applications/refocus.h"
#include "gigaray/workflows/masks.h"
#include "gigaray/workflows/novel_views.h"
#include "result.h"
#include "run.h"

namespace gigaray::python {
namespace {

using Pair = std::optional<std::pair<double, double>>;

MaskRequest mask_request(const Pair& between, const std::optional<std::pair<int, int>>& at,
                         std::optional<double> tolerance, bool soft) {
  MaskRequest request;
  if (between) request.between = MaskRequest::NearFar{between->first, between->second};
  if (at) request.at = PixelPlace{at->first, at->second};
  request.tolerance = tolerance;
  request.soft = soft;
  return request;
}

py::list masks(const ResultPointer& result, std::vector<int> views, const Pair& between,
               const std::optional<std::pair<int, int>>& at, std::optional<double> tolerance,
               bool soft) {
  if (soft) result->require_pictures();
  for (int& view : views) view = result->view(view);
  auto made =
      run([=, request = mask_request(between, at, tolerance, soft)](const RunControl& control) {
        const std::lock_guard lock(*result->turn);
        const SceneMasks of_scene(*result->scene, request);
        std::vector<ViewMask> list;
        for (const int view : views) {
          control.progress("masks", double(list.size()), double(views.size()));
          list.push_back(of_scene.view(view));
        }
        return list;
      });
  py::list arrays;
  for (ViewMask& one : made) {
    if (soft)
      arrays.append(array_of(std::move(one.matte)));
    else
      arrays.append(mask_array(std::move(one.mask)));
  }
  return arrays;
}

py::tuple rendered(const ResultPointer& result, const std::function<Camera()>& camera_of,
                   int sources, double memory) {
  result->require_pictures();
  constexpr double kBytesPerPixel = 80;
  NovelView view = run([=](const RunControl& control) {
    const std::lock_guard lock(*result->turn);
    DepthScene& scene = *result->scene;
    const Camera camera = camera_of();
    fit_into_memory(scene, sources, kBytesPerPixel, MemoryBudget(memory / double(1 << 30)));
    return render(scene, camera, {sources}, control);
  });
  const int bit_depth = result->field().pixels->bit_depth();
  return py::make_tuple(picture_array(std::move(view.picture), bit_depth),
                        array_of(std::move(view.inverse_depth)), mask_array(std::move(view.seen)));
}

py::tuple render_pose(const ResultPointer& result, const std::string& pose, int sources,
                      double memory) {
  return rendered(
      result, [=] { return parse_pose(pose, *result->scene); }, sources, memory);
}

py::tuple render_camera(const ResultPointer& result, const Camera& camera, int sources,
                        double memory) {
  return rendered(
      result, [=] { return camera; }, sources, memory);
}

py::array refocused(const ResultPointer& result, int index, const FocalPlane& plane,
                    double aperture) {
  result->require_pictures();
  const int view = view_index(result->field(), index);
  const LightField field = result->field();
  Image<std::uint16_t> picture = run(
      [=](const RunControl& control) { return refocus(field, view, plane, aperture, control); });
  return picture_array(std::move(picture), field.pixels->bit_depth());
}

}  // namespace

void bind_rendering(py::module_& module) {
  module.def("masks", &masks, py::arg("result"), py::arg("views"), py::arg("between"),
             py::arg("at"), py::arg("tolerance"), py::arg("soft"));
  module.def("render_pose", &render_pose, py::arg("result"), py::arg("pose"), py::arg("sources"),
             py::arg("memory"));
  module.def("render_camera", &render_camera, py::arg("result"), py::arg("camera"),
             py::arg("sources"), py::arg("memory"));
  module.def(
      "refocus",
      [](const ResultPointer& result, int view, double value, double along_u, double along_v,
         double aperture) {
        return refocused(result, view, {value, along_u, along_v}, aperture);
      },
      py::arg("result"), py::arg("view"), py::arg("value"), py::arg("along_u"), py::arg("along_v"),
      py::arg("aperture"));
}

}  // namespace gigaray::python
