// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace gigaray {

/// Appends numbers to a string: 7 bits per byte, the lowest first, the top bit says that more
/// follow.
class ByteWriter {
 public:
  void number(std::uint64_t value);
  void signed_number(std::int64_t value);
  /// Compressed with zstd, its compressed size before it.
  void block(std::string_view bytes);
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads what ByteWriter wrote. Throws Error(kBadInput) when it ends too early or says what can't
/// be.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}
  std::uint64_t number();
  /// A number that is at most `most`.
  std::uint64_t number(std::uint64_t most);
  /// A number of at most `most` and at least −most.
  std::int64_t signed_number(std::int64_t most);
  /// A block that has no more than `most` bytes when it is decompressed.
  std::string block(std::size_t most);
  bool at_end() const { return bytes_.empty(); }
  std::string_view rest() const { return bytes_; }  ///< what was not read yet

 private:
  std::string_view bytes_;
};

/// 0, −1, 1, −2 … as 0, 1, 2, 3 …
inline std::uint64_t zigzag(std::int64_t value) {
  return value < 0 ? (std::uint64_t(-(value + 1)) << 1) + 1 : std::uint64_t(value) << 1;
}
inline std::int64_t unzigzag(std::uint64_t code) {
  return code & 1 ? -std::int64_t(code >> 1) - 1 : std::int64_t(code >> 1);
}

[[noreturn]] void damaged(const char* what);  ///< Throws Error(kBadInput).

}  // namespace gigaray
