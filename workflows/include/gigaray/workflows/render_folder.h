// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Novel and refocused views as files: pictures, maps and gigaray.json (docs/formats.md), into a
// folder that is there; put it in its place with AtomicFolder.
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "gigaray/applications/refocus.h"
#include "gigaray/core/api.h"
#include "gigaray/workflows/novel_views.h"

namespace GIGARAY_API gigaray {

/// Kind of such a folder, for AtomicFolder.
inline constexpr const char* kRenderFormat = "gigaray render";

struct RenderReport {
  std::string record;  ///< gigaray.json
  double seen = 1;     ///< share of the pixels that a source sees, of one view
};

/// view.png and inverse_depth.pfm.
RenderReport write_view(DepthScene& scene, const Camera& camera, const RenderRequest& request,
                        const std::filesystem::path& folder, const RunControl& control);

/// frame_00000.png …
RenderReport write_frames(DepthScene& scene, const std::vector<Camera>& cameras,
                          const RenderRequest& request, const std::filesystem::path& folder,
                          const RunControl& control);

/// view.png, real.png, equal_weights.png, nearest_two.png and inverse_depth.pfm. view: its name.
RenderReport write_left_out(const DepthScene& scene, const LeaveOneOut& result,
                            const std::string& view, const std::filesystem::path& folder);

/// A view with a synthetic aperture.
struct RefocusRequest {
  std::string view = "centre";  ///< as parse_view() takes it
  FocalPlane plane = {};
  /// Views within so many view steps have a part.
  double aperture = std::numeric_limits<double>::infinity();
};

/// view.png.
RenderReport write_refocused(const DepthScene& scene, const RefocusRequest& request,
                             const std::filesystem::path& folder, const RunControl& control);

}  // namespace gigaray
