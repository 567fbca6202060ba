// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "memory_option.h"

#include <fmt/format.h>

#include <cmath>

#include "gigaray/error.h"
#include "gigaray/memory_limit.h"
#include "numbers.h"

namespace gigaray::cli {

void MemoryBudget::add_to(CLI::App& app, const std::string& takes) {
  app.add_option("--memory", gib_,
                 "Most memory to use (default: three quarters of what is free); what needs more is "
                 "refused before the work. Takes " +
                     takes)
      ->check(above_zero())
      ->type_name("GiB");
}

double MemoryBudget::bytes() const {
  if (gib_ > 0) return gib_ * double(1 << 30);
  if (usual_ == 0) usual_ = default_memory_limit();
  return usual_;
}

void MemoryBudget::require(double needed, const std::string& what) const {
  if (needed <= bytes()) return;
  const auto mib = [](double bytes) { return bytes / (1 << 20); };
  throw Error(gigaray::ErrorCode::kOutOfMemory,
              fmt::format("memory of {:.0f} MiB is too little for {}; give it at least {:.0f} MiB "
                          "(--memory {:.2f})",
                          std::floor(mib(bytes())), what, std::ceil(mib(needed)),
                          std::ceil(mib(needed) / 1024 * 100) / 100));
}

std::string views_text(int num_views, int width, int height) {
  return fmt::format("{} view{} of {} x {} px", num_views, num_views == 1 ? "" : "s", width,
                     height);
}

}  // namespace gigaray::cli
