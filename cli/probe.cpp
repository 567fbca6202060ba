// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "command.h"
#include "depth_options_cli.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/drawing.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/reconstruct.h"
#include "gigaray/samplers/any_sampler.h"
#include "output_option.h"
#include "photographs.h"
#include "view_list.h"

namespace gigaray::cli {
namespace {

using nlohmann::ordered_json;

constexpr const char* kProbeFormat = "gigaray probe";

struct Settings {
  DepthRunOptions run;
  std::vector<int> at;  ///< U V
  std::string view = "centre";
  OutputOption output;
  bool decided = false;
  bool json = false;
};

struct Peak {
  double disparity = 0, score = 0;
};

/// A pixel, its score curve, and what is read off the curve.
struct Finding {
  int view = 0, u = 0, v = 0;
  ScoreCurve curve;
  std::optional<Peak> best;          ///< Empty: no hypothesis could be tested.
  std::optional<Peak> runner_up;     ///< The highest peak outside the winner's own hill.
  double mean = kNoEstimate;         ///< Of the tested hypotheses.
  int seen_by = 0;                   ///< Views that see the point of the winner.
  float min_confidence = 0;          ///< `depth` leaves what has no more to coarser levels.
  std::optional<Decision> decision;  ///< of a whole run, if asked for
};

void read_curve(Finding& finding) {
  const std::vector<float>& scores = finding.curve.scores;
  const int count = int(scores.size());
  const int best = int(std::max_element(scores.begin(), scores.end()) - scores.begin());
  if (!(scores[best] >= 0)) return;
  const auto peak_at = [&](int i) { return Peak{finding.curve.hypotheses.value(i), scores[i]}; };
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

void print_text(const Finding& finding, const LightField& light_field) {
  const auto line = [](const char* label, const std::string& text) {
    fmt::print("{:<12}{}\n", label, text);
  };
  const View& view = light_field.views[finding.view];
  const HypothesisRange& range = finding.curve.hypotheses;
  line("pixel", fmt::format("u {}, v {} of {} (s {:.4g}, t {:.4g})", finding.u, finding.v,
                            view.name, view.s, view.t));
  const bool unstructured = light_field.kind == LightFieldKind::kUnstructured;
  const char* unit = unstructured ? "(inverse depth)" : "px per view step";
  line("hypotheses", fmt::format("{}, {:.4g} … {:.4g} {}, one every {:.4g}", range.count, range.min,
                                 range.max, unit, range.step()));
  if (!finding.best) {
    line("disparity", "none: too few views see this pixel at any hypothesis");
    return;
  }
  const float confidence = finding.curve.confidence;
  line("disparity", fmt::format("{:.4f} {}", finding.curve.disparity, unit));
  if (unstructured) line("depth", fmt::format("{:.4g}", 1 / finding.curve.disparity));
  line("confidence", fmt::format("{:.4f}, best score minus mean score{}", confidence,
                                 confidence <= finding.min_confidence
                                     ? fmt::format("; at most {:g}: left to coarser levels",
                                                   finding.min_confidence)
                                     : ""));
  line("best score", fmt::format("{:.4f} at {:.4f}", finding.best->score, finding.best->disparity));
  line("runner-up", finding.runner_up ? fmt::format("{:.4f} at {:.4f}", finding.runner_up->score,
                                                    finding.runner_up->disparity)
                                      : "none, the curve has one peak");
  line("mean score", fmt::format("{:.4f}", finding.mean));
  line("seen by", fmt::format("{} of {} views", finding.seen_by, light_field.num_views()));
}

void print_decision(const Finding& finding, const LightField& light_field) {
  if (!finding.decision) return;
  const Decision& decision = *finding.decision;
  if (decision.level < 0) {
    fmt::print("{:<12}by no level\n", "decided");
    return;
  }
  const std::string where =
      decision.view < 0 ? "filled between the estimates around"
                        : fmt::format("view {}, u {}, v {}", light_field.views[decision.view].name,
                                      decision.u, decision.v);
  fmt::print("{:<12}{:.4f} on level {}: {}\n", "decided", decision.disparity, decision.level,
             where);
  fmt::print("{:<12}{:.4g} … {:.4g}\n", "bounds", decision.bounds.min, decision.bounds.max);
}

ordered_json decision_json(const Finding& finding, const LightField& light_field) {
  if (!finding.decision) return nullptr;
  const Decision& decision = *finding.decision;
  return {{"level", decision.level},
          {"view", decision.view < 0 ? ordered_json(nullptr)
                                     : ordered_json(light_field.views[decision.view].name)},
          {"u", decision.u},
          {"v", decision.v},
          {"disparity", decision.disparity},
          {"bounds", {decision.bounds.min, decision.bounds.max}}};
}

ordered_json to_json(const Finding& finding, const LightField& light_field) {
  const auto peak = [](const std::optional<Peak>& p) {
    return p ? ordered_json{{"disparity", p->disparity}, {"score", p->score}}
             : ordered_json(nullptr);
  };
  const View& view = light_field.views[finding.view];
  const HypothesisRange& range = finding.curve.hypotheses;
  ordered_json samples = ordered_json::array(), scores = ordered_json::array();
  for (const float score : finding.curve.scores)
    scores.push_back(score < 0 ? ordered_json(nullptr) : ordered_json(score));
  for (int i = 0; i < light_field.num_views(); ++i) {
    const View& other = light_field.views[i];
    const Radiance& seen = finding.curve.samples[i];
    samples.push_back({{"view", other.name},
                       {"s", other.s},
                       {"t", other.t},
                       {"rgb", std::isnan(seen.r) ? ordered_json(nullptr)
                                                  : ordered_json{seen.r, seen.g, seen.b}}});
  }
  // NaN becomes null.
  return {
      {"format", kProbeFormat},
      {"version", 1},
      {"view", view.name},
      {"u", finding.u},
      {"v", finding.v},
      {"disparity", finding.curve.disparity},
      {"confidence", finding.curve.confidence},
      {"min_confidence", finding.min_confidence},
      {"hypotheses",
       {{"min", range.min}, {"max", range.max}, {"count", range.count}, {"step", range.step()}}},
      {"best", peak(finding.best)},
      {"runner_up", peak(finding.runner_up)},
      {"mean_score", finding.mean},
      {"seen_by", finding.seen_by},
      {"num_views", light_field.num_views()},
      {"decision", decision_json(finding, light_field)},
      {"scores", scores},
      {"samples", samples}};
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

Image<std::uint16_t> epi_picture(const Finding& finding, const LightField& light_field,
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

Image<std::uint16_t> samples_picture(const Finding& finding, const LightField& light_field) {
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

Image<std::uint16_t> scores_picture(const Finding& finding) {
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

void run(const Settings& settings, const RunControl& control) {
  // An output place that can't be used shows before the work, not after.
  std::optional<AtomicFolder> folder;
  if (settings.output.is_given())
    folder.emplace(settings.output.path, kProbeFormat,
                   settings.output.rules(settings.run.input.places()));
  LightField light_field = open_views(settings.run.input, control);
  for (const std::string& note : light_field.notes) control.message(note);
  Finding finding;
  const DepthOptions options = settings.run.resolve(light_field, control);
  finding.view = parse_view(settings.view, light_field);
  finding.u = settings.at[0];
  finding.v = settings.at[1];
  // With a weight by edges the confidence of a pixel is known in a whole run only.
  if (!options.winner.weigh_by_edge) finding.min_confidence = options.winner.min_confidence;
  finding.curve = probe(light_field, options, settings.run.backend(), finding.view, finding.u,
                        finding.v, control);
  read_curve(finding);
  if (settings.decided) {
    DepthOptions explained = options;
    explained.keep_searches = true;
    finding.decision = reconstruct(light_field, explained, settings.run.backend(), control)
                           .decision(finding.view, finding.u, finding.v);
  }

  const std::string json =
      to_json(finding, light_field).dump(2, ' ', false, ordered_json::error_handler_t::replace);
  if (folder) {
    // Rays of unstructured views lie in no common rows.
    if (light_field.kind != LightFieldKind::kUnstructured)
      write_png(folder->path() / "epi.png", epi_picture(finding, light_field, control), 8);
    write_png(folder->path() / "samples.png", samples_picture(finding, light_field), 8);
    write_png(folder->path() / "scores.png", scores_picture(finding), 8);
    write_file_atomically(folder->path() / "gigaray.json", json + "\n");
    folder->commit(control);
  }
  if (settings.json) {
    fmt::print("{}\n", json);
    return;
  }
  print_text(finding, light_field);
  print_decision(finding, light_field);
}

}  // namespace

Run probe_command(CLI::App& app) {
  app.description("Why a pixel has its depth: scores, samples, epipolar-plane image");
  app.footer(
      "The scores are those of the pixel at full resolution, before slanted support, the median, "
      "coarser levels and\nother views have their say.");
  auto settings = std::make_shared<Settings>();
  settings->run.add_to(app);
  settings->run.add_depth_to(app);
  app.add_option("--at", settings->at, "The pixel, from the top left corner, which is 0 0")
      ->expected(2)
      ->type_name("U V")
      ->required();
  app.add_option("--view", settings->view, "Name or index of a view, or centre")
      ->capture_default_str();
  settings->output.add_to(app,
                          "Folder for pictures: the epipolar-plane image, the colours that the "
                          "views see, the score curve");
  app.add_flag(
      "--decided", settings->decided,
      "Compute the depth of all views too, as `depth` does, and tell which level and which "
      "view decided this pixel, and what was searched there");
  app.add_flag("--json", settings->json, "Print JSON");
  return [settings](const RunControl& control) { run(*settings, control); };
}

}  // namespace gigaray::cli
