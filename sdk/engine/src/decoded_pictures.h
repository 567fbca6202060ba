// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <map>
#include <memory>
#include <string>

#include "gigaray/core/light_field.h"
#include "gigaray/core/run_control.h"
#include "memory_plan.h"
#include "row_store.h"

namespace gigaray {

/// All pictures of a light field as rows of all views side by side.
struct DecodedPictures {
  std::shared_ptr<RowStore> pixels;  ///< [v][view][u][3] as decoded
  std::shared_ptr<RowStore> shown;   ///< [v][view][u]: 0 where a pixel shows nothing; null: all do
};

/// Decodes each of them once, and lets them go.
DecodedPictures decode_pictures(const LightField& light_field, const MemoryPlan& plan,
                                const RunControl& control, std::map<std::string, double>& seconds);

}  // namespace gigaray
