// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "features/agreed_points.h"
#include "gigaray/core/camera.h"
#include "gigaray/core/image.h"

namespace gigaray {

/// A scene for nerfstudio and other programs that train splats: transforms.json, pictures without
/// distortion, depth maps of 16 bit, and the points on which views agree (docs/formats.md).
class NerfstudioScene {
 public:
  explicit NerfstudioScene(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// depth: scene units, NaN where there is none; all of the size of the camera's picture.
  /// depth_file: where it lies as PFM until finish().
  void add(const std::string& view, const Camera& camera, const Image<std::uint16_t>& picture,
           int bit_depth, const FloatMap& depth, std::filesystem::path depth_file);
  /// Writes depth maps in a unit that holds them all, transforms.json and the points.
  void finish();

 private:
  struct Frame {
    std::string view;
    Camera camera;
    std::filesystem::path depth_file;
  };
  void write_depth_maps(double unit) const;
  void write_transforms(double unit) const;
  void write_points() const;

  std::filesystem::path folder_;
  std::vector<Frame> frames_;
  std::vector<float> depths_;  ///< of some pixels of all views
  AgreedPoints points_;
};

}  // namespace gigaray
