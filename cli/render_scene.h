// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <list>
#include <string>
#include <vector>

#include "depth_scene.h"
#include "gigaray/light_field.h"
#include "gigaray/novel_view.h"
#include "gigaray/rig_cameras.h"

namespace gigaray::cli {

/// Pictures, depth and cameras that novel views are made of: an output folder of `gigaray depth` or
/// a .grl file.
class RenderScene {
 public:
  /// input: where the pictures are, when they are no more where they were; may be empty.
  /// min_confidence: points that are less sure are left out.
  RenderScene(const std::filesystem::path& result, const std::filesystem::path& input,
              double min_confidence);

  /// Bytes of one view as a source, and of the maps that are made from one.
  double source_bytes() const;
  double map_bytes() const;
  /// Keeps so many sources at most, or as many as a view is made of if these are more.
  void keep(std::size_t most) { most_kept_ = most; }

  const LightField& light_field() const { return scene_.light_field; }
  const RigCameras& rig() const { return rig_; }

  /// A view of the light field as a source. The last ones are kept.
  const SourceView& source(int view);

  /// The novel view of a camera, of its nearest sources. exclude: a view that is no source; −1:
  /// none.
  NovelView render(const Camera& camera, int most_sources, int exclude,
                   const NovelViewOptions& options, const RunControl& control);

  /// Index of a view by its name; −1: there is none.
  int find(const std::string& name) const;
  /// A view that took no part in the depth (`depth --without`), from the input.
  RealView left_out(const std::string& name) const;

 private:
  DepthScene scene_;
  RigCameras rig_;
  struct Kept {
    int view;
    SourceView source;
  };
  std::size_t most_kept_ = 24;
  std::list<Kept> kept_;  ///< the last one used first
};

/// The camera that a text means:
///   centre, a name or an index          of a view
///   S,T                                 3D and 4D: a place in the plane of the cameras, view steps
///   either with +X,Y,Z                  moved right, down and ahead by so many scene units
///   FILE.json                           a camera as gigaray.json of `depth` has it
/// Throws Error(kInvalidArgument) naming the text, Error(kBadInput) naming the file.
Camera parse_pose(const std::string& text, const RenderScene& scene);

}  // namespace gigaray::cli
