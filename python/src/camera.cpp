// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/camera.h"

#include "arrays.h"
#include "light_field.h"

namespace gigaray::python {
namespace {

template <int kRows, int kColumns>
py::array_t<double> array_of_matrix(const Eigen::Matrix<double, kRows, kColumns>& matrix) {
  py::array_t<double> result({kRows, kColumns});
  auto values = result.mutable_unchecked<2>();
  for (int i = 0; i < kRows; ++i)
    for (int j = 0; j < kColumns; ++j) values(i, j) = matrix(i, j);
  return result;
}

py::array_t<double> inner_matrix(const Camera& camera) {
  Eigen::Matrix3d k = Eigen::Matrix3d::Identity();
  k(0, 0) = camera.focal_u;
  k(1, 1) = camera.focal_v;
  k(0, 2) = camera.centre_u;
  k(1, 2) = camera.centre_v;
  return array_of_matrix<3, 3>(k);
}

py::array_t<double> scene_to_camera(const Camera& camera) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = camera.rotation;
  matrix.topRightCorner<3, 1>() = camera.translation;
  return array_of_matrix<4, 4>(matrix);
}

py::array_t<double> camera_to_scene(const Camera& camera) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = camera.rotation.transpose();
  matrix.topRightCorner<3, 1>() = camera.position();
  return array_of_matrix<4, 4>(matrix);
}

}  // namespace

void bind_camera(py::module_& module) {
  py::class_<Camera>(module, "Camera",
                     "A pinhole camera: x to the right, y down, z along the view; pixel centres "
                     "are at integers.")
      .def_readonly("width", &Camera::width, "px")
      .def_readonly("height", &Camera::height, "px")
      .def_property_readonly("K", &inner_matrix,
                             "(3, 3): [[f_u, 0, c_u], [0, f_v, c_v], [0, 0, 1]], px")
      .def_property_readonly("w2c", &scene_to_camera, "(4, 4): points of the scene to the camera")
      .def_property_readonly("c2w", &camera_to_scene, "(4, 4): points of the camera to the scene")
      .def("__repr__", [](const Camera& camera) {
        return "<gigaray.Camera " + std::to_string(camera.width) + " x " +
               std::to_string(camera.height) + " px>";
      });
}

}  // namespace gigaray::python
