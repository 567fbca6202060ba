// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "light_field.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "arrays.h"
#include "gigaray/adapters/pose_convention.h"
#include "run.h"

namespace gigaray::python {
namespace {

template <class T>
T chosen(const std::map<std::string, T>& choices, const std::string& word,
         const std::string& field) {
  const auto found = choices.find(word);
  if (found != choices.end()) return found->second;
  std::string all;
  for (const auto& [name, value] : choices) all += (all.empty() ? "" : ", ") + name;
  refuse("`" + field + "` is '" + word + "'; it must be one of " + all);
}

Travel travel_of(const std::string& word, const std::string& field) {
  if (word.empty()) return Travel::kAuto;
  return chosen<Travel>({{"right", Travel::kRight},
                         {"left", Travel::kLeft},
                         {"down", Travel::kDown},
                         {"up", Travel::kUp}},
                        word, field);
}

/// What open() of Python was given, by the names of its arguments.
class Arguments {
 public:
  explicit Arguments(const py::dict& values) : values_(values) {}

  template <class T>
  void read(const char* name, T& target) const {
    if (!values_.contains(name) || py::object(values_[name]).is_none()) return;
    try {
      target = py::cast<T>(values_[name]);
    } catch (const py::cast_error&) {
      refuse("`" + std::string(name) + "` is " + std::string(py::repr(values_[name])) +
             ", which can't be meant");
    }
  }

 private:
  const py::dict& values_;
};

InputRequest request_of(const std::filesystem::path& path, const py::dict& values) {
  const Arguments arguments(values);
  InputRequest request;
  request.path = path;
  std::string direction, row_direction, convention, quality = "medium";
  std::vector<int> grid, lenslet;
  arguments.read("direction", direction);
  arguments.read("row_direction", row_direction);
  arguments.read("convention", convention);
  arguments.read("quality", quality);
  arguments.read("grid", grid);
  arguments.read("lenslet", lenslet);
  arguments.read("positions", request.open.positions);
  arguments.read("images", request.open.images);
  arguments.read("masks", request.open.masks);
  arguments.read("memory", request.open.memory_bytes);
  arguments.read("snake", request.open.grid.snake);
  arguments.read("strict", request.open.strict);
  arguments.read("max_size", request.max_size);
  arguments.read("without", request.without);
  arguments.read("focal_px", request.rig.focal_px);
  arguments.read("baseline", request.rig.baseline);
  arguments.read("focus_distance", request.rig.focus_distance);
  arguments.read("unit", request.rig.unit);
  arguments.read("find_cameras", request.find_cameras);
  arguments.read("colmap_folder", request.colmap_folder);
  request.open.direction = travel_of(direction, "direction");
  request.open.row_direction = travel_of(row_direction, "row_direction");
  request.quality = chosen<ColmapQuality>({{"low", ColmapQuality::kLow},
                                           {"medium", ColmapQuality::kMedium},
                                           {"high", ColmapQuality::kHigh}},
                                          quality, "quality");
  if (!grid.empty()) {
    if (grid.size() != 2 || grid[0] < 1 || grid[1] < 1)
      refuse("`grid` must be two numbers, rows and columns");
    request.open.grid.rows = grid[0];
    request.open.grid.columns = grid[1];
  }
  if (!lenslet.empty()) {
    if (lenslet.size() != 2 || lenslet[0] < 1 || lenslet[1] < 1)
      refuse("`lenslet` must be two numbers, columns and rows");
    request.open.lenslet = {lenslet[0], lenslet[1]};
  }
  if (!convention.empty()) {
    request.open.convention = parse_pose_convention(convention);
    if (!request.open.convention)
      refuse("`convention` is '" + convention +
             "'; it must be opencv, opengl, llff, unity, unreal, ros or three letters as RDF, with "
             "-w2c behind it for scene to camera");
  }
  return request;
}

PyLightField open(const std::filesystem::path& path, const py::dict& values) {
  return run([request = request_of(path, values)](const RunControl& control) {
    PyLightField opened{open_input(request, control)};
    for (const std::string& note : opened.field().notes) control.message(note);
    return opened;
  });
}

py::array picture_of(const PyLightField& light_field, int index) {
  const LightField& field = light_field.field();
  const int view = view_index(field, index);
  Image<std::uint16_t> picture = run([field, view](const RunControl&) {
    Image<std::uint16_t> with_mask = read_view(field, view);
    take_mask(with_mask);
    return with_mask;
  });
  return picture_array(std::move(picture), field.pixels->bit_depth());
}

py::object shown_of(const PyLightField& light_field, int index) {
  const LightField& field = light_field.field();
  const int view = view_index(field, index);
  if (!field.pixels->has_mask()) return py::none();
  std::optional<Mask> shown = run([field, view](const RunControl&) {
    Image<std::uint16_t> picture = read_view(field, view);
    return take_mask(picture);
  });
  if (!shown) return py::none();
  return mask_array(std::move(*shown));
}

/// An epipolar-plane image: one row of the pictures of views with one t, or one column of those
/// with one s.
struct EpiPlace {
  bool is_row = true;
  int pixel = 0;                ///< v of a row, u of a column
  std::optional<double> where;  ///< t of the views, or s; empty: that of the centre view
};

std::vector<int> views_of_epi(const LightField& field, const EpiPlace& place) {
  const auto across = place.is_row ? &View::t : &View::s,
             along = place.is_row ? &View::s : &View::t;
  const double wanted = place.where.value_or(field.views[std::size_t(centre_view(field))].*across);
  constexpr double kSame = 1e-6;
  std::vector<int> views;
  for (int i = 0; i < field.num_views(); ++i)
    if (std::abs(field.views[std::size_t(i)].*across - wanted) < kSame) views.push_back(i);
  if (views.size() < 2)
    refuse(std::string(place.is_row ? "`t`" : "`s`") +
           ": fewer than two views have it; see `positions`");
  std::ranges::stable_sort(views, {}, [&](int i) { return field.views[std::size_t(i)].*along; });
  return views;
}

py::array epi_of(const PyLightField& light_field, bool is_row, int pixel,
                 std::optional<double> where) {
  const LightField& field = light_field.field();
  if (field.kind == LightFieldKind::kUnstructured)
    refuse("`epi`: rays of unstructured views lie in no common row");
  const int size = is_row ? field.height : field.width;
  if (pixel < 0 || pixel >= size)
    refuse("`" + std::string(is_row ? "v" : "u") + "` is " + std::to_string(pixel) +
           "; it must be 0 … " + std::to_string(size - 1));
  const std::vector<int> views = views_of_epi(field, {is_row, pixel, where});
  Image<std::uint16_t> epi = run([field, views, is_row, pixel](const RunControl& control) {
    Image<std::uint16_t> rows(is_row ? field.width : field.height, int(views.size()), 3);
    for (std::size_t i = 0; i < views.size(); ++i) {
      control.progress("epi", double(i), double(views.size()));
      Image<std::uint16_t> picture = read_view(field, views[i]);
      take_mask(picture);
      for (int x = 0; x < rows.width(); ++x)
        for (int c = 0; c < 3; ++c)
          rows(x, int(i), c) = is_row ? picture(x, pixel, c) : picture(pixel, x, c);
    }
    return rows;
  });
  return picture_array(std::move(epi), field.pixels->bit_depth());
}

py::array_t<double> positions_of(const PyLightField& light_field) {
  std::vector<std::array<double, 2>> positions;
  for (const View& view : light_field.field().views) positions.push_back({view.s, view.t});
  return array_of_list<double>(std::move(positions));
}

std::vector<std::string> names_of(const PyLightField& light_field) {
  std::vector<std::string> names;
  for (const View& view : light_field.field().views) names.push_back(view.name);
  return names;
}

py::dict rig_of(const PyLightField& light_field) {
  const RigGeometry& rig = light_field.field().rig;
  py::dict result;
  result["focal_px"] = rig.focal_px;
  result["baseline"] = rig.baseline;
  result["focus_distance"] = rig.focus_distance;
  result["unit"] = rig.unit;
  return result;
}

py::object declared_range(const PyLightField& light_field) {
  const auto& range = light_field.field().declared_range;
  if (!range) return py::none();
  return py::make_tuple(range->min, range->max);
}

}  // namespace

int view_index(const LightField& field, int index) {
  const int views = field.num_views();
  if (index < -views || index >= views)
    throw py::index_error("view " + std::to_string(index) + " of " + std::to_string(views));
  return index < 0 ? index + views : index;
}

void bind_light_field(py::module_& module) {
  py::class_<PyLightField, std::shared_ptr<PyLightField>>(module, "LightField")
      .def_property_readonly("kind",
                             [](const PyLightField& self) { return to_string(self.field().kind); })
      .def_property_readonly("shape",
                             [](const PyLightField& self) {
                               const LightField& field = self.field();
                               return std::make_tuple(field.num_views(), field.height, field.width,
                                                      3);
                             })
      .def_property_readonly("positions", &positions_of)
      .def_property_readonly("names", &names_of)
      .def_property_readonly("rig", &rig_of)
      .def_property_readonly("disparity", &declared_range)
      .def_property_readonly("format", [](const PyLightField& self) { return self.field().format; })
      .def_property_readonly("notes", [](const PyLightField& self) { return self.field().notes; })
      .def_property_readonly(
          "path", [](const PyLightField& self) { return self.input.request.path.string(); })
      .def_property_readonly(
          "bit_depth", [](const PyLightField& self) { return self.field().pixels->bit_depth(); })
      .def_property_readonly("centre",
                             [](const PyLightField& self) { return centre_view(self.field()); })
      .def("camera",
           [](const PyLightField& self, int view) {
             const LightField& field = self.field();
             const int index = view_index(field, view);
             if (field.cameras.empty()) refuse("`camera`: views of a rig have none; see `rig`");
             return field.cameras[std::size_t(index)];
           })
      .def("picture", &picture_of, py::arg("view"))
      .def("shown", &shown_of, py::arg("view"))
      .def("truth",
           [](const PyLightField& self, int view) -> py::object {
             const int index = view_index(self.field(), view);
             if (self.truth.empty()) return py::none();
             return array_of(self.truth[std::size_t(index)]);
           })
      .def("epi", &epi_of, py::arg("is_row"), py::arg("pixel"), py::arg("where"));
  module.def("open", &open, py::arg("path"), py::arg("arguments"));
}

}  // namespace gigaray::python
