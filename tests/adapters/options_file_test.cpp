// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/options_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "adapters/adapters_test.h"
#include "gigaray/engine/option_table.h"
#include "support/errors.h"

namespace gigaray {
namespace {

using testing_support::expect_error;

class OptionsFile : public AdaptersTest {
 protected:
  std::vector<NamedValue> read(const std::string& text) const {
    return parse_options_json(text, "options.json");
  }
};

TEST_F(OptionsFile, AllOptionsComeBackAsTheyWere) {
  DepthOptions options = auto_options();
  options.score.bandwidth = 1.0f / 3;
  options.hypothesis_step = 0.1 + 0.2;
  options.disparity = DisparityRange{-1.0 / 3, 2};
  options.views = {4, 0};
  options.work_folder = "a \"folder\"";
  options.edge.threshold = std::numeric_limits<float>::infinity();
  DepthOptions again = paper_options();
  for (const NamedValue& value : read(options_json(option_values(options))))
    set_option(again, value.name, value.value);
  EXPECT_EQ(option_values(again), option_values(options));
}

TEST_F(OptionsFile, NamesMayBeNestedOrHaveDots) {
  const std::vector<NamedValue> expected{{"winner.median_radius", 3}, {"score.bandwidth", 0.03}};
  EXPECT_EQ(read(R"({"winner": {"median_radius": 3}, "score": {"bandwidth": 0.03}})"), expected);
  EXPECT_EQ(read(R"({"winner.median_radius": 3, "score.bandwidth": 0.03})"), expected);
  EXPECT_EQ(read(R"({"winner": {"median_radius": 3}, "score.bandwidth": 0.03})"), expected);
  EXPECT_TRUE(read("{}").empty());
}

TEST_F(OptionsFile, OfAResultTheOptionsThatWereAskedForAreTaken) {
  const std::string text =
      R"({"format": "gigaray depth", "options": {"smoothing": 1},
          "options_asked": {"score": {"smoothing": 0}}, "options_used": {"score": {"smoothing": 1}}})";
  const std::vector<NamedValue> expected{{"score.smoothing", 0}};
  EXPECT_EQ(read(text), expected);
  std::ofstream(folder / "gigaray.json") << text;
  EXPECT_EQ(read_options_file(folder), expected);
  EXPECT_EQ(read_options_file(folder / "gigaray.json"), expected);
}

TEST_F(OptionsFile, WhatIsNoListOfOptionsIsNamed) {
  for (const char* text : {"", "{", "[1]", "3"})
    testing_support::expect_error(ErrorCode::kBadInput, {"options.json", "JSON"},
                                  [&] { read(text); });
  testing_support::expect_error(ErrorCode::kBadInput, {"options.json", "neither"},
                                [&] { read(R"({"format": "gigaray light field"})"); });
  testing_support::expect_error(ErrorCode::kBadInput, {"options_asked"},
                                [&] { read(R"({"format": "gigaray depth", "options": {}})"); });
  testing_support::expect_error(ErrorCode::kBadInput, {"options.json", "winner.views"},
                                [&] { read(R"({"winner": {"views": [1, "a\nb"]}})"); });
  EXPECT_THROW(read_options_file(folder / "nothing.json"), Error);
}

}  // namespace
}  // namespace gigaray
