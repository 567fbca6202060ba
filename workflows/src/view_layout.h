// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/core/light_field.h"
#include "gigaray/core/run_control.h"
#include "gigaray/workflows/input.h"

namespace gigaray {

/// Judges by the pictures how views stand that have one number in their names: a line or a grid
/// that nothing but this number says is opened anew as the grid under which they clearly agree
/// better, if there is one. What `input` states stays, with a message. Other light fields are left
/// alone. True: it is another light field now.
bool settle_layout(const InputRequest& input, LightField& light_field, const RunControl& control);

}  // namespace gigaray
