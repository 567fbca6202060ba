// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <string>
#include <vector>

#include "gigaray/core/error.h"
#include "gigaray/core/run_control.h"
#include "gigaray/workflows/synth.h"

namespace gigaray {

/// A test with an empty folder that is removed afterwards.
class WorkflowsTest : public testing::Test {
 protected:
  WorkflowsTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "gigaray-test-XXXXXX").string();
    folder = mkdtemp(pattern.data());
    control.on_message = [this](const std::string& text) { messages.push_back(text); };
  }
  ~WorkflowsTest() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }

  /// A small grid of views in the folder, disparity −1 … 1.
  std::filesystem::path grid() {
    SyntheticOptions options;
    options.scene = "garden";
    options.width = 93;
    options.height = 63;
    options.views_s = options.views_t = 3;
    write_synthetic_light_field(folder / "grid", options, {}, control);
    return folder / "grid";
  }

  /// A COLMAP workspace of a walk.
  std::filesystem::path walk() {
    SyntheticOptions options;
    options.scene = "garden";
    options.width = 93;
    options.height = 63;
    options.views_s = 7;
    SyntheticPath path;
    path.shape = SyntheticPath::Shape::kWalk;
    write_synthetic_photographs(folder / "walk", options, path, {}, control);
    return folder / "walk";
  }

  std::filesystem::path folder;
  RunControl control;
  std::vector<std::string> messages;
};

/// What the call says when it throws an Error with this code.
template <class Call>
std::string refusal(ErrorCode code, const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

}  // namespace gigaray
