// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/ready_kernels.h"

#include <cstdlib>

#include "opencl/cache_folder.h"
#include "opencl/content_hash.h"
#include "opencl/program_cache.h"

namespace gigaray::opencl {
namespace fs = std::filesystem;
namespace {

/// A file without content per kind of run. Where the kernels' own text changed all are anew.
fs::path file_of(const fs::path& cache, std::string_view job) {
  ContentHash hash;
  hash.add(job);
  for (const char* part :
       {"kernel_params.h", "common.cl", "density_score.cl", "robust_score.cl", "jump_sides.cl"})
    hash.add(kernel_source(part));
  return cache / kReadyFolder / to_hex(hash.value());
}

}  // namespace

std::string stated_device(const std::string& selection) {
  const char* usual = std::getenv("GIGARAY_DEVICE");
  return selection.empty() && usual ? usual : selection;
}

bool kernels_are_ready(std::string_view job) {
  const auto cache = cache_folder();
  std::error_code ignored;
  return cache && fs::exists(file_of(*cache, job), ignored);
}

void note_ready_kernels(std::string_view job) {
  if (const auto cache = cache_folder()) write_file_atomically(file_of(*cache, job), "");
}

void forget_ready_kernels(const fs::path& cache) {
  std::error_code ignored;
  fs::remove_all(cache / kReadyFolder, ignored);
}

}  // namespace gigaray::opencl
