// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "view_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gigaray/adapters/photographs.h"
#include "gigaray/engine/camera_order.h"
#include "gigaray/engine/view_layout.h"
#include "open_as_asked.h"

namespace gigaray {
namespace {

/// Places of the views in the order of their numbers; the layout that they have now.
struct Numbering {
  std::vector<int> cells;
  int num_cells = 0;
  ViewLayout layout;
  bool is_stated = false;  ///< by the options, or by the input itself
};

/// NNN of every input_CamNNN, rising.
std::vector<int> camera_numbers(const LightField& light_field) {
  std::vector<int> numbers;
  for (const View& view : light_field.views)
    numbers.push_back(std::stoi(view.name.substr(view.name.find_first_of("0123456789"))));
  return numbers;
}

/// Of a line the steps from the first view; of a grid without gaps the order of the views.
std::vector<int> places_in_series(const LightField& light_field, const GridSize& grid) {
  const std::vector<View>& views = light_field.views;
  std::vector<int> places;
  if (grid.rows > 0) {
    if (light_field.num_views() != grid.rows * grid.columns) return {};
    for (int i = 0; i < light_field.num_views(); ++i) places.push_back(i);
    return places;
  }
  const bool goes_down = views.front().s == views.back().s;
  for (const View& view : views)
    places.push_back(int(std::lround(goes_down ? std::abs(view.t - views.front().t)
                                               : std::abs(view.s - views.front().s))));
  return places;
}

std::optional<Numbering> numbering_of(const InputRequest& input, const LightField& light_field) {
  const OpenOptions& open = input.open;
  const bool is_series = light_field.format == "image sequence" && open.positions.empty();
  const bool is_hci = light_field.format == "HCI scene";
  if (!is_series && !is_hci) return std::nullopt;
  Numbering numbering;
  numbering.cells = is_hci ? camera_numbers(light_field) : places_in_series(light_field, open.grid);
  if (numbering.cells.empty()) return std::nullopt;
  numbering.num_cells = numbering.cells.back() + 1;
  numbering.layout = {1, numbering.num_cells, false};
  numbering.is_stated = open.direction != Travel::kAuto;
  if (open.grid.rows > 0) {
    numbering.layout = {open.grid.rows, open.grid.columns, open.grid.snake};
    numbering.is_stated = true;
  } else if (is_hci) {
    const auto [first, last] =
        std::ranges::minmax(light_field.views, {}, [](const View& view) { return view.s; });
    numbering.layout.columns = int(std::lround(last.s - first.s)) + 1;
    numbering.layout.rows =
        (numbering.num_cells + numbering.layout.columns - 1) / numbering.layout.columns;
    numbering.is_stated = !light_field.rig.unit.empty();  // parameters.cfg
  }
  return numbering;
}

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

std::string option_of(const ViewLayout& layout) {
  return fmt::format("`grid` {}x{}{}", layout.rows, layout.columns,
                     layout.alternating ? ",snake" : "");
}

}  // namespace

bool settle_layout(const InputRequest& input, LightField& light_field, const RunControl& control) {
  if (!input.open.positions.empty() || light_field.format == "Stanford archive") {
    doubt_positions(light_field, control);
    return false;
  }
  const auto numbering = numbering_of(input, light_field);
  // Of what is stated, rows and columns may be swapped.
  if (!numbering || (numbering->is_stated && numbering->layout.rows == numbering->layout.columns))
    return false;
  const std::vector<LayoutTrial> trials =
      try_layouts(light_field, numbering->cells, numbering->num_cells, control);
  if (trials.empty()) return false;
  const LayoutTrial& best = trials.front();
  const bool is_line = numbering->layout.rows == 1;
  if (best.layout == numbering->layout) return false;
  const double as_is =
      is_line ? best.as_line
              : try_layout(light_field, numbering->cells, numbering->layout, control).agreement;
  if (best.agreement < as_is + kGridLead) return false;

  const std::string what = fmt::format(
      "the {} pictures agree to {} as {} rows of {}{}, to {} {}", light_field.num_views(),
      percent(best.agreement), best.layout.rows, best.layout.columns,
      best.layout.alternating ? ", back along every second one" : "", percent(as_is),
      is_line ? std::string("along a line")
              : fmt::format("as {} rows of {}", numbering->layout.rows, numbering->layout.columns));
  if (numbering->is_stated) {
    control.message(what + ": is what is stated right? " + option_of(best.layout) +
                    " would state it");
    return false;
  }
  control.message(what + ": they are taken as a grid (" + option_of(best.layout) + " states it" +
                  (is_line ? ", `direction` right a line)" : ")"));
  OpenOptions open = input.open;
  open.grid = {best.layout.rows, best.layout.columns, best.layout.alternating};
  LightField grid = open_as_asked(folder_of_photographs(input.path), input, open);
  for (const std::string& note : grid.notes)
    if (std::ranges::find(light_field.notes, note) == light_field.notes.end())
      control.message(note);
  light_field = std::move(grid);
  return true;
}

}  // namespace gigaray
