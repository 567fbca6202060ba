// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

namespace gigaray {

/// Share of pixels within 0.07 px of the truth among those whose best score exceeds the mean score
/// by `contrast`, 0 … 1: what confidence means in `auto`. Rises with the contrast; pooled over
/// rendered and synthetic scenes, clean and noisy (docs/accuracy.md has the table per scene). NaN
/// stays NaN.
float calibrated_confidence(float contrast);

}  // namespace gigaray
