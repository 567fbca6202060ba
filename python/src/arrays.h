// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Images, maps and lists of the library as arrays of NumPy and the other way round.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "gigaray/core/image.h"

namespace gigaray::python {

namespace py = pybind11;

/// What keeps an object alive for the arrays that look into it.
template <class T>
py::capsule owner_of(std::unique_ptr<T> object) {
  return py::capsule(object.release(), [](void* pointer) { delete static_cast<T*>(pointer); });
}

/// An image as an array (v, u) or, with several channels, (v, u, c), without a copy.
template <class T>
py::array_t<T> array_of(Image<T> image) {
  auto owned = std::make_unique<Image<T>>(std::move(image));
  std::vector<py::ssize_t> shape{owned->height(), owned->width()};
  if (owned->channels() > 1) shape.push_back(owned->channels());
  T* data = owned->data();
  return py::array_t<T>(shape, data, owner_of(std::move(owned)));
}

/// A list of numbers, or of vectors of numbers of a fixed size, as an array (n,) or (n, k), without
/// a copy.
template <class Number, class Item>
py::array_t<Number> array_of_list(std::vector<Item> list) {
  auto owned = std::make_unique<std::vector<Item>>(std::move(list));
  constexpr auto kEach = sizeof(Item) / sizeof(Number);
  std::vector<py::ssize_t> shape{py::ssize_t(owned->size())};
  if constexpr (!std::is_same_v<Number, Item>) shape.push_back(kEach);
  auto* data = reinterpret_cast<Number*>(owned->data());
  return py::array_t<Number>(shape, data, owner_of(std::move(owned)));
}

/// A picture as an array (v, u, c): uint8 of 8-bit pictures, else uint16.
py::array picture_array(Image<std::uint16_t> picture, int bit_depth);

/// 0 and 1 as an array of bool (v, u), without a copy.
py::array_t<bool> mask_array(Mask mask);

/// A map (v, u) of any numbers. Throws Error(kInvalidArgument) naming `field`.
FloatMap map_from(const py::handle& array, const std::string& field);

/// A list of finite numbers. Throws Error(kInvalidArgument) naming `field`.
std::vector<double> numbers_from(const py::handle& array, const std::string& field);

/// Numbers of a matrix, of finite numbers, in C order; `shape`: of the array. The same errors.
std::vector<double> matrix_from(const py::handle& array, const std::string& field,
                                std::vector<py::ssize_t>& shape);

/// "(17, 240, 352, 3)"
std::string shape_text(const py::array& array);

/// Throws Error(kInvalidArgument).
[[noreturn]] void refuse(const std::string& text);

}  // namespace gigaray::python
