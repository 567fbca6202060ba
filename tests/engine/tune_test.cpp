// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/engine/tune.h"

#include <gtest/gtest.h>

#include "engine/cache_fixture.h"
#include "gigaray/engine/device.h"
#include "tuning/kernel_trial.h"

namespace gigaray {
namespace {

TuneTrial trial(bool agrees, double seconds) { return {{{"LANES", 4}}, agrees, 0, seconds, ""}; }

TEST(BestTrial, SettingThatDisagreesIsDroppedHoweverFast) {
  EXPECT_EQ(best_trial({trial(true, 3), trial(false, 0.1), trial(true, 2)}), 2);
}

TEST(BestTrial, NothingIsChosenWhenNothingAgrees) {
  EXPECT_EQ(best_trial({trial(false, 1), trial(false, 2)}), std::nullopt);
  EXPECT_EQ(best_trial({}), std::nullopt);
}

TEST(BestTrial, SettingInForceStaysUnlessAnotherIsClearlyFaster) {
  EXPECT_EQ(best_trial({trial(true, 1), trial(true, 0.99)}), 0);
  EXPECT_EQ(best_trial({trial(true, 1), trial(true, 0.9)}), 1);
  EXPECT_EQ(best_trial({trial(true, 1), trial(true, 0.9), trial(true, 0.89)}), 2);
}

TEST(BestTrial, WrongSettingInForceIsReplacedBySlowerRightOne) {
  EXPECT_EQ(best_trial({trial(false, 1), trial(true, 5)}), 1);
}

TEST(KernelTrial, OneWrongLaneInSixteenDoesNotAgree) {
  std::vector<float> expected(37 * 17, 0.5f), actual = expected;
  EXPECT_TRUE(KernelTrial::compare("density_score", expected, actual).good());
  for (std::size_t i = 0; i < actual.size(); i += 16) actual[i] += 0.01f;
  EXPECT_FALSE(KernelTrial::compare("density_score", expected, actual).good());
}

TEST(KernelTrial, MissingValuesDoNotAgree) {
  const std::vector<float> expected(100, 0.5f), actual(100, kNoEstimate);
  EXPECT_FALSE(KernelTrial::compare("winner", expected, actual).good());
}

using Tune = CacheFixture;

TEST_F(Tune, StoresRightSettingsThatStillAgree) {
  const std::vector<std::string> kernels = {"edge_confidence", "winner"};
  const auto results = tune_device("", RunControl{}, kernels);
  ASSERT_EQ(results.size(), kernels.size());
  const auto in_force = tuning_in_force(select_device());
  for (const TuneResult& result : results) {
    ASSERT_TRUE(result.best) << result.kernel;
    const TuneTrial& best = result.trials[*result.best];
    for (const TuneTrial& trial : result.trials)
      EXPECT_TRUE(trial.agrees) << result.kernel << ": " << trial.difference << trial.failure;
    for (const KernelTuning& tuning : in_force)
      if (tuning.kernel == result.kernel) {
        EXPECT_EQ(tuning.origin, "user");
        EXPECT_EQ(tuning.parameters, best.parameters);
      }
    KernelTrial check(KernelTrial::check_shape({}), paper_options());
    EXPECT_TRUE(KernelTrial::compare(result.kernel, check.answer(*check.reference(), result.kernel),
                                     check.answer(*check.opencl(Device::open()), result.kernel))
                    .good())
        << result.kernel;
  }
}

TEST_F(Tune, CancelledStoresNothing) {
  RunControl control;
  control.cancel();
  EXPECT_THROW(tune_device("", control), Error);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "kernel_tuning.txt"));
}

TEST_F(Tune, WithoutACacheSaysSoBeforeTheWork) {
  const ScopedVariable off("GIGARAY_CACHE", "off");
  try {
    tune_device("", RunControl{});
    FAIL() << "it tuned";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kIo);
  }
}

}  // namespace
}  // namespace gigaray
