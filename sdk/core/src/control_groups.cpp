// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "control_groups.h"

#include <fstream>
#include <system_error>

namespace gigaray {
namespace fs = std::filesystem;
namespace {

/// Is a controller in the list "cpu,memory"?
bool names(const std::string& controllers, const std::string& controller) {
  return ("," + controllers + ",").find("," + controller + ",") != std::string::npos;
}

}  // namespace

std::vector<ControlGroup> control_groups(const fs::path& root, const std::string& controller) {
  const fs::path mounts = root / "sys/fs/cgroup";
  std::error_code ignored;
  const fs::path unified =
      fs::is_directory(mounts / "unified", ignored) ? mounts / "unified" : mounts;
  std::vector<ControlGroup> groups;
  std::ifstream own(root / "proc/self/cgroup");
  for (std::string line; std::getline(own, line);) {
    // NUMBER:CONTROLLERS:PATH; a path may have colons.
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    if (!controllers.empty() && !names(controllers, controller)) continue;
    ControlGroup group{controllers.empty() ? unified : mounts / controller,
                       controllers.empty() ? 2 : 1};
    groups.push_back(group);
    // In a container the path can be that of the machine, of which only the root is to be seen.
    for (const fs::path& name : fs::path(line.substr(second + 1)).relative_path()) {
      if (name == "..") break;  // a group beside the root of this name space
      group.folder /= name;
      groups.push_back(group);
    }
  }
  return groups;
}

}  // namespace gigaray
