// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <memory>

#include "gigaray/adapters/registry.h"

namespace gigaray {

std::unique_ptr<const Reader> gigaray_json_reader();
std::unique_ptr<const Reader> hci_reader();
std::unique_ptr<const Reader> hdf5_reader();
std::unique_ptr<const Reader> stanford_reader();
std::unique_ptr<const Reader> lenslet_reader();
std::unique_ptr<const Reader> colmap_reader();
std::unique_ptr<const Reader> named_grid_reader();
std::unique_ptr<const Reader> image_sequence_reader();

/// Recognises the formats that this version can't read and says so.
std::vector<std::unique_ptr<const Reader>> later_formats();

}  // namespace gigaray
