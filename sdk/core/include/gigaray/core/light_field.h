// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/camera.h"
#include "gigaray/core/image.h"

namespace GIGARAY_API gigaray {

enum class LightFieldKind {
  k3D,           ///< Views on a line: t is the same for all, rows are epipolar lines.
  k4D,           ///< Views in a plane, at any real positions (s, t); a grid may be incomplete.
  kUnstructured  ///< Posed cameras anywhere.
};

const char* to_string(LightFieldKind kind);  ///< "3D", "4D", "unstructured"

/// Where a view's rays start. Positions are real numbers in view steps: the median spacing of
/// neighbouring views is 1 and the centre of the rig is (0, 0). A point seen at
/// (u, v) in view (ŝ, t̂) is seen at (u + (ŝ − s)·d, v + (t̂ − t)·d) in view (s, t) (eq. 3, 9): with
/// a camera that moves right, near points move left. Positive d is nearer. Of unstructured views
/// they only tell who stands near whom: place_by_cameras.
struct View {
  std::string name;  ///< Unique; names the view's output folder. Usually the stem of its file.
  double s = 0;
  double t = 0;
};

/// What is known about the rig beyond pixels; turns disparity into depth.
/// For parallel pinhole cameras: z = focal_px * baseline / (d + focal_px * baseline / focus),
/// with focus infinite for a rig that is not focused (the second term is then 0).
struct RigGeometry {
  std::optional<double> focal_px;        ///< Focal length in level-0 pixels.
  std::optional<double> baseline;        ///< Scene units per view step.
  std::optional<double> focus_distance;  ///< Scene units; plane of zero disparity. Empty: infinity.
  std::string unit;                      ///< Name of the scene unit: "m", "mm"; empty if unknown.
  /// (u, v) of the optical axis at s = t = 0, where disparity 0 is at infinity: that of every view.
  /// Level-0 pixels. Empty: the middle of the picture.
  std::optional<Eigen::Vector2d> principal_point = {};
};

/// Closed range of disparities, level-0 pixels per view step, signed. min < max.
struct DisparityRange {
  double min = 0;
  double max = 0;
  bool operator==(const DisparityRange&) const = default;
};

/// Decodes the pictures of a light field, one at a time. Thread-safe.
class PixelSource {
 public:
  virtual ~PixelSource() = default;
  /// The view as RGB, (v, u, c), gamma-encoded sRGB as stored in the file, 0 … 2^bit_depth() − 1.
  /// Grey is repeated over the channels, alpha is dropped. With has_mask() a fourth channel: 0
  /// where the pixel shows nothing of the scene. Throws Error(kBadInput) naming the file.
  virtual Image<std::uint16_t> read(int view_idx) const = 0;
  /// Are there pixels without meaning: outside of the lens's field after undistortion, outside of a
  /// picture smaller than the light field, masked by the user?
  virtual bool has_mask() const { return false; }
  virtual int bit_depth() const = 0;  ///< 8 or 16, the same for all views.
  /// Are the pictures in memory, so that reading one again is only a copy?
  virtual bool is_held() const { return false; }
  /// Nobody is going to read the picture soon: what keeps it (kept_pictures.h) may free it.
  virtual void let_go(int view_idx) const {}
};

/// How an adapter read poses that an input states: pose_convention.h of the adapters.
struct PoseReading {
  std::string convention;
  bool is_mirrored = false;  ///< z of the scene was turned around
};

/// Views, positions, geometry, and where to get the pixels. Cheap to copy; no pixel is held.
struct LightField {
  LightFieldKind kind = LightFieldKind::k3D;
  int width = 0;   ///< u, all views alike
  int height = 0;  ///< v
  std::vector<View> views;
  std::vector<Camera> cameras;  ///< kUnstructured: one per view; else empty
  /// kUnstructured: most views that each is compared with, the best by overlap and angle; 0: all
  /// that see the same.
  int most_partners = 0;
  RigGeometry rig;                               ///< kUnstructured: the unit alone
  std::optional<DisparityRange> declared_range;  ///< From a parameter file, if there is one.
  std::shared_ptr<const PixelSource> pixels;
  std::string format;              ///< What the adapter recognised, e.g. "image sequence".
  std::vector<std::string> notes;  ///< What the adapter assumed; one line each, for the user.
  /// Which way the camera goes as s and as t rise is an assumption that photo-consistency checks:
  /// check_direction() of the engine, which reconstruct() calls where nobody has before.
  bool sign_is_assumed = false;
  /// kUnstructured: there while the pictures have not confirmed the poses that the input states.
  std::optional<PoseReading> pose_reading;
  /// Views of the input that the adapter left out, with their places; the reason is in the notes.
  std::vector<View> left_out;

  int num_views() const { return int(views.size()); }
};

/// Throws Error(kBadInput) when something is missing or contradictory: no pixels, fewer than two
/// views, two views at one place, names that repeat, non-finite positions, sizes below 1, cameras
/// that are missing or wrong.
void check(const LightField& light_field);

/// The picture of a view, see PixelSource::read: 3 channels, or 4 with a mask. Throws
/// Error(kBadInput) naming the view when its size is not that of the light field.
Image<std::uint16_t> read_view(const LightField& light_field, int view_idx);

/// Pictures of another light field: picture i is its view which[i].
std::shared_ptr<const PixelSource> pictures_of(LightField light_field, std::vector<int> which);

/// The light field without some of its views, which become left_out; the others stay where they
/// are. Throws Error(kInvalidArgument) when fewer than two are left.
LightField without(LightField light_field, const std::vector<int>& views);

/// Takes the fourth channel away from a picture that has one: 0 where it shows nothing of the
/// scene.
std::optional<Mask> take_mask(Image<std::uint16_t>& picture);

/// Index of the view nearest to the centre of the rig (ties: smaller s, then smaller t).
int centre_view(const LightField& light_field);

/// All views ordered by distance to the centre of the rig (ties: smaller s, then smaller t).
std::vector<int> views_from_centre(const LightField& light_field);

/// Moves the rig's centre (middle of the bounding box) to (0, 0) and scales the positions so that
/// the median distance of a view to its nearest neighbour is 1. Returns that distance in the old
/// unit, the factor from view steps to the unit that the positions came in. A grid whose step is
/// known should not be normalised with it: state positions in steps instead.
double normalise_positions(std::vector<View>& views);

/// Sets s and t of unstructured views from their cameras: the positions along the two main
/// directions of their spread, in steps of the median distance to the nearest neighbour at another
/// place, 0 in the middle. Returns that distance in scene units. Throws Error(kBadInput) when all
/// stand at one place.
double place_by_cameras(LightField& light_field);

/// 3D when all t are equal, else 4D.
LightFieldKind kind_from_positions(const std::vector<View>& views);

/// A light field over pictures in memory; used by the synthetic scenes and by tests.
/// `pictures` are RGB of equal size, one per view.
std::shared_ptr<const PixelSource> pixels_in_memory(std::vector<Image<std::uint16_t>> pictures,
                                                    int bit_depth);

}  // namespace gigaray
