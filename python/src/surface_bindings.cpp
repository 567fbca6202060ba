// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Clouds and surfaces of a result. Only where the library was built with GIGARAY_MESHING.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <optional>
#include <utility>

#include "arrays.h"
#include "gigaray/adapters/cloud_file.h"
#include "gigaray/workflows/surface.h"
#include "result.h"
#include "run.h"

namespace gigaray::python {
namespace {

using Cloud = std::shared_ptr<PointCloud>;
using Surface = std::shared_ptr<SceneSurface>;

/// A list of vectors of three numbers that lies in an object of Python, (n, 3), without a copy.
template <class Number, class Item>
py::array_t<Number> rows_in(const py::object& owner, const std::vector<Item>& list) {
  static_assert(sizeof(Item) == 3 * sizeof(Number));
  return py::array_t<Number>({py::ssize_t(list.size()), py::ssize_t(3)},
                             reinterpret_cast<const Number*>(list.data()), owner);
}

py::array_t<float> numbers_in(const py::object& owner, const std::vector<float>& list) {
  return py::array_t<float>(py::ssize_t(list.size()), list.data(), owner);
}

py::array_t<double> origin_of(const Eigen::Vector3d& origin) {
  return py::array_t<double>(3, origin.data());
}

PointsRequest points_request(const std::string& views, std::optional<double> min_confidence) {
  return {views, min_confidence, {}};
}

Cloud cloud(const ResultPointer& result, const std::string& views,
            std::optional<double> min_confidence, double voxel, std::size_t most_points,
            double memory) {
  result->require_pictures();
  return run([=](const RunControl& control) {
    const std::lock_guard lock(*result->turn);
    CloudRequest request;
    request.points = points_request(views, min_confidence);
    request.cloud.voxel = voxel;
    request.cloud.most_points = most_points;
    request.memory = MemoryBudget(memory / double(1 << 30));
    auto points = std::make_shared<PointCloud>();
    cloud_of(
        points_of_scene(result->scene, request.points, control), request,
        [&](const PointCloud& tile) { append(*points, tile); }, control);
    return points;
  });
}

void save_cloud(const Cloud& points, const std::filesystem::path& path, bool replace) {
  run([=](const RunControl& control) {
    CloudFile file(AtomicFile(path, OutputRules{{}, replace}, {".ply", ".pcd"}),
                   path.extension() == ".pcd" ? CloudFormat::kPcd : CloudFormat::kPly);
    file.add(*points);
    file.commit(control);
  });
}

SurfaceMethod method_of(const std::string& name) {
  if (name == "grid") return SurfaceMethod::kGrid;
  if (name == "poisson") return SurfaceMethod::kPoisson;
  if (name == "front") return SurfaceMethod::kFront;
  refuse("`method` is '" + name + "'; it must be grid, poisson or front");
}

Surface surface(const ResultPointer& result, const std::string& method, const std::string& views,
                std::optional<double> min_confidence, double voxel, bool is_textured,
                double memory) {
  result->require_pictures();
  return run([=, way = method_of(method)](const RunControl& control) {
    const std::lock_guard lock(*result->turn);
    SurfaceRequest request;
    request.points = points_request(views, min_confidence);
    request.method = way;
    request.voxel = voxel;
    request.is_textured = is_textured;
    request.memory = MemoryBudget(memory / double(1 << 30));
    return std::make_shared<SceneSurface>(
        surface_of(points_of_scene(result->scene, request.points, control), request, control));
  });
}

void save_surface(const Surface& surface, const std::filesystem::path& path, bool replace) {
  run([=](const RunControl& control) {
    SurfaceFile file(path, !surface->texture.picture.empty(), OutputRules{{}, replace});
    file.write(*surface);
    file.commit(control);
  });
}

template <class Object, class Get>
auto in_object(Get get) {
  return [get](const py::object& self) { return get(self, *py::cast<Object>(self)); };
}

}  // namespace

void bind_surfaces(py::module_& module) {
  using Self = const py::object&;
  py::class_<PointCloud, Cloud>(module, "PointCloud")
      .def("__len__", &PointCloud::size)
      .def_property_readonly("origin", [](const PointCloud& c) { return origin_of(c.origin); })
      .def_property_readonly("positions", in_object<Cloud>([](Self self, const PointCloud& c) {
                               return rows_in<float>(self, c.positions);
                             }))
      .def_property_readonly("normals", in_object<Cloud>([](Self self, const PointCloud& c) {
                               return rows_in<float>(self, c.normals);
                             }))
      .def_property_readonly("colours", in_object<Cloud>([](Self self, const PointCloud& c) {
                               return rows_in<std::uint8_t>(self, c.colours);
                             }))
      .def_property_readonly("confidences", in_object<Cloud>([](Self self, const PointCloud& c) {
                               return numbers_in(self, c.confidences);
                             }))
      .def_property_readonly("supports", in_object<Cloud>([](Self self, const PointCloud& c) {
                               return numbers_in(self, c.supports);
                             }))
      .def("save", &save_cloud, py::arg("path"), py::arg("replace"));
  py::class_<SceneSurface, Surface>(module, "Surface")
      .def_property_readonly("origin",
                             [](const SceneSurface& s) { return origin_of(s.mesh.origin); })
      .def_property_readonly("positions", in_object<Surface>([](Self self, const SceneSurface& s) {
                               return rows_in<float>(self, s.mesh.positions);
                             }))
      .def_property_readonly("normals", in_object<Surface>([](Self self, const SceneSurface& s) {
                               return rows_in<float>(self, s.mesh.normals);
                             }))
      .def_property_readonly("colours", in_object<Surface>([](Self self, const SceneSurface& s) {
                               return rows_in<std::uint8_t>(self, s.mesh.colours);
                             }))
      .def_property_readonly("faces", in_object<Surface>([](Self self, const SceneSurface& s) {
                               return rows_in<std::uint32_t>(self, s.mesh.faces);
                             }))
      .def("save", &save_surface, py::arg("path"), py::arg("replace"));
  module.def("cloud", &cloud, py::arg("result"), py::arg("views"), py::arg("min_confidence"),
             py::arg("voxel"), py::arg("most_points"), py::arg("memory"));
  module.def("mesh", &surface, py::arg("result"), py::arg("method"), py::arg("views"),
             py::arg("min_confidence"), py::arg("voxel"), py::arg("textured"), py::arg("memory"));
}

}  // namespace gigaray::python
