// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/depth_folder.h"

#include <algorithm>

#include "colmap/colmap_dense.h"
#include "formats/nerfstudio_scene.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/core/arguments.h"
#include "gigaray/core/error.h"
#include "gigaray/core/metric_depth.h"

namespace gigaray {
namespace {

/// The upper left part of an image.
template <class T>
Image<T> cropped(const Image<T>& image, int width, int height) {
  if (width == image.width() && height == image.height()) return image;
  Image<T> part(width, height, image.channels());
  for (int v = 0; v < height; ++v) std::copy_n(image.row(v), width * image.channels(), part.row(v));
  return part;
}

}  // namespace

DepthFolder::DepthFolder(const std::filesystem::path& target, std::set<MapFormat> formats,
                         OutputRules rules)
    : folder_(target, kDepthFormat, std::move(rules)), formats_(std::move(formats)) {}

void DepthFolder::describe(LightField light_field, std::vector<Camera> cameras) {
  light_field_ = std::move(light_field);
  const bool unstructured = light_field_.kind == LightFieldKind::kUnstructured;
  cameras_ = unstructured ? light_field_.cameras : std::move(cameras);
  if (formats_.contains(MapFormat::kColmap)) {
    if (!unstructured)
      throw Error(
          ErrorCode::kInvalidArgument,
          "MapFormat::kColmap: goes with photographs whose cameras are known, not with a light "
          "field of the format " +
              light_field_.format);
    colmap_ = std::make_unique<ColmapDense>(folder_.path() / "colmap");
  }
  if (formats_.contains(MapFormat::kNerfstudio)) {
    if (!has_metric_depth(light_field_))
      throw Error(
          ErrorCode::kInvalidArgument,
          "MapFormat::kNerfstudio: needs the cameras; state the rig with RigGeometry::focal_px and "
          "RigGeometry::baseline");
    require_argument(cameras_.size() == light_field_.views.size(),
                     "cameras: one for each view is needed");
    nerfstudio_ = std::make_unique<NerfstudioScene>(folder_.path() / "nerfstudio");
  }
}

DepthFolder::~DepthFolder() = default;

void DepthFolder::write_maps(const std::filesystem::path& folder, const FloatMap& disparity,
                             const FloatMap& confidence, DisparityRange pictured) const {
  write_pfm(folder / "disparity.pfm", disparity);
  write_pfm(folder / "confidence.pfm", confidence);
  write_depth_picture(folder / "depth.png", disparity, pictured);
  if (has_metric_depth(light_field_))
    write_pfm(folder / "depth.pfm", depth_from_disparity(disparity, light_field_));
  if (formats_.contains(MapFormat::kExr)) {
    write_exr(folder / "disparity.exr", disparity);
    write_exr(folder / "confidence.exr", confidence);
  }
  if (formats_.contains(MapFormat::kNpy)) {
    write_npy(folder / "disparity.npy", disparity);
    write_npy(folder / "confidence.npy", confidence);
  }
  if (formats_.contains(MapFormat::kPng16))
    write_png16(folder / "disparity16.png", disparity, pictured);
}

void DepthFolder::write_picture(const std::filesystem::path& folder, int view_idx,
                                const FloatMap& disparity, bool is_centre) {
  const bool unstructured = light_field_.kind == LightFieldKind::kUnstructured;
  if (!unstructured && !nerfstudio_) return;
  const int bit_depth = light_field_.pixels->bit_depth();
  Image<std::uint16_t> picture = read_view(light_field_, view_idx);
  light_field_.pixels->let_go(view_idx);
  take_mask(picture);
  picture = cropped(picture, disparity.width(), disparity.height());
  if (unstructured) {
    write_png(folder / "picture.png", picture, bit_depth);
    if (is_centre) write_png(folder_.path() / "picture.png", picture, bit_depth);
  }
  const std::string& name = light_field_.views[view_idx].name;
  if (colmap_ || nerfstudio_) {
    const FloatMap depth = depth_from_disparity(disparity, light_field_);
    if (colmap_) colmap_->add(name, cameras_[view_idx], picture, bit_depth, depth);
    if (nerfstudio_)
      nerfstudio_->add(name, cameras_[view_idx], picture, bit_depth, depth, folder / "depth.pfm");
  }
}

void DepthFolder::write_view(int view_idx, FloatMap disparity, FloatMap confidence,
                             DisparityRange pictured, bool is_centre) {
  require_argument(view_idx >= 0 && view_idx < light_field_.num_views(),
                   "view_idx: the light field that was described has no such view");
  const bool unstructured = light_field_.kind == LightFieldKind::kUnstructured;
  const int width = unstructured ? light_field_.cameras[view_idx].width : light_field_.width;
  const int height = unstructured ? light_field_.cameras[view_idx].height : light_field_.height;
  require_argument(disparity.width() >= width && disparity.height() >= height &&
                       confidence.width() >= width && confidence.height() >= height,
                   "disparity, confidence: must be as large as the view");
  const std::filesystem::path folder = folder_.path() / light_field_.views[view_idx].name;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error(ErrorCode::kIo, folder.string() + ": " + error.message());
  if (unstructured) {
    disparity = cropped(disparity, width, height);
    confidence = cropped(confidence, width, height);
  }
  write_picture(folder, view_idx, disparity, is_centre);
  write_maps(folder, disparity, confidence, pictured);
  if (is_centre) write_maps(folder_.path(), disparity, confidence, pictured);
}

void DepthFolder::commit(const std::string& json, const RunControl& control) {
  if (colmap_) colmap_->finish();
  if (nerfstudio_) nerfstudio_->finish();
  write_file_atomically(folder_.path() / "gigaray.json", json + "\n");
  folder_.commit(control);
}

}  // namespace gigaray
