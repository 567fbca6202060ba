// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "cameras.h"

#include <fmt/format.h>

#include <algorithm>

#include "gigaray/workflows/cameras.h"

namespace gigaray::cli {

namespace {

std::string depths_text(const LightField& light_field) {
  const InverseDepthRange range = all_inverse_depths(light_field.cameras);
  const std::string unit = light_field.rig.unit.empty() ? "" : " " + light_field.rig.unit;
  return fmt::format("{:.4g} … {}{}, each view a part of it", 1 / range.max,
                     range.min > 0 ? fmt::format("{:.4g}", 1 / range.min) : "infinity", unit);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> describe_cameras(const LightField& light_field) {
  std::vector<double> focals;
  for (const Camera& camera : light_field.cameras) focals.push_back(camera.focal_u);
  const auto [least, most] = std::minmax_element(focals.begin(), focals.end());
  std::vector<std::pair<std::string, std::string>> lines{
      {"cameras", *least == *most
                      ? fmt::format("focal length {:.6g} px", *least)
                      : fmt::format("focal lengths {:.6g} … {:.6g} px", *least, *most)}};
  const std::vector<int> partners = count_partners(light_field);
  if (partners.empty()) {
    lines.emplace_back("depths", "not known of every view: estimated, or stated by --disparity");
    return lines;
  }
  lines.emplace_back("depths", depths_text(light_field));
  const auto [fewest, all] = std::minmax_element(partners.begin(), partners.end());
  lines.emplace_back("compared", *fewest == *all
                                     ? fmt::format("each view with {} others", *all)
                                     : fmt::format("each view with {} … {} others", *fewest, *all));
  return lines;
}

}  // namespace gigaray::cli
