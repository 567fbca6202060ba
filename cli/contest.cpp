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

/// A map and how long it took.
struct Timed {
  FloatMap disparity;
  double seconds = 0;
};

template <class Run>
Timed timed(Run run) {
  const auto begin = std::chrono::steady_clock::now();
  Timed result{run(), 0};
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

/// Median time of the first run and of as many more as are asked for.
template <class Run>
double median_seconds(const Contest& contest, const std::string& name, const Timed& first,
                      Run run) {
  std::vector<double> seconds{first.seconds};
  while (int(seconds.size()) < contest.repeats) {
    const Timed again = timed(run);
    if (!is_same(again.disparity, first.disparity))
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
  const auto run = [&] {
    DepthOptions own = options;
    own.views = {contest.view};
    Reconstruction result = reconstruct(contest.light_field, own, backend, control);
    ours.searched = {result.hypotheses().min, result.hypotheses().max};
    ours.device = result.device();
    ours.parameters =
        fmt::format("{} hypotheses; device {}", result.hypotheses().count, result.device());
    return result.view(contest.view).disparity;
  };
  Timed first = timed(run);
  ours.views = fmt::format("{} views", contest.light_field.num_views());
  ours.seconds = median_seconds(contest, ours.name, first, run);
  ours.disparity = std::move(first.disparity);
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
  double least = std::numeric_limits<double>::infinity();
  const baselines::Trial* best = nullptr;
  Timed first;
  for (const baselines::Trial& trial : trials) {
    control.progress(baseline.name, double(&trial - trials.data()), double(trials.size()));
    Timed result = timed([&] { return trial.run(control).disparity; });
    const double value = measure(contest, result.disparity);
    contestant.choices.push_back({trial.views_text, value});
    if (best && !(value < least)) continue;
    least = value;
    best = &trial;
    contestant.views = trial.views_text;
    first = std::move(result);
  }
  contestant.seconds =
      median_seconds(contest, baseline.name, first, [&] { return best->run(control).disparity; });
  contestant.disparity = std::move(first.disparity);
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
