// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gigaray/adapters/lens.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/calibration/rail.h"
#include "gigaray/calibration/rail_line.h"
#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"
#include "gigaray/core/run_control.h"

namespace GIGARAY_API gigaray {

/// A photograph taken on a rail.
struct RailPhotograph {
  std::filesystem::path file;
  std::string name;                                        ///< of the view
  Lens lens;                                               ///< for the size of the file
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< scene → camera, if posed
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();   ///< scene units, if posed
};

/// All photographs of a rail, of one size.
struct RailPhotographs {
  std::vector<RailPhotograph> pictures;  ///< along the rail, unless posed: then in any order
  bool posed = false;                    ///< cameras are known
  bool focal_is_known = true;            ///< else guessed: the scale of depth is open
  bool distortion_is_known = true;       ///< else the lens is a pinhole to start with
  int width = 0, height = 0;
  int bit_depth = 8;
  ValueScale scale;
  std::vector<std::string> notes;  ///< what was assumed or left out
  std::string lens_note;           ///< what was assumed of the lens, unless it comes with the poses
};

/// What is known of the lens of a rail's camera; nothing needs to be.
struct KnownLens {
  std::optional<Lens> lens;        ///< all of it; its size may be left 0
  std::optional<double> focal_px;  ///< the focal length alone
};

/// A folder of photographs in the order of the numbers in their names, at equal steps as far as
/// known. The focal length is the given one, else that of the EXIF data, else a guess. Reads
/// headers. Throws Error(kBadInput) for fewer than 3 pictures, two series of names, several sizes;
/// Error(kInvalidArgument) for a lens that can't be.
RailPhotographs open_rail_in_order(const std::filesystem::path& folder, const KnownLens& lens);

/// Is the input a COLMAP workspace, or the folder of a model?
bool has_colmap_model(const std::filesystem::path& input);

/// The photographs with the cameras of a COLMAP workspace (its largest model, pictures by their
/// file names): posed, with its lenses. Photographs without a camera are left out and noted. Throws
/// Error(kBadInput) when fewer than 3 have one or its cameras are for another size.
RailPhotographs with_colmap_cameras(RailPhotographs photographs,
                                    const std::filesystem::path& workspace);

enum class RailRotations {
  kBest,    ///< kOwn or kCommon, whichever leaves less vertical residual
  kOwn,     ///< each picture is rectified by the rotation of its own camera
  kCommon,  ///< all by one rotation
};

/// What was found out about a rail.
struct RailReport {
  std::optional<RailLine> line;  ///< through the cameras' centres, if they were posed before
  bool own_rotations = false;
  double rotation_rms_deg = 0;  ///< how much the cameras turn, about the common rotation
  ResidualStats reprojection;   ///< of the sightings that were kept, px
  long num_tracks = 0;
  double rejected_share = 0;      ///< of the sightings
  ResidualStats vertical_before;  ///< of features in neighbouring photographs, px
};

/// A rail that is understood: how each photograph becomes a view of a 3D light field.
struct RectifiedRail {
  std::vector<RailPhotograph> pictures;  ///< along the rail
  Rail rail;                             ///< of the pictures; its lens bends what their lenses
                                         ///< have left, between direction and lens
  Camera camera;                         ///< of every view, but for its place along x
  std::vector<double> positions;         ///< along x of the camera, scene units
  RailReport report;
  bool posed = false, focal_is_known = true;  ///< as of the photographs
  int bit_depth = 8;
  ValueScale scale;
};

/// Calibrates a rail from its photographs: features are followed, the cameras are brought onto one
/// line (adjust_rail), from their poses if they have some, else from their order; the common view
/// is chosen so that every pixel of it lies in all photographs. Throws Error(kBadInput) when
/// neighbours share too few features, when it is no rail, and when the pictures share too little.
RectifiedRail calibrate_rail(const RailPhotographs& photographs, RailRotations rotations,
                             const RunControl& control);

/// Where the pixels of a rectified view come from: what RectifiedRail::camera sees in a direction,
/// the photograph shows where its lens shows rotation · direction.
struct RailSource {
  Eigen::Matrix3d rotation;  ///< rectified camera → camera of the photograph
  Lens lens;                 ///< with the distortion that was found
};
RailSource source_of(const RectifiedRail& rail, int view_idx);

/// The 3D light field of a rectified rail. Its pixels are read from the photographs, distortion and
/// rotation undone in one resampling; names are those of the photographs, s is as measured. The rig
/// has a focal length if it is known. step_mm: mean distance of neighbouring cameras, for a rig in
/// mm; without it the unit is that of the poses, or open.
LightField rectified_light_field(const RectifiedRail& rail, std::optional<double> step_mm);

}  // namespace gigaray
