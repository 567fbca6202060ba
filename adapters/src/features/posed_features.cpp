// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "features/posed_features.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace gigaray {
namespace {

Eigen::Vector3d ray_of(const Camera& camera, const cv::Point2f& place) {
  return {(place.x - camera.centre_u) / camera.focal_u,
          (place.y - camera.centre_v) / camera.focal_v, 1};
}

/// Features that may show one point.
struct Candidate {
  int a, b;
  float distance;  ///< of the descriptors, squared
};

float squared_distance(const float* a, const float* b) {
  constexpr int kLength = 128;  // of SIFT
  // Many sums, so that they are taken at once.
  constexpr int kLanes = 16;
  float sums[kLanes] = {};
  for (int i = 0; i < kLength; i += kLanes)
    for (int k = 0; k < kLanes; ++k) {
      const float d = a[i + k] - b[i + k];
      sums[k] += d * d;
    }
  return std::accumulate(std::begin(sums), std::end(sums), 0.0F);
}

/// Features of b that look like one of a and lie where the poses let its point be, or so many px
/// beside it.
std::vector<Candidate> candidates_on_lines(const PosedPair& pair, const ViewFeatures& a,
                                           const ViewFeatures& b, double tolerance, double beside) {
  constexpr float kAlike = 300;  // of 512, the length of a descriptor
  std::vector<Candidate> candidates;
  for (int i = 0; i < int(a.places.size()); ++i) {
    const Eigen::Vector3f line = pair.epipolar_line(a.places[i]).cast<float>();
    const cv::Point2f aside = float(beside) * cv::Point2f(line.x(), line.y());
    for (int j = 0; j < int(b.places.size()); ++j) {
      const cv::Point2f place = b.places[j] - aside;
      if (std::abs(line.x() * place.x + line.y() * place.y + line.z()) > float(tolerance)) continue;
      const float distance =
          squared_distance(a.descriptors.ptr<float>(i), b.descriptors.ptr<float>(j));
      if (distance > kAlike * kAlike) continue;
      const double w = std::max(0.0, pair.inverse_depth(a.places[i], place));
      Eigen::Vector2d there;
      double speed = 0;
      if (pair.locate(a.places[i], w, there, speed) &&
          (there - Eigen::Vector2d(place.x, place.y)).norm() <= tolerance)
        candidates.push_back({i, j, distance});
    }
  }
  return candidates;
}

/// For each feature the index of the candidate that it resembles clearly most, or -1. of: its side;
/// places: of the other side.
std::vector<int> clearly_best(const std::vector<Candidate>& candidates, int Candidate::*of,
                              int Candidate::*other, std::size_t count,
                              const std::vector<cv::Point2f>& places, double tolerance) {
  constexpr float kClearlyBest = 0.8F;
  constexpr double kSamePlace = 2;  // tolerances: the same corner, turned
  std::vector<int> best(count, -1);
  const auto distance = [&](int i) { return candidates[i].distance; };
  for (int i = 0; i < int(candidates.size()); ++i) {
    int& known = best[candidates[i].*of];
    if (known < 0 || distance(i) < distance(known)) known = i;
  }
  std::vector<bool> is_clear(count, true);
  for (const Candidate& candidate : candidates) {
    const Candidate& first = candidates[best[candidate.*of]];
    if (cv::norm(places[candidate.*other] - places[first.*other]) > kSamePlace * tolerance &&
        first.distance > kClearlyBest * kClearlyBest * candidate.distance)
      is_clear[candidate.*of] = false;
  }
  for (std::size_t i = 0; i < count; ++i)
    if (!is_clear[i]) best[i] = -1;
  return best;
}

std::vector<std::pair<int, int>> mutual_matches(const PosedPair& pair, const ViewFeatures& a,
                                                const ViewFeatures& b, double tolerance,
                                                double beside) {
  const std::vector<Candidate> candidates = candidates_on_lines(pair, a, b, tolerance, beside);
  const std::vector<int> forth =
      clearly_best(candidates, &Candidate::a, &Candidate::b, a.places.size(), b.places, tolerance);
  const std::vector<int> back =
      clearly_best(candidates, &Candidate::b, &Candidate::a, b.places.size(), a.places, tolerance);
  std::vector<std::pair<int, int>> matches;
  for (const int i : forth)
    if (i >= 0 && back[candidates[i].b] == i)
      matches.emplace_back(candidates[i].a, candidates[i].b);
  return matches;
}

}  // namespace

PosedPair::PosedPair(const Camera& from, const Camera& to)
    : from_(from),
      to_(to),
      turn_(to.rotation * from.rotation.transpose()),
      shift_(to.translation - turn_ * from.translation) {}

bool PosedPair::locate(const cv::Point2f& pixel, double inverse_depth, Eigen::Vector2d& there,
                       double& speed) const {
  const Eigen::Vector3d at = turn_ * ray_of(from_, pixel) + inverse_depth * shift_;
  if (!(at.z() > 0)) return false;
  const Eigen::Vector2d focal(to_.focal_u, to_.focal_v);
  const Eigen::Array2d on_plane = at.head<2>() / at.z();
  there = (focal.array() * on_plane).matrix() + Eigen::Vector2d(to_.centre_u, to_.centre_v);
  speed =
      (focal.array() * (shift_.head<2>().array() - on_plane * shift_.z()) / at.z()).matrix().norm();
  return true;
}

double PosedPair::inverse_depth(const cv::Point2f& pixel, const cv::Point2f& there) const {
  const Eigen::Vector3d sight = ray_of(to_, there);
  const Eigen::Vector3d at_infinity = sight.cross(turn_ * ray_of(from_, pixel));
  const Eigen::Vector3d by_shift = sight.cross(shift_);
  const double length = by_shift.squaredNorm();
  return length > 0 ? -at_infinity.dot(by_shift) / length : 0;
}

Eigen::Vector3d PosedPair::epipolar_line(const cv::Point2f& pixel) const {
  // Of rays: shift × (turn · ray).
  const Eigen::Vector3d of_rays = shift_.cross(turn_ * ray_of(from_, pixel));
  Eigen::Vector3d line(of_rays.x() / to_.focal_u, of_rays.y() / to_.focal_v, 0);
  line.z() = of_rays.z() - line.x() * to_.centre_u - line.y() * to_.centre_v;
  const double length = line.head<2>().norm();
  return length > 0 ? Eigen::Vector3d(line / length) : Eigen::Vector3d::Zero();
}

std::vector<std::pair<int, int>> matches_on_lines(const Camera& camera_a, const ViewFeatures& a,
                                                  const Camera& camera_b, const ViewFeatures& b,
                                                  double tolerance) {
  constexpr double kBeside = 8;  // tolerances
  constexpr std::size_t kTimesChance = 3;
  const PosedPair pair(camera_a, camera_b);
  std::vector<std::pair<int, int>> matches = mutual_matches(pair, a, b, tolerance, 0);
  const auto by_chance = mutual_matches(pair, a, b, tolerance, kBeside * tolerance).size();
  if (matches.size() < kTimesChance * by_chance) matches.clear();
  return matches;
}

}  // namespace gigaray
