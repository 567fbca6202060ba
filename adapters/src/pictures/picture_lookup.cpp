// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "pictures/picture_lookup.h"

#include <algorithm>
#include <set>
#include <system_error>
#include <utility>

#include "files/text.h"
#include "gigaray/core/error.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

std::string with_slashes(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

/// On any machine: "/home/x/a.png", "C:\x\a.png".
bool is_absolute(const std::string& name) {
  return name.starts_with('/') || name.starts_with('\\') || (name.size() > 1 && name[1] == ':');
}

}  // namespace

const std::multimap<std::string, std::string>& PictureLookup::names_in(
    const fs::path& below) const {
  const auto [entry, is_new] = listed_.try_emplace(below);
  if (!is_new) return entry->second;
  std::error_code error;
  for (auto file = fs::directory_iterator(folder_ / below, error);
       !error && file != fs::directory_iterator(); file.increment(error)) {
    const std::string name = file->path().filename().string();
    entry->second.emplace(lower(name), name);
  }
  return entry->second;
}

std::string PictureLookup::find(const std::string& stated) const {
  if (stated.empty()) return {};
  if (is_file(folder_ / stated)) return stated;
  const std::string slashed = with_slashes(stated);
  if (is_file(folder_ / slashed)) return slashed;

  // Folder by folder, so that every part may be in another case.
  const fs::path path = fs::path(slashed).lexically_normal();
  if (path.is_absolute() || !path.has_filename()) return {};
  fs::path below;
  for (const fs::path& part : path.parent_path()) {
    std::error_code ignored;
    if (part == ".." || fs::is_directory(folder_ / below / part, ignored)) {
      below /= part;
      continue;
    }
    const auto& names = names_in(below);
    const auto found = names.find(lower(part.string()));
    if (found == names.end()) return {};
    below /= found->second;
  }
  const auto& names = names_in(below);
  const std::string wanted = lower(path.filename().string());
  for (auto [name, end] = names.equal_range(wanted); name != end; ++name)
    if (is_file(folder_ / below / name->second)) return (below / name->second).string();

  // A dot may belong to the name, "scene.001", so both readings are tried.
  for (const std::string& stem : {wanted, lower(path.stem().string())}) {
    std::vector<std::string> found;
    for (auto name = names.lower_bound(stem + ".");
         name != names.end() && name->first.starts_with(stem + "."); ++name)
      if (fs::path(name->first).stem() == stem && is_file(folder_ / below / name->second) &&
          is_picture(folder_ / below / name->second))
        found.push_back((below / name->second).string());
    // Of a name without an extension several kinds may be there: the better kept one.
    const auto png = std::ranges::find_if(
        found, [](const std::string& name) { return lower(name).ends_with(".png"); });
    if (stem == wanted && png != found.end()) return *png;
    if (found.size() == 1 || (stem == wanted && !found.empty())) return found.front();
  }
  return {};
}

std::string PictureLookup::find_below(const std::string& stated) const {
  const std::string slashed = with_slashes(stated);
  for (auto slash = slashed.find('/'); slash != std::string::npos;
       slash = slashed.find('/', slash + 1))
    if (std::string found = find(slashed.substr(slash + 1)); !found.empty()) return found;
  return {};
}

FoundNames find_names(const std::vector<fs::path>& folders,
                      const std::vector<std::string>& stated) {
  GIGARAY_CHECK(!folders.empty());
  FoundNames best;
  std::size_t most = 0;
  for (const fs::path& folder : folders) {
    const PictureLookup lookup(folder);
    FoundNames found{folder, {}};
    std::size_t count = 0;
    std::set<std::string> taken;
    for (const std::string& name : stated) {
      std::string there = lookup.find(name);
      count += !there.empty();
      if (!there.empty()) taken.insert(there);
      found.names.push_back(std::move(there));
    }
    const bool is_elsewhere = count == 0;
    for (std::size_t i = 0; i < stated.size(); ++i) {
      std::string& name = found.names[i];
      if (!name.empty()) continue;
      // One picture that is missing is not another one of its name in a folder above.
      if (is_elsewhere || is_absolute(stated[i])) name = lookup.find_below(stated[i]);
      // Two pictures of one name in two folders are not one picture.
      if (!name.empty() && taken.insert(name).second)
        ++count;
      else
        name = with_slashes(stated[i]);
    }
    if (best.names.empty() || count > most) {
      most = count;
      best = std::move(found);
    }
  }
  return best;
}

}  // namespace gigaray
