// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/run_control.h"

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

TEST(RunControl, APartStopsWithTheWholeAndReportsThroughIt) {
  std::vector<std::string> stages, messages;
  RunControl whole;
  whole.on_progress = [&](const std::string& stage, double, double) { stages.push_back(stage); };
  whole.on_message = [&](const std::string& text) { messages.push_back(text); };
  const RunControl part(whole, "first half"), of_part(part, "its half");
  part.progress("level 0", 1, 2);
  of_part.progress("level 0", 1, 2);
  part.message("heard by nobody");
  EXPECT_EQ(stages, (std::vector<std::string>{"first half, level 0", "its half, level 0"}));
  EXPECT_TRUE(messages.empty());
  EXPECT_FALSE(of_part.cancelled());
  whole.cancel();
  EXPECT_TRUE(of_part.cancelled());
  EXPECT_EQ(code_of(of_part, [&] { of_part.throw_if_cancelled(); }), ErrorCode::kCancelled);
}

}  // namespace
}  // namespace gigaray
