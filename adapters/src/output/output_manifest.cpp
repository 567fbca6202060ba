// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "output/output_manifest.h"

#include <sys/stat.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/path_text.h"
#include "gigaray/core/error.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kFormat = "gigaray output";
constexpr int kVersion = 1;

/// Calls visit(path relative to the folder, entry) for all that is below; links aren't followed.
template <class Visit>
void walk(const fs::path& folder, Visit visit) {
  std::error_code error;
  fs::recursive_directory_iterator it(folder, error), end;
  for (; !error && it != end; it.increment(error))
    visit(it->path().lexically_relative(folder), *it);
  if (error)
    throw Error(ErrorCode::kIo, folder.string() + ": can't be looked at (" + error.message() + ")");
}

}  // namespace

std::optional<OutputManifest::Entry> OutputManifest::entry_of(const fs::path& path) {
  struct stat status = {};
  if (lstat(path.c_str(), &status) != 0) return std::nullopt;
  Entry entry{std::uint64_t(status.st_size),
              std::int64_t(status.st_mtim.tv_sec) * 1'000'000'000 + status.st_mtim.tv_nsec,
              {}};
  if (S_ISREG(status.st_mode)) return entry;
  if (!S_ISLNK(status.st_mode)) return std::nullopt;
  std::error_code error;
  entry.link = fs::read_symlink(path, error).native();
  if (error) return std::nullopt;
  return entry;
}

OutputManifest::OutputManifest(const fs::path& folder, std::string kind) : kind_(std::move(kind)) {
  walk(folder, [&](const fs::path& name, const fs::directory_entry& found) {
    if (const auto entry = entry_of(found.path()); entry && name != kFileName)
      entries_[name] = *entry;
  });
}

std::optional<OutputManifest> OutputManifest::read(const fs::path& folder) {
  OutputManifest manifest;
  try {
    const json root = json::parse(read_json_text(folder / kFileName));
    if (root.at("format") != kFormat || root.at("version") != kVersion) return std::nullopt;
    manifest.kind_ = root.at("kind");
    for (const json& line : root.at("files")) {
      Entry& entry = manifest.entries_[path_of_text(line.at("path").get<std::string>())];
      entry.bytes = line.at("bytes");
      entry.changed_ns = line.at("changed_ns");
      if (line.contains("link"))
        entry.link = path_of_text(line["link"].get<std::string>()).native();
    }
  } catch (const json::exception&) {
    return std::nullopt;
  } catch (const Error&) {
    return std::nullopt;
  }
  return manifest;
}

void OutputManifest::write(const fs::path& folder) const {
  json files = json::array();
  for (const auto& [path, entry] : entries_) {
    files.push_back(
        {{"path", path_text(path)}, {"bytes", entry.bytes}, {"changed_ns", entry.changed_ns}});
    if (!entry.link.empty()) files.back()["link"] = path_text(entry.link);
  }
  const json root{{"format", kFormat}, {"version", kVersion}, {"kind", kind_}, {"files", files}};
  write_file_atomically(folder / kFileName, root.dump(1) + "\n");
}

bool OutputManifest::lists(const fs::path& folder, const fs::path& name) const {
  if (name == kFileName) return true;
  const auto listed = entries_.find(name);
  return listed != entries_.end() && entry_of(folder / name) == listed->second;
}

std::vector<fs::path> OutputManifest::foreign(const fs::path& folder) const {
  std::set<fs::path> folders;
  for (const auto& [path, entry] : entries_)
    for (fs::path above = path.parent_path(); !above.empty(); above = above.parent_path())
      folders.insert(above);
  std::vector<fs::path> found;
  walk(folder, [&](const fs::path& name, const fs::directory_entry& entry) {
    std::error_code error;
    const bool is_folder = fs::is_directory(entry.symlink_status(error));
    if (!(is_folder ? folders.contains(name) : lists(folder, name))) found.push_back(name);
  });
  std::sort(found.begin(), found.end());
  return found;
}

bool OutputManifest::remove(const fs::path& folder) const {
  std::vector<fs::path> ours, folders;
  try {
    walk(folder, [&](const fs::path& name, const fs::directory_entry& entry) {
      std::error_code error;
      if (fs::is_directory(entry.symlink_status(error)))
        folders.push_back(name);
      else if (name != kFileName && lists(folder, name))
        ours.push_back(name);
    });
  } catch (const Error&) {
    return false;
  }
  std::error_code kept;
  for (const fs::path& name : ours) fs::remove(folder / name, kept);
  // A folder comes before what is in it.
  std::for_each(folders.rbegin(), folders.rend(),
                [&](const fs::path& name) { fs::remove(folder / name, kept); });
  std::error_code error;
  const bool nothing_else = std::distance(fs::directory_iterator(folder, error), {}) <= 1 && !error;
  if (nothing_else) fs::remove(folder / kFileName, error);
  return nothing_else && fs::remove(folder, error);
}

}  // namespace gigaray
