// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "gigaray/error.h"
#include "gigaray/meshing/cloud.h"
#include "gigaray/run_control.h"
#include "output_option.h"

namespace gigaray::cli {

/// What `cloud` and `mesh` start from.
struct SurfaceInput {
  std::filesystem::path result, input;
  std::string views = "all";
  std::optional<double> least_confidence;  ///< empty: kPosedConfidence, or that of PointOptions
  PointOptions points;                     ///< as stated; see Opened

  /// Of posed photographs, whose confidence is the share of pixels within 1 % of the depth: what is
  /// less sure makes half of a room's wrong points and a seventh of all (docs/accuracy.md).
  static constexpr double kPosedConfidence = 0.6;

  void declare(CLI::App& app);
  /// Of an output of the command.
  OutputRules rules(const OutputOption& output) const { return output.rules({result, input}); }

  /// Bytes of the views that are kept in memory at once: `pixels` of a picture, so many views.
  static double view_bytes(double pixels, int num_views);

  struct Opened {
    DepthViews views;     ///< the chosen ones, with cameras in scene units
    PointOptions points;  ///< with the defaults for these views
  };
  /// Tells when scene units are not known.
  Opened open(const RunControl& control) const;

  /// work(); what it finds wrong with the depth is said of `result`.
  template <class Work>
  auto blamed(Work work) const {
    try {
      return work();
    } catch (const Error& error) {
      const std::string text = error.what();
      if (error.code() != ErrorCode::kBadInput || text.find(result.string()) != std::string::npos)
        throw;
      throw Error(error.code(), result.string() + ": " + text);
    }
  }
};

/// What became of the pixels, for people and for programs.
void print(const PointCounts& counts, int num_views, const PointOptions& options);
nlohmann::ordered_json as_json(const PointCounts& counts);

/// The origin of a cloud or surface; nothing is printed for 0.
void print_origin(const Eigen::Vector3d& origin);
nlohmann::ordered_json origin_json(const Eigen::Vector3d& origin);

}  // namespace gigaray::cli
