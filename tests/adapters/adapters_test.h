// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <locale>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <string>

#include "gigaray/adapters/reader.h"
#include "gigaray/core/error.h"
#include "support/errors.h"

namespace gigaray {

/// A test with an empty folder that is removed afterwards, and pictures to put into it. Pictures
/// are made by OpenCV, so that the adapters are checked against another library.
class AdaptersTest : public testing::Test {
 protected:
  static constexpr int kWidth = 23;
  static constexpr int kHeight = 17;

  AdaptersTest() {
    std::string pattern = (std::filesystem::temp_directory_path() / "gigaray-test-XXXXXX").string();
    folder = mkdtemp(pattern.data());
  }
  ~AdaptersTest() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  }

  /// BGR (or grey, BGRA) in OpenCV's order; every pixel and channel has another value.
  static cv::Mat picture(int type = CV_8UC3, int width = kWidth, int height = kHeight) {
    cv::Mat mat(height, width, type);
    const int channels = mat.channels();
    for (int v = 0; v < height; ++v)
      for (int i = 0; i < width * channels; ++i)
        if (mat.depth() == CV_8U)
          mat.ptr<std::uint8_t>(v)[i] = std::uint8_t(37 * v + 11 * i);
        else
          mat.ptr<std::uint16_t>(v)[i] = std::uint16_t(3701 * v + 1103 * i);
    return mat;
  }
  void save(const std::string& name, const cv::Mat& mat = picture()) const {
    std::filesystem::create_directories((folder / name).parent_path());
    ASSERT_TRUE(cv::imwrite((folder / name).string(), mat));
  }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder / name, std::ios::binary) << bytes;
  }
  std::string read(const std::string& name) const {
    std::ifstream file(folder / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  }
  void cut_short(const std::string& name, double share) const {
    const auto path = folder / name;
    std::filesystem::resize_file(path, std::uintmax_t(share * double(file_size(path))));
  }
  /// Everything in the folder, hidden files too.
  std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      all.insert(entry.path().filename().string());
    return all;
  }

  /// Calls and expects an Error with this code, in one line that holds the word.
  template <class Call>
  static void expect_error(ErrorCode code, const std::string& word, Call call) {
    testing_support::expect_error(code, {word}, call);
  }
  void expect_bad_input(const std::string& word, const OpenOptions& options = {}) const {
    expect_error(ErrorCode::kBadInput, word, [&] { open_light_field(folder, options); });
  }

  std::filesystem::path folder;
};

/// Numbers like "0,5" for as long as it lives, as in a German locale.
class CommaLocale {
 public:
  CommaLocale() : before_(std::locale::global(std::locale(std::locale(), new Comma))) {}
  ~CommaLocale() { std::locale::global(before_); }

 private:
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  std::locale before_;
};

}  // namespace gigaray
