// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/core/api.h"
#include "gigaray/core/point_cloud.h"

namespace GIGARAY_API gigaray {

enum class CloudFormat { kPly, kPcd };

/// Writes a point cloud piece by piece as binary PLY, little endian: x y z nx ny nz confidence
/// support (float), red green blue (uchar); or as binary PCD with the same fields in PCL's names.
/// An origin other than 0, the same for all pieces, is stated as a comment "origin X Y Z". The file
/// appears with commit(). Throws as AtomicFile does.
class CloudFile {
 public:
  explicit CloudFile(AtomicFile file, CloudFormat format = CloudFormat::kPly);

  /// Points whose position or normal is not finite are left out.
  void add(const PointCloud& cloud);
  void commit(const RunControl& control = RunControl());

  std::uint64_t points() const { return points_; }

 private:
  std::string header(const Eigen::Vector3d& origin) const;

  AtomicFile file_;
  CloudFormat format_;
  std::optional<Eigen::Vector3d> origin_;  ///< of the first piece
  std::uint64_t points_ = 0;
};

}  // namespace gigaray
