// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "command.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/light_field_json.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/adapters/sparse_file.h"
#include "gigaray/core/ray_sampler.h"
#include "gigaray/workflows/view_list.h"
#include "output_option.h"

namespace gigaray::cli {
namespace {

struct Settings {
  std::filesystem::path input;
  OutputOption output;
  std::string views = "all";
  std::vector<int> rows;  ///< empty or BEGIN END
  bool depth = false;
};

void write_depth(const std::filesystem::path& folder, const FloatMap& disparity,
                 const SparseFile& file) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error(ErrorCode::kIo, folder.string() + ": " + error.message());
  write_pfm(folder / "disparity.pfm", disparity);
  const DisparityRange range = file.disparity_range();
  if (range.min < range.max) write_depth_picture(folder / "depth.png", disparity, range);
}

void run(const Settings& settings, const RunControl& control) {
  AtomicFolder folder(settings.output.path, kLightFieldFormat,
                      settings.output.rules({settings.input}));
  const SparseFile file(settings.input);
  LightField light_field = file.light_field();
  for (const std::string& note : light_field.notes) control.message(note);
  std::vector<int> views = parse_views(settings.views, light_field);
  if (views.empty()) views = all_views(light_field.num_views());
  RowRange rows{0, light_field.height};
  if (!settings.rows.empty()) rows = {settings.rows[0], settings.rows[1]};
  if (rows.begin < 0 || rows.begin >= rows.end || rows.end > light_field.height)
    throw Error(ErrorCode::kInvalidArgument,
                fmt::format("--rows {} {}: the rows are 0 … {}, the second number is one more than "
                            "the last row",
                            rows.begin, rows.end, light_field.height - 1));

  std::vector<std::string> files;
  std::vector<View> decoded;
  for (std::size_t i = 0; i < views.size(); ++i) {
    control.progress("decode", double(i), double(views.size()));
    decoded.push_back(light_field.views[views[i]]);
    const std::string& name = decoded.back().name;
    files.push_back(name + ".png");
    write_png(folder.path() / files.back(), file.picture(views[i], rows), file.shape().bit_depth);
    if (settings.depth) write_depth(folder.path() / name, file.disparity(views[i], rows), file);
  }
  light_field.views = decoded;
  light_field.kind = kind_from_positions(light_field.views);
  light_field.height = rows.size();
  write_light_field_json(folder.path() / "gigaray.json", light_field, files);
  folder.commit(control);
  control.progress("decode", 1, 1);
  fmt::print("{}: {} views\n", settings.output.path.string(), views.size());
}

}  // namespace

Run decode_command(CLI::App& app) {
  app.description("Views and depth out of a compact file");
  auto settings = std::make_shared<Settings>();
  app.add_option("FILE", settings->input, "What `gigaray encode` wrote")
      ->type_name("FILE.grl")
      ->required();
  settings->output.add_to(app, "Folder for the views as PNG, a light field again")->required();
  app.add_option("--views", settings->views,
                 "all, centre, or a list of names, indices and ranges: 0,4-6,view_09")
      ->capture_default_str();
  app.add_option("--rows", settings->rows,
                 "These rows alone: the first, and the one after the last")
      ->expected(2)
      ->type_name("BEGIN END");
  app.add_flag("--depth", settings->depth,
               "Disparity of each view too, VIEW/disparity.pfm and VIEW/depth.png");
  return [settings](const RunControl& control) { run(*settings, control); };
}

}  // namespace gigaray::cli
