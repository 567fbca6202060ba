// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"

namespace GIGARAY_API gigaray {

/// Share of right pixels among those whose best score exceeds the mean score by `contrast`, 0 … 1:
/// what confidence means in `auto`. Right is within 0.07 px of the truth, of posed photographs
/// within 1 % of the depth. Rises with the contrast; pooled over rendered and synthetic scenes,
/// clean and noisy (docs/accuracy.md has the tables per scene). NaN stays NaN.
float calibrated_confidence(float contrast, LightFieldKind kind);

/// The same of posed photographs whose views were held against each other: agreement is what views
/// say for an estimate less what they say against it, as a share of all that might, −1 … 1.
float calibrated_agreement(float agreement);

}  // namespace gigaray
