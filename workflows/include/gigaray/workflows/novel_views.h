// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>
#include <vector>

#include "gigaray/applications/novel_view.h"
#include "gigaray/applications/picture_quality.h"
#include "gigaray/core/api.h"
#include "gigaray/workflows/memory_budget.h"
#include "gigaray/workflows/result.h"

namespace GIGARAY_API gigaray {

/// The camera that a text means:
///   centre, a name or an index          of a view
///   S,T                                 3D and 4D: a place in the plane of the cameras, view steps
///   either with +X,Y,Z                  moved right, down and ahead by so many scene units
///   FILE.json                           a camera as gigaray.json of `gigaray depth` has it
/// Throws Error(kInvalidArgument) naming the text, Error(kBadInput) naming the file.
Camera parse_pose(const std::string& text, const DepthScene& scene);

/// Key frames: poses with ; between them, two or more. Throws the same.
std::vector<Camera> parse_path(const std::string& text, const DepthScene& scene);

/// So many cameras on the way along key frames, at least one.
std::vector<Camera> cameras_along(const std::vector<Camera>& keys, int frames);

/// How a novel view is made.
struct RenderRequest {
  int sources = 8;  ///< views that it is made of, the nearest. 1 … 32
  NovelViewOptions options = {};
};

/// The novel view of a camera, of its nearest views. exclude: a view that is none of them; −1:
/// none.
NovelView render(DepthScene& scene, const Camera& camera, const RenderRequest& request,
                 const RunControl& control, int exclude = -1);

/// A view rendered without its own picture, beside simpler ways to do it.
struct LeaveOneOut {
  DepthView real;  ///< its camera and picture
  NovelView rendered;
  NovelView equal_weights;           ///< views that see a point count alike
  Image<std::uint16_t> nearest_two;  ///< blended, without depth
  bool took_part_in_depth = false;   ///< its picture helped the depth of the others
  PictureQuality quality, quality_of_equal_weights, quality_of_nearest_two;
};

/// view: a view by name, index or "centre", or one that was left out of the depth, which is the
/// honest test; of others that is said. Throws Error(kInvalidArgument) when there is none.
LeaveOneOut leave_one_out(DepthScene& scene, const std::string& view, const RenderRequest& request,
                          const RunControl& control);

/// Holds a job against the memory, Error(kOutOfMemory), and lets the scene keep as many views as
/// do. bytes_per_pixel: of what is made beside the sources. sources: 0: it reads no depth.
void fit_into_memory(DepthScene& scene, int sources, double bytes_per_pixel,
                     const MemoryBudget& memory);

}  // namespace gigaray
