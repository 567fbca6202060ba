// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/baselines/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>
#include <utility>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/baselines/contest_report.h"
#include "gigaray/baselines/disparity_sampler.h"
#include "gigaray/baselines/external.h"
#include "gigaray/core/parallel.h"
#include "gigaray/workflows/scene_truth.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

bool is_chosen(const CompareRequest& request, const std::string& method) {
  return request.methods.empty() ||
         std::ranges::find(request.methods, method) != request.methods.end();
}

/// Those that were chosen, then the programs outside.
std::vector<baselines::Baseline> chosen_baselines(const CompareRequest& request) {
  std::vector<baselines::Baseline> chosen;
  for (const baselines::Baseline& baseline : baselines::all_baselines())
    if (is_chosen(request, baseline.name)) chosen.push_back(baseline);
  std::vector<std::string> names{"gigaray_auto", "gigaray_paper", "truth"};
  for (const baselines::Baseline& baseline : baselines::all_baselines())
    names.push_back(baseline.name);
  for (const fs::path& path : request.externals) {
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
void find_truth_for(Contest& contest, const fs::path& input, const CompareRequest& request,
                    const RunControl& control) {
  const bool is_named = !request.truth.empty();
  const fs::path& place = is_named ? request.truth : input;
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

/// Processor and number of threads, for the record.
std::string machine() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name"))
      return fmt::format("{}, {} threads", line.substr(line.find(':') + 2), num_threads());
  return fmt::format("{} threads", num_threads());
}

/// The options of one of our presets. range: to search, of views in a plane.
DepthOptions options_of(const char* preset, const CompareRequest& request,
                        const DepthOptions& resolved, const Contest& contest,
                        const std::optional<DisparityRange>& range) {
  DepthOptions options = preset_options(preset);
  if (request.depth.options.hypotheses != 0) options.hypotheses = request.depth.options.hypotheses;
  options.memory_bytes = resolved.memory_bytes;
  options.work_folder = resolved.work_folder;
  options.most_partners = resolved.most_partners;
  options.disparity = contest.is_posed() ? resolved.disparity : range;
  return options;
}

/// The baselines need, beside OpenCL, which is loaded by then, all views as floats and costs of a
/// view; our own presets what their plan says.
void require_memory(const CompareRequest& request, const DepthOptions& resolved,
                    const Contest& contest, const std::optional<DisparityRange>& range) {
  const LightField& light_field = contest.light_field;
  const double pixels = double(light_field.width) * light_field.height;
  constexpr double kOpenClBytes = 100 * double(1 << 20);
  double needed = kProgramBytes + kOpenClBytes + pixels * (18.0 * light_field.num_views() + 400);
  for (const char* preset : {"auto", "paper"}) {
    if (!is_chosen(request, preset)) continue;
    DepthOptions options = options_of(preset, request, resolved, contest, range);
    options.views = {contest.view};
    needed = std::max(needed, least_memory_bytes(light_field, options));
  }
  request.memory.require(
      needed, views_text(light_field.num_views(), light_field.width, light_field.height));
}

}  // namespace

std::vector<std::string> all_methods() {
  std::vector<std::string> names{"auto", "paper"};
  for (const baselines::Baseline& baseline : baselines::all_baselines())
    names.push_back(baseline.name);
  return names;
}

Comparison compare(const InputRequest& place, const CompareRequest& request,
                   const RunControl& control) {
  const std::vector<baselines::Baseline> others = chosen_baselines(request);
  Comparison comparison;
  Contest& contest = comparison.contest;
  contest.repeats = request.repeats;
  OpenedInput input = open_input(place, control);
  for (const std::string& note : input.light_field.notes) control.message(note);
  const DepthOptions resolved = prepare_depth(input, request.depth, control);
  contest.light_field = std::move(input.light_field);
  contest.view = centre_view(contest.light_field);
  contest.unit = baselines::disparity_of_inverse_depth(contest.light_field, contest.view);
  find_truth_for(contest, place.path, request, control);

  // Ours first: it finds the range to search when nothing states it.
  std::optional<DisparityRange> range = range_known(contest, resolved.disparity);
  require_memory(request, resolved, contest, range);
  std::vector<Contestant>& contestants = comparison.contestants;
  for (const char* preset : {"auto", "paper"}) {
    if (!is_chosen(request, preset)) continue;
    const DepthOptions options = options_of(preset, request, resolved, contest, range);
    contestants.push_back(run_ours(contest, options, request.depth.backend, control));
    if (contest.is_posed()) contest.light_field.cameras = contestants.back().cameras;
    if (!range) range = contestants.back().searched;
  }
  if (!range)
    throw Error(ErrorCode::kInvalidArgument,
                "the range of disparities is not known; state `disparity`, or let auto run too");
  contest.range = *range;
  for (const baselines::Baseline& baseline : others) {
    if (auto contestant = run_baseline(contest, baseline, control))
      contestants.push_back(std::move(*contestant));
    else
      control.message(baseline.name + ": left out, the views or the range don't allow it");
  }
  if (contestants.empty())
    throw Error(ErrorCode::kBadInput, "none of the methods can work with these views");
  // The errors of a stereo pair are those of the metrics that it is scored with.
  comparison.error_range = request.error_range > 0               ? request.error_range
                           : contest.light_field.num_views() > 2 ? 0.2
                                                                 : 1;
  return comparison;
}

std::string write_comparison(const Comparison& comparison, const fs::path& folder,
                             const std::string& input, const std::string& program) {
  const auto& [contest, contestants, error_range] = comparison;
  const ContestFacts facts{input, machine(), program, error_range};
  const FloatMap& shape = contest.truth ? *contest.truth : contestants.front().disparity;
  const std::vector<CloseUp> squares = close_ups(shape, contest.range, 3);
  write_contest_pictures(folder, contest, contestants, squares, facts);
  write_file_atomically(folder / "compare.csv", contest_csv(contestants));
  write_file_atomically(folder / "index.html",
                        contest_page(folder, contest, contestants, squares, facts));
  const std::string json = contest_json(contest, contestants, facts)
                               .dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
  write_file_atomically(folder / "compare.json", json + "\n");
  return json;
}

}  // namespace gigaray
