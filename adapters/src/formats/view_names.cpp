// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "formats/view_names.h"

#include <algorithm>
#include <filesystem>
#include <set>

namespace gigaray {
namespace {

bool all_differ(const std::vector<std::string>& names) {
  return std::set<std::string>(names.begin(), names.end()).size() == names.size();
}

std::string without_separators(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '/' || c == '\\'; }, '_');
  if (name.empty() || name.front() == '.') name.insert(0, "_");
  return name;
}

}  // namespace

std::vector<std::string> view_names(const std::vector<std::string>& paths) {
  using Path = std::filesystem::path;
  std::vector<std::string> stems, long_stems, whole;
  for (const std::string& path : paths) {
    stems.push_back(without_separators(Path(path).stem().string()));
    long_stems.push_back(without_separators(Path(path).replace_extension().string()));
    whole.push_back(without_separators(path));
  }
  if (all_differ(stems)) return stems;
  if (all_differ(long_stems)) return long_stems;
  // "a/b.png" beside "a_b.png".
  std::set<std::string> taken;
  for (std::string& name : whole)
    while (!taken.insert(name).second) name += "_";
  return whole;
}

}  // namespace gigaray
