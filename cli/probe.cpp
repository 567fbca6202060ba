// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "depth_options_cli.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/workflows/probe.h"
#include "output_option.h"

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

void print_text(const ProbeFinding& finding, const LightField& light_field) {
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

void print_decision(const ProbeFinding& finding, const LightField& light_field) {
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

ordered_json decision_json(const ProbeFinding& finding, const LightField& light_field) {
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

ordered_json to_json(const ProbeFinding& finding, const LightField& light_field) {
  const auto peak = [](const std::optional<ScorePeak>& p) {
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

void run(const Settings& settings, const RunControl& control) {
  // An output place that can't be used shows before the work, not after.
  std::optional<AtomicFolder> folder;
  if (settings.output.is_given())
    folder.emplace(settings.output.path, kProbeFormat,
                   settings.output.rules(settings.run.input.places()));
  OpenedInput input = open_input(settings.run.input, control);
  const LightField& light_field = input.light_field;
  for (const std::string& note : light_field.notes) control.message(note);
  const ProbeRequest request{settings.run.request(), settings.view, settings.at[0], settings.at[1],
                             settings.decided};
  const ProbeFinding finding = probe_pixel(input, request, control);

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
