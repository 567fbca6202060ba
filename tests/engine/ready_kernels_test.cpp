// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/ready_kernels.h"

#include <gtest/gtest.h>

#include "engine/cache_fixture.h"
#include "gigaray/engine/device.h"
#include "gigaray/engine/reconstruct.h"
#include "opencl/pocl_cache.h"
#include "support/analytic_field.h"

namespace gigaray::opencl {
namespace {

using namespace testing_support;

using ReadyKernels = CacheFixture;

TEST_F(ReadyKernels, AreReadyAfterARunOfTheirKindUntilTheCacheIsCleared) {
  EXPECT_FALSE(kernels_are_ready("a"));
  note_ready_kernels("a");
  EXPECT_TRUE(kernels_are_ready("a"));
  EXPECT_FALSE(kernels_are_ready("b"));
  clear_kernel_cache();
  EXPECT_FALSE(kernels_are_ready("a"));
}

TEST_F(ReadyKernels, AreNotReadyWithoutACache) {
  const ScopedVariable off("GIGARAY_CACHE", "off");
  note_ready_kernels("a");
  EXPECT_FALSE(kernels_are_ready("a"));
}

TEST_F(ReadyKernels, AreForgottenWithDamagedPrograms) {
  note_ready_kernels("a");
  std::filesystem::create_directories(folder_ / "gigaray-pocl/AB/NEW");
  overwrite(folder_ / "gigaray-pocl/AB/NEW/program.bc", "of a run that was killed");
  const PoclCache cache(folder_ / "gigaray-pocl");
  EXPECT_FALSE(kernels_are_ready("a"));
}

TEST_F(ReadyKernels, TheForecastLeavesOutTheCompilerOnceTheyAreReady) {
  const AnalyticField field = analytic_field(61, 47, row_of_views(5), {{0.5}});
  DepthOptions options = paper_options();
  options.disparity = DisparityRange{-1, 2};
  options.hypotheses = 31;
  options.memory_bytes = 4e9;
  const Forecast cold = forecast(field.light_field, options);
  const RunControl control;
  const Reconstruction run = reconstruct(field.light_field, options, {}, control);
  EXPECT_EQ(run.forecast().memory_bytes, cold.memory_bytes);
  const Forecast warm = forecast(field.light_field, options);
  EXPECT_LT(warm.memory_bytes, cold.memory_bytes - (64 << 20));
  EXPECT_EQ(warm.bands, cold.bands);
}

}  // namespace
}  // namespace gigaray::opencl
