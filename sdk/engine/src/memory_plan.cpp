// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "memory_plan.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <thread>

#include "gigaray/samplers/any_sampler.h"
#include "search_bounds.h"

namespace gigaray {
namespace {

constexpr double kMiB = 1 << 20;
/// The program itself, OpenCL and its compiler, decoding buffers of small pictures.
constexpr double kProcessBytes = 220 * kMiB;
/// Most bytes of one device buffer that every OpenCL driver we know grants.
constexpr double kLargestBuffer = 1800 * kMiB;
constexpr int kSmallestLevel = 10;  // px

double free_memory() {
  std::ifstream info("/proc/meminfo");
  std::string key, unit;
  for (double kib; info >> key >> kib >> unit;)
    if (key == "MemAvailable:") return kib * 1024;
  return double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE)) / 2;
}

struct LevelCost {
  double stores = 0;    // bytes of everything that is kept of the level
  double band_row = 0;  // bytes of one row of a band, on the device and beside it
  double row_floats = 0;  // bytes of one row in the band buffer
};

LevelCost cost_of(const LevelShape& shape, const LightField& light_field,
                  const DepthOptions& options, double active, bool in_files) {
  const double n = light_field.num_views();
  const double pixels = double(shape.width) * shape.height;
  const double colour_bytes =
      shape.level == 0 ? 3.0 * light_field.pixels->bit_depth() / 8 : 3.0 * sizeof(float);
  const double kept = sizeof(PackedEstimate) + 1 + (shape.level > 0 ? sizeof(Search) : 0);
  LevelCost cost;
  cost.stores = pixels * (n * colour_bytes + active * kept);
  cost.row_floats = n * (options.score.gradient ? 5 : 3) * StripMap<float>::pitch_for(shape.width) *
                    sizeof(float);
  cost.band_row = cost.row_floats + n * shape.width * std::max(colour_bytes, 3.0);
  // Rows of the stores that are open beside the band.
  if (in_files)
    cost.band_row += shape.width * (n * (colour_bytes + 3.0) + active * (kept + sizeof(Search)));
  return cost;
}

}  // namespace

std::vector<LevelShape> level_shapes(int width, int height, bool fine_to_coarse) {
  std::vector<LevelShape> shapes{{0, width, height}};
  while (fine_to_coarse) {
    const LevelShape& last = shapes.back();
    const LevelShape next{last.level + 1, (last.width + 1) / 2, (last.height + 1) / 2};
    if (std::min(next.width, next.height) < kSmallestLevel) break;
    shapes.push_back(next);
  }
  return shapes;
}

MemoryPlan plan_memory(const LightField& light_field, const DepthOptions& options,
                       const HypothesisRange& hypotheses) {
  const double limit = options.memory_bytes > 0 ? options.memory_bytes : 0.75 * free_memory();
  const double active = options.views.empty() ? light_field.num_views() : double(options.views.size());
  const auto shapes =
      level_shapes(light_field.width, light_field.height, options.propagation.fine_to_coarse);
  const AnySampler sampler = make_sampler(light_field);
  const double pitch = StripMap<float>::pitch_for(light_field.width);

  // Scores of a strip: enough rows to keep the device busy, twice where support makes a second copy.
  const double volume_row = pitch * hypotheses.count * sizeof(float);
  const double support_rows = options.support.radius > 0 ? 2 * options.support.radius + 1 : 1;
  const double copies = options.support.radius > 0 ? 2 : 1;
  const double volume =
      std::min(std::clamp(limit / 12, volume_row * support_rows,
                          std::max(192 * kMiB, volume_row * support_rows)),
               volume_row * (light_field.height + support_rows));
  // Maps of one view: todo, bounds (twice with support), disparity, confidence, median, radiance, slopes.
  const double view_maps = pitch * light_field.height * (options.support.slanted ? 52 : 40);
  const double decoding = std::min(4u, std::max(1u, std::thread::hardware_concurrency())) * 12.0 *
                          light_field.width * light_field.height;
  const double fixed = kProcessBytes + copies * volume + std::max(view_maps, decoding);

  const auto plan = [&](bool in_files) -> std::optional<MemoryPlan> {
    MemoryPlan result;
    result.volume_bytes = std::size_t(volume);
    double stores = 0;
    for (const LevelShape& shape : shapes)
      stores += cost_of(shape, light_field, options, active, in_files).stores;
    double peak_band = 0;
    for (const LevelShape& shape : shapes) {
      LevelPlan level;
      level.shape = shape;
      // Beyond what the windows reach: a row for gradients, two for interpolation taps.
      level.halo = 3 + std::max({options.edge.radius + 2, options.support.radius,
                                 options.winner.median_radius,
                                 options.support.slanted ? kSlopeReach : 0, 3});
      const LevelCost cost = cost_of(shape, light_field, options, active, in_files);
      const double left = limit - fixed - (in_files ? 0 : stores);
      const double rows =
          std::min(left / cost.band_row, std::floor(kLargestBuffer / cost.row_floats));
      const auto loaded_rows = [&](int band_rows) {
        const int begin = std::max((shape.height - band_rows) / 2, 0);
        const RowRange core{begin, std::min(begin + band_rows, shape.height)};
        return std::visit(
            [&](const auto& s) {
              return s.at_level(shape.level)
                  .rows_needed(grown(core, level.halo, shape.height), hypotheses, shape.height)
                  .size();
            },
            sampler);
      };
      int band_rows = shape.height;
      while (band_rows > 0 && loaded_rows(band_rows) > rows) {
        // Halving keeps the number of bands, and with it the halo rows, small.
        band_rows = band_rows > 16 ? (band_rows + 1) / 2 : band_rows - 1;
      }
      if (band_rows < 1) return std::nullopt;
      level.band_rows = band_rows;
      peak_band = std::max(peak_band, loaded_rows(band_rows) * cost.band_row);
      result.levels.push_back(level);
    }
    result.forecast.memory_bytes = fixed + peak_band + (in_files ? 0 : stores);
    result.forecast.disk_bytes = in_files ? stores : 0;
    const int first = result.levels.front().band_rows;
    result.forecast.bands = (light_field.height + first - 1) / first;
    if (in_files)
      result.work_folder = options.work_folder.empty()
                               ? std::filesystem::temp_directory_path().string()
                               : options.work_folder;
    return result;
  };

  double everything = fixed;
  for (const LevelShape& shape : shapes)
    everything += cost_of(shape, light_field, options, active, false).stores;
  everything += light_field.height * cost_of(shapes.front(), light_field, options, active, false).band_row;

  // In memory if that leaves bands of a quarter of the picture or more; else rows go to files.
  auto in_memory = plan(false);
  auto in_files = plan(true);
  if (!in_memory && !in_files)
    throw Error(ErrorCode::kOutOfMemory,
                "memory of " + std::to_string(int(limit / kMiB)) +
                    " MiB is too little for one row of all " +
                    std::to_string(light_field.num_views()) + " views; give it at least " +
                    std::to_string(int((fixed * 1.5) / kMiB)) + " MiB");
  const bool keep = in_memory && (in_memory->forecast.bands <= 4 || !in_files);
  MemoryPlan chosen = keep ? *in_memory : *in_files;
  chosen.forecast.memory_all_bytes = everything;
  return chosen;
}

}  // namespace gigaray
