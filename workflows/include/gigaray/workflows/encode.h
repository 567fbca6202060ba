// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>

#include "gigaray/adapters/sparse_file.h"
#include "gigaray/core/api.h"
#include "gigaray/workflows/depth.h"

namespace GIGARAY_API gigaray {

/// Disparities of all views for write_sparse_file(), computed now. The estimates stay in memory
/// while the file is written; the plan of the run knows of it.
DisparityOfView computed_disparities(OpenedInput& input, const DepthRequest& request,
                                     const RunControl& control);

/// The same of an output folder of `gigaray depth`. It may have found another direction of travel
/// than was assumed: the light field gets its places. Throws Error(kBadInput) when it is of other
/// pictures or lacks a view.
DisparityOfView disparities_of_result(const std::filesystem::path& result, LightField& light_field);

/// Bytes that coding takes, without the program: slopes and tuples of all views, and the planes of
/// the view that is coded.
double coding_bytes(const LightField& light_field);

}  // namespace gigaray
