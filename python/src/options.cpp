// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <pybind11/stl.h>

#include <optional>
#include <utility>
#include <vector>

#include "arrays.h"
#include "gigaray/engine/option_table.h"
#include "result.h"

namespace gigaray::python {
namespace {

OptionValue option_value(const py::object& value, const std::string& name) {
  if (value.is_none()) return std::monostate();
  if (py::isinstance<py::bool_>(value)) return py::cast<bool>(value);
  if (py::isinstance<py::str>(value)) return py::cast<std::string>(value);
  try {
    if (PyIndex_Check(value.ptr())) return py::cast<int>(py::int_(value));
    if (PyNumber_Check(value.ptr()) && !PySequence_Check(value.ptr()))
      return py::cast<double>(py::float_(value));
    if (py::isinstance<py::sequence>(value)) {
      for (const py::handle& item : value)
        if (!PyIndex_Check(item.ptr())) return py::cast<std::vector<double>>(value);
      return py::cast<std::vector<int>>(value);
    }
  } catch (const py::cast_error&) {
  }
  refuse("`" + name + "` is " + std::string(py::repr(value)) + ", which can't be meant");
}

void set(DepthOptions& options, const std::string& name, const py::handle& value) {
  set_option(options, name, option_value(py::reinterpret_borrow<py::object>(value), name));
}

/// "winner__median_radius" or "winner.median_radius"
std::string dotted(std::string name) {
  for (std::size_t at = name.find("__"); at != std::string::npos; at = name.find("__", at))
    name.replace(at, 2, ".");
  return name;
}

std::optional<std::pair<double, double>> pair_of(const py::dict& values, const char* name) {
  if (!values.contains(name) || py::object(values[name]).is_none()) return {};
  try {
    return py::cast<std::pair<double, double>>(values[name]);
  } catch (const std::runtime_error&) {
    refuse("`" + std::string(name) + "` is " + std::string(py::repr(values[name])) +
           "; it must be two numbers");
  }
}

}  // namespace

DepthRequest depth_request(const py::dict& values) {
  DepthRequest request;
  request.options = preset_options(py::cast<std::string>(values["preset"]));
  for (const auto& [name, value] : py::cast<py::dict>(values["options"]))
    set(request.options, dotted(py::cast<std::string>(name)), value);
  if (const auto range = pair_of(values, "disparity"))
    request.options.disparity = DisparityRange{range->first, range->second};
  if (const auto range = pair_of(values, "depth")) {
    if (request.options.disparity) refuse("say one of `disparity` and `depth`");
    request.distances = DistanceRange{range->first, range->second};
  }
  request.options.memory_bytes = py::cast<double>(values["memory"]);
  request.views = py::cast<std::string>(values["views"]);
  request.backend.backend = py::cast<std::string>(values["backend"]);
  request.backend.device = py::cast<std::string>(values["device"]);
  return request;
}

}  // namespace gigaray::python
