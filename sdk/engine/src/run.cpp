// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "run.h"

#include <algorithm>

#include "decoded_pictures.h"
#include "partition.h"
#include "pipeline.h"

namespace gigaray {

std::vector<int> active_views(const LightField& light_field, const DepthOptions& options) {
  std::vector<int> active;
  for (const int view : views_from_centre(light_field))
    if (options.views.empty() ||
        std::find(options.views.begin(), options.views.end(), view) != options.views.end())
      active.push_back(view);
  return active;
}

RunResult run_pipeline(const Run& run, const std::vector<std::unique_ptr<Workspace>>& workspaces) {
  RunResult result;
  DecodedPictures pictures =
      decode_pictures(run.light_field, run.plan, run.control, result.seconds);
  const auto rows =
      partition_rows(run.plan, run.options, make_sampler(run.light_field), run.hypotheses,
                     active_views(run.light_field, run.options), int(workspaces.size()));
  std::vector<std::unique_ptr<Pipeline>> pipelines;
  for (std::size_t i = 0; i < rows.size(); ++i)
    pipelines.push_back(std::make_unique<Pipeline>(run, rows, pictures, *workspaces[i], result));
  pictures = {};
  run_partitions(int(rows.size()),
                 [&](Partition& partition) { pipelines[partition.index()]->run(partition); });
  std::map<std::string, double> slowest;
  for (const auto& pipeline : pipelines) {
    result.tuples.add(pipeline->take_tuples());
    for (const auto& [stage, seconds] : pipeline->seconds())
      slowest[stage] = std::max(slowest[stage], seconds);
  }
  result.seconds.merge(slowest);
  return result;
}

}  // namespace gigaray
