// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "flag_names.h"

#include <algorithm>
#include <map>
#include <regex>
#include <string_view>

namespace gigaray::cli {
namespace {

/// Fields of structures.
struct FlagOfField {
  std::string_view field, flag;
};
constexpr FlagOfField kFlags[] = {
    {"DepthOptions::disparity", "--disparity"},
    {"DepthOptions::memory_bytes", "--memory"},
    {"DepthOptions::most_partners", "--partners"},
    {"DepthOptions::work_folder", "--work"},
    {"OpenOptions::convention", "--convention"},
    {"OpenOptions::direction", "--direction"},
    {"OpenOptions::grid", "--grid"},
    {"OpenOptions::images", "--images"},
    {"OpenOptions::lenslet", "--lenslet"},
    {"OpenOptions::masks", "--masks"},
    {"OpenOptions::memory_bytes", "--memory"},
    {"OpenOptions::positions", "--positions"},
    {"views to leave out", "--without"},
    {"KnownLens::focal_px", "--focal"},
    {"RigGeometry::focal_px", "--focal-px"},
    {"RigGeometry::baseline", "--baseline"},
    {"MapFormat::kColmap", "--format colmap"},
    {"MapFormat::kNerfstudio", "--format nerfstudio"},
    {"OutputRules::replace", "--replace"},
};

/// Fields of requests whose option has another name, or that have the name of a command.
const std::map<std::string, std::string> kOtherNames{{"distances", "--depth"},
                                                     {"memory_gib", "--memory"}};
/// Those whose option is called alike.
constexpr const char* kSameNames[] = {"focal_px",
                                      "baseline",
                                      "focus_distance",
                                      "unit",
                                      "grid",
                                      "direction",
                                      "disparity",
                                      "views",
                                      "without",
                                      "max_size",
                                      "find_cameras",
                                      "input",
                                      "at",
                                      "near",
                                      "far",
                                      "path",
                                      "pose",
                                      "tolerance",
                                      "kept",
                                      "truth_scale",
                                      "mask",
                                      "metrics",
                                      "leave_out",
                                      "poses",
                                      "min_confidence",
                                      "least_faces",
                                      "voxel",
                                      "texture",
                                      "set",
                                      "preset"};

std::string flag_of(const std::string& field) {
  if (const auto found = kOtherNames.find(field); found != kOtherNames.end()) return found->second;
  if (std::ranges::find(kSameNames, field) == std::end(kSameNames)) return {};
  std::string flag = "--" + field;
  std::ranges::replace(flag, '_', '-');
  return flag;
}

}  // namespace

std::string with_flags(std::string message) {
  for (const auto& [field, flag] : kFlags)
    for (auto at = message.find(field); at != std::string::npos; at = message.find(field, at))
      message.replace(at, field.size(), flag), at += flag.size();
  static const std::regex kField("`([a-z_]+)`");
  std::string result;
  auto rest = message.cbegin();
  for (std::sregex_iterator match(message.begin(), message.end(), kField), end; match != end;
       ++match) {
    const std::string flag = flag_of((*match)[1]);
    result.append(rest, (*match)[0].first);
    result += flag.empty() ? match->str() : flag;
    rest = (*match)[0].second;
  }
  return result.append(rest, message.cend());
}

}  // namespace gigaray::cli
