// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gigaray/core/surface_mesh.h"

namespace gigaray {

/// How well every view sees every face, a byte each: an eighth of an octave a step.
class FaceQualities {
 public:
  FaceQualities(int num_views, std::size_t num_faces)
      : num_faces_(num_faces), codes_(std::size_t(num_views) * num_faces) {}

  void set(int view, const std::vector<float>& qualities);

  int num_views() const { return num_faces_ == 0 ? 0 : int(codes_.size() / num_faces_); }
  std::size_t num_faces() const { return num_faces_; }
  /// 0: not seen
  std::uint8_t code(int view, std::size_t face) const {
    return codes_[std::size_t(view) * num_faces_ + face];
  }
  /// Codes that are so far apart are so many octaves apart.
  static constexpr int kOctave = 8;
  static double quality(std::uint8_t code);

 private:
  std::size_t num_faces_;
  std::vector<std::uint8_t> codes_;
};

constexpr std::uint32_t kNoFace = 0xffffffff;
/// Faces across the edges 0–1, 1–2 and 2–0 of each face; kNoFace at a boundary and where more than
/// two faces meet.
std::vector<std::array<std::uint32_t, 3>> faces_across(const SurfaceMesh& mesh);

/// The view that each face takes its colours from, −1 where none sees it: few views and large
/// connected pieces, of views that show the face at least half as large as the best one.
std::vector<int> choose_views(const FaceQualities& qualities,
                              const std::vector<std::array<std::uint32_t, 3>>& across);

/// Connected faces of one view have one number, 0 …; count: how many there are.
std::vector<std::uint32_t> charts_of(const std::vector<int>& view_of_face,
                                     const std::vector<std::array<std::uint32_t, 3>>& across,
                                     std::size_t& count);

}  // namespace gigaray
