// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "noise_rows.h"

#include "gigaray/core/parallel.h"
#include "picture_bands.h"

namespace gigaray {
namespace {

using reference::Band;

/// The view first, then some of those that it is compared with.
std::vector<int> noise_views(const LightField& light_field, int view, std::size_t most,
                             const std::vector<int>& without) {
  std::vector<int> partners =
      std::visit([&](const auto& s) { return s.partners(view); }, make_sampler(light_field));
  std::erase_if(partners, [&](int other) {
    return std::find(without.begin(), without.end(), other) != without.end();
  });
  std::vector<int> chosen{view};
  const std::size_t stride = (partners.size() + most - 1) / most;
  for (std::size_t i = 0; i < partners.size(); i += stride)
    if (partners[i] != view) chosen.push_back(partners[i]);
  return chosen;
}

}  // namespace

NoiseRows load_noise_rows(const LightField& light_field, int view,
                          const HypothesisRange& hypotheses, int num_rows, int reach,
                          const RunControl& control, const std::vector<int>& without) {
  const bool unstructured = light_field.kind == LightFieldKind::kUnstructured;
  const std::vector<int> chosen = noise_views(light_field, view, unstructured ? 9 : 25, without);
  const LightField views = subset(light_field, chosen);
  NoiseRows result{make_sampler(views), views.num_views(), chosen, {}, {}};
  const int width = views.width, height = views.height;
  std::vector<RowRange> needed;
  int rows_of_all = 0;
  for (int i = 0; i < num_rows; ++i) {
    const int v = int((i + 0.5) * height / num_rows);
    result.rows.push_back(v);
    needed.push_back(std::visit(
        [&](const auto& s) {
          return s.rows_needed(0, grown({v, v + 1}, reach, height), hypotheses, height);
        },
        result.sampler));
    rows_of_all += needed.back().size();
  }
  if (rows_of_all > height) needed.assign(1, {0, height});
  for (const RowRange& range : needed) {
    Band band{{0, width, height}, range, views.num_views(), reference::kMaxChannels, {}};
    band.data.resize(std::size_t(range.size()) * band.num_views * band.channels * width);
    result.bands.push_back(std::move(band));
  }
  control.progress("noise", 0, views.num_views());
  parallel_for(
      views.num_views(),
      [&](int view) {
        const EncodedView rows_of_view(views, view);
        for (Band& band : result.bands)
          place(rows_of_view.band(band.rows, band.channels), view, band);
      },
      [&](int done) { control.progress("noise", done, views.num_views()); },
      pictures_at_once(views));
  return result;
}

double percentile(std::vector<float>& values, double share) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + long(share * double(values.size()));
  std::nth_element(values.begin(), at, values.end());
  return double(*at);
}

}  // namespace gigaray
