// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gigaray/core/image.h"

namespace gigaray {

/// Most numbers that a prediction is made of.
inline constexpr int kMostFeatures = 30;
/// Fraction bits of their weights.
inline constexpr int kWeightBits = 12;

/// One weight per feature.
using Weights = std::array<std::int32_t, kMostFeatures>;

/// The channels of some rows as encoder and decoder see them: what the tuples draw everywhere, and
/// of the picture what comes before a pixel (rows from the top, pixels from the left, channels in
/// the order green, red, blue). A value is predicted as what is drawn there plus a weighted
/// sum of features: the differences of the neighbours, those of the channels before, and how what
/// is drawn changes around the pixel. The weights are fitted to every block, so a block may trust
/// the tuples or its neighbours, whichever tell more.
class DifferencePlanes {
 public:
  static constexpr int kChannels = 3;
  static constexpr int kContexts = 40;

  /// drawn: (v, u, c), RGB.
  DifferencePlanes(const Image<std::uint16_t>& drawn, int bit_depth);

  static int num_features(int channel) { return kOwn + kCross * channel; }
  /// Place of a channel in the picture.
  static int component(int channel) {
    constexpr int kOrder[kChannels] = {1, 0, 2};
    return kOrder[channel];
  }

  std::array<std::int32_t, kMostFeatures> features(int channel, int u, int v) const;
  std::int32_t difference(int channel, int u, int v) const {
    return planes_[channel].value[at(u, v)] - planes_[channel].drawn[at(u, v)];
  }
  std::int32_t drawn(int channel, int u, int v) const { return planes_[channel].drawn[at(u, v)]; }
  std::int32_t predict(int channel, int u, int v, const Weights& weights) const;
  /// Class of the pixel by how rough its neighbourhood is: which weights predict it.
  int roughness(int channel, int u, int v) const;
  static constexpr int kRoughnesses = 8;
  /// Class of the pixel by how well its neighbours were predicted: 0 … kContexts − 1.
  int context(int channel, int u, int v) const;
  /// Tells the value of a pixel, and how far its prediction was off.
  void set(int channel, int u, int v, std::int32_t value, std::int32_t miss);

 private:
  static constexpr int kOwn = 12, kCross = 9;
  static constexpr int kPad = 2;
  std::size_t at(int u, int v) const { return std::size_t(v + kPad) * stride_ + u + kPad; }

  struct Plane {
    std::vector<std::int32_t> drawn;
    std::vector<std::int32_t> value;  ///< of the picture; as drawn where not known yet
    std::vector<std::int32_t> miss;   ///< |value − prediction|
  };
  int stride_ = 0;
  std::int32_t most_ = 0;
  std::array<Plane, kChannels> planes_;
};

}  // namespace gigaray
