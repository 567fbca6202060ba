// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gigaray {

/// What this library wrote into an output folder, as the file .gigaray-output.json in it says
/// (docs/formats.md). A file is still ours while its size and the time of its last change are those
/// in the manifest.
class OutputManifest {
 public:
  static constexpr const char* kFileName = ".gigaray-output.json";

  /// Lists everything in a folder. Throws Error(kIo).
  OutputManifest(const std::filesystem::path& folder, std::string kind);
  /// The one in a folder; nothing where there is none, or a damaged one.
  static std::optional<OutputManifest> read(const std::filesystem::path& folder);
  void write(const std::filesystem::path& folder) const;

  const std::string& kind() const { return kind_; }
  /// What is in the folder and not ours, or was changed since: paths relative to it, in order.
  /// Throws Error(kIo) where it can't be looked at.
  std::vector<std::filesystem::path> foreign(const std::filesystem::path& folder) const;
  /// Removes what is ours, the manifest last, and the folders that are empty then. Never fails;
  /// returns whether the folder is gone.
  bool remove(const std::filesystem::path& folder) const;

 private:
  struct Entry {
    std::uint64_t bytes = 0;
    std::int64_t changed_ns = 0;  ///< since 1970
    std::string link;             ///< where a symbolic link leads; empty: a regular file
    bool operator==(const Entry&) const = default;
  };

  OutputManifest() = default;
  static std::optional<Entry> entry_of(const std::filesystem::path& path);
  bool lists(const std::filesystem::path& folder, const std::filesystem::path& name) const;

  std::string kind_;
  std::map<std::filesystem::path, Entry> entries_;  ///< paths relative to the folder
};

}  // namespace gigaray
