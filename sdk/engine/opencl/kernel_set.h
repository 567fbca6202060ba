// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <map>
#include <string>
#include <vector>

#include "opencl/lane_kernel.h"
#include "opencl/opencl_workspace.h"

namespace gigaray::opencl {

/// Local memory of density_score per view, see there; mean_radiance takes 3.
inline constexpr int kStagedVectors = 4;

/// masks.cl and estimates.cl in one program, which knows no sampler.
inline constexpr const char* kMapSteps = "map steps";

/// A file of kernels, and the options that most runs have it built with.
struct KernelFile {
  std::string name;  ///< without .cl
  std::string options;
};

/// The kernels of one workspace, joined with its sampler's twin, each built when first asked for.
class KernelSet {
 public:
  /// sampler_file: a file of samplers/kernels. common: options of every kernel.
  KernelSet(const Device& device, std::string sampler_file, std::string common, int num_views,
            TuningOverrides overrides)
      : device_(device),
        sampler_file_(std::move(sampler_file)),
        common_(std::move(common)),
        num_views_(num_views),
        overrides_(std::move(overrides)) {}

  /// Makes these files one program: every program costs a start a look through OpenCL's own
  /// headers, from an empty cache much more. What two of them define means the same in both. Asked
  /// for with other options, or tuned unlike the ones before it, a file is a program of its own.
  void join(const std::vector<KernelFile>& files);
  /// A kernel without lanes. file: without .cl.
  Kernel& plain(const std::string& file, const std::string& entry, const std::string& options);
  /// A kernel with the lanes and groups of its tuning. entry: empty, as the file.
  /// vectors: of local memory that every work-item wants; groups are made small enough for it.
  /// Throws Error(kDevice) where the device has too little for one work-item.
  LaneKernel& lanes(const std::string& file, const std::string& options, std::string entry,
                    std::size_t vectors);
  /// Throws Error(kDevice) where the device has less local memory.
  void check_local_memory(const std::string& entry, std::size_t bytes) const;

 private:
  Kernel build(const std::string& file, const std::string& entry, const std::string& options,
               const Tuning& tuning);
  Tuning tuning_of(const std::string& kernel) const;

  const Device& device_;
  std::string sampler_file_, common_;
  int num_views_;
  TuningOverrides overrides_;
  std::vector<KernelFile> joined_;
  Tuning joined_tuning_;
  std::map<std::string, Kernel> plain_;
  std::map<std::string, LaneKernel> lanes_;
};

}  // namespace gigaray::opencl
