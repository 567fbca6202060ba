// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/feature_ranges.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "features/posed_features.h"
#include "gigaray/core/parallel.h"

namespace gigaray {
namespace {

constexpr int kMostViews = 60;
constexpr double kTolerance = 3;  ///< px of the pictures that are looked at, of 1000 px

/// A feature as one other view sees it.
struct Sight {
  int view;
  cv::Point2f place;
};

/// A place that views agree on.
struct Triangulated {
  Eigen::Vector3d position;
  double inverse_depth;  ///< in the view that looked
  double error;          ///< of it, for one px
  int num_others;        ///< other views that see it there
};

/// The views that are looked at, evenly spread.
std::vector<int> chosen_views(int num_views) {
  std::vector<int> chosen;
  const int count = std::min(num_views, kMostViews);
  for (int i = 0; i < count; ++i)
    chosen.push_back(count < 2 ? 0 : int(std::int64_t(i) * (num_views - 1) / (count - 1)));
  return chosen;
}

/// Of the chosen views those whose poses let them show the same: the nearest ones, which look most
/// alike, and some farther ones, which tell depths apart.
std::vector<int> partners_by_pose(const std::vector<Camera>& cameras,
                                  const std::vector<int>& chosen, int view) {
  constexpr double kLeastCosine = 0.77;  // 40°
  constexpr double kSamePlace = 1e-3;    // of the distance to the farthest one
  constexpr int kNearest = 3, kFarther = 3;
  const auto distance = [&](int other) {
    return (cameras[other].position() - cameras[view].position()).norm();
  };
  double farthest = 0;
  for (const int other : chosen) farthest = std::max(farthest, distance(other));
  std::vector<int> others;
  for (const int other : chosen)
    if (other != view && distance(other) > kSamePlace * farthest &&
        cameras[other].direction().dot(cameras[view].direction()) > kLeastCosine)
      others.push_back(other);
  std::ranges::stable_sort(others, {}, distance);
  if (int(others.size()) <= kNearest + kFarther) return others;
  std::vector<int> partners(others.begin(), others.begin() + kNearest);
  const int rest = int(others.size()) - kNearest;
  for (int i = 0; i < kFarther; ++i)
    partners.push_back(others[kNearest + (i + 1) * rest / (kFarther + 1)]);
  return partners;
}

/// Features of the views and what their partners show of them.
class Matches {
 public:
  Matches(const LightField& light_field, const RunControl& control)
      : cameras_(light_field.cameras),
        chosen_(chosen_views(light_field.num_views())),
        features_(cameras_.size()),
        sights_(cameras_.size()),
        partners_(cameras_.size()) {
    std::set<std::pair<int, int>> pairs;
    for (const int view : chosen_)
      for (const int other : partners_by_pose(cameras_, chosen_, view))
        pairs.insert(std::minmax(view, other));
    const double total = double(chosen_.size() + pairs.size());
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      control.throw_if_cancelled();
      control.progress("range", double(i), total);
      features_[chosen_[i]] = features_of(light_field, chosen_[i]);
      sights_[chosen_[i]].resize(features_[chosen_[i]].places.size());
    }
    match(std::vector(pairs.begin(), pairs.end()), control, total);
  }

  const std::vector<int>& views() const { return chosen_; }
  double px(int view) const { return 1 / features_[view].scale; }

  /// What the features of a view are places of, where at least so many others agree.
  std::vector<Triangulated> triangulate(int view, int least_others) const {
    std::vector<Triangulated> found;
    for (std::size_t i = 0; i < sights_[view].size(); ++i)
      if (const auto point = agreed(view, features_[view].places[i], sights_[view][i]);
          point && point->num_others >= least_others)
        found.push_back(*point);
    return found;
  }
  const std::vector<int>& partners(int view) const { return partners_[view]; }

 private:
  void match(const std::vector<std::pair<int, int>>& pairs, const RunControl& control,
             double total) {
    std::vector<std::vector<std::pair<int, int>>> found(pairs.size());
    parallel_for(
        int(pairs.size()),
        [&](int i) {
          const auto [a, b] = pairs[i];
          found[i] = matches_on_lines(cameras_[a], features_[a], cameras_[b], features_[b],
                                      kTolerance * std::max(px(a), px(b)));
        },
        [&](int done) { control.progress("range", double(chosen_.size() + done), total); });
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto [a, b] = pairs[i];
      partners_[a].push_back(b);
      partners_[b].push_back(a);
      for (const auto& [of_a, of_b] : found[i]) {
        sights_[a][of_a].push_back({b, features_[b].places[of_b]});
        sights_[b][of_b].push_back({a, features_[a].places[of_a]});
      }
    }
  }

  /// The inverse depth that most of the other views that show it agree on.
  std::optional<Triangulated> agreed(int view, const cv::Point2f& place,
                                     const std::vector<Sight>& sights) const {
    std::optional<Triangulated> best;
    for (const Sight& first : sights) {
      const double guess = std::max(
          0.0, PosedPair(cameras_[view], cameras_[first.view]).inverse_depth(place, first.place));
      double sum = 0, weights = 0;
      int count = 0;
      for (const Sight& sight : sights) {
        const PosedPair pair(cameras_[view], cameras_[sight.view]);
        Eigen::Vector2d there;
        double speed = 0;
        if (!pair.locate(place, guess, there, speed)) continue;
        const Eigen::Vector2d off = there - Eigen::Vector2d(sight.place.x, sight.place.y);
        if (off.norm() > kTolerance * px(sight.view)) continue;
        const double weight = speed * speed / (px(sight.view) * px(sight.view));
        sum += weight * std::max(0.0, pair.inverse_depth(place, sight.place));
        weights += weight;
        ++count;
      }
      if (!(weights > 0) || (best && count <= best->num_others)) continue;
      best = Triangulated{{}, sum / weights, 1 / std::sqrt(weights), count};
    }
    if (!best || 2 * best->num_others <= int(sights.size())) return std::nullopt;
    // What is as far as the pictures can tell still has a place.
    constexpr double kFarthest = 0.1;  // errors
    best->inverse_depth = std::max(best->inverse_depth, kFarthest * best->error);
    best->position = cameras_[view].back_project(place.x, place.y, 1 / best->inverse_depth);
    return best;
  }

  const std::vector<Camera>& cameras_;
  std::vector<int> chosen_;
  std::vector<ViewFeatures> features_;
  std::vector<std::vector<std::vector<Sight>>> sights_;  ///< of each view, of each feature
  std::vector<std::vector<int>> partners_;
};

/// Those that know their inverse depth well, for how far apart all are.
std::vector<Triangulated> precise(std::vector<Triangulated> points) {
  constexpr double kPrecise = 0.03;  // of what is near
  if (points.empty()) return points;
  std::vector<double> inverse;
  for (const Triangulated& point : points) inverse.push_back(point.inverse_depth);
  const auto near = inverse.begin() + long(0.9 * double(inverse.size() - 1));
  std::ranges::nth_element(inverse, near);
  std::erase_if(points, [&](const Triangulated& point) { return point.error > kPrecise * *near; });
  return points;
}

constexpr std::size_t kEnough = 30;   ///< points for a range
constexpr std::size_t kPlenty = 200;  ///< with fewer, less sure ones are taken too

/// Precise points of one view: of four views where these are plenty, else of three, else of two.
std::vector<Triangulated> points_of(const Matches& matches, int view) {
  std::vector<Triangulated> points;
  for (const int others : {3, 2, 1}) {
    if (others > int(matches.partners(view).size())) continue;
    points = precise(matches.triangulate(view, others));
    if (points.size() >= kPlenty) break;
  }
  return points;
}

/// Inverse depths of what a view sees of points, without the nearest and farthest ones that no
/// others lie beside: wrong matches do.
std::vector<double> supported_depths(const Camera& camera,
                                     const std::vector<Eigen::Vector3d>& points) {
  constexpr double kTail = 0.05;   // of the points, on both sides
  constexpr double kBeside = 0.1;  // of the width, and of the range without tails
  constexpr double kSparse = 3;    // mean distances between points
  constexpr int kLeastBeside = 3;
  std::vector<Eigen::Vector3d> seen;  // u, v in widths; inverse depth
  for (const Eigen::Vector3d& point : points) {
    if (!camera.sees(point)) continue;
    const Eigen::Vector3d at = camera.project(point);
    seen.emplace_back(at.x() / camera.width, at.y() / camera.width, 1 / at.z());
  }
  std::ranges::sort(seen, {}, [](const Eigen::Vector3d& at) { return at.z(); });
  const auto count = seen.size(), tail = std::size_t(kTail * double(count));
  if (count < kEnough) return {};
  const double beside = std::max(kBeside, kSparse / std::sqrt(double(count)));
  const double in_depth = kBeside * (seen[count - 1 - tail].z() - seen[tail].z());
  std::vector<double> depths;
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_inside = i >= tail && i < count - tail;
    const auto lies_beside = [&](const Eigen::Vector3d& other) {
      return std::abs(other.z() - seen[i].z()) <= in_depth &&
             (other - seen[i]).head<2>().norm() <= beside;
    };
    if (is_inside || std::ranges::count_if(seen, lies_beside) > kLeastBeside)
      depths.push_back(1 / seen[i].z());
  }
  return depths;
}

std::optional<InverseDepthRange> range_of(const Camera& camera,
                                          const std::vector<Eigen::Vector3d>& points) {
  return range_of_depths(supported_depths(camera, points));
}

}  // namespace

void take_range_of_features(LightField& light_field, const RunControl& control) {
  std::vector<Camera>& cameras = light_field.cameras;
  const auto lacks = [](const Camera& camera) { return !camera.inverse_depth.has_value(); };
  if (light_field.kind != LightFieldKind::kUnstructured || std::ranges::none_of(cameras, lacks))
    return;
  check(light_field);
  const Matches matches(light_field, control);
  std::vector<std::vector<Eigen::Vector3d>> found(cameras.size());
  std::vector<Eigen::Vector3d> all;
  for (const int view : matches.views()) {
    for (const Triangulated& point : points_of(matches, view))
      found[view].push_back(point.position);
    all.insert(all.end(), found[view].begin(), found[view].end());
  }
  std::vector<std::optional<InverseDepthRange>> ranges(cameras.size());
  for (const int view : matches.views()) {
    // What its partners see in its picture may be bare of features of its own.
    std::vector<Eigen::Vector3d> around = found[view];
    for (const int other : matches.partners(view))
      around.insert(around.end(), found[other].begin(), found[other].end());
    ranges[view] = range_of(cameras[view], around);
  }
  for (std::size_t i = 0; i < cameras.size(); ++i)
    if (!ranges[i]) ranges[i] = range_of(cameras[i], all);
  const auto num_known = std::size_t(
      std::ranges::count_if(ranges, [](const auto& range) { return range.has_value(); }));
  if (2 * num_known < cameras.size()) return;
  std::vector<Camera> known;
  for (std::size_t i = 0; i < cameras.size(); ++i)
    if (ranges[i]) {
      known.push_back(cameras[i]);
      known.back().inverse_depth = ranges[i];
    }
  const InverseDepthRange of_all = all_inverse_depths(known);
  for (std::size_t i = 0; i < cameras.size(); ++i)
    if (!cameras[i].inverse_depth) cameras[i].inverse_depth = ranges[i].value_or(of_all);
  control.message("depths are searched where " + std::to_string(all.size()) +
                  " features that the pictures share are");
}

}  // namespace gigaray
