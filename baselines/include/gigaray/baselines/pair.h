// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

#include "gigaray/baselines/baseline.h"

namespace gigaray::baselines {

/// Two rectified pictures, CV_8UC3. What `reference` shows at (u, v) `other` shows at (u − d, v).
struct Pair {
  cv::Mat reference, other;
  int least = 0, most = 0;  ///< d to search, both included; may be negative
  cv::Mat shown{};          ///< CV_8U, 0 where the reference shows nothing; empty: it shows all

  int labels() const { return most - least + 1; }
  /// The same pair with the other picture as the reference, both mirrored.
  Pair turned() const;
};

/// Two views that can be made a pair.
struct PairOfViews {
  int other = 0;      ///< view beside the problem's
  double labels = 0;  ///< px that the range is long in the pair
  std::function<Pair()> read;
  /// d of the pair to disparity of the problem's view, px per view step, CV_32F (v, u).
  std::function<cv::Mat(const cv::Mat&)> to_view;
};

/// Pairs of the problem's view with others in its row (without any, in its column), one and two and
/// four … view steps away and as far as there are.
std::vector<PairOfViews> pairs_in_line(const Problem& problem);

/// Pairs of unstructured views, each rectified: turned so that the other camera is to the right,
/// without distortion but that of the turn. As in a line the nearest one, those at least about
/// twice as far as the last, and the farthest; of those that UnstructuredSampler would compare the
/// view with and that don't stand before or behind it.
std::vector<PairOfViews> pairs_of_cameras(const Problem& problem);

/// Of positions in their order by distance, rising: the first, each that is at least about twice as
/// far as the last that was chosen, and the last.
std::vector<int> doubling(const std::vector<double>& distances);

/// A method for pairs: d of the reference, CV_32F, NaN: none.
using Match = std::function<cv::Mat(const Pair&, const RunControl&)>;

/// The pairs of the problem, each matched by `match`. What lies outside the range is dropped, holes
/// are filled. Pairs with more than `most_labels` labels are left out.
std::vector<Trial> pair_trials(const Problem& problem, const Match& match, int most_labels);

/// NaN where the other picture's map (of Pair::turned()) differs by more than `tolerance` px.
cv::Mat agreed(const cv::Mat& disparity, const cv::Mat& of_turned, float tolerance);

/// Holes take the smaller, farther, one of the next values in their row, empty rows the nearest
/// other row.
void fill_from_farther(cv::Mat& disparity);

/// Where between −½ and ½ the parabola through three costs has its least value.
inline float parabola(float before, float here, float after) {
  const float bend = before - 2 * here + after;
  return bend > 0 ? std::clamp((before - after) / (2 * bend), -0.5f, 0.5f) : 0.0f;
}

/// A cost per label and pixel: volume[label](v, u), CV_32F.
using Volume = std::vector<cv::Mat>;

/// The label with the least cost, refined by a parabola; in labels.
cv::Mat least_cost(const Volume& volume);

}  // namespace gigaray::baselines
