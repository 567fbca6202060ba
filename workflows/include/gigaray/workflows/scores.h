// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/workflows/scene_truth.h"

namespace GIGARAY_API gigaray {

struct Score {
  std::string name;     ///< As in JSON and in the head of a CSV file.
  double value = 0;     ///< NaN: nothing to score.
  std::string meaning;  ///< A few words beside the number.
};

struct ScoreChoice {
  bool hci = true;
  bool middlebury = false;
  std::optional<int> border;  ///< px; empty: 15 for HCI metrics, 0 for those of Middlebury.
  int hci_border() const { return border.value_or(15); }
  int middlebury_border() const { return border.value_or(0); }
};

/// The scores of one estimate in one view.
struct ScoreRow {
  std::string estimate;  ///< Label, unique among the estimates.
  std::string view;      ///< Empty: the only view.
  std::vector<Score> scores;
};

/// Scores of several maps. rows: not empty; all have the same names of scores, ordered by view, the
/// estimates of a view in the order in which they were given.
struct ScoreTable {
  std::vector<ScoreRow> rows;
  /// Of all pixels of all views, one row per estimate; empty: the means over the views are meant.
  std::vector<ScoreRow> pooled;
};

/// All chosen scores of a map. Which there are depends on the choice and the scene alone, so that
/// the scores of several maps make a table. Throws what the metrics throw.
std::vector<Score> scores_of(const FloatMap& estimate, const FloatMap& truth,
                             const SceneParts& scene, const ScoreChoice& choice);

}  // namespace gigaray
