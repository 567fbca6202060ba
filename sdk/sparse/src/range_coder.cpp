// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "range_coder.h"

#include <algorithm>
#include <bit>

#include "bytes.h"

namespace gigaray {
namespace {

constexpr std::uint32_t kLeastRange = 1 << 24;
constexpr int kTail = 5;  ///< bytes that finish() and the constructor of the decoder move

}  // namespace

void RangeEncoder::shift_out() {
  if (low_ < 0xff000000 || low_ > 0xffffffff) {
    const auto carry = std::uint8_t(low_ >> 32);
    for (std::uint8_t byte = held_; num_held_ > 0; --num_held_, byte = 0xff)
      bytes_.push_back(char(std::uint8_t(byte + carry)));
    held_ = std::uint8_t(low_ >> 24);
  }
  ++num_held_;
  low_ = (low_ & 0x00ffffff) << 8;
}

void RangeEncoder::narrow(bool upper, std::uint32_t bound) {
  if (upper) {
    low_ += bound;
    range_ -= bound;
  } else {
    range_ = bound;
  }
  while (range_ < kLeastRange) {
    range_ <<= 8;
    shift_out();
  }
}

void RangeEncoder::put(bool bit, BitModel& model) {
  narrow(bit, (range_ >> 16) * model.zero());
  model.learn(bit);
}

void RangeEncoder::put_raw(std::uint32_t value, int bits) {
  for (int i = bits - 1; i >= 0; --i) narrow(value >> i & 1, range_ >> 1);
}

std::string RangeEncoder::finish() {
  for (int i = 0; i < kTail; ++i) shift_out();
  return std::move(bytes_);
}

RangeDecoder::RangeDecoder(std::string_view bytes) : bytes_(bytes) {
  for (int i = 0; i < kTail; ++i) code_ = code_ << 8 | next_byte();
}

std::uint8_t RangeDecoder::next_byte() {
  if (next_ == bytes_.size()) damaged("its differences end too early");
  return std::uint8_t(bytes_[next_++]);
}

bool RangeDecoder::narrow(std::uint32_t bound) {
  const bool upper = code_ >= bound;
  if (upper) {
    code_ -= bound;
    range_ -= bound;
  } else {
    range_ = bound;
  }
  while (range_ < kLeastRange) {
    range_ <<= 8;
    code_ = code_ << 8 | next_byte();
  }
  return upper;
}

bool RangeDecoder::get(BitModel& model) {
  const bool bit = narrow((range_ >> 16) * model.zero());
  model.learn(bit);
  return bit;
}

std::uint32_t RangeDecoder::get_raw(int bits) {
  std::uint32_t value = 0;
  for (int i = 0; i < bits; ++i) value = value << 1 | std::uint32_t(narrow(range_ >> 1));
  return value;
}

void NumberModel::put(std::uint32_t value, int low_bits, RangeEncoder& coder) {
  const std::uint32_t top = value >> low_bits;
  for (std::uint32_t i = 0; i < std::min(top, kUnary); ++i) coder.put(true, unary_[i]);
  if (top < kUnary) {
    coder.put(false, unary_[top]);
  } else {
    const std::uint32_t rest = top - kUnary + 1;
    const int length = std::bit_width(rest);
    for (int i = 1; i < length; ++i) coder.put(true, length_[i]);
    coder.put(false, length_[length]);
    coder.put_raw(rest, length - 1);
  }
  if (low_bits == 0) return;
  coder.put(value >> (low_bits - 1) & 1, first_low_[std::min<std::uint32_t>(top, 3)]);
  coder.put_raw(value, low_bits - 1);
}

std::uint32_t NumberModel::get(int low_bits, RangeDecoder& coder) {
  std::uint32_t top = 0;
  while (top < kUnary && coder.get(unary_[top])) ++top;
  if (top == kUnary) {
    int length = 1;
    while (coder.get(length_[length]))
      if (++length == kLengths) damaged("a difference is too large");
    top = kUnary - 1 + (1u << (length - 1) | coder.get_raw(length - 1));
  }
  if (low_bits == 0) return top;
  std::uint32_t low = std::uint32_t(coder.get(first_low_[std::min<std::uint32_t>(top, 3)]));
  low = low << (low_bits - 1) | coder.get_raw(low_bits - 1);
  return top << low_bits | low;
}

}  // namespace gigaray
