// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <vector>

#include "estimates.h"
#include "gigaray/core/image.h"
#include "gigaray/engine/depth_options.h"

namespace gigaray {

/// What is done with a view, in this order.
enum class SweepStep {
  kLook,         ///< scores, support, winners; along slopes where those are known before
  kSmooth,       ///< median of the winners
  kSlopes,       ///< of what is smooth
  kSlantedLook,  ///< support along the slopes, of the same scores
  kSmoothAgain,  ///< of the slanted look
  kMeans,        ///< along rays
  kMeanGradients,
  kSlopesAgain,
  kLastLook,      ///< scores of all views, against the means
  kBeside,        ///< what lies beside jumps
  kLookBehind,    ///< with the best half of the views
  kLastMedian,    ///< of the winners
  kSideEvidence,  ///< of pixels beside jumps
  kChooseSides,
  kSideEvidenceAgain,  ///< beside the jumps as they are now
  kChooseSidesAgain,
  kHidden,  ///< what no view can confirm
  kSpecks,  ///< and what stands alone
  kFillHidden,
  kAccept  ///< median where it was not the last one, radiance, propagation
};

/// A step of the sweep over a view and how far it lags.
struct SweepStage {
  SweepStep step = SweepStep::kLook;
  int reach = 0;      ///< rows beyond its own that it wants of the stage before
  int multiple = 1;   ///< its first row is a multiple of this
  double cost = 0.1;  ///< of a row, as measured, in relation to the others
};

/// Where the nearer surface can hide a point from some views, px.
inline constexpr int kBesideJump = 10;

/// Does a first look take few views only? partners: how many views a view is compared with.
bool few_first(const DepthOptions& options, int partners);

/// The steps of a view. guided: slopes are known before (coarse_guide.h).
std::vector<SweepStage> sweep_stages(const DepthOptions& options, int level, int partners,
                                     bool guided);

/// Rows that each stage does so that the last one can do `own`, in a level of so many rows.
std::vector<RowRange> rows_of_stages(const std::vector<SweepStage>& stages, RowRange own,
                                     int height);

/// Most rows between the first and the last stage.
int sweep_lag(const std::vector<SweepStage>& stages);

/// Rows from what the slanted look has done to what the first look has scored, beside those of a
/// strip; where slopes are known before, those that two strips both look at; 0 where no scores are
/// looked at twice.
int score_lag(const std::vector<SweepStage>& stages, const SupportOptions& support);

}  // namespace gigaray
