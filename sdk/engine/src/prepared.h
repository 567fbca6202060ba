// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <memory>

#include "gigaray/core/light_field.h"
#include "gigaray/core/ray_sampler.h"
#include "gigaray/core/run_control.h"
#include "gigaray/engine/depth_options.h"
#include "gigaray/engine/device.h"
#include "workspace.h"

namespace gigaray {

/// What a run goes by, before its memory is planned.
struct Prepared {
  LightField light_field;  ///< as the engine gets to see it
  DepthOptions options;
  HypothesisRange hypotheses;
};

/// The pictures as the engine sees them, each read and cleaned once.
LightField kept_and_cleaned(const LightField& light_field, const DepthOptions& options,
                            const RunControl& control);
/// Most that kept_and_cleaned() holds of them.
double kept_picture_bytes(const LightField& light_field, const DepthOptions& options);

/// Finds which way the camera goes where that is only assumed, and takes the range that it had to
/// estimate for that. Mirrored depth would look finished.
void require_direction(LightField& light_field, DepthOptions& options, const RunControl& control);

/// Checks the input and fills in what decides the memory. Reads pictures where the range has to be
/// estimated.
Prepared prepare(const LightField& light_field, const DepthOptions& wanted,
                 const RunControl& control);

/// Fills in what the pictures decide. The plan of the memory comes before: it holds for all
/// pictures, so that the forecast, which looks at none, and the run say the same.
void adapt_to_pictures(Prepared& run, const RunControl& control);

/// With all that the pictures may ask for.
DepthOptions widest(DepthOptions options);

/// device: null: the reference.
std::unique_ptr<Workspace> make_workspace(const Prepared& run, const Device* device);

}  // namespace gigaray
