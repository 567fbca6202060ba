// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

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

  /// Runs `gigaray ARGUMENTS` in the folder. environment: "NAME=VALUE ...", or other words that a
  /// shell takes before a command.
  Result run(const std::string& arguments, const std::string& environment = "") const {
    const std::string command = "cd '" + folder.string() + "' && " + environment + " '" +
                                GIGARAY_PROGRAM + "' " + arguments + " >.out 2>.err";
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

  /// Expects a failure after the work has begun: notes and stages may stand before the one line,
  /// and the folder holds what it held before.
  void expect_refusal(const std::string& arguments, int exit_code, const std::string& word,
                      const std::string& other_word = "",
                      const std::string& environment = "") const {
    const std::set<std::string> before = names_in(".");
    const Result result = run(arguments, environment);
    EXPECT_EQ(result.exit_code, exit_code) << arguments;
    EXPECT_EQ(result.out, "") << arguments;
    const std::string command = "gigaray " + arguments.substr(0, arguments.find(' ')) + ": ";
    const auto begin = result.err.find(command);
    ASSERT_NE(begin, std::string::npos) << arguments << ": " << result.err;
    const std::string line = result.err.substr(begin);
    EXPECT_EQ(line.find('\n'), line.size() - 1) << arguments << ": " << result.err;
    EXPECT_NE(line.find(word), std::string::npos) << arguments << ": " << line;
    EXPECT_NE(line.find(other_word), std::string::npos) << arguments << ": " << line;
    EXPECT_EQ(names_in("."), before) << arguments;
  }

  /// Starts `gigaray ARGUMENTS` in the folder and returns its process id.
  pid_t start(const std::vector<std::string>& arguments) const {
    const pid_t child = fork();
    if (child != 0) return child;
    std::vector<char*> words{const_cast<char*>("gigaray")};
    for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    const bool ready = chdir(folder.c_str()) == 0 && std::freopen(".out", "w", stdout) &&
                       std::freopen(".err", "w", stderr);
    if (ready) execv(GIGARAY_PROGRAM, words.data());
    _exit(99);
  }
  /// Waits until a condition holds, a minute at most.
  template <class Condition>
  static bool wait_until(Condition condition) {
    using namespace std::chrono_literals;
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(2ms);
    }
    return true;
  }

  std::string text_of(const std::filesystem::path& name) const {
    std::ifstream file(folder / name, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }

  /// Names of what is in a folder, without the outputs of run() and the manifest of an output.
  std::set<std::string> names_in(const std::filesystem::path& name) const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder / name))
      names.insert(entry.path().filename().string());
    names.erase(".out");
    names.erase(".err");
    names.erase(".gigaray-output.json");
    return names;
  }

  std::filesystem::path folder;
};

}  // namespace gigaray
