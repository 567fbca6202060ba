// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <opencv2/core.hpp>

#include "gigaray/adapters/feature_tracks.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/rail_rectification.h"
#include "gigaray/calibration/known_order_start.h"
#include "gigaray/calibration/rail_adjustment.h"
#include "gigaray/calibration/rectifying_rotation.h"
#include "gigaray/core/arguments.h"
#include "pictures/lanczos.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

[[noreturn]] void bad(const std::string& what) { throw Error(ErrorCode::kBadInput, what); }

constexpr const char* kHandHeld =
    "; for photographs taken by hand use gigaray depth, which needs no rail";

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

std::vector<LensMap> lens_maps(const std::vector<RailPhotograph>& pictures) {
  std::vector<LensMap> maps;
  for (const RailPhotograph& picture : pictures) maps.emplace_back(picture.lens);
  return maps;
}

/// Where the photograph of a view shows a pixel of the rectified view, and the other way.
class ViewMap {
 public:
  ViewMap(const Rail& rail, int view_idx, const LensMap& lens, const Camera& camera)
      : own_from_rectified_(rail.view_rotation(view_idx) * camera.rotation.transpose()),
        bend_(rail.lens),
        lens_(lens),
        camera_(camera) {}

  std::optional<Vector2d> source(double u, double v) const {
    const Vector3d ray =
        own_from_rectified_ * Vector3d((u - camera_.centre_u) / camera_.focal_u,
                                       (v - camera_.centre_v) / camera_.focal_v, 1);
    if (ray.z() <= 0) return std::nullopt;
    const Vector2d direction = ray.hnormalized();
    if (!bend_.sees(direction)) return std::nullopt;
    return lens_.distort((bend_.project(direction) - bend_.centre) / bend_.focal);
  }

  std::optional<Vector2d> rectified(const Vector2d& pixel) const {
    const auto bent = lens_.undistort(pixel);
    if (!bent) return std::nullopt;
    const Vector2d direction = bend_.direction(bend_.focal * *bent + bend_.centre);
    const Vector3d ray = own_from_rectified_.transpose() * direction.homogeneous();
    if (ray.z() <= 0) return std::nullopt;
    return Vector2d(camera_.focal_u * ray.x() / ray.z() + camera_.centre_u,
                    camera_.focal_v * ray.y() / ray.z() + camera_.centre_v);
  }

 private:
  Matrix3d own_from_rectified_;
  RadialLens bend_;
  LensMap lens_;
  Camera camera_;
};

/// The rotation nearest to the mean of the matrices.
Matrix3d mean_rotation(const std::vector<Matrix3d>& rotations) {
  Matrix3d sum = Matrix3d::Zero();
  for (const Matrix3d& rotation : rotations) sum += rotation;
  const Eigen::JacobiSVD<Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector3d signs(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1);
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

std::vector<Matrix3d> view_rotations(const Rail& rail) {
  std::vector<Matrix3d> rotations;
  for (int view = 0; view < rail.num_views(); ++view) rotations.push_back(rail.view_rotation(view));
  return rotations;
}

/// Lens of the rail: what is common to the lenses of the pictures. It starts without distortion.
RadialLens common_lens(const std::vector<LensMap>& lenses) {
  RadialLens lens;
  for (const LensMap& map : lenses) {
    lens.focal += map.focal().mean() / double(lenses.size());
    lens.centre += map.centre() / double(lenses.size());
  }
  return lens;
}

/// The sightings as the common lens would have them; those without a direction are left out.
std::vector<Track> undistorted(const std::vector<Track>& tracks, const std::vector<LensMap>& lenses,
                               const RadialLens& lens) {
  std::vector<Track> result;
  for (const Track& track : tracks) {
    Track straight;
    for (const Sighting& sighting : track)
      if (const auto direction = lenses[sighting.view_idx].undistort(sighting.pixel))
        straight.push_back({sighting.view_idx, lens.focal * *direction + lens.centre});
    if (straight.size() >= 2) result.push_back(std::move(straight));
  }
  return result;
}

/// The longest ones say most about the line.
void keep_longest(std::vector<Track>& tracks) {
  constexpr std::size_t kMost = 6000;
  std::stable_sort(tracks.begin(), tracks.end(),
                   [](const Track& a, const Track& b) { return a.size() > b.size(); });
  if (tracks.size() > kMost) tracks.resize(kMost);
}

/// A rail in two halves that share nothing has no common scale.
void check_connected(const std::vector<Track>& tracks,
                     const std::vector<RailPhotograph>& pictures) {
  constexpr int kLeast = 16;
  std::vector<int> across(pictures.size(), 0);  // tracks from picture i or before to after it
  for (const Track& track : tracks)
    for (int i = track.front().view_idx; i < track.back().view_idx; ++i) ++across[i];
  for (std::size_t i = 0; i + 1 < pictures.size(); ++i)
    if (across[i] < kLeast)
      bad(pictures[i].file.string() + ": shares too few features with " +
          pictures[i + 1].file.filename().string() + " (" + std::to_string(across[i]) +
          "); neighbours on a rail have to overlap and show texture" +
          ", and their names to be in the order of the rail");
}

Rail rail_from_poses(const std::vector<RailPhotograph>& pictures, const RailLine& line,
                     const RadialLens& lens) {
  Rail rail;
  std::vector<Matrix3d> rotations;
  for (const RailPhotograph& picture : pictures) rotations.push_back(picture.rotation);
  rail.rotation = mean_rotation(rotations);
  for (const Matrix3d& rotation : rotations)
    rail.turns.push_back(rotation * rail.rotation.transpose());
  rail.direction = line.direction;
  rail.origin = line.origin;
  rail.positions = line.positions;
  rail.lens = lens;
  return rail;
}

Camera rectified_camera(const Rail& rail) {
  Camera camera;
  camera.focal_u = camera.focal_v = rail.lens.focal;
  camera.centre_u = rail.lens.centre.x();
  camera.centre_v = rail.lens.centre.y();
  camera.rotation = rectifying_rotation(mean_rotation(view_rotations(rail)), rail.direction);
  return camera;
}

struct Candidate {
  RailAdjustment adjustment;
  ResidualStats vertical;  ///< of all tracks
};

Candidate adjust(Rail start, const std::vector<Track>& tracks, bool own_rotations,
                 bool refine_distortion, const RunControl& control) {
  RailAdjustmentOptions options;
  options.own_rotations = own_rotations;
  options.refine_distortion = refine_distortion;
  if (!own_rotations)
    for (Matrix3d& turn : start.turns) turn.setIdentity();
  if (own_rotations) {
    RailAdjustmentOptions freer = options;
    freer.off_line_sigma = 0.1;
    start = adjust_rail(start, tracks, freer, control).rail;
  }
  options.hold_turn_trend = own_rotations;
  Candidate candidate;
  candidate.adjustment = adjust_rail(start, tracks, options, control);
  const Rail& rail = candidate.adjustment.rail;
  candidate.vertical = vertical_residual(rectified_tracks(rail, rectified_camera(rail), tracks));
  return candidate;
}

/// The adjustment that leaves less between the rows. Rotations of their own always fit their tracks
/// a little better; they have to be worth it.
Candidate best_adjustment(const Rail& start, const std::vector<Track>& tracks,
                          RailRotations rotations, bool refine_distortion,
                          const RunControl& control) {
  constexpr const char* kStage = "calibrate";
  control.progress(kStage, 0, 2);
  std::optional<Candidate> own, common;
  if (rotations != RailRotations::kCommon)
    own = adjust(start, tracks, true, refine_distortion, control);
  control.progress(kStage, 1, 2);
  if (rotations == RailRotations::kOwn) return *own;
  try {
    common = adjust(start, tracks, false, refine_distortion, control);
  } catch (const Error& error) {
    // An unsteady rail may fit no common rotation at all.
    if (!own || error.code() != ErrorCode::kBadInput) throw;
    return *own;
  }
  control.progress(kStage, 2, 2);
  constexpr double kWorthIt = 0.9;
  return own && own->vertical.median < kWorthIt * common->vertical.median ? *own : *common;
}

void check_is_rail(const Candidate& candidate, double rejected_share, int height) {
  constexpr double kMostRows = 0.0025, kMostRejected = 0.7;  // of the height; of the sightings
  const double limit = std::max(1.0, kMostRows * height);
  if (candidate.vertical.median <= limit && rejected_share <= kMostRejected) return;
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(),
                "the photographs don't fit a rail: rows still differ by %.1f px, %.0f %% of the "
                "features contradict it",
                candidate.vertical.median, 100 * rejected_share);
  bad(text.data() + std::string(kHandHeld));
}

/// Is a source position inside of the photograph with a margin for the resampling?
bool is_well_inside(const std::optional<Vector2d>& source, int width, int height) {
  constexpr double kMargin = 1;
  return source && source->x() >= kMargin && source->y() >= kMargin &&
         source->x() <= width - 1 - kMargin && source->y() <= height - 1 - kMargin;
}

/// Columns and rows between which the borders of all photographs come to lie.
PixelRectangle common_bounds(const std::vector<ViewMap>& maps, int width, int height) {
  constexpr int kSamples = 32;
  double left = -std::numeric_limits<double>::infinity(), top = left;
  double right = -left, bottom = -left;
  for (const ViewMap& map : maps) {
    Eigen::AlignedBox2d box;
    for (int i = 0; i <= kSamples; ++i) {
      const double u = double(width - 1) * i / kSamples, v = double(height - 1) * i / kSamples;
      for (const Vector2d& pixel :
           {Vector2d(u, 0), Vector2d(u, height - 1), Vector2d(0, v), Vector2d(width - 1, v)})
        if (const auto at = map.rectified(pixel)) box.extend(*at);
    }
    if (box.isEmpty()) return {};
    left = std::max(left, box.min().x());
    top = std::max(top, box.min().y());
    right = std::min(right, box.max().x());
    bottom = std::min(bottom, box.max().y());
  }
  // A picture is not stretched beyond this by any rail; it keeps the numbers in range.
  const double most = 4.0 * std::max(width, height);
  left = std::max(left, -most);
  top = std::max(top, -most);
  right = std::min(right, most);
  bottom = std::min(bottom, most);
  if (!(left < right && top < bottom)) return {};
  const int u = int(std::ceil(left)), v = int(std::ceil(top));
  return {u, v, int(std::floor(right)) - u + 1, int(std::floor(bottom)) - v + 1};
}

/// Crops the camera to pixels that all photographs show.
void crop_to_common(const Rail& rail, const std::vector<LensMap>& lenses, int width, int height,
                    Camera& camera) {
  std::vector<ViewMap> maps;
  for (int view = 0; view < rail.num_views(); ++view)
    maps.emplace_back(rail, view, lenses[view], camera);
  constexpr int kRaster = 256;  // places per side
  const PixelRectangle bounds = common_bounds(maps, width, height);
  const int step = std::max(1, std::max(bounds.width, bounds.height) / kRaster);
  const auto rectangle = largest_valid_rectangle(bounds, step, [&](int u, int v) {
    return std::all_of(maps.begin(), maps.end(), [&](const ViewMap& map) {
      return is_well_inside(map.source(u, v), width, height);
    });
  });
  constexpr double kLeastShare = 0.1;
  if (!rectangle || double(rectangle->width) * rectangle->height < kLeastShare * width * height)
    bad("rectified, the photographs share less than a tenth of their area: the camera turned too "
        "much on its way");
  camera.centre_u -= rectangle->u;
  camera.centre_v -= rectangle->v;
  camera.width = rectangle->width;
  camera.height = rectangle->height;
}

class RectifiedPictures : public PixelSource {
 public:
  explicit RectifiedPictures(RectifiedRail rail)
      : rail_(std::move(rail)), lenses_(lens_maps(rail_.pictures)) {}

  int bit_depth() const override { return rail_.bit_depth; }

  Image<std::uint16_t> read(int view_idx) const override {
    const RailPhotograph& photograph = rail_.pictures.at(std::size_t(view_idx));
    PictureSpec spec;
    Image<std::uint16_t> picture =
        decode_picture(photograph.file, Orientation::kIgnored, spec, opening_limit(), rail_.scale);
    if (picture.width() != photograph.lens.width || picture.height() != photograph.lens.height)
      bad(photograph.file.string() + ": has another size than when it was opened");
    if (spec.bit_depth < rail_.bit_depth) widen_to_16_bit(picture);
    const ViewMap map(rail_.rail, view_idx, lenses_[view_idx], rail_.camera);
    cv::Mat sources(rail_.camera.height, rail_.camera.width, CV_32FC2);
    cv::parallel_for_(cv::Range(0, sources.rows), [&](const cv::Range& rows) {
      for (int v = rows.start; v < rows.end; ++v)
        for (int u = 0; u < sources.cols; ++u) {
          // Everywhere inside, by the choice of the camera.
          const Vector2d source = map.source(u, v).value_or(Vector2d::Zero());
          sources.at<cv::Vec2f>(v, u) = {float(source.x()), float(source.y())};
        }
    });
    return resampled_lanczos(picture, sources, (1 << rail_.bit_depth) - 1);
  }

 private:
  RectifiedRail rail_;
  std::vector<LensMap> lenses_;
};

PictureSeries series_of(const std::vector<RailPhotograph>& pictures, int bit_depth,
                        const ValueScale& scale) {
  return {int(pictures.size()), bit_depth, [&pictures, bit_depth, scale](int idx) {
            PictureSpec spec;
            Image<std::uint16_t> picture = decode_picture(pictures[idx].file, Orientation::kIgnored,
                                                          spec, opening_limit(), scale);
            if (spec.bit_depth < bit_depth) widen_to_16_bit(picture);
            return picture;
          }};
}

}  // namespace

RectifiedRail calibrate_rail(const RailPhotographs& photographs, RailRotations rotations,
                             const RunControl& control) {
  RectifiedRail result;
  result.pictures = photographs.pictures;
  result.posed = photographs.posed;
  result.focal_is_known = photographs.focal_is_known;
  result.bit_depth = photographs.bit_depth;
  result.scale = photographs.scale;
  RailReport& report = result.report;
  std::vector<RailPhotograph>& pictures = result.pictures;

  if (photographs.posed) {
    const auto line_of = [&] {
      std::vector<Vector3d> centres;
      for (const RailPhotograph& picture : pictures)
        centres.push_back(-picture.rotation.transpose() * picture.translation);
      return fit_rail_line(centres);
    };
    const RailLine line = line_of();
    const auto [first, last] = std::minmax_element(line.positions.begin(), line.positions.end());
    constexpr double kMostBeside = 0.05;  // of the rail's length
    if (line.rms_distance > kMostBeside * (*last - *first))
      bad("the cameras don't stand on a line (" +
          std::to_string(std::lround(100 * line.rms_distance / (*last - *first))) +
          " % of its length beside it)" + kHandHeld);
    std::vector<std::size_t> order(pictures.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return line.positions[a] < line.positions[b]; });
    std::vector<RailPhotograph> sorted;
    for (const std::size_t i : order) sorted.push_back(pictures[i]);
    pictures = std::move(sorted);
    report.line = line_of();
  }

  const std::vector<LensMap> lenses = lens_maps(pictures);
  const RadialLens lens = common_lens(lenses);
  const PictureSeries series = series_of(pictures, result.bit_depth, result.scale);
  std::vector<Track> tracks = find_feature_tracks(series, {}, "match", control);
  report.vertical_before = vertical_residual(tracks);
  tracks = undistorted(tracks, lenses, lens);
  check_connected(tracks, pictures);
  keep_longest(tracks);

  const Rail start = photographs.posed ? rail_from_poses(pictures, *report.line, lens)
                                       : known_order_start(int(pictures.size()), lens, tracks);
  const Candidate best =
      best_adjustment(start, tracks, rotations, !photographs.distortion_is_known, control);
  const RailAdjustment& adjustment = best.adjustment;
  result.rail = adjustment.rail;
  report.num_tracks = long(tracks.size());
  report.rejected_share =
      double(adjustment.rejected_sightings) / double(std::max(1L, adjustment.num_sightings));
  check_is_rail(best, report.rejected_share, photographs.height);
  report.reprojection = adjustment.after;
  const Matrix3d common = mean_rotation(view_rotations(result.rail));
  double squares = 0;
  for (const Matrix3d& rotation : view_rotations(result.rail)) {
    const double angle = Eigen::AngleAxisd(rotation * common.transpose()).angle();
    squares += angle * angle / result.rail.num_views();
    report.own_rotations |= !rotation.isApprox(common, 1e-12);
  }
  report.rotation_rms_deg = degrees(std::sqrt(squares));

  result.camera = rectified_camera(result.rail);
  crop_to_common(result.rail, lenses, photographs.width, photographs.height, result.camera);
  result.positions = rectified_positions(result.rail, result.camera.rotation);
  return result;
}

RailSource source_of(const RectifiedRail& rail, int view_idx) {
  require_argument(view_idx >= 0 && view_idx < rail.rail.num_views() &&
                       std::size_t(view_idx) < rail.pictures.size() &&
                       rail.rail.turns.size() == rail.rail.positions.size(),
                   "view_idx: the rail has no such view");
  RailSource source{rail.rail.view_rotation(view_idx) * rail.camera.rotation.transpose(),
                    rail.pictures[std::size_t(view_idx)].lens};
  // A lens that was known before is kept, and nothing is added to it.
  const RadialLens& found = rail.rail.lens;
  if (found.k1 != 0 || found.k2 != 0) {
    constexpr double kCorner = 0.5;  // Lens has pixel corners at integers
    source.lens.model = "RADIAL";
    source.lens.params = {found.focal, found.centre.x() + kCorner, found.centre.y() + kCorner,
                          found.k1, found.k2};
  }
  return source;
}

LightField rectified_light_field(const RectifiedRail& rail, std::optional<double> step_mm) {
  require_argument(rail.pictures.size() >= 2 && rail.positions.size() == rail.pictures.size(),
                   "rail: two pictures or more with a position each are needed");
  require_argument(!step_mm || (*step_mm > 0 && std::isfinite(*step_mm)),
                   "step_mm: must be above 0");
  LightField light_field;
  light_field.kind = LightFieldKind::k3D;
  light_field.width = rail.camera.width;
  light_field.height = rail.camera.height;
  for (std::size_t i = 0; i < rail.pictures.size(); ++i)
    light_field.views.push_back({rail.pictures[i].name, rail.positions[i], 0});
  const auto [first, last] = std::minmax_element(rail.positions.begin(), rail.positions.end());
  const double mean_step = (*last - *first) / double(rail.positions.size() - 1);
  const double median_step = normalise_positions(light_field.views);
  if (rail.focal_is_known) light_field.rig.focal_px = rail.camera.focal_u;
  if (step_mm) {
    light_field.rig.baseline = *step_mm * median_step / mean_step;
    light_field.rig.unit = "mm";
  } else if (rail.posed) {
    light_field.rig.baseline = median_step;
  }
  light_field.format = "rectified rail";
  light_field.pixels = std::make_shared<RectifiedPictures>(rail);
  return light_field;
}

}  // namespace gigaray
