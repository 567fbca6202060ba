// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/baselines/contest.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "gigaray/baselines/photo_consistency.h"
#include "gigaray/core/metrics.h"

namespace gigaray {
namespace {

bool is_same(const FloatMap& a, const FloatMap& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// Median time of as many runs as are asked for, after a first one that gave `disparity`.
template <class Run>
double median_seconds(const Contest& contest, const std::string& name, const FloatMap& disparity,
                      Run run) {
  std::vector<double> seconds;
  while (int(seconds.size()) < contest.repeats) {
    const auto begin = std::chrono::steady_clock::now();
    const FloatMap again = run();
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    if (!is_same(again, disparity))
      throw Error(ErrorCode::kDevice, name + ": gives another map when it is run again");
    seconds.push_back(time.count());
  }
  return median(std::move(seconds));
}

double share_of_estimates(const FloatMap& map) {
  const auto known = std::ranges::count_if(map, [](float d) { return std::isfinite(d); });
  return 100 * double(known) / double(map.size());
}

void score(const Contest& contest, Contestant& contestant) {
  if (contest.truth)
    contestant.scores = scores_of(contestant.disparity, *contest.truth, contest.parts,
                                  {.hci = true, .middlebury = true, .border = {}});
  if (!contest.truth)
    contestant.scores.push_back(
        {"filled", share_of_estimates(contestant.disparity), "% of pixels"});
  contestant.scores.push_back(
      {kPhotoConsistency,
       baselines::photo_consistency(contest.light_field, contest.view, contestant.disparity),
       "difference of colours to the other views, of 255"});
  contestant.scores.push_back({"seconds", contestant.seconds, "median of the repeats"});
}

double measure(const Contest& contest, const FloatMap& disparity) {
  if (contest.truth) return score_disparity(disparity, *contest.truth).bad_pix_007;
  return baselines::photo_consistency(contest.light_field, contest.view, disparity);
}

}  // namespace

double Contestant::score(const std::string& wanted) const {
  const auto found = std::ranges::find(scores, wanted, &Score::name);
  return found == scores.end() ? double(kNoEstimate) : found->value;
}

Contestant run_ours(const Contest& contest, const DepthOptions& options,
                    const BackendChoice& backend, const RunControl& control) {
  Contestant ours;
  ours.name = "gigaray_" + options.preset;
  ours.title = "Gigaray, preset " + options.preset;
  ours.reference = options.preset == "paper" ? "Kim et al. 2013" : "after Kim et al. 2013";
  ours.is_ours = true;
  DepthOptions own = options;
  own.views = {contest.view};
  LightField light_field = contest.light_field;
  const auto run = [&] {
    Reconstruction result = reconstruct(light_field, own, backend, control);
    ours.searched = {result.hypotheses().min, result.hypotheses().max};
    ours.cameras = result.cameras();
    if (contest.is_posed()) {
      const InverseDepthRange& range = *ours.cameras[contest.view].inverse_depth;
      ours.searched = {range.min * contest.unit, range.max * contest.unit};
    }
    ours.device = result.device();
    ours.parameters =
        fmt::format("{} hypotheses; device {}", result.hypotheses().count, result.device());
    FloatMap disparity = result.view(contest.view).disparity;
    for (float& d : disparity) d *= float(contest.unit);
    return disparity;
  };
  ours.disparity = run();
  // The range is told the next runs, as it is told the others.
  if (contest.is_posed())
    light_field.cameras = ours.cameras;
  else
    own.disparity = ours.searched;
  ours.views = fmt::format("{} views", contest.light_field.num_views());
  ours.seconds = median_seconds(contest, ours.name, ours.disparity, run);
  score(contest, ours);
  return ours;
}

std::optional<Contestant> run_baseline(const Contest& contest, const baselines::Baseline& baseline,
                                       const RunControl& control) {
  const std::vector<baselines::Trial> trials =
      baseline.trials({contest.light_field, contest.view, contest.range});
  if (trials.empty()) return {};
  Contestant contestant;
  contestant.name = baseline.name;
  contestant.title = baseline.title;
  contestant.reference = baseline.reference;
  contestant.parameters = baseline.parameters;
  double least = std::numeric_limits<double>::infinity();
  const baselines::Trial* best = nullptr;
  for (const baselines::Trial& trial : trials) {
    control.progress(baseline.name, double(&trial - trials.data()), double(trials.size()));
    FloatMap disparity = trial.run(control).disparity;
    const double value = measure(contest, disparity);
    contestant.choices.push_back({trial.views_text, value});
    if (best && !(value < least || std::isnan(least))) continue;
    least = value;
    best = &trial;
    contestant.views = trial.views_text;
    contestant.disparity = std::move(disparity);
  }
  contestant.seconds = median_seconds(contest, baseline.name, contestant.disparity,
                                      [&] { return best->run(control).disparity; });
  score(contest, contestant);
  control.progress(baseline.name, 1, 1);
  return contestant;
}

double agreement(const FloatMap& a, const FloatMap& b, double tolerance) {
  std::size_t close = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    close += std::abs(double(a.data()[i]) - double(b.data()[i])) <= tolerance;
  return 100 * double(close) / double(a.size());
}

}  // namespace gigaray
