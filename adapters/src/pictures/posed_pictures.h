// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gigaray/adapters/lens.h"
#include "gigaray/core/light_field.h"
#include "pictures/picture_faults.h"

namespace gigaray {

/// A photograph with its lens and pose, as readers of posed formats find it.
struct PosedPicture {
  std::filesystem::path file;
  std::string name;  ///< of the view
  Lens lens;         ///< for the size of the file, or another one: then scaled to it
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< scene → camera, see camera.h
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  std::optional<InverseDepthRange> inverse_depth;
  std::filesystem::path mask;  ///< picture, black: leave out; empty: none
  std::string fault;           ///< why it can't be used, one line; empty: it can
};

/// An unstructured light field of photographs: undistorted to pinhole cameras of the same focal
/// length and principal point when read, brought to a common size with the rest masked, placed by
/// place_by_cameras. Reads headers only, and a picture that may be cut short. Those that can't be
/// used are left out with a note. Throws Error(kBadInput) naming the file, also when a view takes
/// more than opening_limit(memory_bytes), when fewer than kLeastPictures can be used, and for any
/// that can't when `strict`.
LightField posed_light_field(std::vector<PosedPicture> pictures, const std::string& format,
                             double memory_bytes = 0, bool strict = false);

}  // namespace gigaray
