// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <filesystem>

namespace gigaray::opencl {

/// PoCL's cache in a folder, as one of the processes that use it. PoCL loads the compiled kernels
/// of its cache without looking at them: a file that was cut short (a full disk, a crash of the
/// machine) ends the program. So the last user writes down the sizes of all files, and the next
/// first user removes the programs (folders) with a file that is missing or has another size; they
/// are compiled anew. Only a process that is alone with the folder does either: PoCL aborts when a
/// program vanishes while it compiles, and the size of a file that is being written is not one to
/// remember. Programs without a record are left alone.
class PoclCache {
 public:
  /// The folder must exist. Without a lock (a file system that has none) nothing is removed or
  /// recorded.
  explicit PoclCache(std::filesystem::path folder);
  ~PoclCache();
  PoclCache(const PoclCache&) = delete;
  PoclCache& operator=(const PoclCache&) = delete;

  const std::filesystem::path& folder() const { return folder_; }

 private:
  bool is_alone() const;
  void remove_damaged_programs() const;
  void record_programs() const;

  std::filesystem::path folder_;
  int lock_ = -1;  ///< descriptor of <folder>.lock, shared by all users
};

}  // namespace gigaray::opencl
