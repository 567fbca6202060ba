// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace gigaray::cli {

/// The known word that was probably meant: the nearest one by letters added, left out, changed or
/// swapped, or the only one that begins like it. Empty: none is near.
std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

/// "; did you mean depth?", or nothing.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& known);

/// Check of an option whose values are words: "is 'png61'; it must be exr, npy or png16; did you
/// mean png16?"
CLI::Validator one_of(std::vector<std::string> words);

/// The first argument that looks like an option and that the command does not have, for an error
/// that says so and what was probably meant; empty: all are known.
std::string about_unknown_option(const CLI::App& command);

}  // namespace gigaray::cli
