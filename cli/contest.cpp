// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "contest.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "baselines/photo_consistency.h"
#include "gigaray/metrics.h"

namespace gigaray::cli {
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

/// The run once more until there are as many times as asked for.
template <class Run>
double timed(const Contest& contest, const std::string& name, const FloatMap& disparity,
             double first, Run run) {
  std::vector<double> seconds{first};
  while (int(seconds.size()) < contest.repeats) {
    const baselines::Estimate again = run();
    if (!is_same(again.disparity, disparity))
      throw Error(ErrorCode::kDevice, name + ": gives another map when it is run again");
    seconds.push_back(again.seconds);
  }
  return median(std::move(seconds));
}

void score(const Contest& contest, Contestant& contestant) {
  if (contest.truth)
    contestant.scores = scores_of(contestant.disparity, *contest.truth, contest.parts,
                                  {.hci = true, .middlebury = true, .border = {}});
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
  ours.reference = "Kim et al. 2013";
  ours.is_ours = true;
  std::string device;
  const auto run = [&] {
    DepthOptions own = options;
    own.views = {contest.view};
    const auto begin = std::chrono::steady_clock::now();
    Reconstruction result = reconstruct(contest.light_field, own, backend, control);
    baselines::Estimate estimate{result.view(contest.view).disparity, {}, 0};
    estimate.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    ours.searched = {result.hypotheses().min, result.hypotheses().max};
    ours.parameters =
        fmt::format("{} hypotheses; device {}", result.hypotheses().count, result.device());
    return estimate;
  };
  baselines::Estimate estimate = run();
  ours.views = fmt::format("{} views", contest.light_field.num_views());
  ours.seconds = timed(contest, ours.name, estimate.disparity, estimate.seconds, run);
  ours.disparity = std::move(estimate.disparity);
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
  contestant.searched = contest.range;
  double least = std::numeric_limits<double>::infinity(), seconds = 0;
  const baselines::Trial* best = nullptr;
  for (const baselines::Trial& trial : trials) {
    control.progress(baseline.name, double(&trial - trials.data()), double(trials.size()));
    baselines::Estimate estimate = trial.run(control);
    const double value = measure(contest, estimate.disparity);
    contestant.choices.push_back({trial.views_text, value});
    if (best && !(value < least)) continue;
    least = value;
    best = &trial;
    seconds = estimate.seconds;
    contestant.views = trial.views_text;
    contestant.disparity = std::move(estimate.disparity);
  }
  contestant.seconds = timed(contest, baseline.name, contestant.disparity, seconds,
                             [&] { return best->run(control); });
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

}  // namespace gigaray::cli
