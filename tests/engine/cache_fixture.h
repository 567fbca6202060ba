// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

namespace gigaray {

/// An environment variable with another value, until the end of the scope. nullptr unsets it.
class ScopedVariable {
 public:
  ScopedVariable(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    set(value);
  }
  ~ScopedVariable() { set(old_ ? old_->c_str() : nullptr); }
  ScopedVariable(const ScopedVariable&) = delete;
  ScopedVariable& operator=(const ScopedVariable&) = delete;

 private:
  void set(const char* value) {
    if (value)
      setenv(name_, value, 1);
    else
      unsetenv(name_);
  }
  const char* name_;
  std::optional<std::string> old_;
};

/// A new, empty folder until the end of the scope.
class ScopedFolder {
 public:
  ScopedFolder() {
    auto name = (std::filesystem::temp_directory_path() / "gigaray-test-XXXXXX").string();
    EXPECT_NE(mkdtemp(name.data()), nullptr);
    path = name;
  }
  ~ScopedFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  ScopedFolder(const ScopedFolder&) = delete;
  ScopedFolder& operator=(const ScopedFolder&) = delete;

  std::filesystem::path path;
};

/// Tests with a kernel cache of their own.
class CacheFixture : public testing::Test {
 protected:
  CacheFixture() {
    // PoCL settles on a folder once per process, so it gets one that outlives the test.
    static const ScopedFolder pocl;
    setenv("POCL_CACHE_DIR", pocl.path.c_str(), 0);
  }

  /// The files of compiled programs.
  std::vector<std::filesystem::path> program_files() const {
    std::vector<std::filesystem::path> files;
    if (std::filesystem::exists(folder_ / "gigaray-programs"))
      for (const auto& entry : std::filesystem::directory_iterator(folder_ / "gigaray-programs"))
        files.push_back(entry.path());
    return files;
  }

  static std::string content(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  static void overwrite(const std::filesystem::path& path, const std::string& content) {
    std::ofstream(path, std::ios::binary) << content;
  }

  const ScopedFolder scope_;
  const std::filesystem::path& folder_ = scope_.path;
  const ScopedVariable cache_on_{"GIGARAY_CACHE", nullptr};
  const ScopedVariable cache_folder_{"GIGARAY_CACHE_DIR", folder_.c_str()};
};

}  // namespace gigaray
