// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/light_field.h"

namespace gigaray {

/// Puts a view where its camera stands: `right` and `down` of the origin, as the picture shows
/// right and down (see View). The one place where adapters convert a direction in the world into s
/// and t.
inline void place_camera(View& view, double right, double down) {
  view.s = right;
  view.t = down;
}

}  // namespace gigaray
