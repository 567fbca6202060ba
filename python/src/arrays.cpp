// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "arrays.h"

#include <cmath>

namespace gigaray::python {
namespace {

/// The array as contiguous numbers. Empty where it can't be one.
template <class T>
py::array_t<T> as_numbers(const py::handle& object, const std::string& field) {
  const auto any = py::array::ensure(object);
  if (!any) {
    PyErr_Clear();
    refuse("`" + field + "` is no array of numbers");
  }
  const char kind = any.dtype().kind();
  if (kind != 'f' && kind != 'i' && kind != 'u')
    refuse("`" + field + "` is an array of " + std::string(py::str(any.dtype())) +
           "; it must hold numbers");
  return py::array_t<T, py::array::c_style | py::array::forcecast>(any);
}

}  // namespace

void refuse(const std::string& text) { throw Error(ErrorCode::kInvalidArgument, text); }

std::string shape_text(const py::array& array) { return py::str(array.attr("shape")); }

py::array picture_array(Image<std::uint16_t> picture, int bit_depth) {
  if (bit_depth > 8) return array_of(std::move(picture));
  Image<std::uint8_t> bytes(picture.width(), picture.height(), picture.channels());
  std::copy(picture.begin(), picture.end(), bytes.begin());
  return array_of(std::move(bytes));
}

py::array_t<bool> mask_array(Mask mask) {
  static_assert(sizeof(bool) == 1);
  auto owned = std::make_unique<Mask>(std::move(mask));
  const std::vector<py::ssize_t> shape{owned->height(), owned->width()};
  auto* data = reinterpret_cast<bool*>(owned->data());
  return py::array_t<bool>(shape, data, owner_of(std::move(owned)));
}

FloatMap map_from(const py::handle& object, const std::string& field) {
  const auto array = as_numbers<float>(object, field);
  if (array.ndim() != 2 || array.size() == 0)
    refuse("`" + field + "` has the shape " + shape_text(array) + "; a map is (v, u)");
  return {int(array.shape(1)), int(array.shape(0)), 1,
          std::vector<float>(array.data(), array.data() + array.size())};
}

std::vector<double> matrix_from(const py::handle& object, const std::string& field,
                                std::vector<py::ssize_t>& shape) {
  const auto array = as_numbers<double>(object, field);
  shape.assign(array.shape(), array.shape() + array.ndim());
  std::vector<double> numbers(array.data(), array.data() + array.size());
  for (const double number : numbers)
    if (!std::isfinite(number)) refuse("`" + field + "` holds a number that is not finite");
  return numbers;
}

std::vector<double> numbers_from(const py::handle& object, const std::string& field) {
  std::vector<py::ssize_t> shape;
  std::vector<double> numbers = matrix_from(object, field, shape);
  if (shape.size() != 1) refuse("`" + field + "` is no list of numbers");
  return numbers;
}

}  // namespace gigaray::python
