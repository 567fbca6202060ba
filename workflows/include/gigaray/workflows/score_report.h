// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>

#include "gigaray/core/api.h"
#include "gigaray/workflows/scores.h"

namespace GIGARAY_API gigaray {

// Each returns text that ends with a line break.

/// One view: a line per score with a column per estimate. Several: a line per view with its main
/// scores, and their means, for one estimate after the other; or all pooled scores below them.
std::string scores_as_text(const ScoreTable& table);

/// One map: an object of its scores. Several: {"scores": [...], "means": [...]}, each with its
/// "estimate" and "view"; means over the views, if there are several, or "all", the pooled scores.
/// NaN is null.
std::string scores_as_json(const ScoreTable& table);

/// A line per estimate and view below a head line, then those of all pixels; NaN is an empty cell.
std::string scores_as_csv(const ScoreTable& table);

}  // namespace gigaray
