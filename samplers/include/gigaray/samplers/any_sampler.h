// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <variant>

#include "gigaray/core/api.h"
#include "gigaray/samplers/epi_sampler.h"
#include "gigaray/samplers/grid_sampler.h"
#include "gigaray/samplers/unstructured_sampler.h"

namespace GIGARAY_API gigaray {

/// The sampler of a light field, chosen at run time. Visited once per run.
using AnySampler = std::variant<EpiSampler, GridSampler, UnstructuredSampler>;

/// The sampler for the kind of the light field.
AnySampler make_sampler(const LightField& light_field);

}  // namespace gigaray
