// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>

#include "gigaray/core/error.h"
#include "gigaray/workflows/surface.h"

namespace gigaray {

double largest_view(const DepthViews& views);  ///< px
/// Bytes of the views that are kept in memory at once.
double kept_bytes(const DepthViews& views);
/// A view and the views that bear witness for it, and maps of the one at work.
double reading_bytes(const DepthViews& views);
std::string text_of(const DepthViews& views);  ///< for MemoryBudget::require()

/// work(); what it finds wrong with the depth is said of `name`.
template <class Work>
auto blamed(const std::string& name, Work work) {
  try {
    return work();
  } catch (const Error& error) {
    const std::string text = error.what();
    if (error.code() != ErrorCode::kBadInput || text.find(name) != std::string::npos) throw;
    throw Error(error.code(), name + ": " + text);
  }
}

}  // namespace gigaray
