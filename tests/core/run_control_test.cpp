// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/run_control.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace gigaray {
namespace {

/// The code of what `call` throws under a control.
template <class Call>
ErrorCode code_of(const RunControl& control, const Call& call) {
  try {
    control.stop_or_fail(call);
  } catch (const Error& error) {
    return error.code();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

TEST(RunControl, WhatFailsAfterCancelIsTheStop) {
  RunControl control;
  const auto fail = [] { throw Error(ErrorCode::kDevice, "does not build"); };
  EXPECT_EQ(code_of(control, fail), ErrorCode::kDevice);
  control.cancel();
  EXPECT_EQ(code_of(control, fail), ErrorCode::kCancelled);
  EXPECT_EQ(code_of(control, [] { throw std::runtime_error("of a library"); }),
            ErrorCode::kCancelled);
}

TEST(RunControl, WhatFailsAfterAResultWasKeptFails) {
  RunControl control;
  control.keep_result();
  control.cancel();
  EXPECT_EQ(code_of(control, [] { throw Error(ErrorCode::kIo, "can't be written"); }),
            ErrorCode::kIo);
}

TEST(RunControl, WhatReturnsIsReturned) {
  RunControl control;
  control.cancel();
  EXPECT_EQ(control.stop_or_fail([] { return 7; }), 7);
}

}  // namespace
}  // namespace gigaray
