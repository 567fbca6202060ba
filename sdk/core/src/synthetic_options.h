// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>

namespace gigaray::synthetic {

/// Throw Error(kInvalidArgument): "synthetic scene: FIELD is VALUE; it must be WANTED".
void require(bool holds, const std::string& field, const std::string& value,
             const std::string& wanted);
void require_range(const std::string& field, double value, double low, double high);

/// Scenes built in scene units, with something in every direction; they are deeper than others.
bool has_room_around(const std::string& scene);

/// The greatest angle between the first and the last camera, as seen from the middle of the scene,
/// from which all pictures are full of it, degrees.
double widest_turn_deg(const std::string& scene);

}  // namespace gigaray::synthetic
