// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/depth_folder.h"

#include "gigaray/adapters/maps.h"
#include "gigaray/error.h"
#include "gigaray/metric_depth.h"

namespace gigaray {

void DepthFolder::write_maps(const std::filesystem::path& folder, const FloatMap& disparity,
                             const FloatMap& confidence) const {
  write_pfm(folder / "disparity.pfm", disparity);
  write_pfm(folder / "confidence.pfm", confidence);
  write_depth_picture(folder / "depth.png", disparity, pictured_);
  if (has_metric_depth(rig_))
    write_pfm(folder / "depth.pfm", depth_from_disparity(disparity, rig_));
  if (formats_.contains(MapFormat::kExr)) {
    write_exr(folder / "disparity.exr", disparity);
    write_exr(folder / "confidence.exr", confidence);
  }
  if (formats_.contains(MapFormat::kNpy)) {
    write_npy(folder / "disparity.npy", disparity);
    write_npy(folder / "confidence.npy", confidence);
  }
  if (formats_.contains(MapFormat::kPng16))
    write_png16(folder / "disparity16.png", disparity, pictured_);
}

void DepthFolder::write_view(const std::string& name, const FloatMap& disparity,
                             const FloatMap& confidence, bool is_centre) {
  const std::filesystem::path folder = folder_.path() / name;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw Error(ErrorCode::kIo, folder.string() + ": " + error.message());
  write_maps(folder, disparity, confidence);
  if (is_centre) write_maps(folder_.path(), disparity, confidence);
}

void DepthFolder::commit(const std::string& json) {
  write_file_atomically(folder_.path() / "gigaray.json", json + "\n");
  folder_.commit();
}

}  // namespace gigaray
