// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "gigaray/core/camera.h"
#include "gigaray/core/light_field.h"
#include "gigaray/core/synthetic.h"
#include "synthetic_vec.h"

namespace gigaray::synthetic {

/// Gamma-encoded RGB in [0, 1]. Everything is mixed in the encoded values: the pictures need to be
/// plausible and the same everywhere, not radiometric.
using Colour = Vec3f;

/// Parallel pinhole cameras whose pictures are shifted so that disparity is signed.
/// A point (X, Y, Z) is seen in view (s, t), with d = near_disparity / Z + offset, at
/// u = cx + focal X / Z - s d, v = cy + focal Y / Z - t d (the sign of light_field.h).
/// The nearest surfaces stand at Z = 1, the farthest at Z = far_z, as the centre view sees them.
struct Rig {
  explicit Rig(const SyntheticOptions& options);

  double width = 0, height = 0;  ///< px
  double cx = 0, cy = 0;         ///< px, the middle of the picture
  double focal = 0;              ///< px
  double far_z = 0;              ///< scene units
  double near_disparity = 0;     ///< px per view step at Z = 1, without the offset
  double offset = 0;             ///< px per view step, the disparity of infinity

  double disparity(double z) const { return near_disparity / z + offset; }
  /// Z of a nearness in [0, 1]: 0 the far end of the range, 1 the near end. Linear in disparity.
  double z(double nearness) const { return 1 / (1 / far_z + nearness * (1 - 1 / far_z)); }
  /// The scene point seen in the centre view at a place of the picture; x and y are fractions of
  /// width and height from the middle, -0.5 … 0.5 inside.
  Vec3d point(double x, double y, double nearness) const;
  /// Scene units of one pixel at Z = 1.
  double pixel() const { return 1 / focal; }
  RigGeometry geometry() const;
};

/// Where a view's rays start and which way its pixels look. The parameter along a ray is the depth
/// of the view, its z.
class ViewRays {
 public:
  ViewRays(const Rig& rig, const View& view);  ///< a view of the rig: looks ahead
  /// A posed view. distortion: k1 of COLMAP's SIMPLE_RADIAL, (x, y) (1 + k1 r²).
  ViewRays(const gigaray::Camera& camera, double distortion);

  Vec3d origin() const { return origin_; }
  Vec3d direction(double u, double v) const;
  /// Place of a pixel in the picture without distortion, px.
  Vec3d undistorted(double u, double v) const;
  /// (u, v, z) of a scene point, in the picture without distortion.
  Vec3d project(Vec3d p) const;

 private:
  Vec3d origin_;
  double u0_ = 0, v0_ = 0, focal_ = 0, inverse_focal_ = 0;
  bool is_posed_ = false;
  Vec3d right_{1, 0, 0}, down_{0, 1, 0}, ahead_{0, 0, 1};  ///< the view's axes in the scene
  double distortion_ = 0;
};

enum class Pattern { kPlain, kNoise, kBricks, kPlanks, kMarble, kChecks };

/// What a surface looks like; its texture is attached to the surface.
struct Material {
  Pattern pattern = Pattern::kNoise;
  Colour dark, mid, light;
  float scale = 0.2f;        ///< Coarsest wavelength, scene units.
  float persistence = 0.7f;  ///< Amplitude of each finer octave; larger is rougher.
  bool is_void = false;      ///< Nothing is there: unlit, and without depth in photographs.
  float gloss = 0;           ///< Strength of the highlight, 0 … 1.
  int gloss_power = 7;       ///< Highlight width: the cosine is raised to 2^gloss_power.
  Vec3f gloss_direction;     ///< Unit vector towards the lamp that is mirrored.
  std::uint32_t seed = 0;
};

/// The material's colour, lit. p: texture_point; normal: unit, towards the viewer; to_viewer: unit;
/// footprint: size of a pixel there, scene units.
Colour shade(const Material& material, Vec3f p, Vec3f normal, Vec3f to_viewer, float footprint);

/// One surface. A card is the part of the plane dot(normal, P) = plane_k that the centre view sees
/// inside [x0, x1] × [y0, y1] (px from the middle; may be infinite); a disc is the ellipse
/// inscribed, a wedge the triangle with its tip in the middle of the side y0 and its base on y1,
/// which may be above or below. A panel is a rectangle anywhere in the scene, a shell a ball seen
/// from inside.
struct Primitive {
  enum class Kind { kCard, kDisc, kWedge, kBall, kRod, kPanel, kShell };
  Kind kind = Kind::kCard;
  int material = 0;
  Vec3d normal;  ///< Card: as above, of any length.
  double plane_k = 0;
  Vec3d along, across;  ///< Card, panel: unit vectors in the plane, the axes of its texture.
  /// Card: px. Panel: x1 and y1 are half its sides, scene units.
  double x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  Vec3d centre;  ///< Ball, shell, panel: centre. Rod: one end of its axis.
  Vec3d axis;    ///< Rod: unit vector to the other end.
  double length = 0;
  double radius = 0;  ///< Ball, shell and rod, scene units.
};

inline constexpr double kNoHit = std::numeric_limits<double>::infinity();

/// Parameter k of the first hit of the ray origin + k direction, or kNoHit. Exact up to rounding:
/// closed forms only.
double intersect(const Primitive& primitive, const Rig& rig, Vec3d origin, Vec3d direction);

/// Unit normal at a point of the surface, on the side of the viewer.
Vec3d surface_normal(const Primitive& primitive, Vec3d p, Vec3d direction);

/// Where a point of the surface lies in its texture: along, across, 0 on a card or a panel, the
/// scene point itself on a ball, a shell or a rod.
Vec3f texture_point(const Primitive& primitive, Vec3d p);

/// Pixels that a primitive may cover in a view; generous by up to the depth of its bounding box.
struct PixelBox {
  double u0, u1, v0, v1;
};
PixelBox bounds(const Primitive& primitive, const Rig& rig, const ViewRays& rays);

/// A rig and what stands before it. One primitive at least fills the picture of every view.
struct Scene {
  explicit Scene(const Rig& r) : rig(r) {}
  Rig rig;
  std::vector<Material> materials;
  std::vector<Primitive> primitives;
};

Scene build_scene(const SyntheticOptions& options);

/// Names and positions of the views, numbered as in SyntheticLightField.
std::vector<View> make_views(const SyntheticOptions& options);

/// The nearest surface along a ray.
struct Hit {
  int primitive = -1;
  double z = kNoHit;
};

/// Whether a hit shows that nothing is there.
bool is_void(const Scene& scene, Hit hit);

/// Colour of a hit, lit.
Colour shade_hit(const Scene& scene, Hit hit, Vec3d origin, Vec3d direction);

struct RenderedView {
  Image<std::uint16_t> picture;
  FloatMap truth;  ///< truth_of(hit) for the ray of each pixel centre
};
/// What a view has of its own beside its rays.
struct ViewTraits {
  int view_idx = 0;
  bool has_outlier = false;  ///< somebody walks through
  float gain = 1;            ///< of the encoded value, before noise and clipping
};
RenderedView render_view(const Scene& scene, const SyntheticOptions& options,
                         const ViewTraits& view, const ViewRays& rays,
                         const std::function<double(Hit)>& truth_of, const RunControl& control);

/// Views with something that walks through: the share of them, those with the smallest hashes.
std::vector<bool> choose_outliers(const SyntheticOptions& options, int num_views);

}  // namespace gigaray::synthetic
