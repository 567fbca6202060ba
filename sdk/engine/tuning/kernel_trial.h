// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gigaray/engine/device.h"
#include "gigaray/samplers/any_sampler.h"
#include "opencl/opencl_workspace.h"

namespace gigaray {

/// Pictures that a kernel is tried on: views_t 1 gives a 3D light field.
struct TrialShape {
  int views_s = 9;
  int views_t = 1;
  int width = 352;
  int height = 48;
  int hypotheses = 64;
  DisparityRange disparity{-0.5, 0.5};
};

/// How far the answers of two workspaces are apart.
struct Agreement {
  double largest = 0;      ///< Largest difference.
  double share_apart = 0;  ///< Share of values beyond the tolerance, or NaN on one side only.

  /// A few values may differ: mean-shift is unstable where samples pull both ways, and two
  /// hypotheses may score alike. A wrong lane or a wrong edge is more than that on pictures as
  /// narrow as check_shape()'s.
  bool good() const { return share_apart <= 0.01; }
};

/// A workspace with a band loaded, and maps that the steps read and write.
struct TrialBench {
  std::unique_ptr<Workspace> workspace;
  EncodedRows pixels;
  Map<std::uint8_t> todo;
  Map<HypothesisBounds> bounds;
  Map<float> disparity, confidence, map, second_map;
  Map<Radiance> radiance, mean_radiance;
  Map<Slope> slopes, fitted_slopes;
  RowsOnDevice estimates, small;
};

/// One step of the method on a small synthetic light field, to check its answer and to time it:
/// what tuning and the benchmarks have in common. The kernel is named as its file: "density_score".
class KernelTrial {
 public:
  static const std::vector<std::string>& kernels();

  /// The pictures to check on: small, so that the reference is quick, and no multiple of any LANES.
  static TrialShape check_shape(const TrialShape& shape);

  /// Renders the light field. options: what the workspaces are set up with, as they are.
  KernelTrial(const TrialShape& shape, const DepthOptions& options);

  std::unique_ptr<TrialBench> reference() const;
  std::unique_ptr<TrialBench> opencl(const Device& device,
                                     const opencl::TuningOverrides& overrides = {}) const;

  /// Makes ready what the kernel takes from earlier steps.
  void prepare(TrialBench& bench, const std::string& kernel) const;
  /// The step itself, on all rows, to its end; what is to be timed.
  void run(TrialBench& bench, const std::string& kernel) const;
  /// The result of the last run() in a fixed order.
  std::vector<float> output(TrialBench& bench, const std::string& kernel) const;
  /// prepare, run, output.
  std::vector<float> answer(TrialBench& bench, const std::string& kernel) const;

  static Agreement compare(const std::string& kernel, const std::vector<float>& expected,
                           const std::vector<float>& actual);

  const TrialShape& shape() const { return shape_; }
  int num_views() const { return shape_.views_s * shape_.views_t; }

 private:
  RowRange rows() const { return {0, shape_.height}; }
  std::unique_ptr<TrialBench> make_bench(std::unique_ptr<Workspace> workspace) const;
  void load(TrialBench& bench) const;

  TrialShape shape_;
  WorkspaceSetup setup_;
  AnySampler sampler_;
  std::vector<std::uint8_t> encoded_;  ///< [row][view][u][3]
  int ref_ = 0;

  // Inputs of the steps.
  StripMap<std::uint8_t> todo_;
  StripMap<HypothesisBounds> bounds_;
  StripMap<float> disparity_, confidence_;
  StripMap<Radiance> radiance_;
  StripMap<Slope> slopes_;
};

}  // namespace gigaray
