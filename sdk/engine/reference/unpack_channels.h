// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include "band.h"

namespace gigaray::reference {

/// Fills a band from encoded rows, gradients included if it has them.
void unpack_channels(const void* encoded, BandEncoding encoding, const std::vector<float>& table,
                     Band& band);

/// The colours of some rows of a band. encoded: of these rows.
void unpack_colours(const void* encoded, BandEncoding encoding, const std::vector<float>& table,
                    RowRange rows, Band& band);

/// Gives the pixels of some rows where mask is 0 the colour kMaskedColour. mask: [row][view][u], of
/// these rows.
void mask_pixels(const std::uint8_t* mask, RowRange rows, Band& band);

/// Fills gx and gy of some rows from the colours: half differences of the neighbours' channel
/// means.
void unpack_gradients(RowRange rows, Band& band);

}  // namespace gigaray::reference
