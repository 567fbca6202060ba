// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "command.h"
#include "depth_options_cli.h"
#include "did_you_mean.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/baselines/compare.h"
#include "gigaray/baselines/contest_report.h"
#include "gigaray/version.h"
#include "numbers.h"
#include "output_option.h"

namespace gigaray::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCompareFormat = "gigaray compare";

struct Settings {
  DepthRunOptions run;
  fs::path truth;
  OutputOption output;
  std::vector<std::string> methods;  ///< empty: all
  std::vector<fs::path> externals;   ///< descriptions of programs
  int repeats = 1;
  double error_range = 0;  ///< 0: by the number of views
  bool json = false;
};

void print_table(const Contest& contest, const std::vector<Contestant>& contestants) {
  const auto rows = contest_table(contest, contestants);
  // Width in characters, of which some are two bytes long.
  const auto length = [](const std::string& text) {
    return std::size_t(std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; }));
  };
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], length(row[i]));
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string space(widths[i] - length(row[i]), ' ');
      const bool is_text = i == 0 || i + 1 == row.size();
      line += (i == 0 ? "" : "  ") + (is_text ? row[i] + space : space + row[i]);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    fmt::print("{}\n", line);
  }
}

CompareRequest request_of(const Settings& settings) {
  CompareRequest request{settings.run.request(), settings.truth};
  request.methods = settings.methods;
  request.externals = settings.externals;
  request.repeats = settings.repeats;
  request.error_range = settings.error_range;
  request.memory = settings.run.budget();
  return request;
}

void run(const Settings& settings, const RunControl& control) {
  std::vector<fs::path> inputs = settings.run.input.places();
  inputs.push_back(settings.truth);
  inputs.insert(inputs.end(), settings.externals.begin(), settings.externals.end());
  AtomicFolder folder(settings.output.path, kCompareFormat,
                      settings.output.rules(std::move(inputs)));
  const Comparison comparison = compare(settings.run.input, request_of(settings), control);
  const std::string json = write_comparison(
      comparison, folder.path(), settings.run.input.path.string(), "gigaray " GIGARAY_VERSION);
  folder.commit(control);
  if (settings.json) {
    fmt::print("{}\n", json);
    return;
  }
  print_table(comparison.contest, comparison.contestants);
  for (const std::string& sentence : verdict(comparison.contest, comparison.contestants))
    fmt::print("{}\n", sentence);
  fmt::print("{}: the page\n", (settings.output.path / "index.html").string());
}

}  // namespace

Run compare_command(CLI::App& app) {
  app.description("This method beside the stereo baselines: numbers, pictures, one HTML page");
  const auto settings = std::make_shared<Settings>();
  settings->run.add_all_but_preset_to(app);
  settings->run.add_depth_to(app);
  app.add_option(
         "--truth", settings->truth,
         "True disparity of the centre view: a map, or a folder with truth.pfm, "
         "gt_disp_lowres.pfm or those of a Middlebury stereo pair; of photographs with cameras "
         "its true depth: a map, or a folder with VIEW.pfm (default: what INPUT has)")
      ->type_name("PATH");
  settings->output.add_to(app, "Folder for compare.json, compare.csv, index.html and the pictures")
      ->required();
  app.add_option(
         "--methods", settings->methods,
         "Some methods instead of all: " + fmt::format("{}", fmt::join(all_methods(), ", ")))
      ->check(one_of(all_methods()))
      ->delimiter(',')
      ->type_name("LIST");
  app.add_option("--external", settings->externals,
                 "A program for stereo pairs too, described in JSON (docs/formats.md)")
      ->allow_extra_args(false)
      ->type_name("FILE");
  app.add_option("--repeats", settings->repeats,
                 "Time every run so often, after one that is not timed; the median counts")
      ->check(CLI::Range(1, 1000))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--error-range", settings->error_range,
                 "Error in px with the full colour of the error maps (default: 0.2, of a pair 1)")
      ->check(above_zero())
      ->type_name("PX");
  app.add_flag("--json", settings->json, "Print compare.json to stdout");
  return [settings](const RunControl& control) { run(*settings, control); };
}

}  // namespace gigaray::cli
