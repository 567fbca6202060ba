// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/core/light_field.h"
#include "gigaray/core/synthetic_solid.h"
#include "gigaray/meshing/depth_view.h"

namespace gigaray::benchmarks {

/// Pictures of a solid with texture that stands in a textured, spherical room.
LightField photographed(const solids::Solid& solid, std::vector<Camera> cameras);

/// Depth of every view, computed from the pictures by the engine with its usual options; the room
/// is masked.
DepthViews computed_views(const solids::Solid& solid, std::vector<Camera> cameras);

}  // namespace gigaray::benchmarks
