// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "gigaray/core/error.h"

namespace gigaray::fuzz {

/// A file in memory, for libraries that open files by name.
class FileOfBytes {
 public:
  explicit FileOfBytes(std::string_view bytes) : descriptor_(memfd_create("fuzz", MFD_CLOEXEC)) {
    GIGARAY_CHECK(descriptor_ >= 0);
    GIGARAY_CHECK(write(descriptor_, bytes.data(), bytes.size()) == ssize_t(bytes.size()));
  }
  ~FileOfBytes() { close(descriptor_); }
  FileOfBytes(const FileOfBytes&) = delete;
  FileOfBytes& operator=(const FileOfBytes&) = delete;

  std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

}  // namespace gigaray::fuzz
