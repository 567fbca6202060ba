// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "memory_plan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "coarse_guide.h"
#include "finished_maps.h"
#include "gigaray/core/memory_limit.h"
#include "gigaray/core/parallel.h"
#include "gigaray/core/scratch_file.h"
#include "gigaray/samplers/any_sampler.h"
#include "sweep.h"

namespace gigaray {
namespace {

constexpr double kMiB = 1 << 20;
/// The program itself, OpenCL without compiling kernels, decoding buffers of small pictures.
constexpr double kProcessBytes = 180 * kMiB;
/// What compiling kernels takes, and the part of it that is free again when the kernels of a view
/// are compiled.
constexpr double kCompilerBytes = 165 * kMiB, kCompilerHeap = 35 * kMiB;
/// Tuples are kept in memory with the stores: so many per pixel of a picture, as a rule.
constexpr double kTuplesPerPixel = 2;
/// Share of a device's own memory that a run may take: the driver and a display want some.
constexpr double kDeviceShare = 0.9;
constexpr int kSmallestLevel = 10;  // px
/// Most for the scores of a strip, where its least number of rows takes less.
constexpr double kLargestVolume = 1024 * kMiB;
/// Rows of a strip, beside those that it keeps, that make all others' scores cheap; with a guide
/// scores are few.
constexpr int kUsualRows = 6 * kScanlineBlock, kGuidedRows = 2 * kScanlineBlock;
/// Most for a band in the host's memory, where a sweep's least window takes less: more rows at once
/// gain little, since none is loaded twice.
constexpr double kLargestBand = 1792 * kMiB;

struct LevelCost {
  double stores = 0;    // bytes of everything that is kept of the level
  double shared = 0;    // of that, what several devices that share the host's memory share
  double band_row = 0;  // bytes of one row of a band, on the device and beside it
  double reached_row =
      0;  // bytes of one row of estimates that rays of a band reach, brought for it
  double reached_estimates = 0;  // the estimates among them
  double row_floats = 0;         // bytes of one row in the band buffer
  double largest_store = 0;
};

/// n: views in a band. Bands of samplers whose rays go each their own way are there twice, the
/// second time with the channels of a pixel padded to 4 or 8.
LevelCost cost_of(const LevelShape& shape, const LightField& light_field,
                  const DepthOptions& options, double active, double n, bool staged) {
  const double all = light_field.num_views();
  const double pixels = double(shape.width) * shape.height;
  const double colour_bytes =
      shape.level == 0 ? 3.0 * light_field.pixels->bit_depth() / 8 : 3.0 * sizeof(float);
  const bool guarded = options.propagation.finished_lead > 0 && active > 1;
  const double kept = sizeof(PackedEstimate) + (guarded ? sizeof(float) : 0) + 1 +
                      (shape.level > 0 ? sizeof(Search) : 0);
  const double kStagedBytes = sizeof(PackedEstimate) + (guarded ? sizeof(float) : 0);
  LevelCost cost;
  cost.stores = pixels * (all * colour_bytes + active * kept);
  cost.largest_store = pixels * std::max(all * colour_bytes, active * sizeof(Search));
  if (shape.level == 0) {
    const double masks = light_field.pixels->has_mask() ? pixels * all : 0;
    cost.stores += masks;
    cost.shared = pixels * all * colour_bytes + masks;
  }
  const bool gradient = options.score.gradient;
  const double planes = n * map_pitch(shape.width) * sizeof(float);
  const double plane_bytes = planes * (gradient ? 5 : 3);
  const double tap_bytes =
      light_field.kind == LightFieldKind::kUnstructured ? planes * (gradient ? 8 : 4) : 0;
  cost.row_floats = std::max(plane_bytes, tap_bytes);
  cost.band_row = plane_bytes + tap_bytes + n * shape.width * std::max(colour_bytes, 3.0);
  // Rows that are brought beside the band: pixels, those of the next level; estimates and bars.
  if (staged) {
    cost.band_row += shape.width * n * (colour_bytes + 3.0);
    cost.reached_row = shape.width * active * kStagedBytes;
    cost.reached_estimates = shape.width * active * sizeof(PackedEstimate);
  }
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
          const HypothesisRange& hypotheses, const DeviceLimits& device)
      : light_field_(light_field),
        options_(options),
        device_(device),
        hypotheses_(hypotheses),
        guided_(is_guided(light_field, options)),
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

  /// Bytes for the scores of a strip. Those of the first look are kept for the slanted one where
  /// memory allows: to score them again costs more than anything else. More rows at once than
  /// `usual_rows()` gain nothing.
  double usual_volume(double limit) const {
    const double memory = std::min(limit, device_memory());
    const double most =
        std::min({rows_volume(usual_rows()), kLargestVolume, device_.largest_buffer});
    return std::min(std::clamp(memory / 12, keeping_volume(), std::max(most, keeping_volume())),
                    all_rows_);
  }
  /// The least that keeps the first look's scores, in strips of a block.
  double keeping_volume() const {
    return std::min(std::max(rows_volume(kScanlineBlock), least_volume_), all_rows_);
  }
  double least_volume() const { return std::min(least_volume_, all_rows_); }

  /// Whatever the bands are.
  double fixed_bytes(double volume) const {
    return kProcessBytes + compiler_bytes() + options_.memory_beside + guide_bytes() + map_bytes() +
           (device_.shares_host_memory ? device_.devices * score_bytes(volume) : 0);
  }

  double score_bytes(double volume) const {
    const double row = volume_row_bytes(light_field_.width, hypotheses_);
    const int lag = score_lag(0);
    const bool strips =
        lag > 0 && volume >= row * (lag + kScanlineBlock) && volume < row * light_field_.height;
    if (!strips) return (1 + beside_scores(0)) * volume;
    // The first look's scores are held of what the slanted one lags, too.
    const double strip = volume - row * (lag - strip_needs(options_.support, 0).halo);
    return volume + std::max(strip * (beside_scores(0) + looks_anew()), volume * beside_scores(1));
  }

  /// What is taken of that by the strips of a plan. The buffers of a level serve the others.
  double score_bytes(const MemoryPlan& plan) const {
    double first = 0, others = 0, anew = 0;
    for (const LevelPlan& level : plan.levels) {
      const int halo = strip_needs(options_.support, level.shape.level).halo;
      const int height = level.shape.height;
      const bool one = level.strip_rows >= height;
      const int lag = level.keeps_scores && !one ? score_lag(level.shape.level) : halo;
      const double row = volume_row_bytes(level.shape.width, hypotheses_);
      const double strip = row * std::min(level.strip_rows + halo, height);
      first = std::max(first, row * std::min(level.strip_rows + lag, height));
      others = std::max(others, strip * beside_scores(level.shape.level));
      if (level.keeps_scores && !one) anew = std::max(anew, strip * looks_anew());
    }
    return first + others + anew;
  }

  /// Maps of one view: what is to do and its bounds (twice with support), disparity, confidence,
  /// median, radiance, scratch; slopes and what lies beside jumps; sides of jumps; means along rays
  /// (5 channels).
  double view_map_bytes() const {
    const SupportOptions& support = options_.support;
    return double(map_pitch(light_field_.width)) * light_field_.height *
           (46 + (support.slanted ? 20 : 0) + (support.choose_sides ? 8 : 0) +
            (options_.score.ray_mean ? 20 : 0));
  }
  double map_bytes() const {
    const double view_maps = device_.shares_host_memory ? device_.devices * view_map_bytes() : 0;
    return std::max(view_maps, std::min(4, num_threads()) * decoder_bytes());
  }

  /// Maps of half the size.
  double guide_bytes() const {
    if (!guided_) return 0;
    const double pixels = ((light_field_.width + 1) / 2) * ((light_field_.height + 1) / 2);
    return active_ * pixels * FinishedMaps::kPixelBytes;
  }

  /// While a picture is decoded.
  double decoder_bytes() const { return 12.0 * light_field_.width * light_field_.height; }

  /// What the compiler frees is where the maps of a view are made later.
  double compiler_bytes() const {
    return kCompilerBytes - kCompilerHeap + std::max(0.0, kCompilerHeap - map_bytes());
  }

  /// Empty: it doesn't fit.
  std::optional<MemoryPlan> plan(double limit, double volume, Place place) const {
    MemoryPlan result;
    result.guided = guided_;
    result.place = place;
    const bool in_files = place == Place::kFile, staged = place != Place::kDevice;
    const bool on_own = !staged && !device_.shares_host_memory;
    const double stores = in_files ? 0 : store_bytes(on_own ? 1 : device_.devices);
    const double on_host = device_.shares_host_memory || staged ? stores : passing_bytes();
    const double fixed = fixed_bytes(volume);
    if (!staged && largest_store() > device_.largest_buffer) return std::nullopt;
    // A device with memory of its own holds bands, scores and maps there; the host the rest. Each
    // of several is planned as if it had all rows: how many it has of other partitions depends on
    // where rays go.
    double room = (limit - fixed - on_host) / device_.devices;
    if (!device_.shares_host_memory) {
      if (room < 0) return std::nullopt;
      room = device_memory() - score_bytes(volume) - view_map_bytes() - (staged ? 0 : stores);
    }
    double peak_band = 0;
    for (const LevelShape& shape : shapes_) {
      const StripNeeds needs = strip_needs(options_.support, shape.level);
      LevelPlan level{shape, 0, 0, 0, halo(shape), 0, false};
      const int held = int(volume / volume_row_bytes(shape.width, hypotheses_));
      const int lag = score_lag(shape.level);
      level.keeps_scores = lag > 0 && held >= std::min(lag + needs.multiple, shape.height);
      const int free = held - (level.keeps_scores ? lag : needs.halo);
      level.strip_rows =
          held >= shape.height ? shape.height : std::max(free / needs.multiple, 1) * needs.multiple;
      const LevelCost cost = cost_of(shape, light_field_, options_, active_, band_views_, staged);
      // One sweep loads every row once and holds what its stages lag; where that doesn't fit every
      // stage loads its own.
      const int stage_lag =
          sweep_lag(sweep_stages(options_, shape.level, int(band_views_), guided_));
      const double moderate =
          std::max(kLargestBand, band_bytes(shape, cost, 2 * kScanlineBlock, stage_lag));
      level.band_rows =
          fit_band(shape, cost, device_.shares_host_memory ? std::min(room, moderate) : room,
                   needs.multiple, stage_lag);
      const bool sweeps = level.band_rows > 0;
      if (!sweeps) level.band_rows = fit_band(shape, cost, room, needs.multiple, 0);
      if (level.band_rows == 0) return std::nullopt;
      const int held_lag = sweeps ? stage_lag : 0;
      peak_band = std::max(peak_band, band_bytes(shape, cost, level.band_rows, held_lag));
      if (level.band_rows < shape.height)
        level.strip_rows = std::min(level.strip_rows, level.band_rows);
      level.window_rows = sweeps ? window_rows(shape, level.band_rows, stage_lag) : 0;
      level.loaded_rows = loaded_rows(shape, level.band_rows, held_lag);
      result.levels.push_back(level);
    }
    const double bands_on_host = device_.shares_host_memory ? device_.devices * peak_band : 0;
    const double scores_on_host =
        device_.shares_host_memory ? device_.devices * (score_bytes(result) - score_bytes(volume))
                                   : 0;
    result.forecast.memory_bytes = fixed + scores_on_host + bands_on_host + on_host;
    result.compiler_bytes = compiler_bytes();
    // Pictures that were kept from the first look (kept_pictures.h) may take a third of it.
    const double free_for_decoding =
        2.0 / 3 * (fixed + bands_on_host - kProcessBytes - options_.memory_beside);
    result.decoders = int(std::clamp(free_for_decoding / decoder_bytes(), 1.0, 1024.0));
    result.forecast.disk_bytes = in_files ? store_bytes(device_.devices) : 0;
    const int first = result.levels.front().band_rows;
    result.forecast.bands = (light_field_.height + first - 1) / first;
    return result;
  }

  /// With the most for scores that leaves room for a sweep; where none does, with the usual.
  std::optional<MemoryPlan> best_plan(double limit, Place place) const {
    const double usual = usual_volume(limit);
    auto first = plan(limit, usual, place);
    for (double volume = usual; !first || !sweeps(*first);) {
      if (volume <= keeping_volume()) break;
      volume = std::max(volume / 2, keeping_volume());
      auto other = plan(limit, volume, place);
      if (other && sweeps(*other)) return other;
    }
    return first;
  }
  static bool sweeps(const MemoryPlan& plan) { return plan.levels.front().window_rows > 0; }

  /// The least limit under which there is a plan.
  double least_limit() const {
    double peak_band = 0;
    for (const LevelShape& shape : shapes_) {
      const LevelCost cost = cost_of(shape, light_field_, options_, active_, band_views_, true);
      const int rows = std::min(strip_needs(options_.support, shape.level).multiple, shape.height);
      peak_band = std::max(peak_band, band_bytes(shape, cost, rows, 0));
    }
    return fixed_bytes(least_volume()) + device_.devices * peak_band;
  }

  /// With all stores in memory, and as much as a run can use.
  double everything() const {
    const double plenty = std::numeric_limits<double>::infinity();
    for (const Place place : {Place::kDevice, Place::kHost})
      if (const auto all = plan(plenty, usual_volume(plenty), place))
        return all->forecast.memory_bytes;
    return fixed_bytes(usual_volume(plenty)) + store_bytes(device_.devices);
  }

 private:
  /// Of strips of so many rows, with what is kept for the slanted look.
  double rows_volume(int rows) const {
    return volume_row_bytes(light_field_.width, hypotheses_) * (score_lag(0) + rows);
  }
  int usual_rows() const { return guided_ ? kGuidedRows : kUsualRows; }
  /// Volumes beside that of the scores as they come: with support, along scan-lines.
  int beside_scores(int level) const {
    return (options_.support.radius > 0) + (options_.support.scanline && level == 0);
  }
  /// Looks that score anew, while the first look's scores wait for the slanted one.
  int looks_anew() const {
    return few_first(options_, int(band_views_)) + options_.support.half_planes;
  }
  double device_memory() const {
    return device_.shares_host_memory ? std::numeric_limits<double>::infinity()
                                      : kDeviceShare * device_.memory;
  }
  double largest_store() const {
    double largest = 0;
    for (const LevelShape& shape : shapes_)
      largest = std::max(
          largest,
          cost_of(shape, light_field_, options_, active_, band_views_, false).largest_store);
    return largest;
  }
  /// copies: devices that each have their own of what is not shared.
  double store_bytes(int copies) const {
    double stores = 0;
    for (const LevelShape& shape : shapes_) {
      const LevelCost cost = cost_of(shape, light_field_, options_, active_, band_views_, false);
      stores += cost.shared + copies * (cost.stores - cost.shared);
    }
    return stores + kTuplesPerPixel * sizeof(RayTuple) * light_field_.width * light_field_.height;
  }
  /// What the host holds of a run that lies on a device with memory of its own: the pictures as
  /// they are decoded; at the end finished maps and tuples.
  double passing_bytes() const {
    const double pixels = double(light_field_.width) * light_field_.height;
    const double value_bytes = 3.0 * light_field_.pixels->bit_depth() / 8;
    const double decoded =
        pixels * light_field_.num_views() * (value_bytes + light_field_.pixels->has_mask());
    const double finished =
        pixels * (active_ * FinishedMaps::kPixelBytes + kTuplesPerPixel * sizeof(RayTuple));
    return std::max(decoded, finished);
  }
  /// What the windows reach, a row for gradients, two for interpolation taps.
  int halo(const LevelShape& shape) const {
    const StripNeeds needs = strip_needs(options_.support, shape.level);
    return 3 + std::max({options_.edge.radius + 2, needs.halo / 2, options_.winner.median_radius,
                         options_.support.slanted ? kSlopeReach : 0, 3});
  }
  /// Rows of a band that fit into so many bytes; 0: none do.
  int fit_band(const LevelShape& shape, const LevelCost& cost, double room, int multiple,
               int lag) const {
    int band = shape.height;
    // One buffer each.
    const auto is_too_large = [&](int rows) {
      return loaded_rows(shape, rows, lag) * cost.row_floats > device_.largest_buffer ||
             (cost.reached_estimates > 0 &&
              reached_rows(shape, rows, 0) * cost.reached_estimates > device_.largest_buffer);
    };
    while (band_bytes(shape, cost, band, lag) > room || is_too_large(band)) {
      // Halving keeps the number of bands, and with it the halo rows, small.
      const int fewer = band > 16 ? (band + 1) / 2 : band - 1;
      const int whole = (fewer + multiple - 1) / multiple * multiple;
      if (whole >= band || whole < 1) return 0;
      band = whole;
    }
    return band;
  }
  int window_rows(const LevelShape& shape, int band_rows, int lag) const {
    return band_rows >= shape.height ? shape.height : std::min(band_rows + lag, shape.height);
  }
  int score_lag(int level) const {
    return gigaray::score_lag(sweep_stages(options_, level, int(band_views_), guided_),
                              options_.support);
  }
  double band_bytes(const LevelShape& shape, const LevelCost& cost, int band_rows, int lag) const {
    return loaded_rows(shape, band_rows, lag) * cost.band_row +
           (cost.reached_row > 0 ? reached_rows(shape, band_rows, 0) * cost.reached_row : 0);
  }
  /// Most rows in memory for a band of so many rows and what stages lag.
  int loaded_rows(const LevelShape& shape, int band_rows, int lag) const {
    return reached_rows(shape, window_rows(shape, band_rows, lag), halo(shape));
  }
  /// Most rows that rays of a band and `around` rows on both sides reach.
  int reached_rows(const LevelShape& shape, int band_rows, int around) const {
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
              const RowRange own = grown(band, around, shape.height);
              most = std::max(most, level.rows_needed(ref, own, hypotheses_, shape.height).size());
            }
          return most;
        },
        sampler_);
  }

  const LightField& light_field_;
  const DepthOptions& options_;
  const DeviceLimits device_;
  const HypothesisRange hypotheses_;
  const bool guided_;
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
                          const HypothesisRange& hypotheses, const DeviceLimits& device) {
  return Planner(light_field, options, hypotheses, device).least_limit();
}

MemoryPlan plan_memory(const LightField& light_field, const DepthOptions& options,
                       const HypothesisRange& hypotheses, const DeviceLimits& device) {
  const double limit = options.memory_bytes > 0 ? options.memory_bytes : default_memory_limit();
  const Planner planner(light_field, options, hypotheses, device);
  // In files only where memory does not hold the stores, or leaves so little that a view would be
  // walked in many more bands, each stage by itself.
  constexpr int kFewBands = 4, kManyMore = 4;
  auto in_files = planner.best_plan(limit, Place::kFile);
  std::optional<MemoryPlan> in_memory;
  for (const Place place : {Place::kDevice, Place::kHost}) {
    auto other = planner.best_plan(limit, place);
    if (other && (!in_memory || Planner::sweeps(*other))) in_memory = std::move(other);
    if (in_memory && Planner::sweeps(*in_memory)) break;
  }
  // With fewer rows at once, which are scored again for every look.
  for (const Place place : {Place::kDevice, Place::kHost, Place::kFile}) {
    if (in_memory || in_files) break;
    (place == Place::kFile ? in_files : in_memory) =
        planner.plan(limit, planner.least_volume(), place);
  }
  if (!in_memory && !in_files && planner.least_limit() <= limit)
    throw Error(
        ErrorCode::kOutOfMemory,
        "the rays of one row reach so much of " + std::to_string(light_field.num_views()) +
            " views that it doesn't fit into one buffer of the device, or into its "
            "memory; compare fewer views (DepthOptions::most_partners) or smaller pictures");
  if (!in_memory && !in_files)
    throw Error(ErrorCode::kOutOfMemory,
                "memory of " + std::to_string(int(limit / kMiB)) +
                    " MiB is too little for one row of all " +
                    std::to_string(light_field.num_views()) + " views; give it at least " +
                    std::to_string(int(std::ceil(planner.least_limit() / kMiB))) + " MiB");
  const bool keep = in_memory && (!in_files || Planner::sweeps(*in_memory) ||
                                  in_memory->forecast.bands <=
                                      std::max(kFewBands, kManyMore * in_files->forecast.bands));
  MemoryPlan chosen = keep ? *in_memory : *in_files;
  if (!keep)
    chosen.work_folder =
        options.work_folder.empty()
            ? temporary_folder(" or name another folder by DepthOptions::work_folder")
            : options.work_folder;
  chosen.forecast.memory_all_bytes = planner.everything();
  return chosen;
}

}  // namespace gigaray
