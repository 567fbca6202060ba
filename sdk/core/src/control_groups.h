// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gigaray {

/// A folder with the limits of a control group, and the version of its files.
struct ControlGroup {
  std::filesystem::path folder;
  int version = 2;
};

/// The groups of this process that may limit what `controller` ("memory", "cpu") gives, and all
/// those around them, by the files of /proc and /sys under `root`. Folders need not be there.
std::vector<ControlGroup> control_groups(const std::filesystem::path& root,
                                         const std::string& controller);

}  // namespace gigaray
