// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/content_hash.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace gigaray::opencl {
namespace {

TEST(ContentHash, TellsEveryBitAndEveryLengthApart) {
  std::string content(93, 'x');
  std::set<ContentHash::Value> seen{content_hash(content)};
  for (char& c : content)
    for (int bit = 0; bit < 8; ++bit) {
      c = char(c ^ (1 << bit));
      EXPECT_TRUE(seen.insert(content_hash(content)).second);
      c = char(c ^ (1 << bit));
    }
  for (std::size_t size = 0; size < 93; ++size) {
    EXPECT_TRUE(seen.insert(content_hash(content.substr(0, size))).second);
    EXPECT_TRUE(seen.insert(content_hash(std::string(size + 1, '\0'))).second);
  }
}

TEST(ContentHash, TellsWordsInAnotherOrderApart) {
  EXPECT_NE(content_hash("12345678abcdefgh"), content_hash("abcdefgh12345678"));
}

TEST(ContentHash, WhereOnePieceEndsCounts) {
  ContentHash a, b;
  a.add("ab");
  a.add("c");
  b.add("a");
  b.add("bc");
  EXPECT_NE(a.value(), b.value());
}

TEST(ContentHash, IsWrittenInThirtyTwoDigits) {
  EXPECT_EQ(to_hex({0x0123456789abcdef, 0xf}), "0123456789abcdef000000000000000f");
}

}  // namespace
}  // namespace gigaray::opencl
