// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "band.h"

namespace gigaray::reference {

/// Fills a band from encoded rows, gradients included if it has them.
void unpack_channels(const void* encoded, BandEncoding encoding, const std::vector<float>& table,
                     Band& band);

/// Gives the pixels where mask is 0 the colour kMaskedColour. mask: [row][view][u].
void mask_pixels(const std::uint8_t* mask, Band& band);

/// Fills gx and gy from the colours: half differences of the neighbours' channel means.
void unpack_gradients(Band& band);

}  // namespace gigaray::reference
