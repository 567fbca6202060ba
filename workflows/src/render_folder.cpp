// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/render_folder.h"

#include <fmt/format.h>

#include <algorithm>

#include "depth_record.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/path_text.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/workflows/view_list.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

double share(const Mask& mask) {
  return double(std::count(mask.begin(), mask.end(), 1)) / double(mask.size());
}

ordered_json frame_json(const std::string& file, const Camera& camera, double seen) {
  return {{"file", file}, {"camera", json_of(camera)}, {"seen", seen}};
}

int bit_depth_of(const DepthScene& scene) { return scene.light_field().pixels->bit_depth(); }

std::string write_record(const DepthScene& scene, const fs::path& folder,
                         const ordered_json& about) {
  ordered_json root{
      {"format", kRenderFormat}, {"version", 1}, {"result", path_text(fs::absolute(scene.name()))}};
  root.update(about);
  std::string text = root.dump(2, ' ', false, ordered_json::error_handler_t::replace);
  write_file_atomically(folder / "gigaray.json", text + "\n");
  return text;
}

}  // namespace

RenderReport write_view(DepthScene& scene, const Camera& camera, const RenderRequest& request,
                        const fs::path& folder, const RunControl& control) {
  control.progress("render", 0, 1);
  const NovelView view = render(scene, camera, request, control);
  write_png(folder / "view.png", view.picture, bit_depth_of(scene));
  write_pfm(folder / "inverse_depth.pfm", view.inverse_depth);
  const double seen = share(view.seen);
  const ordered_json frames = ordered_json::array({frame_json("view.png", camera, seen)});
  return {write_record(scene, folder, {{"frames", frames}}), seen};
}

RenderReport write_frames(DepthScene& scene, const std::vector<Camera>& cameras,
                          const RenderRequest& request, const fs::path& folder,
                          const RunControl& control) {
  ordered_json frames = ordered_json::array();
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    control.progress("render", double(i), double(cameras.size()));
    const NovelView view = render(scene, cameras[i], request, control);
    const std::string file = fmt::format("frame_{:05}.png", i);
    frames.push_back(frame_json(file, cameras[i], share(view.seen)));
    write_png(folder / file, view.picture, bit_depth_of(scene));
  }
  return {write_record(scene, folder, {{"frames", frames}})};
}

RenderReport write_left_out(const DepthScene& scene, const LeaveOneOut& result,
                            const std::string& view, const fs::path& folder) {
  const int bit_depth = bit_depth_of(scene);
  write_png(folder / "view.png", result.rendered.picture, bit_depth);
  write_png(folder / "real.png", result.real.picture, bit_depth);
  write_png(folder / "equal_weights.png", result.equal_weights.picture, bit_depth);
  write_png(folder / "nearest_two.png", result.nearest_two, bit_depth);
  write_pfm(folder / "inverse_depth.pfm", result.rendered.inverse_depth);
  const auto json = [](const PictureQuality& quality) {
    return ordered_json{{"psnr", quality.psnr}, {"ssim", quality.ssim}};
  };
  const double seen = share(result.rendered.seen);
  return {write_record(scene, folder,
                       {{"left_out", view},
                        {"took_part_in_depth", result.took_part_in_depth},
                        {"seen", seen},
                        {"quality",
                         {{"rendered", json(result.quality)},
                          {"equal_weights", json(result.quality_of_equal_weights)},
                          {"nearest_two", json(result.quality_of_nearest_two)}}}}),
          seen};
}

RenderReport write_refocused(const DepthScene& scene, const RefocusRequest& request,
                             const fs::path& folder, const RunControl& control) {
  const LightField& light_field = scene.light_field();
  const int view = parse_view(request.view, light_field);
  const FocalPlane& plane = request.plane;
  write_png(folder / "view.png", refocus(light_field, view, plane, request.aperture, control),
            bit_depth_of(scene));
  return {write_record(scene, folder,
                       {{"view", light_field.views[view].name},
                        {"focus", {plane.value, plane.along_u, plane.along_v}}})};
}

}  // namespace gigaray
