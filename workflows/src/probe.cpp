// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/probe.h"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "gigaray/adapters/drawing.h"
#include "gigaray/samplers/any_sampler.h"
#include "gigaray/workflows/view_list.h"

namespace gigaray {
namespace {

void read_curve(ProbeFinding& finding) {
  const std::vector<float>& scores = finding.curve.scores;
  const int count = int(scores.size());
  const int best = int(std::max_element(scores.begin(), scores.end()) - scores.begin());
  if (!(scores[best] >= 0)) return;
  const auto peak_at = [&](int i) {
    return ScorePeak{finding.curve.hypotheses.value(i), scores[i]};
  };
  finding.best = peak_at(best);
  double sum = 0;
  int tested = 0;
  for (const float score : scores)
    if (score >= 0) sum += score, ++tested;
  finding.mean = sum / tested;

  // The winner's own hill ends half way down to the mean.
  const double foot = 0.5 * (scores[best] + finding.mean);
  int first = best, last = best;
  while (first > 0 && scores[first] > foot) --first;
  while (last < count - 1 && scores[last] > foot) ++last;
  for (int i = 0; i < count; ++i) {
    const bool apart = i < first || i > last;
    const bool is_peak = scores[i] >= 0 && (i == 0 || scores[i] > scores[i - 1]) &&
                         (i == count - 1 || scores[i] >= scores[i + 1]);
    if (apart && is_peak && (!finding.runner_up || scores[i] > finding.runner_up->score))
      finding.runner_up = peak_at(i);
  }
  finding.seen_by = int(std::count_if(finding.curve.samples.begin(), finding.curve.samples.end(),
                                      [](const Radiance& seen) { return !std::isnan(seen.r); }));
}

/// The views in a row with the chosen one, ordered by s: all of a 3D light field.
std::vector<int> row_of_views(const LightField& light_field, int reference) {
  std::vector<int> row;
  for (int i = 0; i < light_field.num_views(); ++i)
    if (std::abs(light_field.views[i].t - light_field.views[reference].t) < 0.5) row.push_back(i);
  std::sort(row.begin(), row.end(),
            [&](int a, int b) { return light_field.views[a].s < light_field.views[b].s; });
  return row;
}

}  // namespace

ProbeFinding probe_pixel(OpenedInput& input, const ProbeRequest& request,
                         const RunControl& control) {
  const DepthOptions options = prepare_depth(input, request.depth, control);
  const LightField& light_field = input.light_field;
  const BackendChoice& backend = request.depth.backend;
  ProbeFinding finding;
  finding.view = parse_view(request.view, light_field);
  finding.u = request.u;
  finding.v = request.v;
  // With a weight by edges the confidence of a pixel is known in a whole run only.
  if (!options.winner.weigh_by_edge) finding.min_confidence = options.winner.min_confidence;
  finding.curve = probe(light_field, options, backend, finding.view, finding.u, finding.v, control);
  read_curve(finding);
  if (request.decided) {
    DepthOptions explained = options;
    explained.keep_searches = true;
    finding.decision = reconstruct(light_field, explained, backend, control)
                           .decision(finding.view, finding.u, finding.v);
  }
  return finding;
}

Image<std::uint16_t> epi_picture(const ProbeFinding& finding, const LightField& light_field,
                                 const RunControl& control) {
  constexpr int kAround = 24;  // px beside everything that a hypothesis reaches
  const std::vector<int> row = row_of_views(light_field, finding.view);
  const HypothesisRange& range = finding.curve.hypotheses;
  const double here = light_field.views[finding.view].s;
  const double travel = std::max(std::abs(light_field.views[row.front()].s - here),
                                 std::abs(light_field.views[row.back()].s - here));
  const double reach = kAround + travel * std::max(std::abs(range.min), std::abs(range.max));
  const int begin = int(std::max(finding.u - reach, 0.0));
  const int end = int(std::min(finding.u + reach + 1, double(light_field.width)));

  EpiDrawing epi;
  epi.pixels = Image<std::uint16_t>(end - begin, int(row.size()), 3);
  epi.first_u = begin;
  epi.reference_u = finding.u;
  const AnySampler sampler = make_sampler(light_field);
  const int shift = light_field.pixels->bit_depth() - 8;
  for (std::size_t i = 0; i < row.size(); ++i) {
    control.progress("draw", double(i), double(row.size()));
    if (row[i] == finding.view) epi.reference_row = int(i);
    epi.s.push_back(light_field.views[row[i]].s);
    const Ray ray{double(finding.u), double(finding.v), finding.curve.disparity};
    const auto there = std::visit(
        [&](const auto& geometry) { return geometry.locate(finding.view, row[i], ray); }, sampler);
    const bool found = there && !std::isnan(there->u);
    epi.line.push_back(found ? there->u : kNoEstimate);
    // Where t wobbles from view to view, the row that the ray meets.
    const int v =
        found ? std::clamp(int(std::lround(there->v)), 0, light_field.height - 1) : finding.v;
    Image<std::uint16_t> picture = light_field.pixels->read(row[i]);
    take_mask(picture);
    std::transform(picture.row(v) + 3 * begin, picture.row(v) + 3 * end, epi.pixels.row(int(i)),
                   [&](std::uint16_t value) { return std::uint16_t(value >> shift); });
  }
  return draw_epi(epi);
}

Image<std::uint16_t> samples_picture(const ProbeFinding& finding, const LightField& light_field) {
  std::vector<SampleCell> cells;
  for (int i = 0; i < light_field.num_views(); ++i) {
    const Radiance& seen = finding.curve.samples[i];
    cells.push_back({light_field.views[i].s,
                     light_field.views[i].t,
                     {seen.r, seen.g, seen.b},
                     i == finding.view});
  }
  return draw_samples(cells);
}

Image<std::uint16_t> scores_picture(const ProbeFinding& finding) {
  std::vector<ScoreMark> marks;
  if (finding.best) marks.push_back({"winner", finding.curve.disparity});
  if (finding.runner_up) marks.push_back({"runner-up", finding.runner_up->disparity});
  if (finding.decision && finding.decision->level >= 0) {
    marks.push_back({"decided", finding.decision->disparity});
    marks.push_back({"least", finding.decision->bounds.min});
    marks.push_back({"most", finding.decision->bounds.max});
  }
  const HypothesisRange& range = finding.curve.hypotheses;
  return draw_scores(finding.curve.scores, {range.min, range.max}, finding.mean, marks);
}

}  // namespace gigaray
