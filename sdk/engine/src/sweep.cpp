// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "sweep.h"

#include <algorithm>
#include <utility>

#include "workspace.h"

namespace gigaray {
namespace {

// So many views make a second scoring cheaper than a first with all of them.
constexpr int kManyViews = 160;

}  // namespace

std::vector<SweepStage> sweep_stages(const DepthOptions& options, int level, int partners,
                                     bool guided) {
  const SupportOptions& support = options.support;
  const int median = options.winner.median_radius;
  // Coarser levels have too few pixels, and test too few hypotheses, for more than one look.
  const bool finest = level == 0, again = finest && support.slanted;
  const bool scanline = finest && support.scanline;
  const int looks_at = scanline ? kScanlineReach : 0, multiple = scanline ? kScanlineBlock : 1;
  // Nearly all of it is scores: of all views, of some, or beside jumps.
  const double look_cost = again && few_first(options, partners) ? 3 : 5, last_cost = 5;
  const double slanted_cost = 2.5, behind_cost = 1;
  // Its lag keeps what smooths again away from what the slopes before still look at.
  const int slanted_reach = std::max(looks_at, kSlopeReach + 1);
  std::vector<SweepStage> stages;
  if (again && guided) {
    stages = {{SweepStep::kSlopes, 0, 1},
              {SweepStep::kLook, slanted_reach, multiple, look_cost},
              {SweepStep::kSmooth, median, 1}};
  } else {
    stages = {{SweepStep::kLook, 0, multiple, look_cost}};
    if (again) {
      stages.push_back({SweepStep::kSmooth, median, 1});
      stages.push_back({SweepStep::kSlopes, kSlopeReach, 1});
      stages.push_back({SweepStep::kSlantedLook, slanted_reach, multiple, slanted_cost});
    }
  }
  if (again) {
    // Where the last look has to score anew anyway, or takes very many views, a few do for the
    // first.
    if (few_first(options, partners)) {
      stages.push_back({SweepStep::kSmoothAgain, median, 1});
      if (options.score.ray_mean) {
        stages.push_back({SweepStep::kMeans, 0, 1});
        stages.push_back({SweepStep::kMeanGradients, 1, 1});
      }
      // A row more: the slanted look still looks at the slopes before.
      stages.push_back({SweepStep::kSlopesAgain, kSlopeReach + 1, 1});
      stages.push_back({SweepStep::kLastLook, looks_at + support.radius + 1, multiple, last_cost});
    }
    if (support.half_planes) {
      stages.push_back({SweepStep::kBeside, kBesideJump + 1, 1});
      stages.push_back({SweepStep::kLookBehind, 2 * support.radius, 1, behind_cost});
    }
  }
  if (again && support.choose_sides) {
    // It writes where those steps still look at what was smooth before.
    const int apart =
        support.half_planes ? kBesideJump - 2 * support.radius : kSlopeReach - support.radius;
    stages.push_back({SweepStep::kLastMedian, std::max(median, apart), 1});
    for (const auto& [evidence, choice] :
         {std::pair(SweepStep::kSideEvidence, SweepStep::kChooseSides),
          std::pair(SweepStep::kSideEvidenceAgain, SweepStep::kChooseSidesAgain)}) {
      stages.push_back({evidence, kSideReach, 1});
      stages.push_back({choice, kSideColours, 1});
    }
    if (support.fill_hidden) {
      stages.push_back({SweepStep::kHidden, kHiddenReach, 1});
      stages.push_back({SweepStep::kSpecks, kSpeckReach, 1});
      // It writes where those still look.
      stages.push_back({SweepStep::kFillHidden, kHiddenReach, 1});
    }
    stages.push_back({SweepStep::kAccept, 0, 1});
  } else {
    stages.push_back({SweepStep::kAccept, median, 1});
  }
  return stages;
}

bool few_first(const DepthOptions& options, int partners) {
  return options.score.gradient && (options.score.ray_mean || partners > kManyViews);
}

std::vector<RowRange> rows_of_stages(const std::vector<SweepStage>& stages, RowRange own,
                                     int height) {
  std::vector<RowRange> rows(stages.size());
  for (std::size_t i = stages.size(); i-- > 0;) {
    const int multiple = stages[i].multiple;
    RowRange wanted = own;
    if (i + 1 < stages.size()) wanted = grown(rows[i + 1], stages[i + 1].reach, height);
    rows[i] = {wanted.begin / multiple * multiple,
               std::min((wanted.end + multiple - 1) / multiple * multiple, height)};
  }
  return rows;
}

int sweep_lag(const std::vector<SweepStage>& stages) {
  int lag = 0;
  for (const SweepStage& stage : stages) lag += stage.reach + stage.multiple - 1;
  return lag;
}

int score_lag(const std::vector<SweepStage>& stages, const SupportOptions& support) {
  const int reach = 2 * ((support.scanline ? kScanlineReach : 0) + support.radius);
  if (stages.front().step == SweepStep::kSlopes) return reach;
  int lag = 0;
  for (const SweepStage& stage : stages) {
    if (stage.step != SweepStep::kLook) lag += stage.reach + stage.multiple - 1;
    if (stage.step == SweepStep::kSlantedLook) return lag + reach;
  }
  return 0;
}

}  // namespace gigaray
