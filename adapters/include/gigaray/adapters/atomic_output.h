// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/run_control.h"

namespace GIGARAY_API gigaray {

/// What an output may do to the place where it goes. Under any rules nothing is removed or replaced
/// but what this library wrote itself and nobody changed since: of folders a manifest in them says
/// so (docs/formats.md), of single files an extended attribute.
struct OutputRules {
  /// What the run reads. An output folder may not be one of these, contain one or lie in one; an
  /// output file may not be one.
  std::vector<std::filesystem::path> inputs;
  /// What stands in the way is moved aside, to NAME.old-1, instead of being refused.
  bool replace = false;
};

/// Writes a file beside its place and renames it there, so that nobody ever sees half of it; an
/// older file is replaced, whoever wrote it. For the files of an output folder, and for callers who
/// have made sure. Throws Error(kIo) naming the place.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// A file that is written piece by piece and appears in its place only when it is complete.
/// Without commit() — an exception, an interrupt, a crash — nothing is left of it. A device or a
/// pipe is written to at commit(), never replaced; of a link the file that it leads to is meant.
/// Throws Error(kIo) naming the place, Error(kInvalidArgument) where it can't be an output.
class AtomicFile {
 public:
  /// An older file is replaced, whoever wrote it.
  explicit AtomicFile(const std::filesystem::path& path);
  /// Make it before the work, so that a place that can't be used shows then. extensions: what the
  /// name may end in (lower case, with the dot); empty: anything. Devices and pipes have none.
  AtomicFile(const std::filesystem::path& path, const OutputRules& rules,
             std::initializer_list<const char*> extensions);
  ~AtomicFile();
  AtomicFile(AtomicFile&&) noexcept;
  AtomicFile& operator=(AtomicFile&&) = delete;

  void write(std::string_view bytes);  ///< At the end of what is there.
  void write_at_begin(std::string_view bytes);
  /// Puts the file in its place, on disk for good. Throws Error(kCancelled) when the run was
  /// cancelled before, never once it is in place.
  void commit(const RunControl& control = RunControl());

  /// The same for files that belong together: all are on disk before the first is put in its place,
  /// and then they follow each other in their order, name by name. Put the one that names the
  /// others last.
  static void commit_together(std::span<AtomicFile> files, const RunControl& control);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// An output folder that appears only when it is complete.
///
///   AtomicFolder out("out", "gigaray depth", rules);
///   write_pfm(out.path() / "disparity.pfm", map);
///   out.commit(control);
///
/// Without commit() — an exception, an interrupt — everything written is removed; what a crash left
/// behind is removed by the next output beside it.
class AtomicFolder {
 public:
  /// Creates a hidden folder beside `target`, and the folders above. kind: what is written, as
  /// "gigaray depth". A target that exists is accepted when it is an empty folder or an earlier
  /// output of the same kind in which nothing was added or changed: commit() replaces it. Anything
  /// else, the folder in which the process is, and what the rules forbid, is refused with
  /// Error(kInvalidArgument); Error(kIo) when the place can't be written.
  AtomicFolder(const std::filesystem::path& target, std::string kind, OutputRules rules = {});
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  /// Where to write; gone after commit().
  const std::filesystem::path& path() const;

  /// Puts the folder in its place at once, on disk for good: whatever happens meanwhile, there is
  /// the older output or this one, complete. Throws Error(kIo), or Error(kCancelled) when the run
  /// was cancelled before; the earlier output is then still there.
  void commit(const RunControl& control = RunControl());

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace gigaray
