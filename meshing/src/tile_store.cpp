// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "tile_store.h"

#include <algorithm>
#include <cmath>

#include "gigaray/core/error.h"

namespace gigaray {

TileStore::TileStore(double side, double halo, std::size_t memory)
    : side_(side), halo_(halo), most_points_(std::max<std::size_t>(memory / sizeof(Record), 1)) {
  GIGARAY_CHECK(side > 0 && halo >= 0 && halo < side / 2);
}

double TileStore::side(int level) const { return std::ldexp(side_, level); }

void TileStore::add(const PointCloud& cloud, std::span<const int> levels) {
  GIGARAY_CHECK(levels.size() == cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d position = cloud.positions[i].cast<double>();
    const double side = this->side(levels[i]), halo = std::ldexp(halo_, levels[i]);
    std::array<int, 3> first, last;
    TileIndex own{levels[i], {}};
    for (int k = 0; k < 3; ++k) {
      first[k] = int(std::floor((position[k] - halo) / side));
      last[k] = int(std::floor((position[k] + halo) / side));
      own.place[k] = int(std::floor(position[k] / side));
    }
    for (int x = first[0]; x <= last[0]; ++x)
      for (int y = first[1]; y <= last[1]; ++y)
        for (int z = first[2]; z <= last[2]; ++z) {
          const TileIndex index{levels[i], {x, y, z}};
          const Eigen::Vector3f relative = (position - origin(index)).cast<float>();
          const Eigen::Vector3f& normal = cloud.normals[i];
          Tile& tile = tiles_[index];
          tile.has_own |= index == own;
          tile.points.push_back({{relative.x(), relative.y(), relative.z()},
                                 {normal.x(), normal.y(), normal.z()},
                                 cloud.colours[i],
                                 std::uint8_t(std::min(cloud.supports[i], 255.0f)),
                                 cloud.confidences[i]});
          if (++points_in_memory_ > most_points_) spill();
        }
  }
}

void TileStore::spill() {
  if (!file_.is_open()) file_ = ScratchFile(temporary_folder());
  for (auto& [index, tile] : tiles_) {
    if (tile.points.empty()) continue;
    const std::size_t bytes = tile.points.size() * sizeof(Record);
    file_.write(file_size_, bytes, tile.points.data());
    tile.on_disk.push_back({file_size_, tile.points.size()});
    file_size_ += bytes;
    tile.points = {};
  }
  points_in_memory_ = 0;
}

std::vector<TileIndex> TileStore::tiles() const {
  std::vector<TileIndex> indices;
  for (const auto& [index, tile] : tiles_)
    if (tile.has_own) indices.push_back(index);
  return indices;
}

Eigen::Vector3d TileStore::origin(const TileIndex& tile) const {
  return side(tile.level) * Eigen::Vector3d(tile.place[0], tile.place[1], tile.place[2]);
}

bool TileStore::is_own(const TileIndex& tile, const Eigen::Vector3f& relative) const {
  return (relative.array() >= 0).all() && (relative.array() < float(side(tile.level))).all();
}

PointCloud TileStore::take(const TileIndex& index) {
  Tile& tile = tiles_.at(index);
  std::vector<Record> records;
  for (const Piece& piece : tile.on_disk) {
    const std::size_t before = records.size();
    records.resize(before + piece.count);
    file_.read(piece.offset, piece.count * sizeof(Record), records.data() + before);
  }
  records.insert(records.end(), tile.points.begin(), tile.points.end());
  points_in_memory_ -= tile.points.size();
  tile.points = {};
  PointCloud cloud;
  for (const Record& record : records) {
    cloud.positions.emplace_back(record.position[0], record.position[1], record.position[2]);
    cloud.normals.emplace_back(record.normal[0], record.normal[1], record.normal[2]);
    cloud.colours.push_back(record.colour);
    cloud.confidences.push_back(record.confidence);
    cloud.supports.push_back(record.support);
  }
  return cloud;
}

}  // namespace gigaray
