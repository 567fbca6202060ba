// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "gigaray/core/api.h"

namespace GIGARAY_API gigaray {

// The door that every input file comes through. A file is a regular file, links followed: devices,
// pipes and sockets, which may never end or never answer, are refused at once. What a file claims
// to hold is compared with a limit before any of it is allocated.

/// Most bytes of a file of text: positions, parameters, cameras.
inline constexpr std::uint64_t kMostText = std::uint64_t(16) << 20;
/// Most bytes of a JSON file.
inline constexpr std::uint64_t kMostJson = std::uint64_t(128) << 20;
/// Deepest nesting of a JSON file.
inline constexpr int kDeepestJson = 64;

/// Bytes that opening an input may take: memory_bytes, or default_memory_limit() when that is 0.
/// Never less than 64 MiB, so that a small limit on a run refuses no small input.
double opening_limit(double memory_bytes = 0);

/// Throws Error(kBadInput) "PLACE: CLAIM, which takes N MiB of memory; the limit is M MiB…" when
/// bytes > limit.
void hold_against_limit(const std::string& place, const std::string& claim, double bytes,
                        double limit);

/// A regular file, open for reading. Thread-safe.
class InputFile {
 public:
  /// Throws Error naming the file: kBadInput for what is no file of bytes, kIo when it can't be
  /// opened.
  explicit InputFile(const std::filesystem::path& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t size() const { return size_; }
  /// Up to `size` bytes from `offset` on; fewer when the file ends before. Throws Error(kIo).
  std::string read(std::uint64_t offset, std::uint64_t size) const;
  /// The same into memory of the caller. Returns how many there were.
  std::uint64_t read(std::uint64_t offset, char* bytes, std::uint64_t size) const;

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

/// Throws what InputFile throws; for libraries that open files by name.
void check_input_file(const std::filesystem::path& path);

/// Everything in a file of at most `most` bytes. Throws Error as InputFile does, and kBadInput when
/// the file is larger.
std::string read_bytes(const std::filesystem::path& path, double most);
/// The same of a text file, as UTF-8: a byte order mark is taken away, UTF-16 with one converted.
std::string read_text(const std::filesystem::path& path);
/// The same of a JSON file, after check_json.
std::string read_json_text(const std::filesystem::path& path, double memory_bytes = 0);

/// Throws Error(kBadInput) beginning with `where` when JSON is nested deeper than kDeepestJson or
/// would take more than opening_limit(memory_bytes) as a tree of values. Looks at nothing else.
void check_json(std::string_view text, const std::string& where, double memory_bytes = 0);

}  // namespace gigaray
