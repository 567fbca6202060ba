// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "gigaray/workflows/surface.h"
#include "output_option.h"

namespace gigaray::cli {

/// RESULT and what its points are to be, of `cloud` and `mesh`.
struct PointsOptions {
  ResultRequest result;
  PointsRequest points;

  void declare(CLI::App& app);
  /// Of an output of the command.
  OutputRules rules(const OutputOption& output) const {
    return output.rules({result.path, result.input});
  }
  ScenePoints open(const RunControl& control) const {
    return points_of_scene(std::make_shared<DepthScene>(result), points, control);
  }
};

/// What became of the pixels, for people and for programs.
void print(const PointCounts& counts, int num_views, const PointOptions& options);
nlohmann::ordered_json as_json(const PointCounts& counts);

/// The origin of a cloud or surface; nothing is printed for 0.
void print_origin(const Eigen::Vector3d& origin);
nlohmann::ordered_json origin_json(const Eigen::Vector3d& origin);

}  // namespace gigaray::cli
