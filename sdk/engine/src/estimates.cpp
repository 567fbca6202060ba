// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "estimates.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace gigaray {

// The order of floats as unsigned integers: negative ones reversed, below the positive ones.
PackedEstimate pack_estimate(float hypothesis, float confidence) {
  const auto bits = std::bit_cast<std::uint32_t>(hypothesis);
  const std::uint32_t key = bits & 0x80000000u ? ~bits : bits | 0x80000000u;
  return PackedEstimate(key) << 32 | std::bit_cast<std::uint32_t>(std::max(confidence, 0.0f));
}

float hypothesis_of(PackedEstimate estimate) {
  if (estimate == 0) return kNoEstimate;
  const auto key = std::uint32_t(estimate >> 32);
  return std::bit_cast<float>(key & 0x80000000u ? key & 0x7fffffffu : ~key);
}

float confidence_of(PackedEstimate estimate) {
  return std::bit_cast<float>(std::uint32_t(estimate));
}

float bar_of(PackedEstimate own, float finished_lead) {
  if (own == 0) return -1;
  return std::max(finished_lead * confidence_of(own), std::numeric_limits<float>::min());
}

}  // namespace gigaray
