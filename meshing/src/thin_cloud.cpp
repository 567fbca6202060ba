// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "thin_cloud.h"

#include <pcl/PCLPointCloud2.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>

#include <array>
#include <cstring>

#include "gigaray/core/error.h"

namespace gigaray {
namespace {

/// One point as PCL's general cloud has it: floats only, colours too, so that all are averaged.
struct Record {
  std::array<float, 3> position, normal, colour;
  float confidence, support;
};
constexpr const char* kFields[] = {"x", "y", "z", "nx",         "ny",     "nz",
                                   "r", "g", "b", "confidence", "support"};
static_assert(sizeof(Record) == std::size(kFields) * sizeof(float));

pcl::PCLPointCloud2::Ptr records_of(const PointCloud& cloud) {
  auto blob = pcl::make_shared<pcl::PCLPointCloud2>();
  for (const char* name : kFields) {
    pcl::PCLPointField field;
    field.name = name;
    field.offset = std::uint32_t(blob->fields.size() * sizeof(float));
    field.datatype = pcl::PCLPointField::FLOAT32;
    field.count = 1;
    blob->fields.push_back(field);
  }
  blob->height = 1;
  blob->width = std::uint32_t(cloud.size());
  blob->point_step = sizeof(Record);
  blob->row_step = blob->point_step * blob->width;
  blob->data.resize(cloud.size() * sizeof(Record));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Rgb8& colour = cloud.colours[i];
    const Eigen::Vector3f &p = cloud.positions[i], &n = cloud.normals[i];
    const Record record{{p.x(), p.y(), p.z()},
                        {n.x(), n.y(), n.z()},
                        {float(colour[0]), float(colour[1]), float(colour[2])},
                        cloud.confidences[i],
                        cloud.supports[i]};
    std::memcpy(blob->data.data() + i * sizeof(Record), &record, sizeof(Record));
  }
  return blob;
}

PointCloud cloud_of(const pcl::PCLPointCloud2& blob) {
  GIGARAY_CHECK(blob.point_step == sizeof(Record));
  PointCloud cloud;
  for (std::size_t i = 0; i < blob.width * std::size_t(blob.height); ++i) {
    Record record;
    std::memcpy(&record, blob.data.data() + i * sizeof(Record), sizeof(Record));
    cloud.positions.emplace_back(record.position.data());
    // Those of two sides may cancel.
    const Eigen::Vector3f normal(record.normal.data());
    const float length = normal.norm();
    cloud.normals.push_back(length > 1e-3f ? Eigen::Vector3f(normal / length)
                                           : Eigen::Vector3f(0, 0, -1));
    Rgb8 colour;
    for (int c = 0; c < 3; ++c)
      colour[c] = std::uint8_t(std::lround(std::clamp(record.colour[c], 0.0f, 255.0f)));
    cloud.colours.push_back(colour);
    cloud.confidences.push_back(record.confidence);
    cloud.supports.push_back(record.support);
  }
  return cloud;
}

pcl::PointCloud<pcl::PointXYZ>::Ptr positions_of(const PointCloud& cloud) {
  auto points = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  points->reserve(cloud.size());
  for (const Eigen::Vector3f& p : cloud.positions) points->emplace_back(p.x(), p.y(), p.z());
  return points;
}

}  // namespace

PointCloud merge_points(const PointCloud& cloud, double voxel) {
  if (cloud.empty()) return {};
  pcl::VoxelGrid<pcl::PCLPointCloud2> grid;
  grid.setInputCloud(records_of(cloud));
  grid.setLeafSize(float(voxel), float(voxel), float(voxel));
  pcl::PCLPointCloud2 merged;
  grid.filter(merged);
  return cloud_of(merged);
}

std::vector<std::uint8_t> points_in_company(const PointCloud& cloud, int neighbours,
                                            double deviations) {
  std::vector<std::uint8_t> in_company(cloud.size(), 1);
  if (int(cloud.size()) <= neighbours) return in_company;
  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> filter(true);
  filter.setInputCloud(positions_of(cloud));
  filter.setMeanK(neighbours);
  filter.setStddevMulThresh(deviations);
  pcl::Indices kept;
  filter.filter(kept);
  for (const pcl::index_t alone : *filter.getRemovedIndices()) in_company[alone] = 0;
  return in_company;
}

void smooth_normals(PointCloud& cloud, int neighbours) {
  if (int(cloud.size()) <= neighbours) return;
  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(positions_of(cloud));
  estimation.setKSearch(neighbours);
  pcl::PointCloud<pcl::Normal> found;
  estimation.compute(found);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    Eigen::Vector3f normal = found[i].getNormalVector3fMap();
    if (!normal.allFinite() || !(normal.squaredNorm() > 0)) continue;
    if (normal.dot(cloud.normals[i]) < 0) normal = -normal;
    cloud.normals[i] = normal;
  }
}

}  // namespace gigaray
