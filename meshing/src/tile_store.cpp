// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "tile_store.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <utility>

#include "gigaray/error.h"

namespace gigaray {
namespace {

[[noreturn]] void io_failed(const std::string& what) {
  throw Error(ErrorCode::kIo, "points in the folder for temporary files (TMPDIR): " + what +
                                  " failed (" + std::strerror(errno) + ")");
}

}  // namespace

TileStore::TileStore(double side, double halo, std::size_t memory)
    : side_(side), halo_(halo), most_points_(std::max<std::size_t>(memory / sizeof(Record), 1)) {
  GIGARAY_CHECK(side > 0 && halo >= 0 && halo < side / 2);
}

TileStore::~TileStore() {
  if (file_ >= 0) close(file_);
}

TileStore::TileStore(TileStore&& other) noexcept { *this = std::move(other); }

TileStore& TileStore::operator=(TileStore&& other) noexcept {
  std::swap(side_, other.side_);
  std::swap(halo_, other.halo_);
  std::swap(most_points_, other.most_points_);
  std::swap(points_in_memory_, other.points_in_memory_);
  std::swap(tiles_, other.tiles_);
  std::swap(file_, other.file_);
  std::swap(file_size_, other.file_size_);
  return *this;
}

void TileStore::add(const PointCloud& cloud) {
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d position = cloud.positions[i].cast<double>();
    TileIndex first, last, own;
    for (int k = 0; k < 3; ++k) {
      first[k] = int(std::floor((position[k] - halo_) / side_));
      last[k] = int(std::floor((position[k] + halo_) / side_));
      own[k] = int(std::floor(position[k] / side_));
    }
    for (int x = first[0]; x <= last[0]; ++x)
      for (int y = first[1]; y <= last[1]; ++y)
        for (int z = first[2]; z <= last[2]; ++z) {
          const TileIndex index{x, y, z};
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
  if (file_ < 0) {
    std::string name = std::filesystem::temp_directory_path() / "gigaray-points-XXXXXX";
    file_ = mkstemp(name.data());
    if (file_ < 0) io_failed("making a file");
    unlink(name.c_str());
  }
  for (auto& [index, tile] : tiles_) {
    if (tile.points.empty()) continue;
    const std::size_t bytes = tile.points.size() * sizeof(Record);
    const char* begin = reinterpret_cast<const char*>(tile.points.data());
    for (std::size_t done = 0; done < bytes;) {
      const ssize_t written = pwrite(file_, begin + done, bytes - done, off_t(file_size_ + done));
      if (written <= 0) io_failed("writing");
      done += std::size_t(written);
    }
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
  return side_ * Eigen::Vector3d(tile[0], tile[1], tile[2]);
}

bool TileStore::is_own(const Eigen::Vector3f& relative) const {
  return (relative.array() >= 0).all() && (relative.array() < float(side_)).all();
}

PointCloud TileStore::take(const TileIndex& index) {
  Tile& tile = tiles_.at(index);
  std::vector<Record> records;
  for (const Piece& piece : tile.on_disk) {
    const std::size_t before = records.size(), bytes = piece.count * sizeof(Record);
    records.resize(before + piece.count);
    char* begin = reinterpret_cast<char*>(records.data() + before);
    for (std::size_t done = 0; done < bytes;) {
      const ssize_t got = pread(file_, begin + done, bytes - done, off_t(piece.offset + done));
      if (got <= 0) io_failed("reading");
      done += std::size_t(got);
    }
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
