// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "gigaray/adapters/lens.h"
#include "gigaray/core/api.h"

namespace GIGARAY_API gigaray {

/// A sparse model of COLMAP 3.8 – 3.12, https://colmap.github.io/format.html. Identifiers are
/// COLMAP's: unique, in no order and with gaps.
struct ColmapModel {
  static constexpr std::uint64_t kNoPoint = ~std::uint64_t(0);

  /// A feature of an image; COLMAP's pixels, the first one has its centre at (0.5, 0.5).
  struct Feature {
    double x = 0, y = 0;
    std::uint64_t point_id = kNoPoint;  ///< the point that it shows, or kNoPoint
    bool operator==(const Feature&) const = default;
  };
  struct Image {
    std::uint32_t id = 0;
    Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();  ///< scene → camera, unit
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();         ///< see gigaray::Camera
    std::uint32_t camera_id = 0;
    std::string name;  ///< path of the picture, relative to the folder of pictures
    std::vector<Feature> features;
  };
  struct Sight {
    std::uint32_t image_id = 0;
    std::uint32_t feature_idx = 0;  ///< in Image::features
    bool operator==(const Sight&) const = default;
  };
  struct Point {
    std::uint64_t id = 0;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    std::array<std::uint8_t, 3> rgb{};
    double error = -1;  ///< mean distance to the features, px; negative: not known
    std::vector<Sight> track;
  };

  std::map<std::uint32_t, Lens> cameras;  ///< by id
  std::vector<Image> images;              ///< registered ones
  std::vector<Point> points;

  /// An image that can't be used.
  struct Faulty {
    std::string name;
    std::string fault;  ///< one line that names the model
  };
  std::vector<Faulty> left_out = {};
  std::map<std::uint32_t, std::string> faulty_cameras = {};  ///< why, by id
  std::vector<std::uint64_t> faulty_points = {};             ///< not finite; left out
};

enum class ColmapFormat { kText, kBinary };

/// Is there a model in the folder: cameras and images, both .bin or both .txt? Looks at names.
bool is_colmap_model(const std::filesystem::path& folder);

/// Reads cameras, images and points3D (which may be missing) of a folder, the binary files if there
/// are both. `rigs` and `frames` of COLMAP 3.12 are ignored: its images still state every pose.
/// Throws Error(kBadInput) naming the file: cut short, more entries stated than it can hold,
/// numbers that are not finite, a quaternion more than 1 % from unit length (others are
/// normalised), cameras that fail check(Lens), identifiers or names that repeat, an image of an
/// unknown camera, no registered image. Not strict: images whose pose is not finite, whose camera
/// is unknown or impossible, and points that are not finite are left out while others are there.
ColmapModel read_colmap_model(const std::filesystem::path& folder, bool strict = true);

/// Writes the three files, each whole or not at all; creates the folder. Refuses, with
/// Error(kInvalidArgument), text beside binary files of an earlier model: readers would prefer
/// those. Throws Error(kIo) when the place can't be written.
void write_colmap_model(const std::filesystem::path& folder, const ColmapModel& model,
                        ColmapFormat format);

}  // namespace gigaray
