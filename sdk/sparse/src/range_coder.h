// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace gigaray {

// Adaptive binary arithmetic coding (Martin 1979, range coding with carry). General compressors
// give a number no less than a bit (zstd's Huffman codes) or a fifth (LZMA's trees); here most have
// less: docs/formats.md has what that cost.

/// How probable a bit is, learned from those before it: the mean of a quick and a slow learner.
class BitModel {
 public:
  /// Of a 0, 2^-16; never certain.
  std::uint32_t zero() const {
    const std::uint32_t mean = (std::uint32_t(quick_) + slow_) >> 1;
    return mean < kLeast ? kLeast : mean > 0x10000 - kLeast ? 0x10000 - kLeast : mean;
  }
  void learn(bool bit) {
    const int target = bit ? 0 : 0xffff;
    quick_ = std::uint16_t(quick_ + ((target - quick_) >> 4));
    slow_ = std::uint16_t(slow_ + ((target - slow_) >> 7));
  }

 private:
  static constexpr std::uint32_t kLeast = 64;
  std::uint16_t quick_ = 0x8000, slow_ = 0x8000;
};

class RangeEncoder {
 public:
  void put(bool bit, BitModel& model);
  void put_raw(std::uint32_t value, int bits);  ///< as they are, the highest first
  std::string finish();

 private:
  void narrow(bool upper, std::uint32_t bound);
  void shift_out();

  std::string bytes_;
  std::uint64_t low_ = 0;
  std::uint32_t range_ = 0xffffffff;
  std::uint8_t held_ = 0;     ///< byte that a carry may still change,
  std::size_t num_held_ = 1;  ///< and 0xff bytes behind it
};

/// Throws Error(kBadInput) when it is asked for more than there is.
class RangeDecoder {
 public:
  explicit RangeDecoder(std::string_view bytes);
  bool get(BitModel& model);
  std::uint32_t get_raw(int bits);
  bool at_end() const { return next_ == bytes_.size(); }

 private:
  bool narrow(std::uint32_t bound);
  std::uint8_t next_byte();

  std::string_view bytes_;
  std::size_t next_ = 0;
  std::uint32_t range_ = 0xffffffff, code_ = 0;
};

/// Models of numbers of which small ones are the most frequent: the part above `low_bits` bits in
/// unary, long ones with their length first, then the low bits, of which only the first is
/// modelled.
class NumberModel {
 public:
  void put(std::uint32_t value, int low_bits, RangeEncoder& coder);
  std::uint32_t get(int low_bits, RangeDecoder& coder);

 private:
  static constexpr std::uint32_t kUnary = 20;  ///< Larger ones are written by their length.
  static constexpr int kLengths = 24;
  std::array<BitModel, kUnary> unary_;
  std::array<BitModel, kLengths> length_;
  std::array<BitModel, 4> first_low_;
};

}  // namespace gigaray
