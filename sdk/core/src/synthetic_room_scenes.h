// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "synthetic_builder.h"

namespace gigaray::synthetic {

// Scenes for photographs from far apart: built in scene units, with something in every direction.
// Cameras may stand 1.6 from their middle, which is that far before the centre view.

void build_room(SceneBuilder& b);
void build_figure(SceneBuilder& b);

}  // namespace gigaray::synthetic
