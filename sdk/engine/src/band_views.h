// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <vector>

#include "gigaray/core/error.h"

namespace gigaray {

/// Place in a band of each view of the light field; -1: not loaded.
inline std::vector<int> places_in(const std::vector<int>& loaded, int num_views) {
  std::vector<int> places(num_views, -1);
  for (std::size_t i = 0; i < loaded.size(); ++i) places[loaded[i]] = int(i);
  return places;
}

/// Place of a view that must be loaded. Before the first band, where no pixel is looked at: 0.
inline int place_of(const std::vector<int>& places, int view) {
  if (places.empty()) return 0;
  GIGARAY_CHECK(places[view] >= 0);
  return places[view];
}

}  // namespace gigaray
