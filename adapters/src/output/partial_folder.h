// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <string>

namespace gigaray {

/// A new, hidden folder .gigaray-partial-NAME-XXXXXX for what isn't complete, locked as long as its
/// process lives, and removed with all that is in it unless release() was called. What a process
/// that was killed left behind is thereby known to the next one, which removes it.
class PartialFolder {
 public:
  /// First tidies up `parent`. Throws Error(kIo) naming NAME in it.
  PartialFolder(const std::filesystem::path& parent, const std::string& name);
  ~PartialFolder();
  PartialFolder(const PartialFolder&) = delete;
  PartialFolder& operator=(const PartialFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// It has got another name, or holds something that was somewhere else: it is not removed.
  void release() { path_.clear(); }

 private:
  void remove();

  std::filesystem::path path_;
  int lock_ = -1;
};

/// Begin of the names of partial folders and files.
inline constexpr const char* kPartialPrefix = ".gigaray-partial-";
/// A path in `parent` that nothing has yet, as good as surely, for what becomes NAME.
std::filesystem::path partial_path(const std::filesystem::path& parent, const std::string& name);

/// Removes what dead processes left in a folder: partial files and folders. A folder with a whole
/// older result (the process died while it removed that) is removed file by file, by its manifest;
/// where the result it belongs to is missing (it died between two renames, on a file system that
/// can't exchange names) it gets its name back. Never throws.
void tidy_partials(const std::filesystem::path& parent);

}  // namespace gigaray
