// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <filesystem>

namespace gigaray::opencl {

/// Least room for what PoCL compiles: all kernels of a run take some MiB, and where there is no
/// room for them LLVM ends the process.
inline constexpr std::uint64_t kPoclRoom = 32 << 20;  // bytes

/// PoCL's cache in a folder, as one of the processes that use it. PoCL loads the compiled kernels
/// of its cache without looking at them: a file that was cut short (a full disk, a kill) or that a
/// power cut left full of zeros ends the program. So the last user writes down a hash of every
/// file, and the next first user removes all programs (folders) with a file that is missing,
/// differs or was never written down, because the run that made it died; they are compiled anew.
/// Only a process that is alone with the folder does either: PoCL aborts when a program vanishes
/// while it compiles, and a file that is being written is not one to remember.
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

/// Is nobody using the cache, this process included? While the object lives nobody starts to.
class PoclCacheAlone {
 public:
  explicit PoclCacheAlone(const std::filesystem::path& folder);
  ~PoclCacheAlone();
  PoclCacheAlone(const PoclCacheAlone&) = delete;
  PoclCacheAlone& operator=(const PoclCacheAlone&) = delete;

  bool is_in_use() const { return is_in_use_; }

 private:
  int lock_ = -1;
  bool is_in_use_ = false;
};

}  // namespace gigaray::opencl
