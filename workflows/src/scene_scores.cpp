// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "scene_scores.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gigaray/core/error.h"
#include "gigaray/engine/estimator.h"
#include "gigaray/workflows/view_list.h"
#include "scene_maps.h"

namespace gigaray {
namespace {

using nlohmann::ordered_json;

constexpr int kMostAcross = 32, kMostDown = 24;

/// A pixel of every square of the grid, px shown.
struct Grid {
  int step = 1, columns = 1, rows = 1;

  Grid(int width, int height)
      : step(std::max((width + kMostAcross - 1) / kMostAcross,
                      (height + kMostDown - 1) / kMostDown)),
        columns(std::max(1, width / step)),
        rows(std::max(1, height / step)) {}
  int place(int cell) const { return cell * step + step / 2; }
};

/// 0 … 254: the score; 255: not tested.
std::string bytes_of(const std::vector<ScoreCurve>& curves) {
  constexpr float kScale = 254;
  std::string bytes;
  for (const ScoreCurve& curve : curves)
    for (const float score : curve.scores)
      bytes += score < 0 ? '\xff' : char(std::lround(kScale * std::min(score, 1.f)));
  return bytes;
}

}  // namespace

ordered_json scene_scores(const CurveSource& source, int view, const std::string& name, int width,
                          int height, double scale, const TakeSceneFile& take,
                          const RunControl& control) {
  const LightField& light_field = source.light_field;
  const Grid grid(width, height);
  std::vector<PixelIndex> pixels;
  const auto full = [&](int shown, int size) {
    return std::clamp(int((shown + 0.5) / scale), 0, size - 1);
  };
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      pixels.push_back({full(std::min(grid.place(column), width - 1), light_field.width),
                        full(std::min(grid.place(row), height - 1), light_field.height)});
  std::vector<ScoreCurve> curves;
  try {
    curves =
        Estimator::of(source.backend)
            .probe(light_field, source.options, parse_view(name, light_field), pixels, control);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::kDevice) throw;
    control.message(std::string("no score curves: ") + error.what());
    return nullptr;
  }
  take("scores", gzipped(bytes_of(curves)));
  const HypothesisRange& range = curves.front().hypotheses;
  return {{"view", view},
          {"step", grid.step},
          {"columns", grid.columns},
          {"rows", grid.rows},
          {"hypotheses", {{"min", range.min}, {"max", range.max}, {"count", range.count}}},
          {"blob", "scores"}};
}

}  // namespace gigaray
