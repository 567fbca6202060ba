// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "difference_planes.h"

#include <algorithm>
#include <bit>
#include <cstdlib>

namespace gigaray {

DifferencePlanes::DifferencePlanes(const Image<std::uint16_t>& drawn, int bit_depth)
    : stride_(drawn.width() + 2 * kPad), most_((1 << bit_depth) - 1) {
  const std::size_t size = std::size_t(stride_) * (drawn.height() + 2 * kPad);
  for (int channel = 0; channel < kChannels; ++channel) {
    Plane& plane = planes_[channel];
    plane.drawn.resize(size);
    plane.miss.resize(size);
    for (int v = -kPad; v < drawn.height() + kPad; ++v)
      for (int u = -kPad; u < drawn.width() + kPad; ++u)
        plane.drawn[at(u, v)] = drawn(std::clamp(u, 0, drawn.width() - 1),
                                      std::clamp(v, 0, drawn.height() - 1), component(channel));
    plane.value = plane.drawn;
  }
}

std::array<std::int32_t, kMostFeatures> DifferencePlanes::features(int channel, int u,
                                                                   int v) const {
  const Plane& plane = planes_[channel];
  const std::size_t here = at(u, v);
  const std::int32_t* value = plane.value.data() + here;
  const std::int32_t* drawn = plane.drawn.data() + here;
  const int down = stride_;
  std::array<std::int32_t, kMostFeatures> values{};
  int i = 0;
  for (const int way : {-1, -down, -down - 1, -down + 1, -2, -2 * down})
    values[i++] = value[way] - drawn[0];
  for (const int way : {-1, -down, 1, down, -down - 1, -down + 1})
    values[i++] = drawn[way] - drawn[0];
  for (int before = 0; before < channel; ++before) {
    const std::int32_t* other = planes_[before].value.data() + here;
    for (const int way : {0, -1, -down, 1, down, -down - 1, -down + 1, -2, -2 * down})
      values[i++] = other[way] - planes_[before].drawn[here];
  }
  return values;
}

std::int32_t DifferencePlanes::predict(int channel, int u, int v, const Weights& weights) const {
  const auto values = features(channel, u, v);
  std::int64_t sum = std::int64_t(1) << (kWeightBits - 1);
  for (int i = 0; i < kMostFeatures; ++i) sum += std::int64_t(weights[i]) * values[i];
  return std::int32_t(
      std::clamp<std::int64_t>(drawn(channel, u, v) + (sum >> kWeightBits), 0, most_));
}

int DifferencePlanes::roughness(int channel, int u, int v) const {
  const std::int32_t* value = planes_[channel].value.data() + at(u, v);
  const std::int32_t* green = planes_[0].value.data() + at(u, v);
  const int down = stride_;
  // Colour changes less than brightness.
  const auto d = [&](int way) { return channel > 0 ? value[way] - green[way] : value[way]; };
  const std::uint32_t change = std::abs(d(-1) - d(-down - 1)) + std::abs(d(-down) - d(-down - 1)) +
                               std::abs(d(-down) - d(-down + 1)) + std::abs(d(-1) - d(-2));
  return std::min(int(std::bit_width(change)), kRoughnesses - 1);
}

int DifferencePlanes::context(int channel, int u, int v) const {
  const std::size_t here = at(u, v);
  const std::int32_t* miss = planes_[channel].miss.data() + here;
  std::uint32_t activity =
      2 * miss[-1] + 2 * miss[-stride_] + miss[-stride_ - 1] + miss[-stride_ + 1];
  if (channel > 0) activity += planes_[channel - 1].miss[here];
  if (activity == 0) return 0;
  // Two classes per octave.
  const int octave = std::bit_width(activity) - 1;
  const int half = octave > 0 ? int(activity >> (octave - 1)) & 1 : 0;
  return std::min(1 + 2 * octave + half, kContexts - 1);
}

void DifferencePlanes::set(int channel, int u, int v, std::int32_t value, std::int32_t miss) {
  const std::size_t here = at(u, v);
  planes_[channel].value[here] = value;
  planes_[channel].miss[here] = std::abs(miss);
}

}  // namespace gigaray
