// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

#include "gigaray/core/image.h"
#include "gigaray/workflows/input.h"

namespace gigaray::python {

namespace py = pybind11;

/// A light field in Python.
struct PyLightField {
  OpenedInput input;
  std::vector<FloatMap> truth = {};  ///< of synthetic scenes, in the unit of ViewDepth; else empty

  const LightField& field() const { return input.light_field; }
};

/// Pictures that lie in arrays (v, u, 3) of uint8 or uint16, all of one size and type, with any
/// strides. They are not copied. Throws Error(kInvalidArgument) naming `field`.
std::shared_ptr<const PixelSource> pixels_in_arrays(const py::object& pictures,
                                                    const std::string& field, LightField& shape);

/// Index of a view of a light field, which may count from the end. Throws IndexError.
int view_index(const LightField& field, int index);

/// The camera, and its poses in the conventions of other programs.
void bind_camera(py::module_& module);
void bind_array_pixels(py::module_& module);
void bind_light_field(py::module_& module);

}  // namespace gigaray::python
