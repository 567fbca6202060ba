// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "baselines/disparity_sampler.h"
#include "baselines/external.h"
#include "command.h"
#include "contest.h"
#include "contest_report.h"
#include "depth_options_cli.h"
#include "did_you_mean.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/parallel.h"
#include "numbers.h"
#include "output_option.h"
#include "photographs.h"

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

bool is_chosen(const Settings& settings, const std::string& method) {
  return settings.methods.empty() ||
         std::ranges::find(settings.methods, method) != settings.methods.end();
}

std::vector<std::string> all_methods() {
  std::vector<std::string> names{"auto", "paper"};
  for (const baselines::Baseline& baseline : baselines::all_baselines())
    names.push_back(baseline.name);
  return names;
}

/// Those that were chosen, then the programs outside.
std::vector<baselines::Baseline> chosen_baselines(const Settings& settings) {
  std::vector<baselines::Baseline> chosen;
  for (const baselines::Baseline& baseline : baselines::all_baselines())
    if (is_chosen(settings, baseline.name)) chosen.push_back(baseline);
  std::vector<std::string> names{"gigaray_auto", "gigaray_paper", "truth"};
  for (const baselines::Baseline& baseline : baselines::all_baselines())
    names.push_back(baseline.name);
  for (const fs::path& path : settings.externals) {
    chosen.push_back(baselines::external_baseline(path));
    if (std::ranges::find(names, chosen.back().name) != names.end())
      throw Error(ErrorCode::kInvalidArgument,
                  path.string() + ": there is a '" + chosen.back().name + "' already");
    names.push_back(chosen.back().name);
  }
  return chosen;
}

/// Is a view left out that is nearer to the centre of the rig than the one that is scored?
bool leaves_out_centre(const Contest& contest) {
  const auto distance = [](const View& view) { return std::hypot(view.s, view.t); };
  const double own = distance(contest.light_field.views[contest.view]);
  return std::ranges::any_of(contest.light_field.left_out,
                             [&](const View& view) { return distance(view) < own - 1e-9; });
}

/// Where the exact depth of a view of a capture is: `place` itself when it is a file, else VIEW.pfm
/// in the folder or in its folder truth. Empty: there is none.
fs::path find_depth(const fs::path& place, const std::string& view) {
  if (!fs::exists(place)) throw Error(ErrorCode::kBadInput, place.string() + ": doesn't exist");
  if (!fs::is_directory(place)) return place;
  for (const fs::path& path : {place / (view + ".pfm"), place / "truth" / (view + ".pfm")})
    if (fs::exists(path)) return path;
  return {};
}

/// Of unstructured views a map of depth, else of disparity; px per view step.
FloatMap read_truth_of(const Contest& contest) {
  if (!contest.is_posed()) return read_truth(contest.truth_place);
  FloatMap map = read_float_map(contest.truth_place);
  for (float& value : map) value = value > 0 ? float(contest.unit / double(value)) : kNoEstimate;
  return map;
}

/// The truth that was named, or the one in the folder of the input.
void find_truth_for(Contest& contest, const Settings& settings, const RunControl& control) {
  const bool is_named = !settings.truth.empty();
  const fs::path& place = is_named ? settings.truth : settings.run.input.input;
  if (!is_named && !fs::is_directory(place)) return;
  const std::string& view = contest.light_field.views[contest.view].name;
  contest.truth_place = contest.is_posed() ? find_depth(place, view) : find_truth(place);
  if (contest.truth_place.empty()) {
    if (is_named)
      throw Error(ErrorCode::kBadInput,
                  place.string() + (contest.is_posed() ? ": has no " + view + ".pfm"
                                                       : ": the folder has no true disparities"));
    control.message("no truth in the folder: maps are compared with each other");
    return;
  }
  const LightField& light_field = contest.light_field;
  FloatMap truth = read_truth_of(contest);
  const bool fits = truth.width() == light_field.width && truth.height() == light_field.height;
  if (!is_named && (!fits || leaves_out_centre(contest))) {
    control.message(fmt::format("{} is of {}: maps are compared with each other",
                                contest.truth_place.string(),
                                fits ? "a view that is left out" : "another size"));
    contest.truth_place.clear();
    return;
  }
  if (!fits)
    throw Error(ErrorCode::kBadInput,
                fmt::format("{}: is {} x {}, the views are {} x {}", contest.truth_place.string(),
                            truth.width(), truth.height(), light_field.width, light_field.height));
  contest.truth = std::move(truth);
  contest.parts = read_scene_parts(place, {}, light_field.width, light_field.height);
  if (!is_named) control.message("truth: " + contest.truth_place.string());
}

/// The range to search, px per view step, that was stated or that the input states.
std::optional<DisparityRange> range_known(const Contest& contest,
                                          const std::optional<DisparityRange>& stated) {
  const LightField& light_field = contest.light_field;
  if (!contest.is_posed()) return stated ? stated : light_field.declared_range;
  std::optional<DisparityRange> inverse = stated;
  if (const auto& seen = light_field.cameras[contest.view].inverse_depth; seen && !inverse)
    inverse = DisparityRange{seen->min, seen->max};
  if (inverse) inverse = DisparityRange{inverse->min * contest.unit, inverse->max * contest.unit};
  return inverse;
}

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

/// Processor and number of threads, for the record.
std::string machine() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name"))
      return fmt::format("{}, {} threads", line.substr(line.find(':') + 2), num_threads());
  return fmt::format("{} threads", num_threads());
}

/// The options of one of our presets. range: to search, of views in a plane.
DepthOptions options_of(const char* preset, const Settings& settings, const DepthOptions& resolved,
                        const Contest& contest, const std::optional<DisparityRange>& range) {
  DepthOptions options = preset_options(preset);
  if (settings.run.hypotheses != 0) options.hypotheses = settings.run.hypotheses;
  options.memory_bytes = resolved.memory_bytes;
  options.work_folder = resolved.work_folder;
  options.most_partners = resolved.most_partners;
  options.disparity = contest.is_posed() ? resolved.disparity : range;
  return options;
}

/// The baselines need, beside OpenCL, which is loaded by then, all views as floats and costs of a
/// view; our own presets what their plan says.
void require_memory(const Settings& settings, const DepthOptions& resolved, const Contest& contest,
                    const std::optional<DisparityRange>& range) {
  const LightField& light_field = contest.light_field;
  const double pixels = double(light_field.width) * light_field.height;
  constexpr double kOpenClBytes = 100 * double(1 << 20);
  double needed = kProgramBytes + kOpenClBytes + pixels * (18.0 * light_field.num_views() + 400);
  for (const char* preset : {"auto", "paper"}) {
    if (!is_chosen(settings, preset)) continue;
    DepthOptions options = options_of(preset, settings, resolved, contest, range);
    options.views = {contest.view};
    needed = std::max(needed, least_memory_bytes(light_field, options));
  }
  settings.run.budget().require(
      needed, views_text(light_field.num_views(), light_field.width, light_field.height));
}

void run(const Settings& settings, const RunControl& control) {
  std::vector<fs::path> inputs = settings.run.input.places();
  inputs.push_back(settings.truth);
  inputs.insert(inputs.end(), settings.externals.begin(), settings.externals.end());
  AtomicFolder folder(settings.output.path, kCompareFormat,
                      settings.output.rules(std::move(inputs)));
  const std::vector<baselines::Baseline> others = chosen_baselines(settings);
  Contest contest;
  contest.repeats = settings.repeats;
  contest.light_field = open_views(settings.run.input, control);
  for (const std::string& note : contest.light_field.notes) control.message(note);
  const DepthOptions resolved = settings.run.resolve(contest.light_field, control);
  contest.view = centre_view(contest.light_field);
  contest.unit = baselines::disparity_of_inverse_depth(contest.light_field, contest.view);
  find_truth_for(contest, settings, control);

  // Ours first: it finds the range to search when nothing states it.
  std::optional<DisparityRange> range = range_known(contest, resolved.disparity);
  require_memory(settings, resolved, contest, range);
  std::vector<Contestant> contestants;
  for (const char* preset : {"auto", "paper"}) {
    if (!is_chosen(settings, preset)) continue;
    const DepthOptions options = options_of(preset, settings, resolved, contest, range);
    contestants.push_back(run_ours(contest, options, settings.run.backend(), control));
    if (contest.is_posed()) contest.light_field.cameras = contestants.back().cameras;
    if (!range) range = contestants.back().searched;
  }
  if (!range)
    throw Error(ErrorCode::kInvalidArgument,
                "the range of disparities is not known; state --disparity, or let auto run too");
  contest.range = *range;
  for (const baselines::Baseline& baseline : others) {
    if (auto contestant = run_baseline(contest, baseline, control))
      contestants.push_back(std::move(*contestant));
    else
      control.message(baseline.name + ": left out, the views or the range don't allow it");
  }
  if (contestants.empty())
    throw Error(ErrorCode::kBadInput, "none of the methods can work with these views");

  ContestFacts facts;
  facts.input = settings.run.input.input.string();
  facts.program = "gigaray " GIGARAY_VERSION;
  facts.machine = machine();
  // The errors of a stereo pair are those of the metrics that it is scored with.
  facts.error_range = settings.error_range > 0              ? settings.error_range
                      : contest.light_field.num_views() > 2 ? 0.2
                                                            : 1;
  const FloatMap& shape = contest.truth ? *contest.truth : contestants.front().disparity;
  const std::vector<CloseUp> squares = close_ups(shape, contest.range, 3);
  write_contest_pictures(folder.path(), contest, contestants, squares, facts);
  write_file_atomically(folder.path() / "compare.csv", contest_csv(contestants));
  write_file_atomically(folder.path() / "index.html",
                        contest_page(folder.path(), contest, contestants, squares, facts));
  const std::string json = contest_json(contest, contestants, facts)
                               .dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
  write_file_atomically(folder.path() / "compare.json", json + "\n");
  folder.commit(control);
  if (settings.json) {
    fmt::print("{}\n", json);
    return;
  }
  print_table(contest, contestants);
  for (const std::string& sentence : verdict(contest, contestants)) fmt::print("{}\n", sentence);
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
