// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// The extension gigaray._gigaray. What a user sees is the package python/gigaray around it.
#include <pybind11/pybind11.h>

#include "arrays.h"
#include "errors.h"
#include "gigaray/adapters/depth_colours.h"
#include "gigaray/version.h"
#include "light_field.h"
#include "result.h"
#include "run.h"

namespace gigaray::python {
namespace {

py::dict config() {
  py::dict result;
  result["version"] = GIGARAY_VERSION;
  result["python"] = GIGARAY_PYTHON;
  result["python_version"] = GIGARAY_PYTHON_VERSION;
  result["meshing"] = bool(GIGARAY_HAS_MESHING);
  return result;
}

}  // namespace
}  // namespace gigaray::python

PYBIND11_MODULE(_gigaray, module) {
  using namespace gigaray::python;
  translate_errors();
  module.def("config", &config);
  module.def("depth_colours", [] {
    const auto colours = gigaray::depth_colours();
    return array_of_list<std::uint8_t>(std::vector<gigaray::Rgb8>(colours.begin(), colours.end()));
  });
  module.def("wait_for_abandoned", &wait_for_abandoned);
  bind_camera(module);
  bind_array_pixels(module);
  bind_light_field(module);
  bind_result(module);
  bind_scenes(module);
  bind_page(module);
  bind_rendering(module);
  bind_scores(module);
#if GIGARAY_HAS_MESHING
  bind_surfaces(module);
#endif
}
