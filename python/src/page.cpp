// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// The page of `gigaray view` of a result.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <mutex>
#include <optional>
#include <utility>

#include "gigaray/workflows/view_page.h"
#include "result.h"
#include "run.h"

namespace gigaray::python {
namespace {

std::string page(const ResultPointer& result, const std::string& title, const std::string& views,
                 int max_size, const std::optional<ResultPointer>& compare,
                 const std::filesystem::path& truth) {
  result->require_pictures();
  ViewSceneRequest request;
  request.views = views;
  request.max_size = max_size;
  request.truth = truth;
  if (compare) request.compare = (*compare)->scene;
  return run([=](const RunControl& control) {
    const std::lock_guard lock(*result->turn);
    return view_page(title, [&](const TakeSceneFile& take) {
      return view_scene(*result->scene, request, take, control);
    });
  });
}

}  // namespace

void bind_page(py::module_& module) {
  module.def("page", &page, py::arg("result"), py::arg("title"), py::arg("views"),
             py::arg("max_size"), py::arg("compare"), py::arg("truth"));
}

}  // namespace gigaray::python
