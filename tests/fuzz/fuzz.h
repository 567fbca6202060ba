// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "gigaray/core/error.h"

namespace gigaray::fuzz {

/// Bytes after the first, which chooses one of `count` parsers.
struct Input {
  Input(const std::uint8_t* data, std::size_t size, int count)
      : choice(size > 0 ? data[0] % count : 0),
        bytes(reinterpret_cast<const char*>(data) + (size > 0), size > 0 ? size - 1 : 0) {}
  int choice;
  std::string_view bytes;
};

/// Calls a parser. The one way it may fail is an Error of one line for bad input.
template <class Parse>
void expect_result_or_one_line(Parse parse) {
  try {
    parse();
  } catch (const Error& error) {
    GIGARAY_CHECK(error.code() == ErrorCode::kBadInput);
    GIGARAY_CHECK(std::string_view(error.what()).find('\n') == std::string_view::npos);
  }
}

}  // namespace gigaray::fuzz
