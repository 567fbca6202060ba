// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <mutex>
#include <string>

#include "gigaray/workflows/depth.h"
#include "gigaray/workflows/result.h"
#include "light_field.h"

namespace gigaray::python {

/// Depth in Python: computed now, or opened from a folder or file.
struct PyResult {
  OpenedInput input;                                         ///< of depth that was computed
  std::shared_ptr<const Reconstruction> computed = nullptr;  ///< null: opened
  std::shared_ptr<DepthScene> scene = nullptr;               ///< one call at a time
  std::shared_ptr<std::mutex> turn = std::make_shared<std::mutex>();
  std::string without_pictures = {};  ///< why there are none; empty: there are

  const LightField& field() const { return scene->light_field(); }
  /// Throws Error(kBadInput) where pictures are needed and there are none.
  void require_pictures() const;
  /// Index of a view that has depth. Throws IndexError.
  int view(int index) const;
};

using ResultPointer = std::shared_ptr<PyResult>;

/// How depth is computed, by the names of the arguments of reconstruct(). Throws
/// Error(kInvalidArgument) naming the field.
DepthRequest depth_request(const py::dict& values);

void bind_result(py::module_& module);
void bind_rendering(py::module_& module);
void bind_surfaces(py::module_& module);
void bind_scores(py::module_& module);
void bind_page(py::module_& module);
void bind_scenes(py::module_& module);

}  // namespace gigaray::python
