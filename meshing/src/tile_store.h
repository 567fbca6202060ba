// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "gigaray/point_cloud.h"

namespace gigaray {

/// Cube of space by its place in the grid of cubes.
using TileIndex = std::array<int, 3>;

/// Points sorted into cubes of space, on disk where they are more than memory may hold: in a file
/// of the folder for temporary files that has no name, so that nothing stays behind. A point is in
/// every cube whose border is less than `halo` away. Not thread-safe. Throws Error(kIo).
class TileStore {
 public:
  /// side, halo: scene units; halo < side / 2.
  TileStore(double side, double halo, std::size_t memory);
  ~TileStore();
  TileStore(TileStore&& other) noexcept;
  TileStore& operator=(TileStore&& other) noexcept;

  void add(const PointCloud& cloud);

  std::vector<TileIndex> tiles() const;  ///< those that hold a point that is their own, in order
  /// All points of a tile and its halo, relative to origin(tile), and forgets them.
  PointCloud take(const TileIndex& tile);
  Eigen::Vector3d origin(const TileIndex& tile) const;
  bool is_own(const Eigen::Vector3f& relative) const;

  std::uint64_t bytes_on_disk() const { return file_size_; }

 private:
  /// As it lies on disk.
  struct Record {
    float position[3], normal[3];
    Rgb8 colour;
    std::uint8_t support;
    float confidence;
  };
  struct Piece {
    std::uint64_t offset;
    std::size_t count;
  };
  struct Tile {
    std::vector<Record> points;
    std::vector<Piece> on_disk;
    bool has_own = false;
  };

  void spill();

  double side_ = 0, halo_ = 0;
  std::size_t most_points_ = 0, points_in_memory_ = 0;
  std::map<TileIndex, Tile> tiles_;
  int file_ = -1;
  std::uint64_t file_size_ = 0;
};

}  // namespace gigaray
