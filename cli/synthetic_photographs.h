// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "gigaray/run_control.h"
#include "gigaray/synthetic_capture.h"
#include "output_option.h"

namespace gigaray::cli {

/// Writes OUT/images/VIEW.png, the exact depth OUT/truth/VIEW.pfm (z, scene units, of the pictures
/// as they are, with the lens's distortion), a COLMAP model OUT/sparse/0 of the exact cameras and
/// points, and how it was made, OUT/synthetic.json. All or nothing; says so on stdout.
void write_synthetic_photographs(const OutputOption& output, const SyntheticOptions& options,
                                 const SyntheticPath& path, const RunControl& control);

}  // namespace gigaray::cli
