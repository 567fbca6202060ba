// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <gtest/gtest.h>

#include <exception>
#include <string>
#include <vector>

#include "gigaray/core/error.h"

namespace gigaray::testing_support {

/// Expects that `call` throws an Error of this code, of one line, that contains all `parts`.
template <class Call>
void expect_error(ErrorCode code, const std::vector<std::string>& parts, Call&& call) {
  try {
    call();
    ADD_FAILURE() << "no error; expected one with: " << (parts.empty() ? "" : parts.front());
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.code(), code) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    for (const std::string& part : parts)
      EXPECT_NE(message.find(part), std::string::npos) << part << " is not in: " << message;
  }
}

/// Expects that a call with arguments that can't be meant throws an Error of one line, of any code.
template <class Call>
void expect_mistake(const char* what, Call&& call) {
  SCOPED_TRACE(what);
  try {
    call();
    ADD_FAILURE() << "no error: " << what;
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_FALSE(message.empty());
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  } catch (const std::exception& other) {
    ADD_FAILURE() << what << ": no Error, but " << other.what();
  }
}

}  // namespace gigaray::testing_support
