// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/input_file.h"

namespace gigaray {

// The container of a .grl file (docs/formats.md): a head of fixed size, sections one after the
// other, and a directory that says where they are. The head and the directory have checksums; those
// of the sections are in the directory.

/// A piece of the file.
struct Section {
  std::uint64_t offset = 0, size = 0;
  std::uint64_t checksum = 0;  ///< XXH64 of its bytes, seed 0
};

class SectionWriter {
 public:
  explicit SectionWriter(AtomicFile file);
  Section add(std::string_view bytes);
  /// Adds the directory and puts the file in its place. Returns its size.
  std::uint64_t finish(std::string_view directory, const RunControl& control);

 private:
  AtomicFile file_;
  std::uint64_t size_;
};

/// Thread-safe. Throws Error(kBadInput) naming the file: of another format, from a newer version,
/// cut short, damaged.
class SectionReader {
 public:
  /// limit: bytes that a section may have.
  SectionReader(const std::filesystem::path& path, double limit);
  std::string read(const Section& section) const;
  std::string directory() const { return read(directory_); }
  std::uint64_t size() const { return size_; }
  const std::filesystem::path& path() const { return file_.path(); }

 private:
  InputFile file_;
  std::uint64_t size_ = 0;
  double limit_;
  Section directory_;
};

}  // namespace gigaray
