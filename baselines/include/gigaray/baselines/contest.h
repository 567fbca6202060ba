// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gigaray/baselines/baseline.h"
#include "gigaray/engine/reconstruct.h"
#include "gigaray/workflows/scene_truth.h"
#include "gigaray/workflows/scores.h"

namespace gigaray {

/// What all methods are run on and scored with.
struct Contest {
  LightField light_field;
  int view = 0;
  DisparityRange range;  ///< to search, px per view step
  /// Makes what reconstruct() gives px per view step: 1; of unstructured views, whose maps are of
  /// inverse depth, baselines::disparity_of_inverse_depth().
  double unit = 1;
  std::optional<FloatMap> truth;      ///< of the view
  std::filesystem::path truth_place;  ///< empty: none
  SceneParts parts;
  bool is_pair() const { return light_field.num_views() == 2; }
  bool is_posed() const { return light_field.kind == LightFieldKind::kUnstructured; }
  /// Pixels at the border that the main scores leave out: HCI's, of a pair Middlebury's.
  int border() const {
    return is_pair() ? ScoreChoice{}.middlebury_border() : ScoreChoice{}.hci_border();
  }
  int repeats = 1;  ///< timed runs, after one that is not
};

/// A choice of views that a method was given, and how good it was.
struct Choice {
  std::string views;
  double measure = 0;  ///< BadPix0.07, without truth photo-consistency; less is better
};

inline constexpr const char* kPhotoConsistency = "PhotoConsistency";

/// A method with its best result: that of the choice of views with the least measure.
struct Contestant {
  std::string name, title, reference, parameters;
  bool is_ours = false;
  std::string device;       ///< of ours
  DisparityRange searched;  ///< by ours, px per view step
  /// Of unstructured views: the cameras with the range of inverse depths that ours searched.
  std::vector<Camera> cameras;
  FloatMap disparity;
  std::string views;            ///< that it looked at
  double seconds = 0;           ///< median of the repeats
  std::vector<Choice> choices;  ///< all that were tried
  /// Against the truth, if there is one; PhotoConsistency and seconds.
  std::vector<Score> scores;
  /// NaN: there is no such score.
  double score(const std::string& wanted) const;
};

/// Gigaray with its options; contest.range plays no part. Throws what reconstruct() throws.
Contestant run_ours(const Contest& contest, const DepthOptions& options,
                    const BackendChoice& backend, const RunControl& control);

/// A baseline with the choice of views that is best; nothing where the views allow none.
/// Throws Error(kDevice) when a repeat gives another map: then its time means nothing.
std::optional<Contestant> run_baseline(const Contest& contest, const baselines::Baseline& baseline,
                                       const RunControl& control);

/// Percentage of pixels where both maps have an estimate and differ by no more than `tolerance`.
double agreement(const FloatMap& a, const FloatMap& b, double tolerance);

}  // namespace gigaray
