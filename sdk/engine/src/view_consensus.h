// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>
#include <vector>

#include "finished_maps.h"
#include "gigaray/core/ray_sampler.h"
#include "gigaray/core/run_control.h"
#include "gigaray/samplers/unstructured_sampler.h"

namespace gigaray {

/// What estimates may differ by and still be one, in steps of the hypotheses.
inline constexpr float kSameEstimate = 3;

/// Holds the depth of posed photographs against each other (docs/method.md, "Agreement of posed
/// views"). A pixel takes the estimate, its own or one that another view has there, that most views
/// share and fewest see through, and of those that share it the mean.
///   active         the views that the maps are of, indices of the sampler
///   maps           hypotheses and contrast, as the pipeline leaves them
///   step           of the hypotheses that were tested
///   folder         where the new maps go; empty: in memory
///   bytes_at_once  of other views' maps; decides nothing but how many rows are done together
/// Returns maps with the confidence that is reported: calibrated_agreement(), where another view
/// was asked. Levels stay, and so does what has no estimate. Throws Error(kCancelled), and
/// Error(kIo) when the folder is full.
FinishedMaps view_consensus(const UnstructuredSampler& sampler, const std::vector<int>& active,
                            FinishedMaps maps, double step, const std::string& folder,
                            const RunControl& control, std::size_t bytes_at_once = 128 << 20);

}  // namespace gigaray
