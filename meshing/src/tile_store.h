// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "gigaray/core/point_cloud.h"
#include "gigaray/core/scratch_file.h"

namespace gigaray {

/// Cube of space: its place in the grid of cubes of its level. Cubes are twice as large on the next
/// level.
struct TileIndex {
  int level = 0;
  std::array<int, 3> place{};
  auto operator<=>(const TileIndex&) const = default;
};

/// Points sorted into cubes of space, on disk where they are more than memory may hold. A point is
/// in every cube of its level whose border is less than the level's halo away. Not thread-safe.
/// Throws Error(kIo).
class TileStore {
 public:
  /// side, halo: of level 0, scene units; halo < side / 2. memory: bytes.
  TileStore(double side, double halo, std::size_t memory);

  /// levels: one per point.
  void add(const PointCloud& cloud, std::span<const int> levels);

  std::vector<TileIndex> tiles() const;  ///< those that hold a point that is their own, in order
  /// All points of a tile and its halo, relative to origin(tile), and forgets them.
  PointCloud take(const TileIndex& tile);
  Eigen::Vector3d origin(const TileIndex& tile) const;
  bool is_own(const TileIndex& tile, const Eigen::Vector3f& relative) const;

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

  double side(int level) const;
  void spill();

  double side_ = 0, halo_ = 0;
  std::size_t most_points_ = 0, points_in_memory_ = 0;
  std::map<TileIndex, Tile> tiles_;
  ScratchFile file_;
  std::uint64_t file_size_ = 0;
};

}  // namespace gigaray
