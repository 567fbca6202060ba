// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// What the page of `gigaray view` shows: docs/formats.md, "Scenes of the page".
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "gigaray/core/api.h"
#include "gigaray/core/run_control.h"
#include "gigaray/engine/depth_options.h"
#include "gigaray/engine/reconstruct.h"
#include "gigaray/workflows/input.h"
#include "gigaray/workflows/result.h"

namespace GIGARAY_API gigaray {

/// Takes a file of the scene: a name without folders, and its bytes.
using TakeSceneFile = std::function<void(const std::string& name, std::string bytes)>;

/// What score curves are found with. Views are found in it by their names.
struct CurveSource {
  LightField light_field;  ///< with pictures: all views that the depth was computed of
  DepthOptions options;    ///< with the range that is searched
  BackendChoice backend = {};
};

struct ViewSceneRequest {
  /// Views whose depth is shown, as parse_views() takes them. Empty: the top view and the eight
  /// that stand farthest from each other and from it. Pictures are those of all views.
  std::string views = {};
  int max_size = 1024;    ///< px; larger pictures and their maps are shrunk. 16 and above
  int jpeg_quality = 85;  ///< 1 … 100
  /// Another result with the same views, to be held against this one; may be none.
  std::shared_ptr<DepthScene> compare = {};
  /// As find_truth() takes it, or a folder with truth/VIEW.pfm; of photographs depth. Empty: no
  /// errors are shown.
  std::filesystem::path truth = {};
  std::filesystem::path cloud = {};  ///< .ply; empty: none
  std::filesystem::path mesh = {};   ///< .glb; empty: none
  /// For curves of the top view on a coarse grid, a few seconds; empty: there are none.
  std::optional<CurveSource> curves = {};
  bool is_live = false;  ///< a server answers what the page asks
};

/// Hands the files of a result's scene to `take`, one after the other, and returns scene.json.
/// Throws Error(kInvalidArgument) naming the field, Error(kBadInput) naming the file, kCancelled.
std::string view_scene(DepthScene& scene, const ViewSceneRequest& request,
                       const TakeSceneFile& take, const RunControl& control);
/// The same of a light field without depth.
std::string view_scene(const LightField& light_field, const std::string& name,
                       const ViewSceneRequest& request, const TakeSceneFile& take,
                       const RunControl& control);

}  // namespace gigaray
