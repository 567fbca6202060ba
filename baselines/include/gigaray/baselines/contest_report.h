// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gigaray/baselines/contest.h"

namespace gigaray {

/// Maps agree where they differ by no more, px per view step.
inline constexpr double kAgreement = 0.07;

/// What a page says about the run beside the results.
struct ContestFacts {
  std::string input, machine, program;
  double error_range = 0;  ///< px with the full colour of an error map
};

/// A square part of the view where silhouettes are.
struct CloseUp {
  int u = 0, v = 0, size = 0;
};

/// Up to `count` squares that don't overlap, with the most jumps of the map: neighbours that differ
/// by a twentieth of the range.
std::vector<CloseUp> close_ups(const FloatMap& disparity, DisparityRange range, int count);

/// Writes into the folder, for the view's picture, the truth and every contestant: its map as
/// NAME/disparity.pfm and .png, NAME/error.png where there is truth, and the close-ups.
void write_contest_pictures(const std::filesystem::path& folder, const Contest& contest,
                            const std::vector<Contestant>& contestants,
                            const std::vector<CloseUp>& squares, const ContestFacts& facts);

nlohmann::ordered_json contest_json(const Contest& contest,
                                    const std::vector<Contestant>& contestants,
                                    const ContestFacts& facts);

/// A line per contestant below a head line.
std::string contest_csv(const std::vector<Contestant>& contestants);

/// The main scores to show: a head line, then a line per contestant.
std::vector<std::vector<std::string>> contest_table(const Contest& contest,
                                                    const std::vector<Contestant>& contestants);

/// One HTML page that needs no other file: the pictures in the folder become part of it.
std::string contest_page(const std::filesystem::path& folder, const Contest& contest,
                         const std::vector<Contestant>& contestants,
                         const std::vector<CloseUp>& squares, const ContestFacts& facts);

/// One sentence per main score: which baselines are ahead of ours, or that none is. Of a pair that
/// ours is behind in, also why. Empty without ours or without a baseline.
std::vector<std::string> verdict(const Contest& contest,
                                 const std::vector<Contestant>& contestants);

}  // namespace gigaray
