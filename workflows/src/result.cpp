// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/result.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "depth_record.h"
#include "gigaray/adapters/depth_result.h"
#include "gigaray/adapters/sparse_file.h"
#include "gigaray/core/ray_sampler.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

/// A view with its picture as large as its camera.
DepthView pictured(const LightField& light_field, int view, const Camera& camera) {
  Image<std::uint16_t> picture = read_view(light_field, view);
  const std::optional<Mask> shown = take_mask(picture);
  DepthView result;
  result.camera = camera;
  result.picture = Image<std::uint16_t>(camera.width, camera.height, 3);
  result.bit_depth = light_field.pixels->bit_depth();
  if (shown) result.shown = Mask(camera.width, camera.height);
  for (int v = 0; v < camera.height; ++v) {
    std::copy_n(picture.row(v), 3 * camera.width, result.picture.row(v));
    if (shown) std::copy_n(shown->row(v), camera.width, result.shown.row(v));
  }
  return result;
}

/// Of an unstructured view what its own camera shows.
FloatMap cropped(FloatMap map, const LightField& light_field, int view) {
  if (light_field.kind != LightFieldKind::kUnstructured) return map;
  const Camera& camera = light_field.cameras[std::size_t(view)];
  if (map.width() == camera.width && map.height() == camera.height) return map;
  FloatMap result(camera.width, camera.height);
  for (int v = 0; v < camera.height; ++v) std::copy_n(map.row(v), camera.width, result.row(v));
  return result;
}

int index_of(const std::vector<View>& views, const std::string& name) {
  const auto found = std::ranges::find(views, name, &View::name);
  return found == views.end() ? -1 : int(found - views.begin());
}

}  // namespace

DepthScene::Source DepthScene::open_folder(const ResultRequest& request) {
  const auto depth = std::make_shared<DepthResult>(request.path);
  Source source;
  source.light_field =
      request.with_pictures ? depth->with_pictures(request.input) : depth->light_field();
  source.range = depth->searched();
  source.hypotheses = depth->hypotheses();
  source.top_view = depth->top_view();
  source.name = request.path.string();
  source.views = all_views(source.light_field.num_views());
  source.disparity = [depth](int view) { return depth->disparity(view); };
  source.confidence = [depth](int view) { return depth->confidence(view); };
  source.open_input = [depth, input = request.input] { return depth->open_input(input); };
  return source;
}

DepthScene::Source DepthScene::open_sparse(const ResultRequest& request) {
  if (request.min_confidence > 0)
    throw Error(ErrorCode::kInvalidArgument,
                "`min_confidence`: a .grl file holds no confidence; give the folder of `depth`");
  const SparseFile file(request.path);
  Source source;
  source.light_field = file.light_field();
  source.range = file.disparity_range();
  source.top_view = centre_view(source.light_field);
  source.name = request.path.string();
  source.views = all_views(source.light_field.num_views());
  source.disparity = [file](int view) { return file.disparity(view, {0, file.shape().height}); };
  return source;
}

DepthScene::DepthScene(Source source)
    : source_(std::move(source)), rig_(source_.light_field, source_.range.min) {}

DepthScene::DepthScene(const ResultRequest& request)
    : DepthScene(is_folder(request.path) ? open_folder(request) : open_sparse(request)) {
  min_confidence_ = request.min_confidence;
}

DepthScene::DepthScene(const OpenedInput& input, std::shared_ptr<const Reconstruction> result)
    : DepthScene([&] {
        Source source;
        source.light_field = input.light_field;
        if (!result->cameras().empty()) source.light_field.cameras = result->cameras();
        source.range = {result->hypotheses().min, result->hypotheses().max};
        source.hypotheses = result->hypotheses().count;
        source.top_view = top_view_of(source.light_field, result->views());
        source.name = input.request.path.string();
        source.views = result->views();
        source.disparity = [result, field = input.light_field](int view) {
          return cropped(result->view(view).disparity, field, view);
        };
        source.confidence = [result, field = input.light_field](int view) {
          return cropped(result->view(view).confidence, field, view);
        };
        return source;
      }()) {}

FloatMap DepthScene::disparity(int view) const {
  FloatMap map = source_.disparity(view);
  if (min_confidence_ <= 0) return map;
  const FloatMap sure = source_.confidence(view);
  for (std::size_t i = 0; i < map.size(); ++i)
    if (!(sure.data()[i] >= min_confidence_)) map.data()[i] = kNoEstimate;
  return map;
}

FloatMap DepthScene::confidence(int view) const {
  return source_.confidence ? source_.confidence(view) : FloatMap();
}

DepthView DepthScene::picture(int view) const {
  return pictured(source_.light_field, view, rig_.camera(view));
}

const DepthView& DepthScene::view(int view) {
  const auto found = std::ranges::find(kept_, view, &Kept::view);
  if (found != kept_.end()) {
    kept_.splice(kept_.begin(), kept_, found);
    return kept_.front().data;
  }
  DepthView data = picture(view);
  data.inverse_depth = rig_.inverse_depth(disparity(view));
  if (reads_confidence_) data.confidence = confidence(view);
  kept_.push_front({view, std::move(data)});
  if (kept_.size() > most_kept_) kept_.resize(most_kept_);
  return kept_.front().data;
}

void DepthScene::keep(std::size_t most) { most_kept_ = std::max<std::size_t>(most, 1); }

double DepthScene::view_bytes() const {
  const double of_pixel = 3 * sizeof(std::uint16_t) + (reads_confidence_ ? 2 : 1) * sizeof(float);
  return of_pixel * source_.light_field.width * source_.light_field.height;
}

int DepthScene::find(const std::string& view_name) const {
  return index_of(source_.light_field.views, view_name);
}

DepthView DepthScene::left_out(const std::string& view_name) const {
  const int place = index_of(source_.light_field.left_out, view_name);
  if (place < 0 || !source_.open_input)
    throw Error(ErrorCode::kInvalidArgument,
                fmt::format("view {}: {} has no view of this name", view_name, source_.name));
  const LightField all = source_.open_input();
  const int view = index_of(all.views, view_name);
  if (view < 0)
    throw Error(ErrorCode::kBadInput,
                fmt::format("{}: its input has no view {} any more", source_.name, view_name));
  const View& stood = source_.light_field.left_out[std::size_t(place)];
  const Camera camera = all.kind == LightFieldKind::kUnstructured
                            ? all.cameras[std::size_t(view)]
                            : rig_.camera_at(stood.s, stood.t);
  return pictured(all, view, camera);
}

}  // namespace gigaray
