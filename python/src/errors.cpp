// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "errors.h"

#include <pybind11/pybind11.h>

#include <filesystem>
#include <new>

#include "gigaray/core/error.h"

namespace gigaray::python {
namespace {

namespace py = pybind11;

const char* name_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::kInvalidArgument:
      return "invalid_argument";
    case ErrorCode::kBadInput:
      return "bad_input";
    case ErrorCode::kIo:
      return "io";
    case ErrorCode::kDevice:
      return "device";
    case ErrorCode::kOutOfMemory:
      return "out_of_memory";
    case ErrorCode::kCancelled:
      return "cancelled";
  }
  return "unknown";
}

void raise(const char* code, const char* text) {
  const py::object type = py::module_::import("gigaray._error").attr("Error");
  const py::object error =
      type(py::reinterpret_steal<py::object>(PyUnicode_DecodeUTF8(
               text, Py_ssize_t(std::char_traits<char>::length(text)), "surrogateescape")),
           code);
  PyErr_SetObject(type.ptr(), error.ptr());
}

}  // namespace

void translate_errors() {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const Error& error) {
      raise(name_of(error.code()), error.what());
    } catch (const std::bad_alloc&) {
      raise("out_of_memory", "there is not enough memory; `memory` limits what a run takes");
    } catch (const std::filesystem::filesystem_error& error) {
      raise("io", error.what());
    }
  });
}

}  // namespace gigaray::python
