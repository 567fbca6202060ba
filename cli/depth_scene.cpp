// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "depth_scene.h"

#include <list>
#include <memory>

#include "gigaray/adapters/depth_result.h"
#include "gigaray/adapters/sparse_file.h"

namespace gigaray::cli {
namespace {

namespace fs = std::filesystem;

FloatMap sure(FloatMap disparity, const FloatMap& confidence, double least) {
  for (std::size_t i = 0; i < disparity.size(); ++i)
    if (!(confidence.data()[i] >= least)) disparity.data()[i] = kNoEstimate;
  return disparity;
}

}  // namespace

DepthScene open_depth_scene(const fs::path& result, const fs::path& input, double min_confidence) {
  DepthScene scene;
  scene.result = result;
  std::error_code ignored;
  if (fs::is_directory(result, ignored)) {
    const auto depth = std::make_shared<DepthResult>(result);
    scene.light_field = depth->with_pictures(input);
    scene.range = depth->searched();
    scene.open_input = [depth, input] { return depth->open_input(input); };
    scene.confidence = [depth](int view) { return depth->confidence(view); };
    scene.disparity = [depth, min_confidence](int view) {
      FloatMap map = depth->disparity(view);
      return min_confidence > 0 ? sure(std::move(map), depth->confidence(view), min_confidence)
                                : map;
    };
  } else {
    if (min_confidence > 0)
      throw Error(ErrorCode::kInvalidArgument,
                  "--min-confidence: a .grl file holds no confidence; give the folder of `depth`");
    const SparseFile file(result);
    scene.light_field = file.light_field();
    scene.range = file.disparity_range();
    scene.disparity = [file](int view) { return file.disparity(view, {0, file.shape().height}); };
  }
  return scene;
}

RealView real_view(const LightField& light_field, int view, const Camera& camera) {
  Image<std::uint16_t> picture = read_view(light_field, view);
  const std::optional<Mask> shown = take_mask(picture);
  RealView real{camera, Image<std::uint16_t>(camera.width, camera.height, 3), {}};
  if (shown) real.shown = Mask(camera.width, camera.height);
  for (int v = 0; v < camera.height; ++v) {
    std::copy_n(picture.row(v), 3 * camera.width, real.picture.row(v));
    if (shown) std::copy_n(shown->row(v), camera.width, real.shown.row(v));
  }
  return real;
}

}  // namespace gigaray::cli
