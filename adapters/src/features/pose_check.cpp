// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/pose_check.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "features/view_features.h"
#include "gigaray/core/arguments.h"

namespace gigaray {
namespace {

constexpr std::size_t kMostPairs = 4;
constexpr int kMostTrials = 10;

struct Pair {
  int a, b;
  std::vector<FeatureMatch> matches;
  double px = 1;  ///< of the view, per px of the pictures that were looked at
};

/// Do most points move by more than what is taken for none?
bool moves(Pair& pair) {
  constexpr double kLeastMotion = 4;  // px of the pictures that were looked at
  if (pair.matches.empty()) return false;
  const auto motion = [](const FeatureMatch& m) {
    return std::hypot(m.b.x - m.a.x, m.b.y - m.a.y);
  };
  const auto middle = pair.matches.begin() + long(pair.matches.size() / 2);
  std::ranges::nth_element(pair.matches, middle, {}, motion);
  return motion(*middle) > kLeastMotion * pair.px;
}

/// Pairs of pictures that follow each other, or stand a little farther apart where hardly anything
/// moves, spread over the capture. Poses that may be wrong can't tell which overlap.
std::vector<Pair> find_pairs(const LightField& light_field, const RunControl& control) {
  const int last = light_field.num_views() - 1;
  const int trials = std::min(kMostTrials, last);
  std::map<int, ViewFeatures> known;
  const auto features = [&](int view) -> const ViewFeatures& {
    const auto found = known.find(view);
    if (found != known.end()) return found->second;
    return known.emplace(view, features_of(light_field, view)).first->second;
  };
  std::vector<Pair> pairs;
  for (int i = 0; i < trials && pairs.size() < kMostPairs; ++i) {
    // Every second place first: the first pairs are from the whole capture.
    const int place = 2 * i < trials ? 2 * i : 2 * (i - (trials + 1) / 2) + 1;
    const int first = int((2L * place + 1) * last / (2L * trials));
    control.progress("poses", double(pairs.size()), kMostPairs);
    for (const int distance : {1, 3, 9}) {
      control.throw_if_cancelled();
      if (first + distance > last) break;
      Pair pair{first, first + distance, {}, 1};
      pair.matches = matches_of(features(pair.a), features(pair.b));
      pair.px = 1 / std::min(features(pair.a).scale, features(pair.b).scale);
      if (pair.matches.empty()) break;
      if (!moves(pair)) continue;
      pairs.push_back(std::move(pair));
      break;
    }
  }
  return pairs;
}

std::string percent(double share) { return std::to_string(std::lround(100 * share)) + " %"; }

Eigen::Vector3d ray_of(const Camera& camera, const cv::Point2f& place) {
  return {(place.x - camera.centre_u) / camera.focal_u,
          (place.y - camera.centre_v) / camera.focal_v, 1};
}

/// Does b lie where the pose sends a, at some depth before both cameras? Within a px, or a part of
/// what the point moved.
bool fits(const Camera& a, const Camera& b, const CameraPose& relative, const FeatureMatch& match,
          double px) {
  constexpr double kOfMotion = 0.15, kMostOfWidth = 0.01;
  const double moved = std::hypot(match.b.x - match.a.x, match.b.y - match.a.y);
  const double tolerance = std::max(px, std::min(kOfMotion * moved, kMostOfWidth * b.width));
  const Eigen::Vector3d ray = relative.rotation * ray_of(a, match.a);
  const Eigen::Vector3d& t = relative.translation;
  const auto seen_at = [&](const Eigen::Vector3d& point) -> Eigen::Vector2d {
    return {b.focal_u * point.x() / point.z() + b.centre_u,
            b.focal_v * point.y() / point.z() + b.centre_v};
  };
  const Eigen::Vector2d there(match.b.x, match.b.y);
  // The point of the epipolar line nearest to b, from infinity (w = 0) to the camera a.
  const auto point_at = [&](double w) -> Eigen::Vector3d { return ray + w * t; };
  const auto away = [&](double w) {
    const Eigen::Vector3d point = point_at(w);
    return point.z() > 0 ? (seen_at(point) - there).norm()
                         : std::numeric_limits<double>::infinity();
  };
  if (ray.z() > 0 && away(0) <= tolerance) return true;
  // Where the line of sight of b, x_b × (ray + w t) = 0, meets that of a best.
  const Eigen::Vector3d sight = ray_of(b, match.b);
  const Eigen::Vector3d at_infinity = sight.cross(ray), by_t = sight.cross(t);
  const double length = by_t.squaredNorm();
  if (!(length > 0)) return false;
  const double w = -at_infinity.dot(by_t) / length;
  return w > 0 && away(w) <= tolerance;
}

}  // namespace

PoseAgreement measure_pose_agreement(const LightField& light_field, const RunControl& control) {
  check(light_field);
  require_argument(light_field.kind == LightFieldKind::kUnstructured,
                   "light_field: has no cameras with poses");
  const bool is_read =
      light_field.pose_reading && parse_pose_convention(light_field.pose_reading->convention);
  require_argument(is_read, "light_field.pose_reading: names no convention");
  const std::vector<Pair> pairs = find_pairs(light_field, control);
  PoseAgreement agreement;
  agreement.num_pairs = int(pairs.size());
  if (pairs.empty()) return agreement;
  const PoseReading& reading = light_field.pose_reading.value();
  const PoseConvention as_read = parse_pose_convention(reading.convention).value();
  const auto share_under = [&](const PoseConvention& convention) {
    const auto pose_in = [&](const Camera& camera) {
      const CameraPose pose{camera.rotation, camera.translation, reading.is_mirrored};
      return read_pose(state_pose(pose, as_read), convention).value();
    };
    double sum = 0;
    for (const Pair& pair : pairs) {
      const Camera &a = light_field.cameras[pair.a], &b = light_field.cameras[pair.b];
      const CameraPose pose_a = pose_in(a), pose_b = pose_in(b);
      CameraPose relative;
      relative.rotation = pose_b.rotation * pose_a.rotation.transpose();
      relative.translation = pose_b.translation - relative.rotation * pose_a.translation;
      const auto count = std::ranges::count_if(pair.matches, [&](const FeatureMatch& match) {
        return fits(a, b, relative, match, pair.px);
      });
      sum += double(count) / double(pair.matches.size());
    }
    return sum / double(pairs.size());
  };
  agreement.as_read = share_under(as_read);
  agreement.best = as_read;
  agreement.share_of_best = agreement.as_read;
  constexpr double kClearlyBetter = 0.02;
  for (const PoseConvention& convention : all_pose_conventions()) {
    const double share = share_under(convention);
    if (share > agreement.share_of_best + kClearlyBetter) {
      agreement.best = convention;
      agreement.share_of_best = share;
    }
  }
  return agreement;
}

void check_poses(LightField& light_field, bool is_stated, const RunControl& control) {
  if (!light_field.pose_reading) return;
  constexpr double kFits = 0.5, kFitsInstead = 0.6, kLeastLead = 0.25, kFitsNowhere = 0.1;
  constexpr int kLeastPairs = 3;
  const PoseAgreement agreement = measure_pose_agreement(light_field, control);
  const std::string reading = light_field.pose_reading->convention;
  light_field.pose_reading.reset();
  if (agreement.num_pairs == 0 || agreement.as_read >= kFits) return;
  std::string what = "the poses don't fit the pictures: read as " + reading + ", " +
                     percent(agreement.as_read) + " of what features show agrees with them";
  const bool other_fits = agreement.share_of_best >= kFitsInstead &&
                          agreement.share_of_best >= agreement.as_read + kLeastLead;
  if (other_fits)
    what += ", in the convention " + describe(agreement.best) + " " +
            percent(agreement.share_of_best) + "; state it with OpenOptions::convention " +
            name_of(agreement.best);
  else
    what += ", and no other convention does better than " + percent(agreement.share_of_best) +
            "; are they of these pictures, in their order, with the right focal length? "
            "(OpenOptions::convention " +
            reading + " takes them all the same)";
  const bool is_sure =
      other_fits || (agreement.share_of_best < kFitsNowhere && agreement.num_pairs >= kLeastPairs);
  if (is_sure && !is_stated) throw Error(ErrorCode::kBadInput, what);
  control.message(what);
}

}  // namespace gigaray
