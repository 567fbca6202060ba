// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <string>

#include "gigaray/core/api.h"

namespace GIGARAY_API gigaray {

/// The folder for temporary files: $TMPDIR, else the system's. Throws Error(kIo) naming TMPDIR when
/// there is no such folder, with `advice` at the end of the line.
std::string temporary_folder(const std::string& advice = "");

/// Bytes in a file without a name, so that nothing is left behind, even after a crash. Different
/// threads may use different bytes. Errors throw Error(kIo) naming the folder.
class ScratchFile {
 public:
  ScratchFile() = default;  ///< no file
  /// folder: where the file is; must exist.
  explicit ScratchFile(std::string folder);
  ScratchFile(ScratchFile&& other) noexcept;
  ScratchFile& operator=(ScratchFile&& other) noexcept;
  ~ScratchFile();

  bool is_open() const { return file_ >= 0; }
  /// Takes the space now, so that a full disk shows before the work and not in the middle of it.
  void reserve(std::uint64_t bytes);
  void read(std::uint64_t offset, std::size_t bytes, void* out) const;
  void write(std::uint64_t offset, std::size_t bytes, const void* in);

 private:
  std::string folder_;
  int file_ = -1;
};

}  // namespace gigaray
