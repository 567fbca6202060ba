// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Partitions of rows: the same bits, whoever works on them.
#include "src/partition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <mutex>

#include "engine/cache_fixture.h"
#include "engine/planned_run.h"
#include "gigaray/engine/estimator.h"
#include "opencl/device.h"
#include "support/analytic_field.h"
#include "support/errors.h"
#include "support/posed_field.h"

namespace gigaray::testing_support {
namespace {

constexpr int kHypotheses = 19;

void expect_partitions_alike(const std::string& backend, const LightField& light_field,
                             const DepthOptions& options) {
  const ScopedFolder work;
  const PlannedRun expected(light_field, options, backend, {});
  EXPECT_GT(expected.tuples.size(), std::size_t(light_field.width) * light_field.height / 2);
  for (const int partitions : {2, 3}) {
    Cut whole, bands{8}, own_memory;
    whole.partitions = bands.partitions = own_memory.partitions = partitions;
    bands.in_files(work.path);
    own_memory.device_shares_memory = false;
    const std::string what = backend + " in " + std::to_string(partitions) + " partitions";
    PlannedRun(light_field, options, backend, whole).expect_same(expected, what);
    if (partitions == 3)
      PlannedRun(light_field, options, backend, bands).expect_same(expected, what + " and bands");
    else if (backend == "opencl")
      PlannedRun(light_field, options, backend, own_memory)
          .expect_same(expected, what + " of devices with memory of their own");
  }
}

TEST(Partitions, GiveTheSameBitsInTheReference) {
  DepthOptions options = small_job("auto", kHypotheses);
  options.hypotheses = 13;
  options.support.radius = 2;
  expect_partitions_alike("reference", card_before_wall(row_of_views(3), 27, 131).light_field,
                          options);
  expect_partitions_alike("reference", card_before_wall(grid_of_views(2, 2), 31, 97).light_field,
                          options);
}

TEST(Partitions, GiveTheSameBitsForARow) {
  for (const char* preset : {"paper", "auto"})
    expect_partitions_alike("opencl", card_before_wall(irregular_row(), 45, 261).light_field,
                            small_job(preset, kHypotheses));
}

TEST(Partitions, GiveTheSameBitsForAGrid) {
  for (const char* preset : {"paper", "auto"})
    expect_partitions_alike("opencl", card_before_wall(irregular_grid(), 41, 163).light_field,
                            small_job(preset, kHypotheses));
}

std::vector<View> posed_grid() {
  std::vector<View> grid = grid_of_views(3, 2);
  for (View& view : grid) {
    view.s *= 0.15;
    view.t *= 0.15;
  }
  return grid;
}

DepthResult depth(const Estimator& estimator, const LightField& light_field,
                  const DepthOptions& options) {
  return all_of(estimator.reconstruct(light_field, options, RunControl{}));
}

TEST(Partitions, GiveTheSameBitsForPosedCamerasOnDevicesOfOneEstimator) {
  const LightField light_field =
      posed_field(cameras_around(posed_grid(), 90, 131), posed_grid()).light_field;
  const Device device = Device::open();
  for (const char* preset : {"paper", "auto"}) {
    DepthOptions options = preset_options(preset);
    options.hypotheses = 24;
    const DepthResult expected = depth(Estimator(device), light_field, options);
    EXPECT_FALSE(expected.tuples.empty());
    expect_identical(expected, depth(Estimator({device, device}), light_field, options), preset);
    expect_identical(expected, depth(Estimator({device, device, device}), light_field, options),
                     preset);
  }
}

TEST(Partitions, OnPartsOfACpuGiveTheSameBits) {
  const opencl::Device whole = opencl::Device::open();
  if (whole.info().type != DeviceType::kCpu || whole.info().compute_units < 2) {
    EXPECT_THROW(whole.split(2), Error);  // nothing that has parts
    return;
  }
  std::vector<Device> halves;
  for (const opencl::Device& part : whole.split(2))
    halves.emplace_back(std::make_shared<const opencl::Device>(part));
  const LightField light_field = card_before_wall(grid_of_views(3, 3), 61, 97).light_field;
  const Estimator estimator(halves);
  expect_identical(depth(Estimator(), light_field, small_job("auto", kHypotheses)),
                   depth(estimator, light_field, small_job("auto", kHypotheses)), "two halves");
  const Reconstruction result =
      estimator.reconstruct(light_field, small_job("paper", kHypotheses), RunControl{});
  EXPECT_NE(result.device().find("; " + halves[1].info().name), std::string::npos)
      << result.device();
}

TEST(Partitions, AnEstimatorWithoutADeviceIsRefused) {
  expect_error(ErrorCode::kInvalidArgument, {"needs a device"},
               [] { Estimator(std::vector<Device>()); });
}

TEST(Partitions, CancellingEndsAllOfThem) {
  const LightField light_field = card_before_wall(grid_of_views(3, 3), 41, 97).light_field;
  RunControl control;
  int reports = 0;
  control.on_progress = [&](const std::string& stage, double, double) {
    if (stage == "level 0" && ++reports == 3) control.cancel();
  };
  Cut cut;
  cut.partitions = 3;
  expect_error(ErrorCode::kCancelled, {}, [&] {
    PlannedRun(light_field, small_job("auto", kHypotheses), "opencl", cut, control);
  });
  EXPECT_GE(reports, 3);
}

// ---- Rows ---------------------------------------------------------------------------------------

std::vector<std::vector<PartitionRows>> rows_of(const LightField& light_field,
                                                const DepthOptions& options, int partitions) {
  const HypothesisRange hypotheses{-1, 2, 19};
  DepthOptions planned = options;
  planned.memory_bytes = 4e9;
  const MemoryPlan plan = plan_memory(light_field, planned, hypotheses, DeviceLimits{});
  return partition_rows(plan, options, make_sampler(light_field), hypotheses,
                        all_views(light_field.num_views()), partitions);
}

bool within(RowRange a, RowRange b) { return a.begin >= b.begin && a.end <= b.end; }

TEST(PartitionRows, OwnRowsMeetAndTheOthersLieAroundThem) {
  for (const char* preset : {"paper", "auto"}) {
    const LightField light_field = card_before_wall(grid_of_views(3, 3), 41, 1003).light_field;
    DepthOptions options = small_job(preset, kHypotheses);
    options.support.fill_hidden = false;  // as prepared by reconstruct(): there are more views
    const auto all = rows_of(light_field, options, 4);
    ASSERT_EQ(all.size(), 4u);
    int height = light_field.height;
    for (std::size_t level = 0; level < all[0].size(); ++level) {
      EXPECT_EQ(all.back()[level].own.end, height);
      for (std::size_t i = 0; i < all.size(); ++i) {
        const PartitionRows& rows = all[i][level];
        EXPECT_GT(rows.own.size(), 0);
        EXPECT_EQ(rows.own.begin, i > 0 ? all[i - 1][level].own.end : 0);
        EXPECT_TRUE(within(rows.own, rows.swept));
        EXPECT_TRUE(within(rows.swept, rows.todo));
        EXPECT_TRUE(within(rows.todo, rows.unpacked));
        EXPECT_TRUE(within(rows.unpacked, rows.pixels));
      }
      height = (height + 1) / 2;
    }
    // Each does a part of the work.
    for (const auto& rows : all) EXPECT_LT(rows[0].swept.size(), 600);
  }
}

TEST(PartitionRows, OneHasAllAndSmallPicturesAreNotCutIntoNothing) {
  const LightField light_field = card_before_wall(row_of_views(3), 41, 67).light_field;
  const RowRange all{0, 67};
  EXPECT_EQ(rows_of(light_field, small_job("auto", kHypotheses), 1).front().front(),
            (PartitionRows{all, all, all, all, all}));
  const auto most = rows_of(light_field, small_job("auto", kHypotheses), 100);
  EXPECT_GT(most.size(), 1u);
  EXPECT_LE(most.size(), 5u);  // blocks of 16 rows
  for (const auto& partition : most)
    for (const PartitionRows& rows : partition) EXPECT_GT(rows.own.size(), 0);
}

// ---- What passes between them -------------------------------------------------------------------

TEST(RunPartitions, BringsWhatOthersHave) {
  constexpr int kPartitions = 3, kRowsEach = 4, kRows = kPartitions * kRowsEach;
  std::vector<std::vector<int>> rows(kPartitions, std::vector<int>(kRows, -1));
  run_partitions(kPartitions, [&](Partition& partition) {
    std::vector<int>& mine = rows[partition.index()];
    EXPECT_EQ(partition.count(), kPartitions);
    const RowRange own{partition.index() * kRowsEach, (partition.index() + 1) * kRowsEach};
    for (int v = own.begin; v < own.end; ++v) mine[v] = 100 + v;
    for (const int around : {1, 6}) {
      partition.bring({own, grown(own, around, kRows), sizeof(int),
                       [&](RowRange part, std::byte* out) {
                         std::memcpy(out, &mine[part.begin], part.size() * sizeof(int));
                       },
                       [&](RowRange part, const std::byte* in) {
                         std::memcpy(&mine[part.begin], in, part.size() * sizeof(int));
                       }});
      for (int v = 0; v < kRows; ++v)
        EXPECT_EQ(mine[v], grown(own, around, kRows).contains(v) ? 100 + v : -1) << v;
    }
  });
}

TEST(RunPartitions, SumsOverAllAndTakesTurns) {
  std::vector<int> order;
  run_partitions(4, [&](Partition& partition) {
    for (int round = 0; round < 100; ++round) {
      EXPECT_EQ(partition.sum(partition.index() + round), 6 + 4 * round);
      partition.in_turn([&] { order.push_back(partition.index()); });
    }
  });
  ASSERT_EQ(order.size(), 400u);
  for (std::size_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[i], int(i % 4));
}

TEST(RunPartitions, WhatOneThrowsEndsTheOthers) {
  for (const int who : {0, 2}) {
    std::mutex mutex;
    int begun = 0, gone_on = 0;
    expect_error(ErrorCode::kDevice, {"lost"}, [&] {
      run_partitions(3, [&](Partition& partition) {
        {
          const std::lock_guard lock(mutex);
          ++begun;
        }
        partition.sum(0);
        if (partition.index() == who) throw Error(ErrorCode::kDevice, "lost");
        partition.sum(0);
        const std::lock_guard lock(mutex);
        ++gone_on;
      });
    });
    EXPECT_EQ(begun, 3);
    EXPECT_EQ(gone_on, 0);
  }
}

}  // namespace
}  // namespace gigaray::testing_support
