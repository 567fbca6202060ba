// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/applications/segmentation.h"

#include <algorithm>

#include "gigaray/core/arguments.h"
#include "gigaray/core/parallel.h"

namespace gigaray {
namespace {

/// Values in, 0 or 1 out. By value: bytes that are written may alias anything else.
void segment_part(const float* values, std::uint8_t* inside, std::size_t count, float least,
                  float most) {
  for (std::size_t i = 0; i < count; ++i)
    inside[i] = std::uint8_t((values[i] >= least) & (values[i] <= most));
}

}  // namespace

void segment(const FloatMap& map, ValueInterval interval, Mask& mask) {
  require_argument(map.channels() == 1, "map: must have one channel");
  if (mask.width() != map.width() || mask.height() != map.height() || mask.channels() != 1)
    mask = Mask(map.width(), map.height());
  // Threads cost more than they bring for a small map.
  constexpr std::size_t kPart = std::size_t(1) << 22;
  const auto segment_from = [&](std::size_t begin) {
    segment_part(map.data() + begin, mask.data() + begin, std::min(map.size() - begin, kPart),
                 interval.least, interval.most);
  };
  const std::size_t parts = (map.size() + kPart - 1) / kPart;
  if (parts == 1) return segment_from(0);
  if (parts > 1)
    parallel_for(
        int(parts), [&](int part) { segment_from(std::size_t(part) * kPart); }, [](int) {});
}

}  // namespace gigaray
