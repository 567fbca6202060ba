// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "command.h"
#include "did_you_mean.h"
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
#include "pixel_interval.h"
#include "view_list.h"

namespace gigaray::cli {
namespace {

using nlohmann::ordered_json;

constexpr const char* kSegmentFormat = "gigaray segment";

struct Settings {
  std::filesystem::path result, input;
  OutputOption output;
  double near = 0, far = 0;
  bool is_interval = false;  ///< are these stated?
  std::vector<int> at;       ///< empty or U V
  std::optional<double> tolerance;
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

/// Of the maps.
Unit unit_of(const LightField& light_field) {
  return light_field.kind == LightFieldKind::kUnstructured ? Unit::kInverseDepth : Unit::kDisparity;
}

/// Near is the larger disparity but the smaller depth, so the order of the two tells the unit.
Interval interval_of(const Settings& settings, const LightField& light_field) {
  const auto bad = [](const std::string& what) { return Error(ErrorCode::kInvalidArgument, what); };
  if (settings.near == settings.far) throw bad("--near and --far are the same");
  const bool rises = settings.near > settings.far;
  if (settings.unit == "disparity" && !rises)
    throw bad("--unit disparity: --near must be larger than --far, near things move more");
  if (settings.unit == "depth" && rises) throw bad("--unit depth: --near must be less than --far");
  if (rises) return {unit_of(light_field), {float(settings.far), float(settings.near)}};
  if (!has_metric_depth(light_field))
    throw bad(fmt::format(
        "--near {} is less than --far {}: these are distances, but {} has no depth in scene units; "
        "state disparities (disparity.pfm), of which the near one is larger, or the rig to "
        "`gigaray "
        "depth` with --focal-px and --baseline",
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

/// Disparities of a view that are sure enough.
FloatMap disparity_of(const DepthResult& depth, int view, double min_confidence) {
  FloatMap map = depth.disparity(view);
  if (min_confidence <= 0) return map;
  const FloatMap confidence = depth.confidence(view);
  for (std::size_t k = 0; k < map.size(); ++k)
    if (!(confidence.data()[k] >= min_confidence)) map.data()[k] = kNoEstimate;
  return map;
}

/// The interval in scene units, for people; empty where these are not known.
std::string depth_text(const ValueInterval& values, const LightField& geometry) {
  if (!has_metric_depth(geometry)) return {};
  const FloatMap depth =
      depth_from_disparity(FloatMap(2, 1, 1, {values.most, values.least}), geometry);
  const std::string& unit = geometry.rig.unit;
  return fmt::format(", depth {:.4g} … {}{}", depth(0, 0),
                     std::isnan(depth(1, 0)) ? "infinity" : fmt::format("{:.4g}", depth(1, 0)),
                     unit.empty() ? "" : " " + unit);
}

void print_choice(const PixelInterval& pixel, const Interval& interval, const Settings& settings,
                  const DepthResult& depth) {
  const LightField& geometry = depth.light_field();
  const bool posed = geometry.kind == LightFieldKind::kUnstructured;
  fmt::print("around {:.4g} at {} {} of {}{}; {}: --near {} --far {}\n", pixel.value(),
             settings.at[0], settings.at[1], geometry.views[depth.top_view()].name,
             depth_text(interval.values, geometry), posed ? "there the same" : "the same",
             interval.values.most, interval.values.least);
}

void run(const Settings& settings, const RunControl& control) {
  if (!settings.is_interval && settings.at.empty())
    throw Error(ErrorCode::kInvalidArgument,
                "say what belongs to the mask: --at U V, a pixel of it, or --near A --far B");
  AtomicFolder folder(settings.output.path, kSegmentFormat,
                      settings.output.rules({settings.result, settings.input}));
  const DepthResult depth(settings.result);
  const LightField& geometry = depth.light_field();
  std::optional<PixelInterval> pixel;
  if (!settings.at.empty())
    pixel.emplace(depth, disparity_of(depth, depth.top_view(), settings.min_confidence),
                  settings.at, settings.tolerance);
  const Interval interval =
      pixel ? Interval{unit_of(geometry), pixel->values()} : interval_of(settings, geometry);
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
    FloatMap map = disparity_of(depth, views[i], settings.min_confidence);
    if (interval.unit == Unit::kDepth) map = depth_from_disparity(map, geometry);
    segment(map, pixel ? pixel->values_in(views[i]) : interval.values, mask);

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
  ordered_json root{{"format", kSegmentFormat},
                    {"version", 1},
                    {"depth", path_text(std::filesystem::absolute(settings.result))},
                    {"unit", name_of(interval.unit)},
                    {"least", interval.values.least},
                    {"most", interval.values.most},
                    {"min_confidence", settings.min_confidence},
                    {"views", list}};
  if (pixel) root["at"] = pixel->json();
  write_file_atomically(folder.path() / "gigaray.json",
                        root.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n");
  folder.commit(control);
  control.progress("segment", 1, 1);
  fmt::print("{}: {} {:g} … {:g} in {} views\n", settings.output.path.string(),
             name_of(interval.unit), interval.values.least, interval.values.most, views.size());
  if (pixel) print_choice(*pixel, interval, settings, depth);
}

void add_interval(CLI::App& app, const std::shared_ptr<Settings>& settings) {
  CLI::Option* at =
      app.add_option("--at", settings->at,
                     "What lies at the depth of this pixel of the view at top level, which is the "
                     "centre view as a rule; 0 0 is its top left corner")
          ->expected(2)
          ->type_name("U V");
  app.add_option("--tolerance", settings->tolerance,
                 "With --at: how far from its depth, px per view step, of photographs with cameras "
                 "a share of the inverse depth (default: as far as the surface at the pixel goes "
                 "without a jump, a tenth of all disparities at most)")
      ->check(above_zero())
      ->needs(at)
      ->type_name("T");
  CLI::Option* near = app.add_option("--near", settings->near, "Nearest value that belongs to it")
                          ->excludes(at)
                          ->type_name("A");
  CLI::Option* far = app.add_option("--far", settings->far, "Farthest value that belongs to it")
                         ->excludes(at)
                         ->type_name("B");
  near->needs(far);
  far->needs(near);
  far->each([settings](const std::string&) { settings->is_interval = true; });
  app.add_option("--unit", settings->unit,
                 "disparity or depth: refuse a pair in the other order; auto: by their order")
      ->check(one_of({"auto", "disparity", "depth"}))
      ->excludes(at)
      ->capture_default_str();
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
  add_interval(app, settings);
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
      ->check(one_of({"exr"}))
      ->delimiter(',');
  return [settings](const RunControl& control) { run(*settings, control); };
}

}  // namespace gigaray::cli
