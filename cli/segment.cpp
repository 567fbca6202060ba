// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "command.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/depth_result.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/path_text.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/metric_depth.h"
#include "gigaray/ray_sampler.h"
#include "gigaray/segmentation.h"
#include "numbers.h"
#include "output_option.h"
#include "view_list.h"

namespace gigaray::cli {
namespace {

using nlohmann::ordered_json;

constexpr const char* kSegmentFormat = "gigaray segment";

struct Settings {
  std::filesystem::path result, input;
  OutputOption output;
  double near = 0, far = 0;
  std::string unit = "auto", views = "all";
  double min_confidence = 0;
  bool soft = false;
  MatteOptions matte;
  std::vector<std::string> formats;
};

/// What the interval is measured in.
enum class Unit { kDisparity, kInverseDepth, kDepth };

struct Interval {
  Unit unit = Unit::kDisparity;
  ValueInterval values;
};

const char* name_of(Unit unit) {
  switch (unit) {
    case Unit::kDisparity:
      return "disparity";
    case Unit::kInverseDepth:
      return "inverse depth";
    case Unit::kDepth:
      return "depth";
  }
  return "?";
}

/// Near is the larger disparity but the smaller depth, so the order of the two tells the unit.
Interval interval_of(const Settings& settings, const LightField& light_field) {
  const auto bad = [](const std::string& what) { return Error(ErrorCode::kInvalidArgument, what); };
  if (settings.near == settings.far) throw bad("--near and --far are the same");
  const bool rises = settings.near > settings.far;
  if (settings.unit == "disparity" && !rises)
    throw bad("--unit disparity: --near must be larger than --far, near things move more");
  if (settings.unit == "depth" && rises) throw bad("--unit depth: --near must be less than --far");
  if (rises) {
    const bool posed = light_field.kind == LightFieldKind::kUnstructured;
    return {posed ? Unit::kInverseDepth : Unit::kDisparity,
            {float(settings.far), float(settings.near)}};
  }
  if (!has_metric_depth(light_field))
    throw bad(fmt::format(
        "--near {} is less than --far {}: these are distances, but {} has no depth in scene units; "
        "state disparities (disparity.pfm), of which the near one is larger",
        settings.near, settings.far, settings.result.string()));
  if (settings.near < 0) throw bad("--near: a distance can't be negative");
  return {Unit::kDepth, {float(settings.near), float(settings.far)}};
}

Image<std::uint16_t> as_picture(const Mask& mask) {
  Image<std::uint16_t> picture(mask.width(), mask.height());
  std::transform(mask.begin(), mask.end(), picture.begin(),
                 [](std::uint8_t inside) { return std::uint16_t(inside ? 255 : 0); });
  return picture;
}

Image<std::uint16_t> as_picture(const FloatMap& matte) {
  Image<std::uint16_t> picture(matte.width(), matte.height());
  std::transform(matte.begin(), matte.end(), picture.begin(),
                 [](float opacity) { return std::uint16_t(std::lround(opacity * 65535)); });
  return picture;
}

/// Colours of a view without what its picture has beyond its own camera.
Image<std::uint16_t> colours(const LightField& light_field, int view, const Mask& mask) {
  const Image<std::uint16_t> picture = read_view(light_field, view);
  Image<std::uint16_t> rgb(mask.width(), mask.height(), 3);
  for (int v = 0; v < rgb.height(); ++v)
    for (int u = 0; u < rgb.width(); ++u) std::copy_n(&picture(u, v), 3, &rgb(u, v));
  return rgb;
}

/// matte: empty if there is none.
void write_masks(const std::filesystem::path& place, const Mask& mask, const FloatMap& matte,
                 bool as_exr) {
  write_png(place / "mask.png", as_picture(mask), 8);
  if (!matte.empty()) write_png(place / "matte.png", as_picture(matte), 16);
  if (!as_exr) return;
  if (!matte.empty()) return write_exr(place / "matte.exr", matte);
  FloatMap opacity(mask.width(), mask.height());
  std::copy(mask.begin(), mask.end(), opacity.begin());
  write_exr(place / "mask.exr", opacity);
}

void run(const Settings& settings, const RunControl& control) {
  AtomicFolder folder(settings.output.path, kSegmentFormat,
                      settings.output.rules({settings.result, settings.input}));
  const DepthResult depth(settings.result);
  const LightField& geometry = depth.light_field();
  const Interval interval = interval_of(settings, geometry);
  std::vector<int> views = parse_views(settings.views, geometry);
  if (views.empty()) views = all_views(geometry.num_views());
  const int centre = centre_view(geometry);
  const bool as_exr =
      std::set<std::string>(settings.formats.begin(), settings.formats.end()).contains("exr");
  LightField light_field;
  if (settings.soft) light_field = depth.with_pictures(settings.input);

  ordered_json list = ordered_json::array();
  Mask mask;
  for (std::size_t i = 0; i < views.size(); ++i) {
    control.progress("segment", double(i), double(views.size()));
    const std::string& name = geometry.views[views[i]].name;
    FloatMap map = depth.disparity(views[i]);
    if (settings.min_confidence > 0) {
      const FloatMap confidence = depth.confidence(views[i]);
      for (std::size_t k = 0; k < map.size(); ++k)
        if (!(confidence.data()[k] >= settings.min_confidence)) map.data()[k] = kNoEstimate;
    }
    if (interval.unit == Unit::kDepth) map = depth_from_disparity(map, geometry);
    segment(map, interval.values, mask);

    FloatMap matte;
    if (settings.soft)
      matte = soft_matte(mask, colours(light_field, views[i], mask),
                         light_field.pixels->bit_depth(), settings.matte);
    const std::filesystem::path place = folder.path() / name;
    std::error_code error;
    std::filesystem::create_directories(place, error);
    if (error) throw Error(ErrorCode::kIo, place.string() + ": " + error.message());
    write_masks(place, mask, matte, as_exr);
    if (views[i] == centre) write_masks(folder.path(), mask, matte, as_exr);
    const auto inside = std::count(mask.begin(), mask.end(), 1);
    list.push_back({{"name", name}, {"share", double(inside) / double(mask.size())}});
  }
  const ordered_json root{{"format", kSegmentFormat},
                          {"version", 1},
                          {"depth", path_text(std::filesystem::absolute(settings.result))},
                          {"unit", name_of(interval.unit)},
                          {"least", interval.values.least},
                          {"most", interval.values.most},
                          {"min_confidence", settings.min_confidence},
                          {"views", list}};
  write_file_atomically(folder.path() / "gigaray.json",
                        root.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
  folder.commit(control);
  control.progress("segment", 1, 1);
  fmt::print("{}: {} {:g} … {:g} in {} views\n", settings.output.path.string(),
             name_of(interval.unit), interval.values.least, interval.values.most, views.size());
}

}  // namespace

Run segment_command(CLI::App& app) {
  app.description("Masks of what lies in an interval of depth, every view");
  app.footer(
      "--near 0.8 --far -0.2 are disparities, as in disparity.pfm (of photographs with cameras "
      "inverse depths): the near one is larger.\n--near 1.2 --far 3 are distances in scene units, "
      "as in depth.pfm: the near one is less.");
  auto settings = std::make_shared<Settings>();
  app.add_option("RESULT", settings->result, "What `gigaray depth` wrote")
      ->type_name("OUT")
      ->required();
  app.add_option("--near", settings->near, "Nearest value that belongs to it")
      ->type_name("A")
      ->required();
  app.add_option("--far", settings->far, "Farthest value that belongs to it")
      ->type_name("B")
      ->required();
  app.add_option("--unit", settings->unit,
                 "disparity or depth: refuse a pair in the other order; auto: by their order")
      ->check(CLI::IsMember({"auto", "disparity", "depth"}))
      ->capture_default_str();
  settings->output
      .add_to(app, "Folder for VIEW/mask.png, that of the centre view also at top level")
      ->required();
  app.add_option("--views", settings->views,
                 "all, centre, or a list of names, indices and ranges: 0,4-6,view_09")
      ->capture_default_str();
  app.add_option("--min-confidence", settings->min_confidence, "Leave out what is less sure")
      ->check(zero_or_more())
      ->type_name("C");
  app.add_flag("--soft", settings->soft,
               "VIEW/matte.png too, 16 bit, with edges that follow the colours of the picture");
  app.add_option("--radius", settings->matte.radius, "With --soft: half the width of the edge, px")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  app.add_option("--input", settings->input,
                 "With --soft: where the pictures are, when they are no more where they were")
      ->type_name("INPUT");
  app.add_option("--format", settings->formats, "exr: VIEW/matte.exr or mask.exr too")
      ->check(CLI::IsMember({"exr"}))
      ->delimiter(',');
  return [settings](const RunControl& control) { run(*settings, control); };
}

}  // namespace gigaray::cli
