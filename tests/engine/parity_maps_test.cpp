// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Steps on maps of the reference view: nothing in them may round differently, so both workspaces
// give the same bits. They know no sampler.
#include "engine/same_outcome.h"

namespace gigaray::testing_support {
namespace {

using Bench = ParityBench<EpiSampler>;

class ParityMaps : public testing::TestWithParam<ParityCase> {
 protected:
  ParityMaps() : bench(GetParam(), options()) {}

  static DepthOptions options() {
    DepthOptions options = paper_options();
    options.winner.min_relief = 0.3f;
    return options;
  }

  RowRange rows() const { return bench.rows(); }
  RowRange all() const { return {0, bench.height()}; }
  StripMap<std::uint8_t> random_mask(RowRange rows, double share) {
    StripMap<std::uint8_t> mask(bench.width(), rows);
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < bench.width(); ++u) mask.row(v)[u] = bench.uniform() < share;
    return mask;
  }
  /// Few values, so that comparisons meet equal ones.
  StripMap<float> stepped_values(RowRange rows) {
    StripMap<float> map(bench.width(), rows);
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < bench.width(); ++u)
        map.row(v)[u] = bench.uniform() < 0.15 ? kNoEstimate : float(int(bench.uniform() * 8)) / 8;
    return map;
  }
  std::vector<std::uint8_t> random_bytes(std::size_t size, double share) {
    std::vector<std::uint8_t> bytes(size);
    for (std::uint8_t& byte : bytes) byte = bench.uniform() < share;
    return bytes;
  }

  Bench bench;
};

TEST_P(ParityMaps, EdgeMask) {
  const auto confidence = stepped_values(rows());
  expect_same(bench, [&](HostSteps& steps) {
    const auto strip = steps.strip<float>(rows());
    const auto mask = steps.strip<std::uint8_t>(rows());
    steps.workspace().put(confidence, strip);
    steps.workspace().edge_mask(rows(), strip, 0.5f, mask);
    return Outcome().add("mask", steps, mask, rows());
  });
}

TEST_P(ParityMaps, ErodeAndDilate) {
  const auto mask = random_mask(all(), 0.8);
  expect_same(bench, [&](HostSteps& steps) {
    // As masks are opened: strips that shrink by a row on both sides, clipped to the picture.
    const auto eroded = steps.strip<std::uint8_t>(bench.around(1));
    const auto opened = steps.strip<std::uint8_t>(rows());
    steps.workspace().erode(bench.around(1), steps.up(mask), eroded);
    steps.workspace().dilate(rows(), eroded, opened);
    return Outcome()
        .add("eroded", steps, eroded, bench.around(1))
        .add("opened", steps, opened, rows());
  });
}

TEST_P(ParityMaps, PutMask) {
  const auto mask = random_mask(bench.around(1), 0.5);
  const auto before = random_bytes(std::size_t(bench.around(2).size()) * 3 * bench.width(), 0.5);
  expect_same(bench, [&](HostSteps& steps) {
    const auto strip = steps.strip<std::uint8_t>(bench.around(1));
    steps.workspace().put(mask, strip);
    const RowsOnDevice views = steps.up(before, bench.around(2).begin, 3);
    steps.workspace().put_mask(rows(), strip, {views, 1});
    return Outcome().add<std::uint8_t>("mask of the view", steps, views);
  });
}

/// What select_todo may get: each of the three or not, what shows at the level or four times finer.
struct Selection {
  bool mask, shown, search;
  int shift;
};

TEST_P(ParityMaps, SelectTodo) {
  const auto disparity = bench.random_disparity(all(), 0.4);
  const RowRange stored = bench.around(2);
  const std::size_t pixels = std::size_t(stored.size()) * bench.width();
  const auto mask = random_bytes(2 * pixels, 0.7);
  std::vector<Search> search(3 * pixels);
  const HypothesisRange& range = bench.hypotheses();
  for (Search& pixel : search) {
    if (bench.uniform() < 0.2) continue;
    // Some bounds are beyond the range.
    const double a = range.min + (1.2 * bench.uniform() - 0.1) * (range.max - range.min);
    const double b = range.min + (1.2 * bench.uniform() - 0.1) * (range.max - range.min);
    pixel = {float(std::min(a, b)), float(std::max(a, b)), kNoEstimate, kNoEstimate};
    // Others are hypotheses, which rounding must not count as the next one.
    if (bench.uniform() < 0.5)
      pixel.low = float(range.value(int(bench.uniform() * range.count))), pixel.high = pixel.low;
  }
  for (const Selection& given :
       {Selection{false, false, false, 0}, Selection{true, false, false, 0},
        Selection{false, true, false, 0}, Selection{false, true, true, 2},
        Selection{true, true, true, 2}, Selection{true, false, true, 0}}) {
    const auto shown = random_bytes((pixels << (2 * given.shift)) * 2, 0.7);
    expect_same(bench, [&](HostSteps& steps) {
      ViewRows wanted, finer;
      ShownRows shows;
      if (given.mask) wanted = {steps.up(mask, stored.begin, 2), 1};
      if (given.search) finer = {steps.up(search, stored.begin, 3), 2};
      if (given.shown)
        shows = {steps.up(shown, stored.begin << given.shift, 2), bench.width() << given.shift,
                 given.shift};
      const auto todo = steps.strip<std::uint8_t>(all());
      const auto bounds = steps.strip<HypothesisBounds>(all());
      steps.workspace().select_todo(rows(), steps.up(disparity), wanted, shows, 1, finer, todo,
                                    bounds);
      return Outcome().add("todo", steps, todo, rows()).add("bounds", steps, bounds, rows());
    });
  }
}

TEST_P(ParityMaps, BoundThinHoles) {
  const auto todo = random_mask(all(), 0.7), wide = random_mask(all(), 0.3);
  const auto bounds = bench.random_bounds(all());
  // Neighbours alike, so that windows differ in what they hold; nothing in some of them.
  StripMap<float> estimates = bench.random_disparity(all(), 0.02);
  for (int v = 0; v < bench.height(); ++v)
    for (int u = 0; u < bench.width(); ++u)
      if (bench.uniform() < 0.05)
        estimates.row(v)[u] =
            float(bench.hypotheses().value(int(bench.uniform() * bench.hypotheses().count)));
  expect_same(bench, [&](HostSteps& steps) {
    const auto narrowed = steps.up(bounds);
    steps.workspace().bound_thin_holes(rows(), steps.up(todo), steps.up(wide), steps.up(estimates),
                                       narrowed);
    return Outcome().add("bounds", steps, narrowed, all());
  });
}

TEST_P(ParityMaps, GrowTodo) {
  const auto todo = random_mask(all(), 0.03);
  const auto bounds = bench.random_bounds(all());
  for (const int radius : {1, 5})
    expect_same(bench, [&](HostSteps& steps) {
      const auto grown = steps.strip<std::uint8_t>(all());
      const auto joined = steps.strip<HypothesisBounds>(all());
      steps.workspace().grow_todo(rows(), radius, steps.up(todo), steps.up(bounds), grown, joined);
      Outcome outcome = Outcome().add("grown todo", steps, grown, all());
      // Bounds of pixels that are not to do mean nothing.
      const StripMap<std::uint8_t> is_set = steps.workspace().get(grown);
      const StripMap<HypothesisBounds> values = steps.workspace().get(joined);
      std::vector<std::uint16_t> wanted;
      for (int v = rows().begin; v < rows().end; ++v)
        for (int u = 0; u < bench.width(); ++u)
          if (is_set.row(v)[u]) {
            wanted.push_back(values.row(v)[u].first);
            wanted.push_back(values.row(v)[u].last);
          }
      return outcome.add("grown bounds", wanted);
    });
}

TEST_P(ParityMaps, BesideJumps) {
  auto map = stepped_values(all());
  StripMap<float> flat(bench.width(), all());
  for (int v = 0; v < bench.height(); ++v)
    for (int u = 0; u < bench.width(); ++u) flat.row(v)[u] = bench.uniform() < 0.01;
  const auto todo = random_mask(all(), 0.7);
  for (const auto& [values, jump, reach] : {std::tuple(&map, 0.5f, 1), std::tuple(&flat, 0.5f, 4)})
    expect_same(bench, [&](HostSteps& steps) {
      const auto beside = steps.strip<std::uint8_t>(all());
      steps.workspace().beside_jumps(rows(), steps.up(*values), jump, reach, steps.up(todo),
                                     beside);
      return Outcome()
          .add("beside jumps", steps, beside, all())
          .add("todo", steps, steps.up(todo), rows());
    });
}

TEST_P(ParityMaps, Counts) {
  auto mask = random_mask(all(), 0.4);
  mask.row(0)[bench.width() - 1] = 255;  // counts once
  const auto estimates = bench.random_disparity(all(), 0.6);
  expect_same(bench, [&](HostSteps& steps) {
    return Outcome()
        .add("set", steps.workspace().count_rows(steps.up(mask)))
        .add("estimates", steps.workspace().count_estimates(steps.up(estimates)));
  });
}

TEST_P(ParityMaps, TakeWinners) {
  const auto todo = bench.random_todo(all());
  const auto bounds = bench.random_bounds(all());
  const auto winners = bench.random_disparity(rows(), 0.8);
  const auto contrast = bench.random_values(rows()), edges = bench.random_values(rows());
  auto best = stepped_values(rows());
  const auto disparity = bench.random_disparity(all(), 0.5),
             confidence = bench.random_values(all());
  for (int given = 0; given < 8; ++given)
    expect_same(bench, [&](HostSteps& steps) {
      const bool has_best = given & 1, has_edges = given & 2, is_last_level = given & 4;
      const auto up = [&](const StripMap<float>& values) {
        const auto strip = steps.strip<float>(rows());
        steps.workspace().put(values, strip);
        return strip;
      };
      const auto taken = steps.up(disparity), sure = steps.up(confidence);
      steps.workspace().take_winners(rows(), is_last_level, steps.up(todo), steps.up(bounds),
                                     up(winners), up(contrast), has_best ? up(best) : Map<float>(),
                                     has_edges ? up(edges) : Map<float>(), taken, sure);
      return Outcome().add("disparity", steps, taken, all()).add("confidence", steps, sure, all());
    });
}

TEST_P(ParityMaps, StepBack) {
  const auto winners = stepped_values(rows()), contrast = bench.random_values(rows());
  const auto best = stepped_values(rows()), own = stepped_values(rows());
  const auto disparity = stepped_values(all()), confidence = bench.random_values(all());
  expect_same(bench, [&](HostSteps& steps) {
    const auto up = [&](const StripMap<float>& values) {
      const auto strip = steps.strip<float>(rows());
      steps.workspace().put(values, strip);
      return strip;
    };
    const auto stepped = steps.up(disparity), sure = steps.up(confidence);
    steps.workspace().step_back(rows(), 0.125f, up(winners), up(contrast), up(best), up(own),
                                stepped, sure);
    return Outcome().add("disparity", steps, stepped, all()).add("confidence", steps, sure, all());
  });
}

TEST_P(ParityMaps, Accept) {
  const auto todo = bench.random_todo(all());
  const auto confidence = stepped_values(all());
  const auto estimates = bench.random_disparity(all(), 0.8);
  expect_same(bench, [&](HostSteps& steps) {
    const auto accepted = steps.up(estimates);
    steps.workspace().accept(rows(), 0.5f, steps.up(todo), steps.up(confidence), accepted);
    return Outcome().add("estimates", steps, accepted, all());
  });
}

std::string name_of(const testing::TestParamInfo<ParityCase>& info) {
  return std::to_string(info.param.width) + "x" + std::to_string(info.param.height);
}
INSTANTIATE_TEST_SUITE_P(Sizes, ParityMaps, testing::ValuesIn(parity_cases()), name_of);

}  // namespace
}  // namespace gigaray::testing_support
