// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"

namespace GIGARAY_API gigaray {

/// A camera in the convention of docs/conventions.md, as JSON: what read_camera() reads.
std::string camera_json(const Camera& camera);

/// Views that each unstructured view is compared with, itself not counted. Empty when the depths
/// that the views see are not known, or there are no cameras.
std::vector<int> count_partners(const LightField& light_field);

/// A sentence for who takes distances for metres: views with cameras whose unit nobody stated.
/// Empty: it is known, or there are no distances.
std::string note_on_scale(const LightField& light_field);

}  // namespace gigaray
