// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// What devices without doubles or without 64-bit atomics run, on a device that has both.
#include "engine/same_outcome.h"
#include "support/errors.h"

namespace gigaray::testing_support {
namespace {

const opencl::TuningOverrides kNoDoubles{{opencl::kDeviceParts, {{"FP64", 0}}}};
const opencl::TuningOverrides kNoAtomics{{opencl::kDeviceParts, {{"INT64_ATOMICS", 0}}}};

template <class S>
class ParityWithoutAtomics : public testing::Test {};
using Samplers = testing::Types<EpiSampler, GridSampler, UnstructuredSampler>;
TYPED_TEST_SUITE(ParityWithoutAtomics, Samplers);

/// Bars and estimates after three views have arrived, the last two in finished views.
template <class S>
Outcome arrivals(ParityBench<S>& bench, HostSteps& steps) {
  const RowRange rows = bench.rows(), reached = bench.rows_of_all(rows);
  std::mt19937 random(7);
  const auto uniform = [&] { return double(random()) / 4294967296.0; };
  const HypothesisRange& range = bench.hypotheses();
  std::vector<PackedEstimate> before(std::size_t(reached.size()) * bench.active_count *
                                     bench.width());
  for (PackedEstimate& estimate : before)
    if (uniform() < 0.5) estimate = pack_estimate(float(uniform() - 0.5), float(uniform()));
  const RowsOnDevice merged = steps.up(before, reached.begin, bench.active_count);
  const RowsOnDevice bars =
      steps.up(std::vector<float>(before.size()), reached.begin, bench.active_count);
  Outcome outcome;
  for (const int ref : {4, 0, 2}) {
    const int finished = ref == 4 ? 0 : 2;
    StripMap<float> disparity(bench.width(), rows), confidence = disparity;
    StripMap<Radiance> radiance(bench.width(), rows);
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < bench.width(); ++u) {
        disparity.row(v)[u] =
            uniform() < 0.8 ? float(range.min + uniform() * (range.max - range.min)) : kNoEstimate;
        confidence.row(v)[u] = float(uniform());
      }
    bench.reference->mean_radiance(ref, rows, disparity, radiance);
    const auto from = steps.up(disparity);
    if (finished) {
      steps.workspace().set_bars(ref, rows, from, reached, finished, merged, bars);
      outcome.template add<float>("bars", steps, bars);
    }
    steps.workspace().propagation(ref, rows, from, steps.up(confidence), steps.up(radiance),
                                  reached, finished, bars, merged);
    if (finished) steps.workspace().clear_bars(ref, rows, from, reached, finished, bars);
    outcome.template add<PackedEstimate>("estimates", steps, merged);
    outcome.template add<float>("cleared bars", steps, bars);
  }
  return outcome;
}

TYPED_TEST(ParityWithoutAtomics, ArrivalsAreTheSame) {
  for (const ParityCase& size : parity_cases()) {
    DepthOptions options = paper_options();
    options.propagation.finished_lead = 1.25f;
    options.propagation.tolerance = 0.3f;
    using Rig = ParityRig<TypeParam>;
    ParityBench<TypeParam> with(size, options);
    ParityBench<TypeParam> without(size, options, Rig::irregular(), Rig::hypotheses(), kNoAtomics);
    const Outcome expected = arrivals(with, *with.opencl);
    EXPECT_TRUE(expected.varies());
    EXPECT_EQ(expected.difference(arrivals(without, *without.opencl)), "");
    // Where rays go by one shift nothing rounds differently on the host either.
    if (TypeParam::kRaysShiftAlike) {
      EXPECT_EQ(arrivals(with, *with.reference).difference(expected), "");
    }
  }
}

class ParityWithoutDoubles : public testing::TestWithParam<ParityCase> {
 protected:
  ParityWithoutDoubles()
      : bench(GetParam(), paper_options(), irregular_row(), {-1.31, 1.73, 19}, kNoDoubles) {}

  RowRange rows() const { return bench.rows(); }
  RowRange all() const { return {0, bench.height()}; }
  /// Rounding may test a hypothesis more or less at both ends.
  void expect_near(const StripMap<HypothesisBounds>& expected,
                   const StripMap<HypothesisBounds>& actual) {
    for (int v = rows().begin; v < rows().end; ++v)
      for (int u = 0; u < bench.width(); ++u) {
        EXPECT_LE(std::abs(expected.row(v)[u].first - actual.row(v)[u].first), 1) << u << " " << v;
        EXPECT_LE(std::abs(expected.row(v)[u].last - actual.row(v)[u].last), 1) << u << " " << v;
      }
  }

  ParityBench<EpiSampler> bench;
};

TEST_P(ParityWithoutDoubles, SelectTodo) {
  std::vector<Search> search(std::size_t(rows().size()) * bench.width());
  const HypothesisRange& range = bench.hypotheses();
  for (Search& pixel : search) {
    if (bench.uniform() < 0.2) continue;
    pixel.low = float(range.value(int(bench.uniform() * range.count)));
    pixel.high = pixel.low + float(0.2 * bench.uniform());
  }
  const auto disparity = bench.random_disparity(all(), 0.4);
  std::map<HostSteps*, StripMap<std::uint8_t>> todo;
  std::map<HostSteps*, StripMap<HypothesisBounds>> bounds;
  for (HostSteps* steps : {bench.reference.get(), bench.opencl.get()}) {
    const auto selected = steps->strip<std::uint8_t>(all());
    const auto wanted = steps->strip<HypothesisBounds>(all());
    steps->workspace().select_todo(rows(), steps->up(disparity), {}, {}, 0,
                                   {steps->up(search, rows().begin, 1), 0}, selected, wanted);
    todo[steps] = steps->workspace().get(selected);
    bounds[steps] = steps->workspace().get(wanted);
  }
  for (int v = rows().begin; v < rows().end; ++v)
    for (int u = 0; u < bench.width(); ++u)
      EXPECT_EQ(todo[bench.reference.get()].row(v)[u], todo[bench.opencl.get()].row(v)[u]);
  expect_near(bounds[bench.reference.get()], bounds[bench.opencl.get()]);
}

TEST_P(ParityWithoutDoubles, BoundThinHoles) {
  const auto todo = bench.random_todo(all());
  const StripMap<std::uint8_t> wide(bench.width(), all());
  const auto estimates = bench.random_disparity(all(), 0.05);
  const auto bounds = bench.random_bounds(all());
  std::map<HostSteps*, StripMap<HypothesisBounds>> narrowed;
  for (HostSteps* steps : {bench.reference.get(), bench.opencl.get()}) {
    const auto own = steps->up(bounds);
    steps->workspace().bound_thin_holes(rows(), steps->up(todo), steps->up(wide),
                                        steps->up(estimates), own);
    narrowed[steps] = steps->workspace().get(own);
  }
  expect_near(narrowed[bench.reference.get()], narrowed[bench.opencl.get()]);
}

TEST_P(ParityWithoutDoubles, WinnersOfTheLastLevel) {
  const auto todo = bench.random_todo(all());
  const auto bounds = bench.random_bounds(all());
  const auto winners = bench.random_disparity(rows(), 0.3), contrast = bench.random_values(rows());
  const auto disparity = bench.random_disparity(all(), 0.5);
  StripMap<float> expected(bench.width(), rows()), actual = expected;
  for (HostSteps* steps : {bench.reference.get(), bench.opencl.get()}) {
    const auto found = steps->strip<float>(rows()), lead = steps->strip<float>(rows());
    steps->workspace().put(winners, found);
    steps->workspace().put(contrast, lead);
    const auto taken = steps->up(disparity), confidence = steps->strip<float>(all());
    steps->workspace().take_winners(rows(), true, steps->up(todo), steps->up(bounds), found, lead,
                                    {}, {}, taken, confidence);
    steps->down(taken, rows(), steps == bench.reference.get() ? expected : actual);
  }
  const Difference difference = compare(expected, actual, rows());
  EXPECT_EQ(difference.one_sided, 0);
  EXPECT_LE(difference.largest, 1e-6);
}

TEST_P(ParityWithoutDoubles, CloseCracks) {
  const auto disparity = bench.random_disparity(all(), 0.5);
  const auto confidence = bench.random_values(all());
  StripMap<float> expected(bench.width(), rows()), actual = expected;
  for (HostSteps* steps : {bench.reference.get(), bench.opencl.get()}) {
    const auto closed = steps->strip<float>(all()), sure = steps->strip<float>(all());
    const RowsOnDevice views = steps->up(
        std::vector<PackedEstimate>(std::size_t(rows().size()) * bench.width()), rows().begin, 1);
    steps->workspace().close_cracks(rows(), 2, 1.0f, steps->up(disparity), steps->up(confidence),
                                    closed, sure, {views, 0});
    steps->down(closed, rows(), steps == bench.reference.get() ? expected : actual);
  }
  const Difference difference = compare(expected, actual, rows());
  EXPECT_EQ(difference.one_sided, 0);
  EXPECT_LE(difference.largest, 1e-6);
}

std::string name_of(const testing::TestParamInfo<ParityCase>& info) {
  return std::to_string(info.param.width) + "x" + std::to_string(info.param.height);
}
INSTANTIATE_TEST_SUITE_P(Sizes, ParityWithoutDoubles, testing::ValuesIn(parity_cases()), name_of);

TEST(LocalMemory, GroupsAreMadeSmallEnoughForIt) {
  // A window of 17 x 17 in groups of 64 takes 72 KiB, more than GPUs have for a group.
  const ParityCase size{33, 24, {11, 12}, BandEncoding::kFloat, 1};
  const opencl::TuningOverrides gpu{{"bilateral_median", {{"LANES", 1}, {"GROUP", 64}}},
                                    {opencl::kDeviceParts, {{"LOCAL_MEMORY", 48 << 10}}}};
  ParityBench<EpiSampler> bench(size, paper_options(), irregular_row(), {-1.31, 1.73, 19}, gpu);
  const auto in = bench.random_disparity(bench.around(8), 0.6);
  StripMap<float> expected(bench.width(), bench.rows()), actual = expected;
  bench.reference->bilateral_median(2, bench.rows(), 8, 0.1f, in, expected);
  bench.opencl->bilateral_median(2, bench.rows(), 8, 0.1f, in, actual);
  const Difference difference = compare(expected, actual, bench.rows());
  EXPECT_EQ(difference.largest, 0);
  EXPECT_EQ(difference.one_sided, 0);
}

TEST(LocalMemory, TooLittleForOneWorkItemIsAnErrorThatNamesTheKernel) {
  const opencl::TuningOverrides tiny{{opencl::kDeviceParts, {{"LOCAL_MEMORY", 256}}}};
  ParityBench<EpiSampler> bench({33, 24, {11, 12}, BandEncoding::kFloat, 1}, paper_options(),
                                irregular_row(), {-1.31, 1.73, 19}, tiny);
  const auto in = bench.random_disparity(bench.around(8), 0.6);
  StripMap<float> out(bench.width(), bench.rows());
  expect_error(ErrorCode::kDevice, {"bilateral_median", "local memory", "1 KiB"},
               [&] { bench.opencl->bilateral_median(2, bench.rows(), 8, 0.1f, in, out); });
}

}  // namespace
}  // namespace gigaray::testing_support
