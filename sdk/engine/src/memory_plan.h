// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>
#include <vector>

#include "estimates.h"
#include "gigaray/engine/reconstruct.h"
#include "level_rows.h"

namespace gigaray {

/// Sizes of one level and how it is walked.
struct LevelPlan {
  LevelShape shape;
  int band_rows = 0;  ///< Rows of a band without halo.
  /// Rows whose pixels are there during a sweep: a band and what its stages lag. 0: every stage
  /// loads its own.
  int window_rows = 0;
  int loaded_rows = 0;  ///< Most rows of a band in memory, as a rule: with halo and rays' reach.
  int halo = 0;         ///< Rows around a band that the steps look at in one view.
  int strip_rows = 0;   ///< Rows that a sweep goes on by; no more than a band.
  bool keeps_scores = false;  ///< Scores of the first look are there for the slanted one.
};

/// How a run fits into the memory it may take.
struct MemoryPlan {
  std::vector<LevelPlan> levels;
  bool guided = false;  ///< Level 0 is searched where half the size tells (coarse_guide.h).
  Place place = Place::kDevice;  ///< Where rows are stored.
  std::string work_folder;       ///< of files; else empty
  Forecast forecast;
  /// The part of the forecast that compiling kernels takes. Every plan leaves room for it, so that
  /// a run needs as much whether its kernels are cached or not.
  double compiler_bytes = 0;
  int decoders = 1;  ///< Pictures that may be decoded at a time, in the room of the bands to come.
};

/// What a device has, or each of several alike that share a run.
struct DeviceLimits {
  double memory = 0;                   ///< bytes of its own
  double largest_buffer = 1800 << 20;  ///< bytes; every driver we know grants so much
  bool shares_host_memory = true;      ///< then it has no other memory than the host's
  int devices = 1;
};

/// options: resolved (range, hypotheses). Throws Error(kOutOfMemory) when even one row at a time
/// does not fit.
MemoryPlan plan_memory(const LightField& light_field, const DepthOptions& options,
                       const HypothesisRange& hypotheses, const DeviceLimits& device);

/// Least DepthOptions::memory_bytes that there is a plan for.
double least_memory_limit(const LightField& light_field, const DepthOptions& options,
                          const HypothesisRange& hypotheses, const DeviceLimits& device);

/// Sizes of all levels: halved, odd sizes rounded up, until a dimension would fall below 10 px.
std::vector<LevelShape> level_shapes(int width, int height, bool fine_to_coarse);

}  // namespace gigaray
