// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gigaray/engine/device.h"
#include "gigaray/samplers/any_sampler.h"
#include "opencl/opencl_workspace.h"
#include "src/make_workspace.h"
#include "src/run.h"
#include "support/analytic_field.h"
#include "support/depth_result.h"

namespace gigaray::testing_support {

/// A card before a wall, with a little noise.
inline AnalyticField card_before_wall(const std::vector<View>& views, int width, int height,
                                      int bit_depth = 8) {
  const Layer back{-0.3, 1, 0.4};
  Layer front{1.1, 2};
  front.left = 0.3 * width;
  front.right = 0.7 * width;
  front.top = 0.2 * height;
  front.bottom = 0.6 * height;
  return analytic_field(width, height, views, {back, front}, bit_depth, 0.004);
}

/// What finds it.
inline DepthOptions small_job(const std::string& preset, int hypotheses) {
  DepthOptions options = preset_options(preset);
  options.disparity = DisparityRange{-1, 2};
  options.hypotheses = hypotheses;
  return options;
}

/// How a run is cut into pieces, and where it lies.
struct Cut {
  int band_rows = 1000;
  bool least_strips = false;
  bool keeps_scores = true;
  Place place = Place::kDevice;
  std::string work_folder = "";
  int partitions = 1;
  bool device_shares_memory = true;

  void in_files(const std::string& folder) {
    place = Place::kFile;
    work_folder = folder;
  }
};

/// A run that is cut where memory would not ask for it. options: with range and hypotheses.
struct PlannedRun {
  std::vector<RayTuple> tuples;
  std::vector<std::vector<float>> maps;  // disparity, confidence and level of every view

  PlannedRun(const LightField& light_field, DepthOptions options, const std::string& backend,
             const Cut& cut, const RunControl& control = RunControl{}) {
    const HypothesisRange hypotheses{options.disparity->min, options.disparity->max,
                                     options.hypotheses};
    options.memory_bytes = 4e9;
    MemoryPlan plan = plan_memory(light_field, options, hypotheses, DeviceLimits{});
    for (LevelPlan& level : plan.levels) {
      // Scan-lines work on whole blocks of rows.
      const bool blocks = options.support.scanline && level.shape.level == 0;
      const int least = blocks ? kScanlineBlock : 1;
      const int rows = (cut.band_rows + least - 1) / least * least;
      level.band_rows = std::min(rows, level.shape.height);
      level.window_rows = cut.keeps_scores ? level.band_rows : 0;
      level.strip_rows = cut.least_strips ? least : level.band_rows;
      level.keeps_scores = cut.keeps_scores;
      // Less than a band takes is made more when the second one comes; of the others some rows
      // more stay than are asked for.
      level.loaded_rows = 4 * cut.band_rows;
    }
    plan.work_folder = cut.work_folder;
    plan.place = cut.place;
    const WorkspaceSetup setup{options, hypotheses, light_field.kind,
                               light_field.pixels->bit_depth()};
    std::vector<std::unique_ptr<Workspace>> workspaces;
    std::visit(
        [&](const auto& sampler) {
          const opencl::TuningOverrides parts{
              {opencl::kDeviceParts, {{"SHARED_MEMORY", cut.device_shares_memory}}}};
          for (int i = 0; i < cut.partitions; ++i)
            workspaces.push_back(
                backend == "reference"
                    ? make_reference_workspace(sampler, setup)
                    : opencl::make_tuned_workspace(sampler, setup, device().opened(), parts));
        },
        make_sampler(light_field));
    const RunResult result =
        run_pipeline({light_field, options, hypotheses, plan, control}, workspaces);
    result.tuples.for_each([&](const RayTuple& tuple) { tuples.push_back(tuple); });
    const int width = light_field.width;
    const std::size_t views = active_views(light_field, options).size();
    for (std::size_t view = 0; view < views; ++view)
      for (int v = 0; v < light_field.height; ++v) {
        std::vector<std::int8_t> level(width);
        maps.emplace_back(3 * width);
        result.maps.read(int(view), v, maps.back().data(), maps.back().data() + width,
                         level.data());
        std::copy(level.begin(), level.end(), maps.back().begin() + 2 * width);
        for (float& value : maps.back())
          if (std::isnan(value)) value = -1000;  // equal to itself
      }
  }

  void expect_same(const PlannedRun& other, const std::string& what) const {
    EXPECT_TRUE(maps == other.maps) << what;
    ASSERT_EQ(tuples.size(), other.tuples.size()) << what;
    for (std::size_t i = 0; i < tuples.size(); ++i)
      ASSERT_TRUE(same_bits(tuples[i], other.tuples[i])) << what << ", tuple " << i;
  }

 private:
  static const Device& device() {
    static const Device opened = Device::open();
    return opened;
  }
};

}  // namespace gigaray::testing_support
