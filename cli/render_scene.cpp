// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "render_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "gigaray/adapters/depth_result.h"
#include "view_list.h"

namespace gigaray::cli {
namespace {

namespace fs = std::filesystem;

std::optional<std::vector<double>> parse_numbers(const std::string& text, std::size_t count) {
  std::vector<double> numbers;
  const char* begin = text.data();
  const char* const end = begin + text.size();
  while (begin < end) {
    double number = 0;
    const auto [next, error] = std::from_chars(begin, end, number);
    if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
    numbers.push_back(number);
    if (next == end) break;
    if (*next != ',') return std::nullopt;
    begin = next + 1;
  }
  if (numbers.size() != count) return std::nullopt;
  return numbers;
}

}  // namespace

RenderScene::RenderScene(const fs::path& result, const fs::path& input, double min_confidence)
    : scene_(open_depth_scene(result, input, min_confidence)),
      rig_(scene_.light_field, scene_.range.min) {}

double RenderScene::source_bytes() const {
  return 10.0 * light_field().width * light_field().height;
}

double RenderScene::map_bytes() const { return 12.0 * light_field().width * light_field().height; }

const SourceView& RenderScene::source(int view) {
  const auto found =
      std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) { return kept.view == view; });
  if (found != kept_.end()) {
    kept_.splice(kept_.begin(), kept_, found);
    return kept_.front().source;
  }
  const Camera& camera = rig_.camera(view);
  kept_.push_front({view,
                    {camera, real_view(light_field(), view, camera).picture,
                     rig_.inverse_depth(scene_.disparity(view))}});
  return kept_.front().source;
}

NovelView RenderScene::render(const Camera& camera, int most_sources, int exclude,
                              const NovelViewOptions& options, const RunControl& control) {
  std::vector<SourceView> sources;
  for (const int view : nearest_cameras(rig_.cameras(), camera, most_sources, exclude)) {
    control.throw_if_cancelled();
    sources.push_back(source(view));
  }
  if (kept_.size() > most_kept_) kept_.resize(std::max(most_kept_, sources.size()));
  return render_view(camera, sources, light_field().pixels->bit_depth(), options, control);
}

int RenderScene::find(const std::string& name) const {
  const auto found = std::find_if(light_field().views.begin(), light_field().views.end(),
                                  [&](const View& view) { return view.name == name; });
  return found == light_field().views.end() ? -1 : int(found - light_field().views.begin());
}

RealView RenderScene::left_out(const std::string& name) const {
  const auto place = std::find_if(light_field().left_out.begin(), light_field().left_out.end(),
                                  [&](const View& view) { return view.name == name; });
  if (place == light_field().left_out.end())
    throw Error(ErrorCode::kInvalidArgument,
                fmt::format("view {}: {} has no view of this name", name, scene_.result.string()));
  const LightField all = scene_.open_input();
  const auto view = std::find_if(all.views.begin(), all.views.end(),
                                 [&](const View& other) { return other.name == name; });
  if (view == all.views.end())
    throw Error(ErrorCode::kBadInput,
                fmt::format("{}: its input has no view {} any more", scene_.result.string(), name));
  const int index = int(view - all.views.begin());
  const Camera camera = all.kind == LightFieldKind::kUnstructured
                            ? all.cameras[index]
                            : rig_.camera_at(place->s, place->t);
  return real_view(all, index, camera);
}

Camera parse_pose(const std::string& text, const RenderScene& scene) {
  const LightField& light_field = scene.light_field();
  if (text.ends_with(".json")) return read_camera(text);
  const auto plus = scene.find(text) < 0 ? text.find('+') : std::string::npos;
  const std::string base = text.substr(0, plus);
  const auto bad = [&](const std::string& what) {
    return Error(ErrorCode::kInvalidArgument, "pose '" + text + "': " + what);
  };
  Camera camera;
  if (const auto place = scene.find(base) < 0 ? parse_numbers(base, 2) : std::nullopt) {
    if (light_field.kind == LightFieldKind::kUnstructured)
      throw bad("S,T is a place of a 3D or 4D light field; name a view, as in " +
                light_field.views.front().name + "+0.1,0,0");
    camera = scene.rig().camera_at((*place)[0], (*place)[1]);
  } else {
    camera = scene.rig().camera(parse_view(base, light_field));
  }
  if (plus == std::string::npos) return camera;
  const auto way = parse_numbers(text.substr(plus + 1), 3);
  if (!way) throw bad("after + three numbers are needed: right,down,ahead in scene units");
  camera.translation -= Eigen::Vector3d((*way)[0], (*way)[1], (*way)[2]);
  return camera;
}

}  // namespace gigaray::cli
