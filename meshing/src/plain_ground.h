// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <optional>

#include "gigaray/core/point_cloud.h"
#include "gigaray/meshing/depth_view.h"

namespace gigaray {

/// White or black, when at least half of the border of every picture is, as far as it has an
/// estimate: objects are photographed on such a ground. Nothing when it is not, or there is no
/// second view.
std::optional<Rgb8> plain_ground(const DepthViews& views, const RunControl& control);

/// Views whose ground has no points: any depth fits a plain colour, so that next to an object it
/// gets that of the object. Pixels of the colour that hang together with the border of the picture
/// get an inverse depth of 0, farther than everything, if they had one; others of that colour none.
DepthViews without_ground(const DepthViews& views, Rgb8 colour);

/// Without their plain ground, where they have one and `is_kept` does not say otherwise.
DepthViews without_plain_ground(const DepthViews& views, bool is_kept, const RunControl& control);

}  // namespace gigaray
