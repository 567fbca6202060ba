// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/engine/estimator.h"

#include <gtest/gtest.h>

#include <functional>
#include <thread>

#include "opencl/device.h"
#include "support/analytic_field.h"
#include "support/depth_result.h"

namespace gigaray::testing_support {
namespace {

/// Light fields and options that differ in their kernels and in the sizes of their maps.
struct Job {
  LightField light_field;
  DepthOptions options;

  static Job row() {
    Job job{analytic_field(77, 41, row_of_views(5), {{0.4, 3}, Layer{1.1, 7}}).light_field,
            auto_options()};
    job.options.disparity = DisparityRange{-1, 2};
    job.options.hypotheses = 31;
    return job;
  }
  static Job grid() {
    Job job{analytic_field(51, 37, grid_of_views(3, 3), {{-0.3, 3}, Layer{0.9, 7}}).light_field,
            paper_options()};
    job.options.disparity = DisparityRange{-1, 2};
    job.options.hypotheses = 19;
    return job;
  }
};

DepthResult run(const Estimator& estimator, const Job& job) {
  const RunControl control;
  return all_of(estimator.reconstruct(job.light_field, job.options, control));
}

/// The programs of a device, and how they came about.
opencl::ProgramCounters counters(const Estimator& estimator) {
  return estimator.devices().front().opened().counters();
}

/// Calls two functions in two threads, as near to each other as can be.
void at_once(const std::function<void()>& first, const std::function<void()>& second) {
  std::thread other(second);
  first();
  other.join();
}

TEST(Estimators, SecondCallGivesTheSameBitsAndMakesNoProgram) {
  const Job job = Job::row();
  const Estimator estimator;
  const DepthResult first = run(estimator, job);
  const auto after_first = counters(estimator);
  EXPECT_GT(after_first.built + after_first.loaded, 0);
  expect_identical(first, run(estimator, job), "second call");
  const auto after_second = counters(estimator);
  EXPECT_EQ(after_second.built, after_first.built);
  EXPECT_EQ(after_second.loaded, after_first.loaded);
  EXPECT_GT(after_second.reused, after_first.reused);
}

TEST(Estimators, CallsOfOtherSizesBetweenChangeNothing) {
  const Job row = Job::row(), grid = Job::grid();
  const Estimator estimator;
  const DepthResult first = run(estimator, row), other = run(estimator, grid);
  expect_identical(first, run(estimator, row), "row after grid");
  expect_identical(other, run(estimator, grid), "grid after row");
}

TEST(Estimators, GiveWhatTheOneOffGives) {
  const Job job = Job::grid();
  const RunControl control;
  for (const char* backend : {"opencl", "reference"}) {
    const Estimator estimator = Estimator::of({backend, ""});
    EXPECT_EQ(estimator.devices().size(), std::string(backend) == "opencl" ? 1u : 0u);
    expect_identical(all_of(reconstruct(job.light_field, job.options, {backend, ""}, control)),
                     run(estimator, job), backend);
    const ScoreCurve once = probe(job.light_field, job.options, {backend, ""}, 4, 20, 10, control);
    const ScoreCurve again = estimator.probe(job.light_field, job.options, 4, 20, 10, control);
    EXPECT_EQ(once.scores, again.scores) << backend;
    EXPECT_EQ(once.disparity, again.disparity) << backend;
  }
  EXPECT_THROW(Estimator::of({"none", ""}), Error);
}

TEST(Estimators, ProbeManyPixelsAsOneByOne) {
  const RunControl control;
  const std::vector<PixelIndex> pixels{{20, 10}, {0, 0}, {22, 10}, {5, 17}, {20, 10}};
  for (const Job& job : {Job::row(), Job::grid()}) {
    const Estimator estimator;
    const auto together = estimator.probe(job.light_field, job.options, 2, pixels, control);
    ASSERT_EQ(together.size(), pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      const ScoreCurve alone =
          estimator.probe(job.light_field, job.options, 2, pixels[i].u, pixels[i].v, control);
      EXPECT_EQ(together[i].scores, alone.scores) << i;
      EXPECT_EQ(together[i].disparity, alone.disparity) << i;
      EXPECT_EQ(together[i].confidence, alone.confidence) << i;
    }
  }
  EXPECT_TRUE(
      Estimator().probe(Job::row().light_field, Job::row().options, 2, {}, control).empty());
  EXPECT_THROW(
      Estimator().probe(Job::row().light_field, Job::row().options, 2, {{1, 1}, {-1, 0}}, control),
      Error);
}

TEST(Estimators, OfOneDeviceWorkAtOnce) {
  const Job row = Job::row(), grid = Job::grid();
  const DepthResult row_alone = run(Estimator(), row), grid_alone = run(Estimator(), grid);
  const Device device = Device::open();
  const Estimator first(device), second(device);
  // Kernels are built by both; then each uses what the other one built.
  at_once([&] { expect_identical(row_alone, run(first, row), "row"); },
          [&] { expect_identical(grid_alone, run(second, grid), "grid"); });
  const auto built = counters(first).built + counters(first).loaded;
  at_once([&] { expect_identical(grid_alone, run(first, grid), "grid of the first"); },
          [&] { expect_identical(row_alone, run(second, row), "row of the second"); });
  EXPECT_EQ(counters(second).built + counters(second).loaded, built);
}

TEST(Estimators, OneMayBeCalledByTwoThreadsAtOnce) {
  const Job row = Job::row(), grid = Job::grid();
  const Estimator estimator;
  const DepthResult row_alone = run(estimator, row), grid_alone = run(estimator, grid);
  const auto before = counters(estimator);
  at_once([&] { expect_identical(row_alone, run(estimator, row), "row beside grid"); },
          [&] { expect_identical(grid_alone, run(estimator, grid), "grid beside row"); });
  at_once([&] { expect_identical(row_alone, run(estimator, row), "row beside row"); },
          [&] { expect_identical(row_alone, run(estimator, row), "row beside row"); });
  const auto after = counters(estimator);
  EXPECT_EQ(after.built, before.built);
  EXPECT_EQ(after.loaded, before.loaded);
}

TEST(Estimators, OfTwoDevicesWorkAtOnce) {
  const Job row = Job::row(), grid = Job::grid();
  const Estimator first, second;
  const DepthResult row_alone = run(first, row), grid_alone = run(second, grid);
  at_once([&] { expect_identical(row_alone, run(second, row), "row"); },
          [&] { expect_identical(grid_alone, run(first, grid), "grid"); });
}

TEST(Estimators, OfPartsOfACpuGiveTheSameBitsAndOtherDevicesAreNotSplit) {
  const Job job = Job::row();
  const opencl::Device whole = opencl::Device::open();
  EXPECT_THROW(whole.split(whole.info().compute_units + 1), Error);
  if (whole.info().type != DeviceType::kCpu || whole.info().compute_units < 2) {
    // GPUs have no parts, and one unit is not cut.
    EXPECT_THROW(whole.split(2), Error);
    return;
  }
  const DepthResult expected = run(Estimator(), job);
  std::vector<Estimator> halves;
  for (const opencl::Device& part : whole.split(2)) {
    EXPECT_EQ(part.info().compute_units, whole.info().compute_units / 2);
    halves.emplace_back(Device(std::make_shared<const opencl::Device>(part)));
  }
  ASSERT_EQ(halves.size(), 2u);
  at_once([&] { expect_identical(expected, run(halves[0], job), "first half"); },
          [&] { expect_identical(expected, run(halves[1], job), "second half"); });
}

TEST(Estimators, GoOnAfterACallThatFailed) {
  Job job = Job::row();
  const Estimator estimator;
  const DepthResult expected = run(estimator, job);
  RunControl control;
  int steps = 0;
  control.on_progress = [&](const std::string&, double, double) {
    if (++steps == 5) control.cancel();
  };
  EXPECT_THROW(estimator.reconstruct(job.light_field, job.options, control), Error);
  expect_identical(expected, run(estimator, job), "after a cancelled one");
}

}  // namespace
}  // namespace gigaray::testing_support
