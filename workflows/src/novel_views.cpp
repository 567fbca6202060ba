// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/novel_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

#include "gigaray/adapters/depth_result.h"
#include "gigaray/workflows/view_list.h"

namespace gigaray {
namespace {

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

/// nearest_cameras() among the views that have depth.
std::vector<int> nearest_views(const DepthScene& scene, const Camera& camera, int most,
                               int exclude) {
  std::vector<Camera> cameras;
  int left_out = -1;
  for (const int view : scene.views()) {
    if (view == exclude) left_out = int(cameras.size());
    cameras.push_back(scene.rig().camera(view));
  }
  std::vector<int> nearest = nearest_cameras(cameras, camera, most, left_out);
  for (int& view : nearest) view = scene.views()[std::size_t(view)];
  return nearest;
}

/// The two nearest views, the nearer one counting more; no depth.
Image<std::uint16_t> blend_of_nearest(DepthScene& scene, const Camera& camera, int exclude) {
  const std::vector<int> two = nearest_views(scene, camera, 2, exclude);
  const DepthView a = scene.view(two.front());
  const double to_a = (a.camera.position() - camera.position()).norm();
  const DepthView& b = scene.view(two.back());
  const double to_b = (b.camera.position() - camera.position()).norm();
  const double part = to_a + to_b > 0 ? to_a / (to_a + to_b) : 0;
  Image<std::uint16_t> picture(camera.width, camera.height, 3);
  for (int v = 0; v < picture.height(); ++v)
    for (int u = 0; u < picture.width(); ++u)
      for (int c = 0; c < 3; ++c) {
        const auto of = [&](const Image<std::uint16_t>& from) {
          return double(from(std::min(u, from.width() - 1), std::min(v, from.height() - 1), c));
        };
        picture(u, v, c) =
            std::uint16_t(std::lround((1 - part) * of(a.picture) + part * of(b.picture)));
      }
  return picture;
}

}  // namespace

Camera parse_pose(const std::string& text, const DepthScene& scene) {
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

std::vector<Camera> parse_path(const std::string& text, const DepthScene& scene) {
  std::vector<Camera> keys;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ';');) keys.push_back(parse_pose(part, scene));
  if (keys.size() < 2)
    throw Error(ErrorCode::kInvalidArgument,
                "`path` needs two key frames or more, with ; between them");
  return keys;
}

std::vector<Camera> cameras_along(const std::vector<Camera>& keys, int frames) {
  std::vector<Camera> cameras;
  for (int i = 0; i < frames; ++i) {
    const double at = frames > 1 ? double(i) * double(keys.size() - 1) / (frames - 1) : 0;
    const auto key = std::min(std::size_t(at), keys.size() - (keys.size() > 1 ? 2 : 1));
    cameras.push_back(keys.size() > 1 ? between(keys[key], keys[key + 1], at - double(key))
                                      : keys[0]);
  }
  return cameras;
}

NovelView render(DepthScene& scene, const Camera& camera, const RenderRequest& request,
                 const RunControl& control, int exclude) {
  std::vector<DepthView> sources;
  for (const int view : nearest_views(scene, camera, request.sources, exclude)) {
    control.throw_if_cancelled();
    sources.push_back(scene.view(view));
  }
  return render_view(camera, sources, scene.light_field().pixels->bit_depth(), request.options,
                     control);
}

LeaveOneOut leave_one_out(DepthScene& scene, const std::string& view, const RenderRequest& request,
                          const RunControl& control) {
  const LightField& light_field = scene.light_field();
  LeaveOneOut result;
  int exclude = -1;
  if (scene.find(view) < 0 &&
      std::ranges::find(light_field.left_out, view, &View::name) != light_field.left_out.end()) {
    result.real = scene.left_out(view);
  } else {
    exclude = parse_view(view, light_field);
    result.took_part_in_depth = true;
    result.real = scene.picture(exclude);
    control.message(
        "its picture had a part in the depth of the others; `depth --without` keeps it out");
  }
  control.progress("render", 0, 1);
  const Camera& camera = result.real.camera;
  result.rendered = render(scene, camera, {request.sources, {}}, control, exclude);
  RenderRequest equal{request.sources, {}};
  equal.options.blend.view_dependent = false;
  result.equal_weights = render(scene, camera, equal, control, exclude);
  result.nearest_two = blend_of_nearest(scene, camera, exclude);
  const auto quality = [&](const Image<std::uint16_t>& picture) {
    return picture_quality(picture, result.real.picture, result.real.bit_depth, result.real.shown);
  };
  result.quality = quality(result.rendered.picture);
  result.quality_of_equal_weights = quality(result.equal_weights.picture);
  result.quality_of_nearest_two = quality(result.nearest_two);
  return result;
}

void fit_into_memory(DepthScene& scene, int sources, double bytes_per_pixel,
                     const MemoryBudget& memory) {
  const LightField& light_field = scene.light_field();
  const double pixels = double(light_field.width) * light_field.height;
  constexpr double kMapBytes = 12;  // of the maps that are made from a source
  sources = std::min(sources, light_field.num_views());
  // Copies of the sources, a map of what each gives, and what is made of them.
  const double view = scene.view_bytes();
  const double least =
      kProgramBytes + pixels * bytes_per_pixel + sources * (2 * view + kMapBytes * pixels);
  memory.require(least, views_text(light_field.num_views(), light_field.width, light_field.height));
  constexpr double kMostKept = 24;
  scene.keep(std::size_t(std::clamp(sources + (memory.bytes() - least) / view, 1.0, kMostKept)));
}

}  // namespace gigaray
