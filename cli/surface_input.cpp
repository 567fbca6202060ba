// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "surface_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <list>
#include <memory>

#include "cameras.h"
#include "depth_scene.h"
#include "gigaray/ray_sampler.h"
#include "gigaray/rig_cameras.h"
#include "view_list.h"

namespace gigaray::cli {
namespace {

/// Reads views of a scene; the last ones are kept, since they bear witness for each other.
class ViewReader {
 public:
  ViewReader(DepthScene scene, RigCameras rig, std::vector<int> views)
      : scene_(std::move(scene)), rig_(std::move(rig)), views_(std::move(views)) {}

  static constexpr std::size_t kMostKept = 24;

  DepthView read(int index) {
    const auto found = std::ranges::find(kept_, index, &Kept::index);
    if (found != kept_.end())
      kept_.splice(kept_.begin(), kept_, found);
    else
      kept_.push_front({index, read_now(views_[index])});
    if (kept_.size() > kMostKept) kept_.pop_back();
    return kept_.front().view;
  }

 private:
  struct Kept {
    int index;
    DepthView view;
  };

  DepthView read_now(int view) const {
    const Camera& camera = rig_.camera(view);
    DepthView result{camera, rig_.inverse_depth(scene_.disparity(view)), {}, {}};
    if (scene_.confidence) result.confidence = scene_.confidence(view);
    const Image<std::uint16_t> picture = real_view(scene_.light_field, view, camera).picture;
    const int shift = scene_.light_field.pixels->bit_depth() - 8;
    result.picture = Image<std::uint8_t>(picture.width(), picture.height(), 3);
    std::ranges::transform(picture, result.picture.begin(),
                           [&](std::uint16_t value) { return std::uint8_t(value >> shift); });
    return result;
  }

  DepthScene scene_;
  RigCameras rig_;
  std::vector<int> views_;
  std::list<Kept> kept_;  ///< the last one used first
};

}  // namespace

void SurfaceInput::declare(CLI::App& app) {
  app.add_option("RESULT", result, "What `gigaray depth` wrote, or a .grl file")
      ->type_name("OUT")
      ->required();
  app.add_option("--views", views, "all, centre, or a list of names, indices and ranges")
      ->capture_default_str();
  app.add_option("--input", input, "Where the pictures are, when they are no more where they were")
      ->type_name("INPUT");
  app.add_option("--min-confidence", least_confidence,
                 "Leave out what is less sure (default: 0.6 of posed photographs, whose confidence "
                 "is the share within 1 % of the depth, else 0.1)")
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("C");
  app.add_option_function<int>(
         "--min-support", [this](int support) { points.least_support = support; },
         "Leave out points that fewer other views see where they are (default: two, and four "
         "fifths of those that should)")
      ->check(CLI::Range(0, 1000))
      ->type_name("N");
  app.add_flag("--keep-ground", points.keeps_plain_ground,
               "Keep points of the white or black that is half of the border of every picture");
}

double SurfaceInput::view_bytes(double pixels, int num_views) {
  constexpr double kPixel = 2 * sizeof(float) + 3;
  return kPixel * pixels * std::min<double>(num_views, ViewReader::kMostKept);
}

SurfaceInput::Opened SurfaceInput::open(const RunControl& control) const {
  DepthScene scene = open_depth_scene(result, input, 0);
  std::vector<int> chosen = parse_views(views, scene.light_field);
  if (chosen.empty()) chosen = all_views(scene.light_field.num_views());
  RigCameras rig(scene.light_field, scene.range.min);
  if (!rig.is_metric())
    control.message(
        "focal length and view step are not known: the scene keeps straight lines but not angles "
        "(--focal-px and --baseline of `gigaray depth` state them)");
  if (const std::string note = note_on_scale(scene.light_field); !note.empty())
    control.message(note);
  Opened opened{{}, points};
  if (scene.light_field.kind == LightFieldKind::kUnstructured)
    opened.points.least_confidence = kPosedConfidence;
  if (least_confidence) opened.points.least_confidence = *least_confidence;
  DepthViews& result = opened.views;
  for (const int view : chosen) result.cameras.push_back(rig.camera(view));
  const auto reader =
      std::make_shared<ViewReader>(std::move(scene), std::move(rig), std::move(chosen));
  result.read = [reader](int view) { return reader->read(view); };
  return opened;
}

void print(const PointCounts& counts, int num_views, const PointOptions& options) {
  fmt::print("pixels        {} of {} views\n", counts.pixels, num_views);
  fmt::print("no estimate   {}\n", counts.without_estimate);
  if (counts.ground > 0)
    fmt::print("plain ground  {} of the white or black around what all views show\n",
               counts.ground);
  fmt::print("unsure        {} with a confidence below {:g}\n", counts.unsure,
             options.least_confidence);
  fmt::print("too far       {} whose depth could be twice as large\n", counts.too_far);
  fmt::print("contradicted  {} that more views see through than see\n", counts.contradicted);
  fmt::print("unconfirmed   {} that fewer than {} other views see\n", counts.unconfirmed,
             options.least_support ? std::to_string(*options.least_support)
                                   : "two, or than four fifths of those that should,");
}

nlohmann::ordered_json as_json(const PointCounts& counts) {
  return {{"pixels", counts.pixels},           {"without_estimate", counts.without_estimate},
          {"plain_ground", counts.ground},     {"unsure", counts.unsure},
          {"too_far", counts.too_far},         {"contradicted", counts.contradicted},
          {"unconfirmed", counts.unconfirmed}, {"points", counts.points}};
}

void print_origin(const Eigen::Vector3d& origin) {
  if (origin.isZero(0)) return;
  fmt::print("origin        {} {} {}: coordinates in the file are relative to it\n", origin.x(),
             origin.y(), origin.z());
}

nlohmann::ordered_json origin_json(const Eigen::Vector3d& origin) {
  return nlohmann::ordered_json::array({origin.x(), origin.y(), origin.z()});
}

}  // namespace gigaray::cli
