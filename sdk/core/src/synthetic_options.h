// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <string>

namespace gigaray::synthetic {

/// Throw Error(kInvalidArgument): "synthetic scene: FIELD is VALUE; it must be WANTED".
void require(bool holds, const std::string& field, const std::string& value,
             const std::string& wanted);
void require_range(const std::string& field, double value, double low, double high);

}  // namespace gigaray::synthetic
