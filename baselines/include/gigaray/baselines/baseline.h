// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gigaray/core/light_field.h"
#include "gigaray/core/run_control.h"

// Other methods to compare with, each from its paper, with parameters that serve all scenes. They
// see what the method sees: the pictures of the light field and the range of disparities.
namespace gigaray::baselines {

/// Disparity of one view is asked for.
struct Problem {
  LightField light_field;
  int view = 0;
  /// To search, px per view step; of unstructured views inverse depths times
  /// disparity_of_inverse_depth().
  DisparityRange range;
};

/// What a baseline found with some of the views.
struct Estimate {
  FloatMap disparity;      ///< px per view step, (v, u); NaN: none
  std::vector<int> views;  ///< those that it looked at, the reference first
};

/// One choice of views that a baseline may be given.
struct Trial {
  std::string views_text;  ///< "views 40 and 44"
  /// Reads the pictures and finds the map.
  std::function<Estimate(const RunControl&)> run;
};

struct Baseline {
  std::string name;        ///< as it is chosen by: "sgbm"
  std::string title;       ///< "Semi-global block matching"
  std::string reference;   ///< "Hirschmüller 2008, OpenCV"
  std::string parameters;  ///< all that were chosen, for the report
  /// The choices of views: for stereo one per separation of the pair, since which is best depends
  /// on the scene (section 5 of Kim et al. 2013); none where the views don't allow it.
  std::function<std::vector<Trial>(const Problem&)> trials;
};

const std::vector<Baseline>& all_baselines();

}  // namespace gigaray::baselines
