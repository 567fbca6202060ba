// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "points_options.h"

#include <fmt/format.h>

#include <string>

namespace gigaray::cli {

void PointsOptions::declare(CLI::App& app) {
  app.add_option("RESULT", result.path, "What `gigaray depth` wrote, or a .grl file")
      ->type_name("OUT")
      ->required();
  app.add_option("--views", points.views, "all, centre, or a list of names, indices and ranges")
      ->capture_default_str();
  app.add_option("--input", result.input,
                 "Where the pictures are, when they are no more where they were")
      ->type_name("INPUT");
  app.add_option("--min-confidence", points.min_confidence,
                 "Leave out what is less sure (default: 0.6 of posed photographs, whose confidence "
                 "is the share within 1 % of the depth, else 0.1)")
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("C");
  app.add_option_function<int>(
         "--min-support", [this](int support) { points.options.least_support = support; },
         "Leave out points that fewer other views see where they are (default: two, and four "
         "fifths of those that should)")
      ->check(CLI::Range(0, 1000))
      ->type_name("N");
  app.add_flag("--keep-ground", points.options.keeps_plain_ground,
               "Keep points of the white or black that is half of the border of every picture");
}

void print(const PointCounts& counts, int num_views, const PointOptions& options) {
  fmt::print("pixels        {} of {} views\n", counts.pixels, num_views);
  fmt::print("no estimate   {}\n", counts.without_estimate);
  if (counts.ground > 0)
    fmt::print("plain ground  {} of the white or black around what all views show\n",
               counts.ground);
  fmt::print("unsure        {} with a confidence below {:g}\n", counts.unsure,
             options.least_confidence);
  fmt::print("too far       {} whose depth could be twice as large\n", counts.too_far);
  fmt::print("contradicted  {} that more views see through than see\n", counts.contradicted);
  fmt::print("unconfirmed   {} that fewer than {} other views see\n", counts.unconfirmed,
             options.least_support ? std::to_string(*options.least_support)
                                   : "two, or than four fifths of those that should,");
}

nlohmann::ordered_json as_json(const PointCounts& counts) {
  return {{"pixels", counts.pixels},           {"without_estimate", counts.without_estimate},
          {"plain_ground", counts.ground},     {"unsure", counts.unsure},
          {"too_far", counts.too_far},         {"contradicted", counts.contradicted},
          {"unconfirmed", counts.unconfirmed}, {"points", counts.points}};
}

void print_origin(const Eigen::Vector3d& origin) {
  if (origin.isZero(0)) return;
  fmt::print("origin        {} {} {}: coordinates in the file are relative to it\n", origin.x(),
             origin.y(), origin.z());
}

nlohmann::ordered_json origin_json(const Eigen::Vector3d& origin) {
  return nlohmann::ordered_json::array({origin.x(), origin.y(), origin.z()});
}

}  // namespace gigaray::cli
