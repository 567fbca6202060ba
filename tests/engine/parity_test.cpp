// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Every step of the method on both backends over the same band. The last lines of
//   gigaray_engine_tests --gtest_filter='Parity*'
// are the table of the largest differences per stage and sampler.
#include <gtest/gtest.h>

#include <limits>

#include "engine/parity_bench.h"

namespace gigaray::testing_support {
namespace {

// Rounding: values up to about 10 in single precision, sums of some dozen of them in another order.
constexpr double kRounding = 4e-6;
// A colour is off by some 1e-7; the kernel's slope is up to 2 / h with h = 0.02, so a score is off
// by 1e-5, and mean-shift steps pass it on.
constexpr double kScore = 1e-4;
// density_score.cl: stopping early changes a score by less than 2 * MOVE_BOUND * ITERATIONS.
constexpr double kEarlyStop = 2 * 1e-4 * 10;
// A slope is the quotient of two sums, which leaves fewer digits.
constexpr double kSlope = 5e-4;
// Ten mean-shift iterations around a mean that moves.
constexpr double kRadiance = 5e-4;
// Mean-shift amplifies rounding without bound where the samples pull both ways with equal force;
// that happens for few rays, and only in random content.
constexpr double kUnstableShare = 2e-3;

template <class S>
class Parity : public testing::Test {
 protected:
  static void TearDownTestSuite() { ParityTable::instance().print(); }

  /// Notes the difference for the table and expects it within bounds.
  void expect_within(const std::string& stage, const Difference& difference, double tolerance) {
    ParityTable::instance().add(ParityRig<S>::kName, stage, difference);
    this->RecordProperty(ParityRig<S>::kName + (": " + stage), std::to_string(difference.largest));
    EXPECT_LE(difference.largest, tolerance) << stage;
    EXPECT_EQ(difference.one_sided, 0) << stage << ": estimates on one side only";
    EXPECT_LE(double(difference.apart), kUnstableShare * double(difference.values)) << stage;
  }

  /// The sums of the paths stay in the backend: what can be compared is which hypotheses they
  /// choose and the scores of those.
  void check_scanlines(const ParityCase& size) {
    DepthOptions options = auto_options();
    options.winner.refine = false;
    options.score.bandwidth = 0.1f;
    options.score.gradient_bandwidth = 0.05f;
    ParityBench<S> bench(size, options);
    const RowRange supported = bench.around(kScanlineReach);
    const RowRange scored = bench.around(kScanlineReach + options.support.radius);
    const auto all = bench.all_todo(scored);
    const auto full = bench.full_bounds(scored);
    const auto todo = bench.random_todo(supported);
    StripMap<float> expected(bench.width(), bench.rows()), actual = expected;
    StripMap<float> expected_score = expected, actual_score = expected;
    for (HostSteps* backend : {bench.reference.get(), bench.opencl.get()}) {
      const bool is_reference = backend == bench.reference.get();
      StripMap<float>& found = is_reference ? expected : actual;
      StripMap<float> contrast(bench.width(), bench.rows());
      backend->robust_score(2, scored, all, full, ScoreViews::kAll);
      backend->score_support(2, supported, todo, full);
      backend->scanline(2, bench.rows(), todo);
      backend->winner(bench.rows(), todo, full, found, contrast);
      backend->score_of_estimate(bench.rows(), todo, found,
                                 is_reference ? expected_score : actual_score);
    }
    Difference choice, score;
    for (int v = bench.rows().begin; v < bench.rows().end; ++v)
      for (int u = 0; u < bench.width(); ++u) {
        const float a = expected.row(v)[u], b = actual.row(v)[u];
        // Of hypotheses whose paths sum up alike, as all do in the flat stripe, rounding chooses.
        if (std::abs(a - b) > kRounding) {
          ++choice.values, ++choice.apart;
        } else {
          choice.add(a, b);
          score.add(expected_score.row(v)[u], actual_score.row(v)[u]);
        }
      }
    this->expect_within("scan-lines, score of the choice", score, kScore);
    ParityTable::instance().add(ParityRig<S>::kName, "scan-lines, choice", choice);
    EXPECT_EQ(choice.one_sided, 0);
    EXPECT_LT(4 * choice.apart, choice.values) << "the flat stripe is a sixth";
  }
};

using Samplers = testing::Types<EpiSampler, GridSampler, UnstructuredSampler>;
TYPED_TEST_SUITE(Parity, Samplers);

TYPED_TEST(Parity, UnpackedColours) {
  // With a tiny bandwidth the mean radiance is the pixel's own colour.
  for (const ParityCase& size : parity_cases())
    for (const bool linear_rgb : {true, false}) {
      DepthOptions options = paper_options();
      options.score.linear_rgb = linear_rgb;
      options.score.bandwidth = 1e-6f;
      ParityBench<TypeParam> bench(size, options);
      const StripMap<float> disparity(bench.width(), bench.rows());
      StripMap<Radiance> expected(bench.width(), bench.rows()), actual = expected;
      bench.reference->mean_radiance(2, bench.rows(), disparity, expected);
      bench.opencl->mean_radiance(2, bench.rows(), disparity, actual);
      this->expect_within("unpack colours", compare(expected, actual, disparity, bench.rows()),
                          kRounding);
    }
}

TYPED_TEST(Parity, EdgeConfidence) {
  for (const ParityCase& size : parity_cases())
    for (const bool squared : {true, false})
      for (const int radius : {4, 1}) {
        if (radius == 1 && !squared) continue;  // every program costs a second to build
        DepthOptions options = paper_options();
        options.edge.squared = squared;
        options.edge.radius = radius;
        ParityBench<TypeParam> bench(size, options);
        StripMap<float> expected(bench.width(), bench.rows()), actual = expected;
        bench.reference->edge_confidence(1, bench.rows(), expected);
        bench.opencl->edge_confidence(1, bench.rows(), actual);
        this->expect_within(squared ? "edge confidence, squared" : "edge confidence, plain",
                            compare(expected, actual, bench.rows()), kRounding);
      }
}

TYPED_TEST(Parity, PaperScores) {
  struct Variant {
    const char* stage;
    int iterations;
    bool stop_early;
    double tolerance;
  };
  const Variant variants[] = {{"score, paper, no mean-shift", 0, true, kScore},
                              {"score, paper, 2 iterations", 2, false, kScore},
                              {"score, paper, 10 iterations", 10, false, kScore},
                              {"score, paper, 10, early stop", 10, true, kEarlyStop}};
  for (const Variant& variant : variants)
    for (const ParityCase& size : parity_cases()) {
      DepthOptions options = paper_options();
      options.score.mean_shift_iterations = variant.iterations;
      options.score.stop_early = variant.stop_early;
      ParityBench<TypeParam> bench(size, options);
      const auto todo = bench.random_todo(bench.rows());
      const auto bounds = bench.random_bounds(bench.rows());
      bench.reference->density_score(3, bench.rows(), todo, bounds);
      bench.opencl->density_score(3, bench.rows(), todo, bounds);
      this->expect_within(variant.stage,
                          compare_scores(bench, bench.rows(), todo, variant.tolerance),
                          variant.tolerance);
    }
}

TYPED_TEST(Parity, RobustScores) {
  struct Variant {
    const char* stage;
    float gradient_share;
    ScoreViews views;
    float slack;
  };
  const Variant variants[] = {{"robust score", 0.7f, ScoreViews::kAll, 0},
                              {"robust score, gradient alone", 1.0f, ScoreViews::kAll, 0},
                              {"robust score, slack", 0.7f, ScoreViews::kAll, 0.8f},
                              {"robust score, half-planes", 0.7f, ScoreViews::kHalfPlanes, 0}};
  for (const Variant& variant : variants)
    for (const ParityCase& size : parity_cases()) {
      DepthOptions options = auto_options();
      options.score.gradient_share = variant.gradient_share;
      options.score.colour_slack = variant.slack;
      options.score.gradient_slack = variant.slack / 2;
      options.score.unseen = variant.slack > 0 ? 0.1f : 0.5f;
      options.score.gradient_bandwidth = 0.02f;
      options.score.min_views = 0.4f;
      ParityBench<TypeParam> bench(size, options);
      const auto todo = bench.random_todo(bench.rows());
      const auto bounds = bench.random_bounds(bench.rows());
      for (const int ref : {3, 0}) {
        for (HostSteps* backend : {bench.reference.get(), bench.opencl.get()})
          backend->robust_score(ref, bench.rows(), todo, bounds, variant.views);
        this->expect_within(variant.stage, compare_scores(bench, bench.rows(), todo, 1), kScore);
      }
    }
}

TYPED_TEST(Parity, FirstLookAtSomeOfManyViews) {
  for (const ParityCase& size : {ParityCase{33, 9, {2, 6}}, ParityCase{17, 5, {0, 5}}}) {
    const auto views =
        ParityRig<TypeParam>::kKind == LightFieldKind::k3D ? row_of_views(61) : grid_of_views(7, 9);
    ParityBench<TypeParam> bench(size, auto_options(), views, {-0.1, 0.2, 7});
    const auto todo = bench.all_todo(bench.rows());
    const auto bounds = bench.full_bounds(bench.rows());
    for (HostSteps* backend : {bench.reference.get(), bench.opencl.get()})
      backend->robust_score(30, bench.rows(), todo, bounds, ScoreViews::kFirst);
    this->expect_within("robust score, some views", compare_scores(bench, bench.rows(), todo, 1),
                        kScore);
  }
}

TYPED_TEST(Parity, SidesOfJumps) {
  for (const ParityCase& size : parity_cases()) {
    if (size.level > 0) continue;  // a step of the finest level
    DepthOptions options = auto_options();
    options.score.bandwidth = 0.1f;
    ParityBench<TypeParam> bench(size, options);
    const auto [evidence, choice] = compare_sides(bench, 2, kScore);
    this->expect_within("evidence of sides", evidence, kScore);
    this->expect_within("choice of sides", choice, 0);
  }
}

TYPED_TEST(Parity, WhatIsHiddenAndWhatFillsIt) {
  for (const ParityCase& size : parity_cases()) {
    if (size.level > 0) continue;  // a step of the finest level
    ParityBench<TypeParam> bench(size, auto_options());
    const auto [hidden, guessed, filled] = compare_hidden(bench, 2);
    this->expect_within("what is hidden", hidden, 0);
    this->expect_within("what is guessed", guessed, 0);
    this->expect_within("what fills it", filled, 0);
  }
}

TYPED_TEST(Parity, RayMeansAndWhatIsScoredAgainstThem) {
  for (const ParityCase& size : parity_cases()) {
    DepthOptions options = auto_options();
    options.score.bandwidth = 0.1f;
    options.score.gradient_bandwidth = 0.02f;
    options.support.sigma_colour = 0.1f;
    ParityBench<TypeParam> bench(size, options);
    const RowRange around = bench.around(options.support.radius + 1);
    StripMap<float> expected;
    this->expect_within("ray mean", compare_ray_means(bench, 2, around, expected), kRadiance);

    const auto all = bench.all_todo(around);
    const auto full = bench.full_bounds(around);
    for (HostSteps* backend : {bench.reference.get(), bench.opencl.get()}) {
      backend->replace_reference(expected);
      backend->robust_score(2, around, all, full, ScoreViews::kAll);
    }
    this->expect_within("robust score against means", compare_scores(bench, bench.rows(), all, 1),
                        kScore);
    for (HostSteps* backend : {bench.reference.get(), bench.opencl.get()})
      backend->score_support(2, bench.rows(), all, full);
    this->expect_within("score support by means", compare_scores(bench, bench.rows(), all, 1),
                        kScore);
    for (HostSteps* backend : {bench.reference.get(), bench.opencl.get()}) {
      backend->restore_reference();
      backend->robust_score(2, around, all, full, ScoreViews::kAll);
    }
    this->expect_within("robust score, restored", compare_scores(bench, around, all, 1), kScore);
  }
}

TYPED_TEST(Parity, RegularRigs) {
  // Shifts of whole and half pixels, exact or off by rounding, up to the edges of the picture.
  for (const ParityCase& size : parity_cases())
    for (const HypothesisRange& hypotheses :
         {HypothesisRange{-1, 1, 17}, HypothesisRange{-1, 1, 21}})
      for (const DepthOptions& preset : {paper_options(), auto_options()}) {
        DepthOptions options = preset;
        options.score.stop_early = false;
        options.score.gradient_bandwidth = 0.02f;
        ParityBench<TypeParam> bench(size, options, ParityRig<TypeParam>::regular(), hypotheses);
        const auto todo = bench.all_todo(bench.rows());
        const auto bounds = bench.full_bounds(bench.rows());
        for (HostSteps* backend : {bench.reference.get(), bench.opencl.get()}) {
          if (options.score.gradient)
            backend->robust_score(1, bench.rows(), todo, bounds, ScoreViews::kAll);
          else
            backend->density_score(1, bench.rows(), todo, bounds);
        }
        this->expect_within("score, regular rig, " + preset.preset,
                            compare_scores(bench, bench.rows(), todo, kScore), kScore);
      }
}

TYPED_TEST(Parity, SupportedScores) {
  for (const ParityCase& size : parity_cases()) {
    DepthOptions options = auto_options();
    options.support.sigma_colour = 0.1f;
    ParityBench<TypeParam> bench(size, options);
    const RowRange around = bench.around(options.support.radius);
    const auto all = bench.all_todo(around);
    const auto full = bench.full_bounds(around);
    const auto todo = bench.random_todo(bench.rows());
    const auto bounds = bench.random_bounds(bench.rows());
    const auto slopes = bench.random_slopes(bench.rows());
    for (HostSteps* backend : {bench.reference.get(), bench.opencl.get()}) {
      backend->robust_score(0, around, all, full, ScoreViews::kAll);
      backend->score_support(0, bench.rows(), todo, bounds);
    }
    this->expect_within("score support", compare_scores(bench, bench.rows(), todo, 1), kScore);
    for (HostSteps* backend : {bench.reference.get(), bench.opencl.get()})
      backend->slanted_support(0, bench.rows(), todo, bounds, slopes);
    this->expect_within("slanted support", compare_scores(bench, bench.rows(), todo, 1), kScore);
  }
}

TYPED_TEST(Parity, Scanlines) {
  for (const ParityCase& size : parity_cases()) {
    if (size.rows.begin % kScanlineBlock != 0) continue;
    this->check_scanlines(size);
  }
  // A second block of rows, its end at the edge of the picture or inside.
  this->check_scanlines({33, 41, {32, 41}});
  this->check_scanlines({17, 83, {32, 64}, BandEncoding::kBits16});
}

TYPED_TEST(Parity, Slopes) {
  for (const ParityCase& size : parity_cases()) {
    ParityBench<TypeParam> bench(size, auto_options());
    const auto in = bench.slanted_disparity(bench.around(kSlopeReach));
    StripMap<Slope> expected(bench.width(), bench.rows()), actual = expected;
    bench.reference->slope_fit(2, bench.rows(), in, expected);
    bench.opencl->slope_fit(2, bench.rows(), in, actual);
    this->expect_within("slope fit", compare(expected, actual, bench.rows()), kSlope);
  }
}

TYPED_TEST(Parity, Winners) {
  for (const ParityCase& size : parity_cases())
    for (const bool refine : {false, true}) {
      DepthOptions options = auto_options();
      options.winner.refine = refine;
      options.winner.peak_share = refine ? 0.3f : 0;
      options.winner.peak_width = 1;
      options.winner.widest_peak = 3;
      options.score.bandwidth = 0.1f;
      options.score.gradient_bandwidth = 0.05f;
      ParityBench<TypeParam> bench(size, options);
      const RowRange rows = bench.rows();
      const auto todo = bench.random_todo(rows);
      const auto bounds = bench.random_bounds(rows);
      StripMap<float> expected(bench.width(), rows), actual = expected;
      StripMap<float> expected_lead = expected, actual_lead = expected;
      bench.reference->robust_score(3, rows, todo, bounds, ScoreViews::kAll);
      bench.reference->winner(rows, todo, bounds, expected, expected_lead);
      bench.opencl->robust_score(3, rows, todo, bounds, ScoreViews::kAll);
      bench.opencl->winner(rows, todo, bounds, actual, actual_lead);

      // Two hypotheses that score alike, or three on a flat top, are told apart by rounding: the
      // winners may differ then, their scores may not.
      const HypothesisRange& hypotheses = bench.hypotheses();
      Difference difference;
      for (int v = rows.begin; v < rows.end; ++v)
        for (int u = 0; u < bench.width(); ++u) {
          const float a = expected.row(v)[u], b = actual.row(v)[u];
          const double tolerance = refine ? 1e-2 * hypotheses.step() : kRounding;
          if (std::isnan(a) || std::isnan(b) || std::abs(a - b) <= tolerance) {
            difference.add(a, b);
            continue;
          }
          ++difference.values;
          ++difference.apart;
          const auto scores = bench.reference->scores_at(u, v);
          const auto score_near = [&](float h) {
            const int i = int(std::lround((h - hypotheses.min) / hypotheses.step()));
            float best = scores[i];
            if (refine)
              best = std::max({best, scores[std::max(i - 1, 0)],
                               scores[std::min(i + 1, hypotheses.count - 1)]});
            return best;
          };
          EXPECT_NEAR(score_near(a), score_near(b), kScore) << "at " << u << ", " << v;
        }
      ParityTable::instance().add(ParityRig<TypeParam>::kName,
                                  refine ? "winner, refined" : "winner", difference);
      EXPECT_EQ(difference.one_sided, 0);
      EXPECT_LT(4 * difference.apart, difference.values) << "the flat stripe is a sixth";
      this->expect_within("winner, contrast", compare(expected_lead, actual_lead, rows), kScore);
    }
}

TYPED_TEST(Parity, BilateralMedian) {
  for (const ParityCase& size : parity_cases())
    for (const int radius : {1, 2, 5})
      for (const float tolerance : {0.1f, std::numeric_limits<float>::infinity()}) {
        if ((radius == 1) != std::isinf(tolerance)) continue;  // as the presets use it
        ParityBench<TypeParam> bench(size, paper_options());
        const auto in = bench.random_disparity(bench.around(radius), 0.6);
        StripMap<float> expected(bench.width(), bench.rows()), actual = expected;
        bench.reference->bilateral_median(2, bench.rows(), radius, tolerance, in, expected);
        bench.opencl->bilateral_median(2, bench.rows(), radius, tolerance, in, actual);
        // A median picks a value: nothing is rounded.
        this->expect_within(std::isinf(tolerance) ? "median, plain" : "median, bilateral",
                            compare(expected, actual, bench.rows()), 0);
      }
}

TYPED_TEST(Parity, MeanRadiance) {
  for (const ParityCase& size : parity_cases())
    for (const DepthOptions& preset : {paper_options(), auto_options()}) {
      DepthOptions options = preset;
      options.score.bandwidth = 0.1f;
      ParityBench<TypeParam> bench(size, options);
      const auto disparity = bench.random_disparity(bench.rows(), 0.8);
      StripMap<Radiance> expected(bench.width(), bench.rows()), actual = expected;
      bench.reference->mean_radiance(4, bench.rows(), disparity, expected);
      bench.opencl->mean_radiance(4, bench.rows(), disparity, actual);
      this->expect_within("mean radiance, " + preset.preset,
                          compare(expected, actual, disparity, bench.rows()), kRadiance);
    }
}

/// Estimates of three views, and what is there before.
template <class S>
struct Arrivals {
  explicit Arrivals(ParityBench<S>& bench) : reached(bench.rows_of_all(bench.rows())) {
    before.resize(std::size_t(reached.size()) * bench.active_count * bench.width());
    for (PackedEstimate& estimate : before)
      if (bench.uniform() < 0.5) estimate = pack_estimate(float(bench.uniform() - 0.5), 0.4f);
    for (const int ref : refs) {
      disparity[ref] = bench.random_disparity(bench.rows(), 0.9);
      confidence[ref] = bench.random_values(bench.rows());
      radiance[ref] = StripMap<Radiance>(bench.width(), bench.rows());
      bench.reference->mean_radiance(ref, bench.rows(), disparity[ref], radiance[ref]);
    }
  }
  const std::vector<int> refs{4, 0, 2};
  RowRange reached;
  std::vector<PackedEstimate> before;
  std::map<int, StripMap<float>> disparity, confidence;
  std::map<int, StripMap<Radiance>> radiance;
};

TYPED_TEST(Parity, Propagation) {
  for (const ParityCase& size : parity_cases()) {
    DepthOptions options = paper_options();
    options.propagation.finished_lead = 1.25f;
    ParityBench<TypeParam> bench(size, options);
    Arrivals<TypeParam> arrivals(bench);
    auto expected = arrivals.before, actual = expected;
    for (const int ref : arrivals.refs) {
      const int finished = ref == 4 ? 0 : 2;
      bench.reference->propagation(ref, bench.rows(), arrivals.disparity[ref],
                                   arrivals.confidence[ref], arrivals.radiance[ref],
                                   arrivals.reached, bench.active_count, finished, expected);
      bench.opencl->propagation(ref, bench.rows(), arrivals.disparity[ref],
                                arrivals.confidence[ref], arrivals.radiance[ref], arrivals.reached,
                                bench.active_count, finished, actual);
      EXPECT_FALSE(bench.reference->bars_left || bench.opencl->bars_left);
    }
    EXPECT_NE(expected, arrivals.before);
    Difference hypothesis, confidence;
    // Rounding decides about a nearest pixel, and of a quotient which of two estimates is nearer.
    const double same = TypeParam::kRaysShiftAlike ? 0 : 1e-5;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const float a = hypothesis_of(expected[i]), b = hypothesis_of(actual[i]);
      if (std::isnan(a) != std::isnan(b) || std::abs(a - b) > same ||
          confidence_of(expected[i]) != confidence_of(actual[i])) {
        ++hypothesis.values;
        ++hypothesis.apart;
        continue;
      }
      hypothesis.add(a, b);
      confidence.add(confidence_of(expected[i]), confidence_of(actual[i]));
    }
    this->expect_within("propagation, hypothesis", hypothesis, same);
    this->expect_within("propagation, confidence", confidence, 0);
  }
}

TYPED_TEST(Parity, PropagationHasNoOrder) {
  // The estimates of a view, cut into rows, arrive in random orders.
  DepthOptions options = paper_options();
  options.propagation.finished_lead = 1.25f;
  ParityBench<TypeParam> bench(ParityCase{93, 31, {9, 16}}, options);
  Arrivals<TypeParam> arrivals(bench);
  for (HostSteps* steps : {bench.reference.get(), bench.opencl.get()}) {
    std::vector<PackedEstimate> expected;
    for (unsigned seed = 0; seed < 8; ++seed) {
      const RowsOnDevice merged =
          steps->up(arrivals.before, arrivals.reached.begin, bench.active_count);
      const RowsOnDevice bars = steps->up(std::vector<float>(arrivals.before.size()),
                                          arrivals.reached.begin, bench.active_count);
      std::mt19937 random(seed);
      for (const int ref : arrivals.refs) {
        const auto disparity = steps->up(arrivals.disparity[ref]);
        const auto confidence = steps->up(arrivals.confidence[ref]);
        const auto radiance = steps->up(arrivals.radiance[ref]);
        std::vector<RowRange> parts;
        for (int v = bench.rows().begin; v < bench.rows().end;) {
          const int end = std::min(v + 1 + int(random() % 3), bench.rows().end);
          parts.push_back({v, end});
          v = end;
        }
        std::shuffle(parts.begin(), parts.end(), random);
        for (const RowRange rows : parts) {
          steps->workspace().set_bars(ref, rows, disparity, arrivals.reached, 2, merged, bars);
          steps->workspace().propagation(ref, rows, disparity, confidence, radiance,
                                         arrivals.reached, 2, bars, merged);
        }
        for (const RowRange rows : parts)
          steps->workspace().clear_bars(ref, rows, disparity, arrivals.reached, 2, bars);
      }
      std::vector<PackedEstimate> result(arrivals.before.size());
      steps->down(merged, result);
      if (seed == 0)
        expected = result;
      else
        EXPECT_EQ(result, expected) << seed;
    }
    EXPECT_NE(expected, arrivals.before);
  }
}

TYPED_TEST(Parity, Downsampling) {
  for (const ParityCase& size : parity_cases()) {
    ParityBench<TypeParam> bench(size, paper_options());
    const RowRange small{(bench.rows().begin + 1) / 2, (bench.rows().end + 1) / 2};
    std::vector<float> expected(std::size_t(small.size()) * bench.sampler().num_views() * 3 *
                                ((bench.width() + 1) / 2));
    auto actual = expected;
    bench.reference->downsample(small, bench.sampler().num_views(), expected);
    bench.opencl->downsample(small, bench.sampler().num_views(), actual);
    Difference difference;
    for (std::size_t i = 0; i < expected.size(); ++i) difference.add(expected[i], actual[i]);
    this->expect_within("downsampling", difference, kRounding);
  }
}

}  // namespace
}  // namespace gigaray::testing_support
