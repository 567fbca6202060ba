// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <memory>

#include "gigaray/adapters/registry.h"

namespace gigaray {

std::unique_ptr<const Reader> gigaray_json_reader();
std::unique_ptr<const Reader> sparse_file_reader();
std::unique_ptr<const Reader> hci_reader();
std::unique_ptr<const Reader> hdf5_reader();
std::unique_ptr<const Reader> stanford_reader();
std::unique_ptr<const Reader> lenslet_reader();
std::unique_ptr<const Reader> colmap_reader();
std::unique_ptr<const Reader> transforms_json_reader();
std::unique_ptr<const Reader> llff_reader();
std::unique_ptr<const Reader> mvsnet_reader();
std::unique_ptr<const Reader> middlebury_par_reader();
std::unique_ptr<const Reader> middlebury_stereo_reader();
std::unique_ptr<const Reader> calibrated_pair_reader();
std::unique_ptr<const Reader> strecha_reader();
std::unique_ptr<const Reader> named_grid_reader();
std::unique_ptr<const Reader> image_sequence_reader();

}  // namespace gigaray
