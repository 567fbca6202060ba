// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/feature_tracks.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "gigaray/calibration/rectifying_rotation.h"
#include "gigaray/core/arguments.h"

namespace gigaray {
namespace {

struct Features {
  std::vector<cv::Point2f> places;  // px of the full size, pixel centres at integers
  cv::Mat descriptors;
};

cv::Mat to_grey(const Image<std::uint16_t>& picture, int bit_depth) {
  const cv::Mat rgb(picture.height(), picture.width(), CV_16UC3,
                    const_cast<std::uint16_t*>(picture.data()));
  cv::Mat grey;
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  grey.convertTo(grey, CV_8U, bit_depth == 16 ? 1 / 257.0 : 1.0);
  return grey;
}

Features find_features(const Image<std::uint16_t>& picture, int bit_depth,
                       const FeatureTrackOptions& options) {
  cv::Mat grey = to_grey(picture, bit_depth);
  const double scale =
      std::min(1.0, double(options.max_size) / std::max(picture.width(), picture.height()));
  if (scale < 1) cv::resize(grey, grey, {}, scale, scale, cv::INTER_AREA);
  const double full_u = double(picture.width()) / grey.cols;
  const double full_v = double(picture.height()) / grey.rows;

  std::vector<cv::KeyPoint> points;
  Features features;
  cv::SIFT::create(options.max_features)
      ->detectAndCompute(grey, cv::noArray(), points, features.descriptors);
  // A reduced pixel covers several: their outer edges agree, not their centres.
  for (const cv::KeyPoint& point : points)
    features.places.emplace_back(float((point.pt.x + 0.5) * full_u - 0.5),
                                 float((point.pt.y + 0.5) * full_v - 0.5));
  return features;
}

using Match = std::pair<int, int>;  // indices of features

/// For each feature of a the nearest one of b, or -1 when another is about as near.
std::vector<int> nearest(const cv::Mat& a, const cv::Mat& b) {
  constexpr float kRatio = 0.8F;
  std::vector<std::vector<cv::DMatch>> found;
  cv::BFMatcher(cv::NORM_L2).knnMatch(a, b, found, 2);
  std::vector<int> best(std::size_t(a.rows), -1);
  for (const auto& two : found)
    if (two.size() == 2 && two[0].distance < kRatio * two[1].distance)
      best[std::size_t(two[0].queryIdx)] = two[0].trainIdx;
  return best;
}

std::vector<Match> match(const Features& a, const Features& b) {
  constexpr std::size_t kLeast = 16;  // fewer agree on a fundamental matrix by chance
  constexpr double kEpipolarPx = 2, kConfidence = 0.999;
  if (a.places.size() < kLeast || b.places.size() < kLeast) return {};
  const std::vector<int> forth = nearest(a.descriptors, b.descriptors);
  const std::vector<int> back = nearest(b.descriptors, a.descriptors);
  std::vector<Match> matches;
  std::vector<cv::Point2f> from, to;
  for (int i = 0; i < int(forth.size()); ++i)
    if (forth[i] >= 0 && back[forth[i]] == i) {
      matches.emplace_back(i, forth[i]);
      from.push_back(a.places[i]);
      to.push_back(b.places[forth[i]]);
    }
  if (matches.size() < kLeast) return {};
  cv::Mat agrees;
  cv::findFundamentalMat(from, to, cv::FM_RANSAC, kEpipolarPx, kConfidence, agrees);
  if (agrees.total() != matches.size()) return {};
  std::vector<Match> kept;
  for (std::size_t i = 0; i < matches.size(); ++i)
    if (agrees.at<std::uint8_t>(int(i))) kept.push_back(matches[i]);
  return kept.size() < kLeast ? std::vector<Match>{} : kept;
}

/// Features of all pictures that matches join, as sets of a forest.
class Chains {
 public:
  explicit Chains(const std::vector<Features>& features) {
    for (const Features& of_picture : features) {
      begin_.push_back(int(parent_.size()));
      parent_.resize(parent_.size() + of_picture.places.size());
    }
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  void join(int picture_a, int picture_b, const Match& match) {
    parent_[root(begin_[picture_a] + match.first)] = root(begin_[picture_b] + match.second);
  }

  std::vector<Track> tracks(const std::vector<Features>& features) {
    std::map<int, Track> by_root;
    for (int picture = 0; picture < int(features.size()); ++picture)
      for (int i = 0; i < int(features[picture].places.size()); ++i) {
        const cv::Point2f& place = features[picture].places[i];
        by_root[root(begin_[picture] + i)].push_back({picture, {place.x, place.y}});
      }
    std::vector<Track> tracks;
    for (auto& [ignored, track] : by_root) {
      // A point can't be at two places of a picture.
      const bool ambiguous =
          std::adjacent_find(track.begin(), track.end(), [](const Sighting& a, const Sighting& b) {
            return a.view_idx == b.view_idx;
          }) != track.end();
      if (track.size() >= 2 && !ambiguous) tracks.push_back(std::move(track));
    }
    return tracks;
  }

 private:
  int root(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  std::vector<int> begin_;
  std::vector<int> parent_;
};

void check(const PictureSeries& pictures) {
  require_argument(pictures.count >= 0 && bool(pictures.read),
                   "pictures: a number of them and a way to read them are needed");
  require_argument(pictures.bit_depth >= 1 && pictures.bit_depth <= 16,
                   "pictures.bit_depth: must be between 1 and 16");
}

}  // namespace

std::vector<Track> find_feature_tracks(const PictureSeries& pictures,
                                       const FeatureTrackOptions& options, const char* stage,
                                       const RunControl& control) {
  check(pictures);
  std::vector<Features> features;
  const double total = pictures.count;
  for (int i = 0; i < pictures.count; ++i) {
    control.progress(stage, 0.5 * i, total);
    features.push_back(find_features(pictures.read(i), pictures.bit_depth, options));
  }
  Chains chains(features);
  for (int i = 0; i < pictures.count; ++i) {
    control.progress(stage, 0.5 * (total + i), total);
    for (const int distance : options.reach)
      if (i + distance < pictures.count)
        for (const Match& found : match(features[i], features[i + distance]))
          chains.join(i, i + distance, found);
  }
  control.progress(stage, total, total);
  return chains.tracks(features);
}

ResidualStats measure_vertical_residual(const PictureSeries& pictures, const char* stage,
                                        const RunControl& control) {
  check(pictures);
  constexpr int kMostPairs = 12;
  const int num_pairs = std::min(kMostPairs, pictures.count - 1);
  const FeatureTrackOptions options;
  std::vector<Track> pairs;
  for (int pair = 0; pair < num_pairs; ++pair) {
    control.progress(stage, pair, num_pairs);
    const int first = int(long(pair) * (pictures.count - 1) / num_pairs);
    const Features a = find_features(pictures.read(first), pictures.bit_depth, options);
    const Features b = find_features(pictures.read(first + 1), pictures.bit_depth, options);
    for (const auto& [i, j] : match(a, b))
      pairs.push_back(
          {{first, {a.places[i].x, a.places[i].y}}, {first + 1, {b.places[j].x, b.places[j].y}}});
  }
  control.progress(stage, num_pairs, num_pairs);
  return vertical_residual(pairs);
}

}  // namespace gigaray
