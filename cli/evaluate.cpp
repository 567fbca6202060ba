// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "command.h"
#include "did_you_mean.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/pictures.h"
#include "gigaray/workflows/error_map.h"
#include "gigaray/workflows/evaluate.h"
#include "gigaray/workflows/score_report.h"
#include "memory_option.h"

namespace gigaray::cli {
namespace {

namespace fs = std::filesystem;

constexpr auto kPicture = {".png"};
constexpr auto kTable = {".csv", ".txt"};

struct EvaluateOptions {
  std::vector<fs::path> maps;  ///< The last one is the truth.
  std::string views;           ///< Empty: not stated.
  std::vector<std::string> metrics{"hci"};
  std::vector<std::string> masks;
  ScoreChoice choice;
  DepthChoice depth;
  bool kept_is_stated = false;
  MemoryBudget memory;
  bool json = false;
  std::string csv;
  fs::path error_map;
  double error_range = 0.2;
  bool replace = false;

  bool wants(const char* name) const {
    return std::find(metrics.begin(), metrics.end(), name) != metrics.end();
  }
  bool scores_depth() const { return wants("depth"); }
  bool writes_csv() const { return !csv.empty() && csv != "-"; }
  /// What the files that are written may do; they appear together, at the end.
  OutputRules rules() const {
    std::vector<fs::path> inputs = maps;
    for (const std::string& mask : masks) inputs.emplace_back(mask.substr(mask.find('=') + 1));
    return {std::move(inputs), replace};
  }
};

/// FILE.png, or FILE-ESTIMATE-VIEW.png where there are several.
fs::path error_map_path(const fs::path& path, const std::string& estimate,
                        const std::string& view) {
  std::string name = path.stem().string();
  for (const std::string& part : {estimate, view})
    if (!part.empty()) name += "-" + part;
  std::replace(name.begin(), name.end(), '/', '_');
  return path.parent_path() / (name + ".png");
}

void check_depth(const EvaluateOptions& options) {
  const auto refuse = [](const std::string& text) {
    throw Error(ErrorCode::kInvalidArgument, text);
  };
  if (!options.scores_depth()) {
    if (options.depth.truth_scale) refuse("--truth-scale is for --metrics depth");
    if (options.kept_is_stated) refuse("--kept is for --metrics depth");
    return;
  }
  if (options.metrics.size() > 1)
    refuse("--metrics depth compares depth, the others disparities; ask for them one by one");
  if (!options.masks.empty()) refuse("--mask is for disparities, not for --metrics depth");
  if (!options.error_map.empty()) refuse("--error-map is for disparities, not for --metrics depth");
}

void check(const EvaluateOptions& options) {
  const auto refuse = [](const std::string& text) {
    throw Error(ErrorCode::kInvalidArgument, text);
  };
  if (options.maps.size() < 2) refuse("TRUTH is missing; write ESTIMATE [ESTIMATE ...] TRUTH");
  check_depth(options);
  if (!options.masks.empty() && options.views != "centre")
    refuse("--mask is for one view; leave --views out");
  if (!(options.error_range > 0 && std::isfinite(options.error_range)))
    refuse(fmt::format("--error-range is {}; it must be above 0", options.error_range));
  if (options.json && options.csv == "-") refuse("--json and --csv - both print; leave one out");
}

EvaluateRequest request_of(const EvaluateOptions& options) {
  EvaluateRequest request;
  request.estimates.assign(options.maps.begin(), options.maps.end() - 1);
  request.truth = options.maps.back();
  request.views = options.views;
  request.choice = options.choice;
  request.of_depth = options.scores_depth();
  request.depth = options.depth;
  request.masks = options.masks;
  request.memory = options.memory;
  return request;
}

/// files: error maps are added.
ScoreTable score(const EvaluateOptions& options, std::vector<AtomicFile>& files,
                 const RunControl& control) {
  return gigaray::evaluate(request_of(options), control, [&](const ScoredMap& map) {
    if (options.error_map.empty()) return;
    const fs::path path = map.is_only_one ? options.error_map
                                          : error_map_path(options.error_map, map.label, map.view);
    files.emplace_back(path, options.rules(), kPicture);
    files.back().write(png_bytes(
        draw_error_map(map.estimate, map.truth, options.choice.hci_border(), options.error_range),
        8));
  });
}

void evaluate(EvaluateOptions options, const RunControl& control) {
  options.choice.hci = options.wants("hci");
  options.choice.middlebury = options.wants("middlebury");
  if (options.views.empty()) options.views = options.scores_depth() ? "all" : "centre";
  check(options);
  std::vector<AtomicFile> files;
  if (options.writes_csv()) files.emplace_back(options.csv, options.rules(), kTable);
  // The names of several are known once the views are.
  if (!options.error_map.empty()) AtomicFile(options.error_map, options.rules(), kPicture);
  const ScoreTable table = score(options, files, control);
  if (options.writes_csv()) files.front().write(scores_as_csv(table));
  for (AtomicFile& file : files) file.commit(control);
  if (options.csv == "-")
    fmt::print("{}", scores_as_csv(table));
  else if (options.json)
    fmt::print("{}", scores_as_json(table));
  else
    fmt::print("{}", scores_as_text(table));
}

}  // namespace

Run evaluate_command(CLI::App& app) {
  app.description(
      "Score disparity maps against the truth: HCI and Middlebury metrics; or depth maps: relative "
      "errors");
  auto options = std::make_shared<EvaluateOptions>();
  app.add_option("ESTIMATE", options->maps,
                 "Disparity maps or folders of gigaray depth, several for a table; the last "
                 "argument is TRUTH: a map, or a folder with truth.pfm, gt_disp_lowres.pfm or the "
                 "disparities of a Middlebury stereo pair; for --metrics depth a map or a folder "
                 "with VIEW.pfm, .exr, .npy or 16-bit .png")
      ->type_name("... TRUTH")
      ->required();
  app.add_option("--views", options->views,
                 "centre, all, or a list of names: each against truth/VIEW.pfm of the TRUTH folder "
                 "[centre; all for depth]");
  app.add_option("--metrics", options->metrics,
                 "hci, middlebury or both; or depth: shares within 0.5, 1, 2 and 5 % of it")
      ->check(one_of({"hci", "middlebury", "depth"}))
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--mask", options->masks,
                 "Scores of a part too: where FILE, a picture or float map, isn't zero; masks of "
                 "an HCI scene are found in its folder")
      ->type_name("NAME=FILE")
      ->allow_extra_args(false);
  app.add_option("--truth-scale", options->depth.truth_scale,
                 "For depth: scene units of a value of the truth [1]");
  app.add_option_function<std::vector<double>>(
         "--kept",
         [options](const std::vector<double>& percents) {
           options->depth.kept = percents;
           options->kept_is_stated = true;
         },
         "For depth: scores of the most confident so many percent of the pixels too [75]")
      ->delimiter(',')
      ->type_name("PERCENT,...");
  app.add_option("--border", options->choice.border,
                 "Pixels left out on each side [15 for hci, 0 for others]");
  add_memory_option(app, options->memory, "some 32 bytes per pixel of a map");
  app.add_flag("--json", options->json, "Print JSON");
  app.add_option("--csv", options->csv, "Write a CSV table, a line per map; - prints it")
      ->type_name("FILE|-");
  app.add_option("--error-map", options->error_map,
                 "Write the signed error as a picture: red too far, blue too near, black missing; "
                 "several get the name of estimate and view")
      ->type_name("FILE.png");
  app.add_flag("--replace", options->replace,
               "What is in the way and this program did not write is moved to NAME.old-1, in place "
               "of an error");
  app.add_option("--error-range", options->error_range, "Error in px with the full colour")
      ->capture_default_str();
  return [options](const RunControl& control) { evaluate(*options, control); };
}

}  // namespace gigaray::cli
