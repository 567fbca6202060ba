// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/memory_budget.h"

#include <fmt/format.h>

#include <cmath>

#include "gigaray/core/error.h"
#include "gigaray/core/memory_limit.h"

namespace gigaray {

double MemoryBudget::bytes() const {
  if (gib > 0) return gib * double(1 << 30);
  if (usual_ == 0) usual_ = default_memory_limit();
  return usual_;
}

void MemoryBudget::require(double needed, const std::string& what) const {
  if (needed <= bytes()) return;
  const auto mib = [](double bytes) { return bytes / (1 << 20); };
  throw Error(ErrorCode::kOutOfMemory,
              fmt::format("memory of {:.0f} MiB is too little for {}; give it at least {:.0f} MiB "
                          "(`memory_gib` {:.2f})",
                          std::floor(mib(bytes())), what, std::ceil(mib(needed)),
                          std::ceil(mib(needed) / 1024 * 100) / 100));
}

std::string views_text(int num_views, int width, int height) {
  return fmt::format("{} view{} of {} x {} px", num_views, num_views == 1 ? "" : "s", width,
                     height);
}

}  // namespace gigaray
