// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <gtest/gtest.h>

#include "gigaray/engine/reconstruct.h"

namespace gigaray::testing_support {

/// The least memory that a run can be given, within 64 KiB: it makes the run use files and many
/// bands.
inline double least_limit_by_trial(const LightField& light_field, DepthOptions options) {
  double too_little = 1 << 20, enough = 4e9;
  while (enough - too_little > 65536) {
    options.memory_bytes = (too_little + enough) / 2;
    try {
      forecast(light_field, options);
      enough = options.memory_bytes;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kOutOfMemory);
      too_little = options.memory_bytes;
    }
  }
  return enough;
}

}  // namespace gigaray::testing_support
