// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Light fields of pictures that lie in arrays of NumPy.
#include <pybind11/stl.h>

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "arrays.h"
#include "gigaray/adapters/pose_convention.h"
#include "gigaray/core/image_view.h"
#include "light_field.h"

namespace gigaray::python {
namespace {

/// Keeps arrays; the last one who reads may be a thread of the library.
std::shared_ptr<const void> kept(py::object owner) {
  return {new py::object(std::move(owner)), [](py::object* object) {
            const py::gil_scoped_acquire lock;
            delete object;
          }};
}

template <class T>
std::shared_ptr<const PixelSource> pixels_of_arrays(const std::vector<py::array>& pictures,
                                                    py::object owner) {
  std::vector<ImageView<const T>> views;
  for (const py::array& picture : pictures) {
    ImageView<const T>& view = views.emplace_back(static_cast<const T*>(picture.data()),
                                                  int(picture.shape(1)), int(picture.shape(0)), 3);
    view.stride_v = picture.strides(0);
    view.stride_u = picture.strides(1);
    view.stride_c = picture.strides(2);
  }
  return pixels_of_views(std::move(views), kept(std::move(owner)));
}

int bit_depth_of(const py::array& array, const std::string& field) {
  if (py::isinstance<py::array_t<std::uint8_t>>(array)) return 8;
  if (py::isinstance<py::array_t<std::uint16_t>>(array)) return 16;
  refuse("`" + field + "` holds " + std::string(py::str(array.dtype())) +
         "; pictures are uint8 or uint16, encoded as sRGB");
}

/// Pictures of one array (view, v, u, 3), or of a list of arrays (v, u, 3).
std::vector<py::array> pictures_of_object(const py::object& object, const std::string& field) {
  std::vector<py::array> pictures;
  if (py::isinstance<py::array>(object)) {
    const auto array = py::reinterpret_borrow<py::array>(object);
    if (array.ndim() != 4)
      refuse("`" + field + "` has the shape " + shape_text(array) + "; it must be (view, v, u, 3)");
    for (py::ssize_t i = 0; i < array.shape(0); ++i)
      pictures.push_back(py::reinterpret_borrow<py::array>(array[py::int_(i)]));
    return pictures;
  }
  if (!py::isinstance<py::sequence>(object) || py::isinstance<py::str>(object))
    refuse("`" + field + "` is no array (view, v, u, 3) and no list of arrays (v, u, 3)");
  for (const py::handle& item : object) {
    auto array = py::array::ensure(item);
    if (!array) {
      PyErr_Clear();
      refuse("`" + field + "` holds something that is no array");
    }
    pictures.push_back(std::move(array));
  }
  return pictures;
}

LightField named_views(std::size_t count, const std::vector<std::string>& names) {
  if (!names.empty() && names.size() != count)
    refuse("`names` has " + std::to_string(names.size()) + " entries for " + std::to_string(count) +
           " views");
  LightField field;
  field.format = "arrays";
  field.views.resize(count);
  const int digits = int(std::max<std::size_t>(3, std::to_string(count - 1).size()));
  for (std::size_t i = 0; i < count; ++i) {
    const std::string number = std::to_string(i);
    field.views[i].name =
        names.empty() ? "view_" + std::string(std::size_t(digits) - number.size(), '0') + number
                      : names[i];
  }
  return field;
}

/// The middle of the rig is its zero.
void place(std::vector<View>& views, const py::object& positions, double View::*axis,
           const char* name) {
  if (positions.is_none()) return;
  const std::vector<double> values = numbers_from(positions, name);
  if (values.size() != views.size())
    refuse("`" + std::string(name) + "` has " + std::to_string(values.size()) + " entries for " +
           std::to_string(views.size()) + " views");
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double middle = (*least + *most) / 2;
  for (std::size_t i = 0; i < views.size(); ++i) views[i].*axis = values[i] - middle;
}

/// What can't be meant is a mistake of the arguments here, not of a file.
void check_arguments(const LightField& field) {
  try {
    check(field);
  } catch (const Error& error) {
    refuse(error.what());
  }
}

PyLightField with_pixels(LightField field) {
  check_arguments(field);
  PyLightField result;
  result.input.light_field = std::move(field);
  return result;
}

PyLightField of_positions(const py::object& pixels, const py::object& s, const py::object& t,
                          const StatedRig& rig, const std::vector<std::string>& names) {
  LightField shape;
  const auto source = pixels_in_arrays(pixels, "pixels", shape);
  LightField field = named_views(shape.views.size(), names);
  field.width = shape.width;
  field.height = shape.height;
  field.pixels = source;
  if (s.is_none() && t.is_none()) {
    // As numbered pictures: that the camera goes right is held against the pictures.
    for (std::size_t i = 0; i < field.views.size(); ++i)
      field.views[i].s = double(i) - double(field.views.size() - 1) / 2;
    field.sign_is_assumed = true;
  }
  place(field.views, s, &View::s, "s");
  place(field.views, t, &View::t, "t");
  field.kind = kind_from_positions(field.views);
  rig.apply(field);
  return with_pixels(std::move(field));
}

/// One matrix of `rows` x `columns`, or one for each view.
std::vector<std::vector<double>> matrices(const py::object& object, const std::string& field,
                                          std::size_t views, bool may_be_one,
                                          const std::set<int>& rows, int columns) {
  std::vector<py::ssize_t> shape;
  const std::vector<double> numbers = matrix_from(object, field, shape);
  const bool is_one = shape.size() == 2 && may_be_one;
  const std::size_t at = is_one ? 0 : 1;
  if ((!is_one && (shape.size() != 3 || std::size_t(shape[0]) != views)) ||
      shape[at + 1] != columns || !rows.contains(int(shape[at])))
    refuse("`" + field + "` is no list of " + std::to_string(views) + " matrices of " +
           std::to_string(*rows.begin()) + " x " + std::to_string(columns));
  const std::size_t each = std::size_t(shape[at]) * std::size_t(columns);
  std::vector<std::vector<double>> result;
  for (std::size_t i = 0; i < views; ++i) {
    const double* first = numbers.data() + (is_one ? 0 : i * each);
    result.emplace_back(first, first + each);
  }
  return result;
}

/// Where the centre of the first pixel is.
struct PoseConventions {
  const char* name;
  PoseConvention poses;
  double first_pixel;
};

const PoseConventions& convention_of(const std::string& name) {
  static const PoseConventions all[] = {{"opencv", {"RDF", false}, 0},
                                        {"opengl", {"RUB", false}, 0.5},
                                        {"colmap", {"RDF", false}, 0.5}};
  for (const PoseConventions& one : all)
    if (name == one.name) return one;
  refuse("`convention` is '" + name + "'; it must be opengl, opencv or colmap");
}

Camera camera_of(const std::vector<double>& k, double first_pixel, const std::string& view) {
  Camera camera;
  camera.focal_u = k[0];
  camera.focal_v = k[4];
  camera.centre_u = k[2] - first_pixel;
  camera.centre_v = k[5] - first_pixel;
  if (k[1] != 0 || k[3] != 0 || k[6] != 0 || k[7] != 0 || k[8] != 1)
    refuse("`K` of " + view + " is no matrix [[f_u, 0, c_u], [0, f_v, c_v], [0, 0, 1]]");
  return camera;
}

PyLightField of_poses(const py::object& images, const py::object& poses, const py::object& k,
                      const std::string& convention,
                      const std::optional<std::vector<double>>& depth, const std::string& unit,
                      const std::vector<std::string>& names) {
  LightField shape;
  const auto source = pixels_in_arrays(images, "images", shape);
  const std::size_t count = shape.views.size();
  LightField field = named_views(count, names);
  field.kind = LightFieldKind::kUnstructured;
  field.width = shape.width;
  field.height = shape.height;
  field.pixels = source;
  field.rig.unit = unit;
  const PoseConventions& how = convention_of(convention);
  const auto stated = matrices(poses, "c2w", count, false, {3, 4}, 4);
  const auto inner = matrices(k, "K", count, true, {3}, 3);
  std::size_t mirrored = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Camera camera = camera_of(inner[i], how.first_pixel, field.views[i].name);
    const StatedPose matrix =
        Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(stated[i].data());
    const auto pose = read_pose(matrix, how.poses);
    if (!pose) refuse("`c2w` of " + field.views[i].name + " has a rotation that is none");
    mirrored += pose->is_mirrored;
    camera.width = field.width;
    camera.height = field.height;
    camera.rotation = pose->rotation;
    camera.translation = pose->translation;
    if (depth) {
      if (depth->size() != 2 || !((*depth)[0] > 0 && (*depth)[0] < (*depth)[1]))
        refuse("`depth` must be two distances, 0 < near < far");
      camera.inverse_depth = InverseDepthRange{1 / (*depth)[1], 1 / (*depth)[0]};
    }
    field.cameras.push_back(camera);
  }
  if (mirrored != 0 && mirrored != count)
    refuse("`c2w`: some frames are left-handed, others are not");
  field.pose_reading = PoseReading{name_of(how.poses), mirrored != 0};
  place_by_cameras(field);
  return with_pixels(std::move(field));
}

}  // namespace

std::shared_ptr<const PixelSource> pixels_in_arrays(const py::object& object,
                                                    const std::string& field, LightField& shape) {
  const std::vector<py::array> pictures = pictures_of_object(object, field);
  if (pictures.size() < 2)
    refuse("`" + field + "` has " + std::to_string(pictures.size()) +
           " pictures; depth needs two or more");
  const int bit_depth = bit_depth_of(pictures.front(), field);
  py::list owners;
  for (const py::array& picture : pictures) {
    if (picture.ndim() != 3 || picture.shape(2) != 3 || picture.size() == 0)
      refuse("`" + field + "`: a picture has the shape " + shape_text(picture) +
             "; it must be (v, u, 3)");
    if (picture.shape(0) != pictures[0].shape(0) || picture.shape(1) != pictures[0].shape(1) ||
        bit_depth_of(picture, field) != bit_depth)
      refuse("`" + field + "`: pictures must all have one size and type");
    owners.append(picture);
  }
  shape.views.resize(pictures.size());
  shape.height = int(pictures[0].shape(0));
  shape.width = int(pictures[0].shape(1));
  return bit_depth == 8 ? pixels_of_arrays<std::uint8_t>(pictures, std::move(owners))
                        : pixels_of_arrays<std::uint16_t>(pictures, std::move(owners));
}

void bind_array_pixels(py::module_& module) {
  module.def(
      "light_field_of_arrays",
      [](const py::object& pixels, const py::object& s, const py::object& t,
         std::optional<double> focal_px, std::optional<double> baseline,
         std::optional<double> focus_distance, const std::string& unit,
         const std::vector<std::string>& names) {
        return of_positions(pixels, s, t, {focal_px, baseline, focus_distance, unit}, names);
      },
      py::arg("pixels"), py::arg("s"), py::arg("t"), py::arg("focal_px"), py::arg("baseline"),
      py::arg("focus_distance"), py::arg("unit"), py::arg("names"));
  module.def("light_field_of_poses", &of_poses, py::arg("images"), py::arg("c2w"), py::arg("K"),
             py::arg("convention"), py::arg("depth"), py::arg("unit"), py::arg("names"));
}

}  // namespace gigaray::python
