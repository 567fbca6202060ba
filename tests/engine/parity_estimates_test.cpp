// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Steps on the estimates of all active views: the same bits from both workspaces.
#include "engine/same_outcome.h"

namespace gigaray::testing_support {
namespace {

class ParityEstimates : public testing::TestWithParam<ParityCase> {
 protected:
  ParityEstimates() : bench(GetParam(), paper_options()) {}

  RowRange rows() const { return bench.rows(); }
  RowRange all() const { return {0, bench.height()}; }
  PackedEstimate random_estimate() {
    const HypothesisRange& range = bench.hypotheses();
    return pack_estimate(float(range.min + bench.uniform() * (range.max - range.min)),
                         float(bench.uniform()));
  }
  /// Rows of `views` views.
  std::vector<PackedEstimate> random_estimates(RowRange rows, int views, double share) {
    std::vector<PackedEstimate> estimates(std::size_t(rows.size()) * views * bench.width());
    for (PackedEstimate& estimate : estimates)
      if (bench.uniform() < share) estimate = random_estimate();
    return estimates;
  }

  /// Of maps that go into files, where NaNs are not all alike.
  std::vector<std::uint32_t> bits_of(HostSteps& steps, const Map<float>& map) const {
    const StripMap<float> values = steps.workspace().get(map);
    std::vector<std::uint32_t> bits;
    for (int v = 0; v < bench.height(); ++v)
      for (int u = 0; u < bench.width(); ++u)
        bits.push_back(std::bit_cast<std::uint32_t>(values.row(v)[u]));
    return bits;
  }

  ParityBench<EpiSampler> bench;
};

TEST_P(ParityEstimates, Unpack) {
  const auto estimates = random_estimates(bench.around(1), 3, 0.6);
  expect_same(bench, [&](HostSteps& steps) {
    const auto disparity = steps.strip<float>(all()), confidence = steps.strip<float>(all());
    steps.workspace().unpack_estimates(rows(), {steps.up(estimates, bench.around(1).begin, 3), 2},
                                       disparity, confidence);
    return Outcome()
        .add("disparity", steps, disparity, all())
        .add("confidence", steps, confidence, all());
  });
}

TEST_P(ParityEstimates, CloseCracks) {
  auto disparity = bench.random_disparity(all(), 0.5);
  // Surfaces beside each other, so that some holes are between two that differ.
  for (int v = 0; v < bench.height(); ++v)
    for (int u = 0; u < bench.width(); ++u)
      disparity.row(v)[u] = 0.1f * disparity.row(v)[u] + float(u / 5 % 2) + float(v / 7 % 2);
  const auto confidence = bench.random_values(all());
  const auto estimates = random_estimates(bench.around(1), 2, 0.3);
  for (const int width : {1, 2, 5})
    expect_same(bench, [&](HostSteps& steps) {
      const auto closed = steps.strip<float>(all()), sure = steps.strip<float>(all());
      const RowsOnDevice views = steps.up(estimates, bench.around(1).begin, 2);
      steps.workspace().close_cracks(rows(), width, 0.3f, steps.up(disparity), steps.up(confidence),
                                     closed, sure, {views, 1});
      return Outcome()
          .add("closed", steps, closed, rows())
          .add("confidence", steps, sure, rows())
          .add<PackedEstimate>("estimates of the view", steps, views);
    });
}

TEST_P(ParityEstimates, CompactTuples) {
  const auto disparity = bench.random_disparity(all(), 0.4),
             confidence = bench.random_values(all());
  StripMap<Radiance> radiance(bench.width(), all());
  for (int v = 0; v < bench.height(); ++v)
    for (int u = 0; u < bench.width(); ++u)
      radiance.row(v)[u] = {float(bench.uniform()), float(bench.uniform()), float(bench.uniform())};
  expect_same(bench, [&](HostSteps& steps) {
    const std::size_t most = std::size_t(rows().size()) * bench.width();
    const RowsOnDevice tuples{steps.workspace().allocate(most * sizeof(RayTuple)), 0, 1};
    const int count = steps.workspace().compact_tuples(
        3, rows(), steps.up(disparity), steps.up(confidence), steps.up(radiance), *tuples.memory);
    std::vector<std::uint32_t> bits(most * sizeof(RayTuple) / sizeof(std::uint32_t));
    steps.down(tuples, bits);
    return Outcome().add("count", std::vector<int>{count}).add("tuples", bits);
  });
}

TEST_P(ParityEstimates, CoarsenBounds) {
  const RowRange coarse{rows().begin / 2, (rows().end + 1) / 2};
  const RowRange fine{2 * coarse.begin, std::min(2 * coarse.end, bench.height())};
  // Few, so that some coarse pixels know nothing; wide holes between them.
  const auto estimates = random_estimates(fine, 3, 0.15);
  std::vector<Search> search(std::size_t(fine.size()) * 2 * bench.width());
  for (Search& pixel : search) {
    const float a = hypothesis_of(random_estimate()), b = hypothesis_of(random_estimate());
    if (bench.uniform() < 0.7) pixel.low = std::min(a, b), pixel.high = std::max(a, b);
    if (bench.uniform() < 0.4) pixel.known_low = std::min(a, b), pixel.known_high = std::max(a, b);
  }
  const int width = (bench.width() + 1) / 2;
  for (const bool has_search : {false, true})
    expect_same(bench, [&](HostSteps& steps) {
      const std::vector<float> nothing(std::size_t(coarse.size()) * 2 * width * 4, -1.0f);
      const RowsOnDevice out = steps.up(nothing, coarse.begin, 2);
      steps.workspace().coarsen_bounds(
          coarse, {steps.up(estimates, fine.begin, 3), 1},
          has_search ? ViewRows{steps.up(search, fine.begin, 2), 1} : ViewRows(), {out, 1});
      return Outcome().add<float>("search", steps, out);
    });
}

TEST_P(ParityEstimates, FillView) {
  const int width = bench.width(), height = bench.height();
  const LevelShape shape{1, width, height};
  const auto estimates = random_estimates(all(), 2, 0.4);
  StripMap<float> above((width + 1) / 2, {0, (height + 1) / 2}), sure = above;
  StripMap<std::int8_t> decided(above.width(), above.rows());
  for (int v = 0; v < above.rows().end; ++v)
    for (int u = 0; u < above.width(); ++u) {
      decided.row(v)[u] = std::int8_t(2 + bench.uniform() * 3);
      above.row(v)[u] = float(bench.uniform());
      sure.row(v)[u] = float(bench.uniform());
      if (bench.uniform() < 0.2)
        decided.row(v)[u] = -1, above.row(v)[u] = sure.row(v)[u] = kNoEstimate;
    }
  std::vector<std::uint8_t> shown(std::size_t(width) * height * 3);
  for (std::uint8_t& byte : shown) byte = bench.uniform() < 0.7;
  for (int given = 0; given < 4; ++given)
    expect_same(bench, [&](HostSteps& steps) {
      const bool has_coarse = given & 1, has_shown = given & 2;
      const auto make_maps = [&](int w, int h) {
        Workspace& workspace = steps.workspace();
        return ViewMaps{workspace.make_map<float>(w, {0, h}), workspace.make_map<float>(w, {0, h}),
                        workspace.make_map<std::int8_t>(w, {0, h})};
      };
      ViewMaps coarse;
      if (has_coarse) {
        coarse = make_maps(above.width(), above.rows().end);
        steps.workspace().put(above, coarse.disparity);
        steps.workspace().put(sure, coarse.confidence);
        steps.workspace().put(decided, coarse.level);
      }
      ShownRows shows;
      if (has_shown) shows = {steps.up(shown, 0, 3), width, 0};
      const ViewMaps maps = make_maps(width, height);
      steps.workspace().fill_view(rows(), shape, {steps.up(estimates, 0, 2), 1}, coarse, shows, 2,
                                  maps);
      return Outcome()
          .add("disparity", bits_of(steps, maps.disparity))
          .add("confidence", bits_of(steps, maps.confidence))
          .add("level", steps, maps.level, all());
    });
}

std::string name_of(const testing::TestParamInfo<ParityCase>& info) {
  return std::to_string(info.param.width) + "x" + std::to_string(info.param.height);
}
INSTANTIATE_TEST_SUITE_P(Sizes, ParityEstimates, testing::ValuesIn(parity_cases()), name_of);

}  // namespace
}  // namespace gigaray::testing_support
