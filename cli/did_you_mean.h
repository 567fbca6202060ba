// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "gigaray/workflows/did_you_mean.h"

namespace gigaray::cli {

/// Check of an option whose values are words: "is 'png61'; it must be exr, npy or png16; did you
/// mean png16?"
CLI::Validator one_of(std::vector<std::string> words);

/// The first argument that looks like an option and that the command does not have, for an error
/// that says so and what was probably meant; empty: all are known.
std::string about_unknown_option(const CLI::App& command);

}  // namespace gigaray::cli
