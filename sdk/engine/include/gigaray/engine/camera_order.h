// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <optional>

#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"
#include "gigaray/core/run_control.h"

namespace GIGARAY_API gigaray {

/// When the adapter only assumed which way the cameras go (LightField::sign_is_assumed), finds it
/// by photo-consistency and turns the positions accordingly. Of (s, t), (s, −t), (t, s) and (−t, s)
/// the order under which views agree best stays; the assumed one unless another is clearly better.
/// Each of them has a twin with both axes turned around, whose disparities have the other sign:
/// parallel cameras see no negative ones, so that order stays under which most are positive. When
/// the pictures hold both signs (a focused rig), that one under which nearer surfaces hide farther
/// ones; the assumed one when they don't tell.
///
/// What was found is one line through control.message, in the words of `--direction`: the way of
/// the camera as s rises, then as t rises, of the positions that came in. A row that stays as
/// assumed is not reported. Returns the range that it had to estimate, in the new positions, if
/// any. Throws Error(kBadInput) when the pictures match under no order.
std::optional<DisparityRange> check_direction(LightField& light_field, const RunControl& control);

/// Do the views agree clearly better when positions in a plane that the input states are turned,
/// that is, when its two numbers change places or one of them its sign? Says so through
/// control.message; the positions stay. Both signs at once are not seen.
void doubt_positions(const LightField& light_field, const RunControl& control);

}  // namespace gigaray
