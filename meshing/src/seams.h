// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <vector>

#include "gigaray/core/run_control.h"
#include "gigaray/core/surface_mesh.h"
#include "gigaray/core/surface_texture.h"

namespace gigaray {

/// Adds offsets to the texture that make both sides of every seam alike and fade away from it: at
/// the vertices they solve min Σ seam (colour + offset − colour' − offset')² + Σ edge (offset −
/// offset')² + ε Σ offset² (Lempitsky and Ivanov 2007), within triangles they are linear.
void level_seams(const SurfaceMesh& mesh, const std::vector<int>& view_of_face,
                 SurfaceTexture& texture, const RunControl& control);

}  // namespace gigaray
