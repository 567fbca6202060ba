// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "synthetic_builder.h"

namespace gigaray::synthetic {

// Scenes that are hard for depth estimation, one difficulty each; synthetic_scene_names() says
// which.

void build_plaster(SceneBuilder& b);
void build_silhouettes(SceneBuilder& b);
void build_wedges(SceneBuilder& b);

}  // namespace gigaray::synthetic
