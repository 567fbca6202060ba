// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gigaray/adapters/lens.h"
#include "gigaray/adapters/pose_convention.h"
#include "gigaray/adapters/reader.h"
#include "gigaray/core/light_field.h"

namespace gigaray {

/// A view as a file of cameras states it, converted to the convention of camera.h.
struct StatedView {
  std::string picture;  ///< relative path, perhaps without its extension; empty: not stated
  std::string mask;     ///< relative path; empty: none
  Lens lens;            ///< width 0: for the size of its picture
  /// Instead of the lens: horizontal field of view of a pinhole, radians.
  std::optional<double> field_of_view;
  /// May the lens be that of a copy of the picture of half, a quarter … or twice its size? Its
  /// principal point, which is near the middle, tells. For a lens of width 0.
  bool may_be_of_a_copy = false;
  /// Is the principal point in the middle of the picture? For a lens of width 0.
  bool is_centred = false;
  StatedPose matrix = StatedPose::Identity();  ///< as in the file
  PoseConvention convention;                   ///< of the file's format
  CameraPose pose;                             ///< the matrix read in it
  std::optional<InverseDepthRange> inverse_depth;
  std::string fault;  ///< why it can't be used, one line with the file; empty: it can
};

/// Parsers of one file each: text or bytes, and its name for messages. Throw Error(kBadInput)
/// beginning with it. They touch no other file.
std::vector<StatedView> parse_transforms_json(std::string_view text, const std::string& where);
std::vector<StatedView> parse_poses_bounds(std::string_view bytes, const std::string& where);
std::vector<StatedView> parse_middlebury_par(std::string_view text, const std::string& where);
StatedView parse_strecha_camera(std::string_view text, const std::string& where);
StatedView parse_mvsnet_camera(std::string_view text, const std::string& where);

/// What `parse` makes of a file with the camera of one view; what it throws for bad input is a
/// fault of the view.
StatedView view_of_file(StatedView (*parse)(std::string_view text, const std::string& where),
                        const std::filesystem::path& file);

/// Sets the pose of a view from the matrix that a file states, see read_pose. Numbers that are not
/// finite and axes that are no rotation are a fault of the view.
void set_pose(StatedView& view, const StatedPose& matrix, const PoseConvention& convention,
              const std::string& where);

/// Opens the pictures of views that a file states, every one with `picture`. folders: where they
/// may lie, unless options.images says it. points: relative path of a file of points of the scene,
/// if one is stated (points_beside). Throws Error(kBadInput).
LightField open_stated_views(std::vector<StatedView> views, const std::filesystem::path& file,
                             const std::vector<std::filesystem::path>& folders,
                             const OpenOptions& options, const std::string& format,
                             const std::string& points = "");

}  // namespace gigaray
