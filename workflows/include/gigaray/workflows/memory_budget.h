// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>

#include "gigaray/core/api.h"

namespace GIGARAY_API gigaray {

/// Bytes that the program takes before it holds a picture, its libraries included.
inline constexpr double kProgramBytes = 112 * double(1 << 20);

/// The memory that a job may take which tells from sizes alone what it will take, and refuses
/// before the work what doesn't fit.
struct MemoryBudget {
  double gib = 0;  ///< 0: default_memory_limit()

  explicit MemoryBudget(double gib = 0) : gib(gib) {}

  /// What the job may take, bytes: as stated, else default_memory_limit(). The same at every call.
  double bytes() const;

  /// Throws Error(kOutOfMemory) when `needed` bytes, those of the program included, are more than
  /// that; names the least limit that will do. what: "25 views of 640 x 480 px".
  void require(double needed, const std::string& what) const;

 private:
  mutable double usual_ = 0;
};

/// "25 views of 640 x 480 px", for MemoryBudget::require().
std::string views_text(int num_views, int width, int height);

}  // namespace gigaray
