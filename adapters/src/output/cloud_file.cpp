// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/cloud_file.h"

#include <string>
#include <utility>

#include "gigaray/core/arguments.h"
#include "output/pcd.h"
#include "output/ply.h"

namespace gigaray {

CloudFile::CloudFile(AtomicFile file, CloudFormat format)
    : file_(std::move(file)), format_(format) {}

std::string CloudFile::header(const Eigen::Vector3d& origin) const {
  if (format_ == CloudFormat::kPcd) return pcd::header(points_, origin);
  return ply::begin_header(points_, origin,
                           {"x", "y", "z", "nx", "ny", "nz", "confidence", "support"}) +
         "end_header\n";
}

void CloudFile::add(const PointCloud& cloud) {
  const std::size_t size = cloud.size();
  require_argument(cloud.normals.size() == size && cloud.colours.size() == size &&
                       cloud.confidences.size() == size && cloud.supports.size() == size,
                   "cloud: each point needs a normal, a colour, a confidence and a support");
  if (!origin_) file_.write(header(*(origin_ = cloud.origin)));
  require_argument(cloud.origin == *origin_,
                   "cloud.origin: is another one than that of the points before");
  std::string bytes;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3f &p = cloud.positions[i], &n = cloud.normals[i];
    if (!p.allFinite() || !n.allFinite()) continue;
    for (const float number :
         {p.x(), p.y(), p.z(), n.x(), n.y(), n.z(), cloud.confidences[i], cloud.supports[i]})
      ply::append(bytes, number);
    if (format_ == CloudFormat::kPcd)
      ply::append(bytes, pcd::packed(cloud.colours[i]));
    else
      ply::append(bytes, cloud.colours[i]);
    ++points_;
  }
  file_.write(bytes);
}

void CloudFile::commit(const RunControl& control) {
  if (origin_)
    file_.write_at_begin(header(*origin_));
  else
    file_.write(header(Eigen::Vector3d::Zero()));
  file_.commit(control);
}

}  // namespace gigaray
