// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

namespace gigaray {

/// Runs the program in an empty folder that is removed afterwards.
class ProgramTest : public testing::Test {
 protected:
  struct Result {
    int exit_code = -1;
    std::string out, err;
  };

  ProgramTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "gigaray-test-XXXXXX").string();
    folder = mkdtemp(pattern.data());
  }
  ~ProgramTest() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }

  /// Runs `gigaray ARGUMENTS` in the folder.
  Result run(const std::string& arguments) const {
    const std::string command =
        "cd '" + folder.string() + "' && '" + GIGARAY_PROGRAM + "' " + arguments + " >.out 2>.err";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(".out"), text_of(".err")};
  }

  /// Expects an exit code and one line on stderr that holds both words.
  void expect_failure(const std::string& arguments, int exit_code, const std::string& word,
                      const std::string& other_word = "") const {
    const Result result = run(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
    EXPECT_NE(result.err.find(word), std::string::npos) << arguments << ": " << result.err;
    EXPECT_NE(result.err.find(other_word), std::string::npos) << arguments << ": " << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }

  std::string text_of(const std::filesystem::path& name) const {
    std::ifstream file(folder / name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

  /// Names of what is in a folder, without the outputs of run().
  std::set<std::string> names_in(const std::filesystem::path& name) const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder / name))
      names.insert(entry.path().filename().string());
    names.erase(".out");
    names.erase(".err");
    return names;
  }

  std::filesystem::path folder;
};

}  // namespace gigaray
