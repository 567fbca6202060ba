// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "memory_plan.h"

#include <algorithm>
#include <cmath>

#include "gigaray/memory_limit.h"
#include "gigaray/parallel.h"
#include "gigaray/samplers/any_sampler.h"
#include "gigaray/scratch_file.h"

namespace gigaray {
namespace {

constexpr double kMiB = 1 << 20;
/// The program itself, OpenCL without compiling, decoding buffers of small pictures.
constexpr double kProcessBytes = 175 * kMiB;
/// What compiling kernels takes, and the part of it that is free again when the kernels of a view
/// are compiled.
constexpr double kCompilerBytes = 175 * kMiB, kCompilerHeap = 35 * kMiB;
/// Tuples are kept in memory with the stores: so many per pixel of a picture, as a rule.
constexpr double kTuplesPerPixel = 2;
/// Most bytes of one device buffer that every OpenCL driver we know grants.
constexpr double kLargestBuffer = 1800 * kMiB;
constexpr int kSmallestLevel = 10;  // px
/// Most for the scores of a strip, where its least number of rows takes less.
constexpr double kLargestVolume = 1024 * kMiB;

struct LevelCost {
  double stores = 0;      // bytes of everything that is kept of the level
  double band_row = 0;    // bytes of one row of a band, on the device and beside it
  double row_floats = 0;  // bytes of one row in the band buffer
};

/// n: views in a band. Bands of samplers whose rays go each their own way are there twice, the
/// second time with the channels of a pixel padded to 4 or 8.
LevelCost cost_of(const LevelShape& shape, const LightField& light_field,
                  const DepthOptions& options, double active, double n, bool in_files) {
  const double all = light_field.num_views();
  const double pixels = double(shape.width) * shape.height;
  const double colour_bytes =
      shape.level == 0 ? 3.0 * light_field.pixels->bit_depth() / 8 : 3.0 * sizeof(float);
  const double kept = sizeof(PackedEstimate) + 1 + (shape.level > 0 ? sizeof(Search) : 0);
  LevelCost cost;
  cost.stores = pixels * (all * colour_bytes + active * kept);
  if (shape.level == 0 && light_field.pixels->has_mask()) cost.stores += pixels * all;
  const bool gradient = options.score.gradient;
  const double planes = n * map_pitch(shape.width) * sizeof(float);
  const double plane_bytes = planes * (gradient ? 5 : 3);
  const double tap_bytes =
      light_field.kind == LightFieldKind::kUnstructured ? planes * (gradient ? 8 : 4) : 0;
  cost.row_floats = std::max(plane_bytes, tap_bytes);
  cost.band_row = plane_bytes + tap_bytes + n * shape.width * std::max(colour_bytes, 3.0);
  // Rows of the stores that are open beside the band: pixels, those of the next level, estimates.
  if (in_files)
    cost.band_row += shape.width * (n * (colour_bytes + 3.0) + active * sizeof(PackedEstimate));
  return cost;
}

/// What a strip of a level needs beside its own rows.
struct StripNeeds {
  int halo = 0;      ///< rows above and below together
  int multiple = 1;  ///< its first row is a multiple of this
};

StripNeeds strip_needs(const SupportOptions& support, int level) {
  if (support.scanline && level == 0)
    return {2 * (support.radius + kScanlineReach), kScanlineBlock};
  return {2 * support.radius, 1};
}

double volume_row_bytes(int width, const HypothesisRange& hypotheses) {
  constexpr int kWidestLanes = 16;
  return double(width) * ((hypotheses.count + kWidestLanes - 1) / kWidestLanes * kWidestLanes) *
         sizeof(float);
}

/// Sizes of a job that don't depend on the limit, and plans for it.
class Planner {
 public:
  Planner(const LightField& light_field, const DepthOptions& options,
          const HypothesisRange& hypotheses)
      : light_field_(light_field),
        options_(options),
        hypotheses_(hypotheses),
        sampler_(make_sampler(light_field)),
        shapes_(level_shapes(light_field.width, light_field.height,
                             options.propagation.fine_to_coarse)),
        active_(options.views.empty() ? light_field.num_views() : double(options.views.size())),
        refs_(options.views.empty() ? all_views(light_field.num_views()) : options.views) {
    for (const int ref : refs_)
      std::visit(
          [&](const auto& s) {
            band_views_ = std::max(band_views_, double(s.partners(ref).size()));
          },
          sampler_);
    const StripNeeds finest = strip_needs(options.support, 0);
    const double row = volume_row_bytes(light_field.width, hypotheses);
    least_volume_ = row * (finest.halo + finest.multiple);
    all_rows_ = row * (light_field.height + finest.halo + finest.multiple);
  }

  /// Bytes for the scores of a strip. All rows if they fit into a part of the memory: else a strip
  /// is scored again for the second look.
  double usual_volume(double limit) const {
    return std::min(std::clamp(limit / 12, least_volume_, std::max(kLargestVolume, least_volume_)),
                    all_rows_);
  }
  double least_volume() const { return std::min(least_volume_, all_rows_); }

  /// Whatever the bands are.
  double fixed_bytes(double volume) const {
    const SupportOptions& support = options_.support;
    const double copies = 1 + (support.radius > 0) + support.scanline;
    return kProcessBytes + compiler_bytes() + options_.memory_beside + copies * volume +
           map_bytes();
  }

  double map_bytes() const {
    const SupportOptions& support = options_.support;
    // Maps of one view: todo, bounds (twice with support), disparity, confidence, median, radiance,
    // slopes, means along rays (5 channels).
    const double pitch = map_pitch(light_field_.width);
    const double view_maps = pitch * light_field_.height *
                             (27 + (support.slanted ? 24 : 0) + (options_.score.ray_mean ? 24 : 0));
    return std::max(view_maps, std::min(4, num_threads()) * decoder_bytes());
  }

  /// While a picture is decoded.
  double decoder_bytes() const { return 12.0 * light_field_.width * light_field_.height; }

  /// What the compiler frees is where the maps of a view are made later.
  double compiler_bytes() const {
    return kCompilerBytes - kCompilerHeap + std::max(0.0, kCompilerHeap - map_bytes());
  }

  std::optional<MemoryPlan> plan(double limit, double volume, bool in_files) const {
    MemoryPlan result;
    const double stores = in_files ? 0 : store_bytes(), fixed = fixed_bytes(volume);
    double peak_band = 0;
    for (const LevelShape& shape : shapes_) {
      const StripNeeds needs = strip_needs(options_.support, shape.level);
      LevelPlan level{shape, 0, halo(shape), 0};
      const int held = int(volume / volume_row_bytes(shape.width, hypotheses_)) - needs.halo;
      level.strip_rows = std::max(held / needs.multiple, 1) * needs.multiple;
      const LevelCost cost = cost_of(shape, light_field_, options_, active_, band_views_, in_files);
      const double rows = std::min((limit - fixed - stores) / cost.band_row,
                                   std::floor(kLargestBuffer / cost.row_floats));
      level.band_rows = shape.height;
      while (loaded_rows(shape, level.band_rows) > rows) {
        // Halving keeps the number of bands, and with it the halo rows, small.
        const int fewer = level.band_rows > 16 ? (level.band_rows + 1) / 2 : level.band_rows - 1;
        const int whole = (fewer + needs.multiple - 1) / needs.multiple * needs.multiple;
        if (whole >= level.band_rows || whole < 1) return std::nullopt;
        level.band_rows = whole;
      }
      peak_band = std::max(peak_band, loaded_rows(shape, level.band_rows) * cost.band_row);
      result.levels.push_back(level);
    }
    result.forecast.memory_bytes = fixed + peak_band + stores;
    result.compiler_bytes = compiler_bytes();
    // Pictures that were kept from the first look (kept_pictures.h) may take a third of it.
    const double free_for_decoding =
        2.0 / 3 * (fixed + peak_band - kProcessBytes - options_.memory_beside);
    result.decoders = int(std::clamp(free_for_decoding / decoder_bytes(), 1.0, 1024.0));
    result.forecast.disk_bytes = in_files ? store_bytes() : 0;
    const int first = result.levels.front().band_rows;
    result.forecast.bands = (light_field_.height + first - 1) / first;
    return result;
  }

  /// The least limit under which there is a plan.
  double least_limit() const {
    double peak_band = 0;
    for (const LevelShape& shape : shapes_) {
      const LevelCost cost = cost_of(shape, light_field_, options_, active_, band_views_, true);
      const int rows = std::min(strip_needs(options_.support, shape.level).multiple, shape.height);
      peak_band = std::max(peak_band, loaded_rows(shape, rows) * cost.band_row);
    }
    return fixed_bytes(least_volume()) + peak_band;
  }

  /// With all stores and one band in memory.
  double everything(double volume) const {
    return fixed_bytes(volume) + store_bytes() +
           light_field_.height *
               cost_of(shapes_.front(), light_field_, options_, active_, band_views_, false)
                   .band_row;
  }

 private:
  double store_bytes() const {
    double stores = 0;
    for (const LevelShape& shape : shapes_)
      stores += cost_of(shape, light_field_, options_, active_, band_views_, false).stores;
    return stores + kTuplesPerPixel * sizeof(RayTuple) * light_field_.width * light_field_.height;
  }
  /// What the windows reach, a row for gradients, two for interpolation taps.
  int halo(const LevelShape& shape) const {
    const StripNeeds needs = strip_needs(options_.support, shape.level);
    return 3 + std::max({options_.edge.radius + 2, needs.halo / 2, options_.winner.median_radius,
                         options_.support.slanted ? kSlopeReach : 0, 3});
  }
  /// Most rows in memory for a band of so many rows.
  int loaded_rows(const LevelShape& shape, int band_rows) const {
    // Of many bands some are looked at; neighbours need much the same.
    constexpr int kMostBands = 16;
    const int bands = (shape.height + band_rows - 1) / band_rows;
    const int stride = band_rows * ((bands + kMostBands - 1) / kMostBands);
    return std::visit(
        [&](const auto& s) {
          const auto level = s.at_level(shape.level);
          int most = 0;
          for (const int ref : refs_)
            for (int begin = 0; begin < shape.height; begin += stride) {
              const RowRange band{begin, std::min(begin + band_rows, shape.height)};
              const RowRange own = grown(band, halo(shape), shape.height);
              most = std::max(most, level.rows_needed(ref, own, hypotheses_, shape.height).size());
            }
          return most;
        },
        sampler_);
  }

  const LightField& light_field_;
  const DepthOptions& options_;
  const HypothesisRange hypotheses_;
  const AnySampler sampler_;
  const std::vector<LevelShape> shapes_;
  const double active_;          ///< views that get depth
  const std::vector<int> refs_;  ///< the same, their indices
  double band_views_ = 0;        ///< most in a band
  double least_volume_ = 0, all_rows_ = 0;
};

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

double least_memory_limit(const LightField& light_field, const DepthOptions& options,
                          const HypothesisRange& hypotheses) {
  return Planner(light_field, options, hypotheses).least_limit();
}

MemoryPlan plan_memory(const LightField& light_field, const DepthOptions& options,
                       const HypothesisRange& hypotheses) {
  const double limit = options.memory_bytes > 0 ? options.memory_bytes : default_memory_limit();
  const Planner planner(light_field, options, hypotheses);
  const double usual = planner.usual_volume(limit);

  // In memory if that leaves bands of a quarter of the picture or more; else rows go to files.
  auto in_memory = planner.plan(limit, usual, false);
  auto in_files = planner.plan(limit, usual, true);
  if (!in_memory && !in_files) in_files = planner.plan(limit, planner.least_volume(), true);
  if (!in_memory && !in_files && planner.least_limit() <= limit)
    throw Error(ErrorCode::kOutOfMemory,
                "the rays of one row reach so much of " + std::to_string(light_field.num_views()) +
                    " views that it doesn't fit into one buffer of a device; compare fewer views "
                    "(--partners) or smaller pictures (--max-size)");
  if (!in_memory && !in_files)
    throw Error(ErrorCode::kOutOfMemory,
                "memory of " + std::to_string(int(limit / kMiB)) +
                    " MiB is too little for one row of all " +
                    std::to_string(light_field.num_views()) + " views; give it at least " +
                    std::to_string(int(std::ceil(planner.least_limit() / kMiB))) + " MiB");
  const bool keep = in_memory && (in_memory->forecast.bands <= 4 || !in_files);
  MemoryPlan chosen = keep ? *in_memory : *in_files;
  chosen.place = keep ? Place::kDevice : Place::kFile;
  if (!keep)
    chosen.work_folder = options.work_folder.empty()
                             ? temporary_folder(" or name another folder by --work")
                             : options.work_folder;
  chosen.forecast.memory_all_bytes = planner.everything(usual);
  return chosen;
}

}  // namespace gigaray
