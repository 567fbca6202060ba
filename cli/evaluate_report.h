// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>
#include <vector>

#include "evaluate_scores.h"

namespace gigaray::cli {

/// The scores of one estimate in one view.
struct ScoreRow {
  std::string estimate;  ///< Label, unique among the estimates.
  std::string view;      ///< Empty: the only view.
  std::vector<Score> scores;
};

// Each returns text that ends with a line break. rows: not empty; all have the same names of
// scores, ordered by view, the estimates of a view in the order of the command line.

/// One view: a line per score with a column per estimate. Several: a line per view with its main
/// scores, and their means, for one estimate after the other.
std::string scores_as_text(const std::vector<ScoreRow>& rows);

/// One map: an object of its scores. Several: {"scores": [...], "means": [...]}, each with its
/// "estimate" and "view"; means over the views, if there are several. NaN is null.
std::string scores_as_json(const std::vector<ScoreRow>& rows);

/// A line per estimate and view below a head line; NaN is an empty cell.
std::string scores_as_csv(const std::vector<ScoreRow>& rows);

}  // namespace gigaray::cli
