// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace gigaray::opencl {

/// A 128-bit hash of pieces of bytes, 8 bytes per step. Guards against accidents, not against an
/// attacker who can write to the user's cache. In the byte order of the machine, as what is kept in
/// the cache.
class ContentHash {
 public:
  using Value = std::array<std::uint64_t, 2>;

  /// Another piece. Its length counts too: ("ab", "c") and ("a", "bc") differ.
  void add(std::string_view piece);
  Value value() const { return {std::uint64_t(state_ >> 64), std::uint64_t(state_)}; }

 private:
  using Wide = unsigned __int128;
  void step(std::uint64_t word) {
    // Both ways back and forth are one to one, so that a change of one word is never lost.
    state_ ^= word;
    state_ *= kMultiplier;
    state_ ^= state_ >> 64;
  }
  static constexpr Wide kMultiplier = (Wide(0x9e3779b97f4a7c15) << 64) | 0xf39cc0605cedc835;
  Wide state_ = kMultiplier;
};

/// Of one piece.
ContentHash::Value content_hash(std::string_view content);

std::string to_hex(const ContentHash::Value& hash);  ///< 32 digits

}  // namespace gigaray::opencl
