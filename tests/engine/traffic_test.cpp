// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// What a run moves between host and device, and how often it waits, view by view.
#include <gtest/gtest.h>

#include <map>
#include <memory>

#include "gigaray/samplers/any_sampler.h"
#include "opencl/device.h"
#include "opencl/opencl_workspace.h"
#include "src/make_workspace.h"
#include "src/run.h"
#include "support/analytic_field.h"

namespace gigaray::testing_support {
namespace {

struct LevelTraffic {
  Traffic first, last;  ///< when its first view began, and its last report
};

/// Runs a pipeline and takes the traffic at the beginning of every view.
std::map<std::string, LevelTraffic> watch(const LightField& light_field, std::size_t& tuples,
                                          Traffic& all, int& levels) {
  DepthOptions options = auto_options();
  options.disparity = DisparityRange{-1, 2};
  options.hypotheses = 24;
  const HypothesisRange hypotheses{-1, 2, 24};
  const MemoryPlan plan = plan_memory(light_field, options, hypotheses, DeviceLimits{});
  EXPECT_EQ(plan.place, Place::kDevice);
  levels = int(plan.levels.size());
  std::map<std::string, LevelTraffic> by_level;
  std::visit(
      [&](const auto& sampler) {
        std::vector<std::unique_ptr<Workspace>> workspaces;
        workspaces.push_back(make_opencl_workspace(
            sampler, {options, hypotheses, light_field.kind, 8}, opencl::Device::open()));
        const Workspace& workspace = *workspaces.front();
        RunControl control;
        std::map<std::string, int> reports;
        control.on_progress = [&](const std::string& stage, double, double) {
          if (stage == "decode" || stage == "depth") return;
          LevelTraffic& level = by_level[stage];
          level.last = workspace.traffic();
          if (++reports[stage] == 1) level.first = level.last;
        };
        tuples = run_pipeline({light_field, options, hypotheses, plan, control}, workspaces)
                     .tuples.size();
        all = workspace.traffic();
      },
      make_sampler(light_field));
  return by_level;
}

void expect_little_traffic(const LightField& light_field) {
  std::size_t tuples = 0;
  Traffic all;
  int levels = 0;
  const auto by_level = watch(light_field, tuples, all, levels);
  const long views = light_field.num_views();
  ASSERT_EQ(int(by_level.size()), levels);
  for (const auto& [stage, level] : by_level) {
    const long waits = level.last.waits - level.first.waits;
    const int looks = stage == "level 0" ? 3 : 1;
    EXPECT_LE(waits, 2 * looks * views) << stage;
    EXPECT_EQ(level.last.bytes_up, level.first.bytes_up) << stage;
    std::printf("%s: %.2f waits and %.0f bytes down per view\n", stage.c_str(),
                double(waits) / double(views),
                double(level.last.bytes_down - level.first.bytes_down) / double(views));
  }
  // Down come the tuples, the maps and the small answers: pixels to do of every row.
  const std::size_t pitch = map_pitch(light_field.width);
  const std::size_t maps = std::size_t(views) * pitch * light_field.height * 9;
  const std::size_t answers =
      std::size_t(views) * levels * (2 * light_field.height + 1) * sizeof(int);
  EXPECT_LE(all.bytes_down, tuples * sizeof(RayTuple) + maps + answers);
  EXPECT_GE(all.bytes_down, tuples * sizeof(RayTuple) + maps);
}

TEST(Traffic, AGridOf81ViewsStaysOnTheDevice) {
  expect_little_traffic(
      analytic_field(64, 48, grid_of_views(9, 9), {{-0.5, 1}, {1.3, 2, 1, 20, 44, 12, 33}})
          .light_field);
}

TEST(Traffic, ARowOf100ViewsStaysOnTheDevice) {
  expect_little_traffic(
      analytic_field(93, 40, row_of_views(100), {{-0.05, 1}, {0.13, 2, 1, 30, 60, 12, 33}})
          .light_field);
}

}  // namespace
}  // namespace gigaray::testing_support
