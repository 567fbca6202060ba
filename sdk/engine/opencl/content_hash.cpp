// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/content_hash.h"

#include <cstring>

namespace gigaray::opencl {

void ContentHash::add(std::string_view piece) {
  step(piece.size());
  std::uint64_t word = 0;
  while (piece.size() >= sizeof word) {
    std::memcpy(&word, piece.data(), sizeof word);
    step(word);
    piece.remove_prefix(sizeof word);
  }
  if (piece.empty()) return;
  word = 0;
  std::memcpy(&word, piece.data(), piece.size());
  step(word);
}

ContentHash::Value content_hash(std::string_view content) {
  ContentHash hash;
  hash.add(content);
  return hash.value();
}

std::string to_hex(const ContentHash::Value& hash) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const auto word : hash)
    for (int shift = 60; shift >= 0; shift -= 4) text += kDigits[(word >> shift) & 15];
  return text;
}

}  // namespace gigaray::opencl
