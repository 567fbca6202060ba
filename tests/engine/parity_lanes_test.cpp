// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Every kernel with the tuning of a GPU, for every sampler, and every lane width, against the
// reference: what other devices run is tested here too.
#include <gtest/gtest.h>

#include "engine/lane_check.h"

namespace gigaray::testing_support {
namespace {

opencl::TuningOverrides tuned(int lanes, int group, int stage) {
  opencl::TuningOverrides overrides;
  for (const KernelTuning& kernel : tuning_in_force(select_device())) {
    overrides[kernel.kernel] = {{"LANES", lanes}, {"GROUP", group}};
    if (kernel.parameters.contains("STAGE")) overrides[kernel.kernel]["STAGE"] = stage;
  }
  return overrides;
}

template <class S>
class ParityOnAGpu : public testing::Test {
 protected:
  static void TearDownTestSuite() { ParityTable::instance().print(); }
};
using Samplers = testing::Types<EpiSampler, GridSampler, UnstructuredSampler>;
TYPED_TEST_SUITE(ParityOnAGpu, Samplers);

TYPED_TEST(ParityOnAGpu, Paper) {
  const auto tuning = tuned_for_a_gpu();
  for (const auto& [kernel, parameters] : tuning) {
    EXPECT_EQ(parameters.at("LANES"), 1) << kernel;
    EXPECT_GT(parameters.at("GROUP"), 1) << kernel << ": barriers";
  }
  LaneCheck<TypeParam>(", GPU", tuning).paper();
}

TYPED_TEST(ParityOnAGpu, Auto) { LaneCheck<TypeParam>(", GPU", tuned_for_a_gpu()).automatic(); }

class ParityLanes : public testing::Test {
 protected:
  static void TearDownTestSuite() { ParityTable::instance().print(); }
  static void check(const std::string& lanes, const opencl::TuningOverrides& tuning) {
    LaneCheck<EpiSampler>(lanes, tuning).paper();
    LaneCheck<EpiSampler>(lanes, tuning).automatic();
  }
};

TEST_F(ParityLanes, OneLaneStaged) { check(", 1 lane", tuned(1, 1, 1)); }

TEST_F(ParityLanes, FourLanesInGroupsOf3) { check(", 4 lanes", tuned(4, 3, 1)); }

TEST_F(ParityLanes, EightLanesNotStaged) { check(", 8 lanes", tuned(8, 1, 0)); }

TEST_F(ParityLanes, SixteenLanes) { check(", 16 lanes", tuned(16, 1, 1)); }

}  // namespace
}  // namespace gigaray::testing_support
