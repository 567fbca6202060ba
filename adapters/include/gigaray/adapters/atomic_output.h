// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace gigaray {

/// Writes a file beside its place and renames it there, so that nobody ever sees half of it; the
/// temporary is removed when anything fails. Throws Error(kIo) naming the place.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// A file that is written piece by piece and appears in its place only when it is complete.
/// Without commit() — an exception, an interrupt — what was written is removed. Throws Error(kIo)
/// naming the place; Error(kInvalidArgument) when it is a folder.
class AtomicFile {
 public:
  /// Opens a hidden file beside `path`; an older file stays until commit() replaces it.
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);  ///< At the end of what is there.
  void write_at_begin(std::string_view bytes);
  void commit();

 private:
  void check();

  std::filesystem::path path_, temporary_;
  std::ofstream file_;
};

/// An output folder that appears only when it is complete.
///
///   AtomicFolder out("out", "gigaray depth");
///   write_pfm(out.path() / "disparity.pfm", map);
///   out.commit();
///
/// Without commit() — an exception, an interrupt — everything written is removed.
class AtomicFolder {
 public:
  /// Creates TARGET.partial-<process id> beside `target`, and the folders above. A target that
  /// exists is accepted when it is an empty folder, or when its `description` has
  /// "format": `format`, an earlier output of the same kind: commit() replaces it. Anything else is
  /// refused with Error(kInvalidArgument); Error(kIo) when the place can't be written.
  AtomicFolder(const std::filesystem::path& target, std::string format,
               std::string description = "gigaray.json");
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  /// Where to write; gone after commit().
  const std::filesystem::path& path() const { return partial_; }

  /// Puts the folder in its place. Throws Error(kIo); the earlier output is then still there.
  void commit();

 private:
  void check_target() const;

  std::filesystem::path target_;
  std::filesystem::path partial_;
  std::string format_, description_;
};

}  // namespace gigaray
