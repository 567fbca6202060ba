// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <optional>
#include <string>

#include "gigaray/core/api.h"
#include "gigaray/core/image.h"
#include "gigaray/workflows/depth.h"

namespace GIGARAY_API gigaray {

/// A pixel to be explained.
struct ProbeRequest {
  DepthRequest depth = {};
  std::string view = "centre";  ///< as parse_view() takes it
  int u = 0, v = 0;             ///< px
  /// Computes the depth of all views too, for what decided the pixel.
  bool decided = false;
};

/// A hill of a score curve.
struct ScorePeak {
  double disparity = 0, score = 0;
};

/// A pixel, its score curve, and what is read off the curve.
struct ProbeFinding {
  int view = 0, u = 0, v = 0;
  ScoreCurve curve;
  std::optional<ScorePeak> best;       ///< Empty: no hypothesis could be tested.
  std::optional<ScorePeak> runner_up;  ///< The highest peak outside the winner's own hill.
  double mean = kNoEstimate;           ///< Of the tested hypotheses.
  int seen_by = 0;                     ///< Views that see the point of the winner.
  float min_confidence = 0;            ///< What has no more is left to coarser levels.
  std::optional<Decision> decision;    ///< of a whole run, if asked for
};

/// Why a pixel has the depth that it has. Prepares the input as prepare_depth() does; throws what
/// that and probe() of the engine throw.
ProbeFinding probe_pixel(OpenedInput& input, const ProbeRequest& request,
                         const RunControl& control);

/// Pictures of it, RGB 8 bit. The row of views through the pixel: the EPI, with the winner's line.
/// Not of unstructured views, whose rays lie in no common rows.
Image<std::uint16_t> epi_picture(const ProbeFinding& finding, const LightField& light_field,
                                 const RunControl& control);
/// What each view sees of the winner.
Image<std::uint16_t> samples_picture(const ProbeFinding& finding, const LightField& light_field);
/// The score curve.
Image<std::uint16_t> scores_picture(const ProbeFinding& finding);

}  // namespace gigaray
