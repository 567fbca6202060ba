// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/photographs.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "features/view_features.h"

namespace gigaray {
namespace {

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
  return values[values.size() / 2];
}

}  // namespace

std::optional<double> displacement_across_rows(const LightField& light_field,
                                               const RunControl& control) {
  check(light_field);
  std::vector<int> order(light_field.views.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return light_field.views[a].s < light_field.views[b].s; });
  const int count = int(order.size());
  std::set<int> firsts;
  for (const double at : {0.2, 0.5, 0.8}) firsts.insert(int(at * (count - 1)));
  std::vector<double> across;
  for (const int first : firsts) {
    if (first + 1 >= count) continue;
    control.progress("rows", double(across.size()), double(firsts.size()));
    control.throw_if_cancelled();
    const ViewFeatures here = features_of(light_field, order[first]);
    const auto matches = matches_of(here, features_of(light_field, order[first + 1]));
    if (matches.empty()) continue;
    std::vector<double> du, dv;
    for (const FeatureMatch& match : matches) {
      du.push_back(std::abs(match.b.x - match.a.x) * here.scale);
      dv.push_back(std::abs(match.b.y - match.a.y) * here.scale);
    }
    across.push_back(std::min(median(du), median(dv)));
  }
  if (across.empty()) return std::nullopt;
  return *std::max_element(across.begin(), across.end());
}

}  // namespace gigaray
