// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gigaray/backend.h"
#include "gigaray/samplers/any_sampler.h"
#include "opencl/opencl_backend.h"

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

/// How far the answers of two backends are apart.
struct Agreement {
  double largest = 0;      ///< Largest difference.
  double share_apart = 0;  ///< Share of values beyond the tolerance, or NaN on one side only.

  /// A few values may differ: mean-shift is unstable where samples pull both ways, and two
  /// hypotheses may score alike. A wrong lane or a wrong edge is more than that on pictures as
  /// narrow as check_shape()'s.
  bool good() const { return share_apart <= 0.01; }
};

/// One step of the method on a small synthetic light field, to check its answer and to time it:
/// what tuning and the benchmarks have in common. The kernel is named as its file: "density_score".
class KernelTrial {
 public:
  static const std::vector<std::string>& kernels();

  /// The pictures to check on: small, so that the reference is quick, and no multiple of any LANES.
  static TrialShape check_shape(const TrialShape& shape);

  /// Renders the light field. options: what the backends are set up with, as they are.
  KernelTrial(const TrialShape& shape, const DepthOptions& options);

  /// Backends with the band loaded.
  std::unique_ptr<Backend> reference() const;
  std::unique_ptr<Backend> opencl(const std::string& device,
                                  const opencl::TuningOverrides& overrides = {}) const;

  /// Makes ready what the kernel takes from earlier steps.
  void prepare(Backend& backend, const std::string& kernel) const;
  /// The step itself, on all rows; what is to be timed.
  void run(Backend& backend, const std::string& kernel);
  /// The result of the last run() in a fixed order.
  std::vector<float> output(Backend& backend, const std::string& kernel);
  /// prepare, run, output.
  std::vector<float> answer(Backend& backend, const std::string& kernel);

  static Agreement compare(const std::string& kernel, const std::vector<float>& expected,
                           const std::vector<float>& actual);

  const TrialShape& shape() const { return shape_; }
  int num_views() const { return shape_.views_s * shape_.views_t; }

 private:
  RowRange rows() const { return {0, shape_.height}; }
  void load(Backend& backend) const;

  TrialShape shape_;
  BackendSetup setup_;
  AnySampler sampler_;
  std::vector<std::uint8_t> encoded_;  ///< [row][view][u][3]
  int ref_ = 0;

  // Inputs and results of the steps.
  StripMap<std::uint8_t> todo_;
  StripMap<HypothesisBounds> bounds_;
  StripMap<float> disparity_, confidence_, map_, second_map_;
  StripMap<Radiance> radiance_, mean_radiance_;
  StripMap<Slope> slopes_, fitted_slopes_;
  std::vector<PackedEstimate> estimates_;
  std::vector<float> small_;
};

}  // namespace gigaray
