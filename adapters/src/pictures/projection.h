// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>
#include <vector>

#include "formats/stated_views.h"

namespace gigaray {

/// Which of some numbers are a pose, which set_pose looks at.
struct PoseAt {
  std::size_t begin = 0, end = 0;
};

/// Words from the first-th on as numbers. Throws Error(kBadInput) for one that is not finite, but
/// for those of a pose.
std::vector<double> finite_numbers(const std::vector<std::string>& words, std::size_t first,
                                   const std::string& where, PoseAt pose = {});

/// Sets the lens, but for its size, from K: 9 numbers by rows, pixel centres at integers. Throws
/// Error(kBadInput) when it is no matrix of a camera without skew.
void set_projection(StatedView& view, const double* k, const std::string& where);

}  // namespace gigaray
