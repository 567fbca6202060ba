// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "cli/program_test.h"
#include "gigaray/adapters/maps.h"

namespace gigaray {
namespace {

class EvaluateCommand : public ProgramTest {
 protected:
  EvaluateCommand() {
    FloatMap estimate(5, 3, 1, 1.0f), truth(5, 3, 1, 1.0f);
    estimate(2, 1) = 1.5f;
    estimate(1, 1) = std::numeric_limits<float>::quiet_NaN();
    write_pfm(folder / "estimate.pfm", estimate);
    write_pfm(folder / "truth.pfm", truth);
  }
};

TEST_F(EvaluateCommand, PrintsTheMetricsAsJson) {
  const Result result = run("evaluate estimate.pfm truth.pfm --border 1 --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto scores = nlohmann::json::parse(result.out);
  EXPECT_DOUBLE_EQ(scores["BadPix0.07"], 200 / 3.0);
  EXPECT_DOUBLE_EQ(scores["BadPix0.01"], 200 / 3.0);
  EXPECT_DOUBLE_EQ(scores["MSEx100"], 12.5);
  EXPECT_DOUBLE_EQ(scores["Q25"], 12.5);
  EXPECT_DOUBLE_EQ(scores["filled"], 200 / 3.0);
  EXPECT_EQ(scores["scored"], 3);
}

TEST_F(EvaluateCommand, PrintsTheMetricsAsText) {
  const Result result = run("evaluate estimate.pfm truth.pfm --border 0");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* word : {"BadPix0.07", "BadPix0.03", "BadPix0.01", "MSEx100", "Q25", "filled"})
    EXPECT_NE(result.out.find(word), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("13.333"), std::string::npos) << result.out;
}

TEST_F(EvaluateCommand, FindsTheMapsInFolders) {
  std::filesystem::create_directories(folder / "out");
  std::filesystem::create_directories(folder / "hci");
  std::filesystem::copy_file(folder / "estimate.pfm", folder / "out/disparity.pfm");
  std::filesystem::copy_file(folder / "truth.pfm", folder / "hci/gt_disp_lowres.pfm");
  const std::string expected = run("evaluate estimate.pfm truth.pfm --border 0 --json").out;
  EXPECT_NE(expected, "");
  EXPECT_EQ(run("evaluate out hci --border 0 --json").out, expected);
  EXPECT_EQ(run("evaluate out . --border 0 --json").out, expected);
}

TEST_F(EvaluateCommand, AFailureIsOneLineThatNamesTheFile) {
  write_pfm(folder / "other.pfm", FloatMap(4, 3));
  std::ofstream(folder / "cut.pfm") << "Pf\n5 3\n-1\nabc";
  std::filesystem::create_directory(folder / "empty");
  expect_failure("evaluate estimate.pfm", 2, "TRUTH");
  expect_failure("evaluate nothing.pfm truth.pfm", 1, "nothing.pfm");
  expect_failure("evaluate empty truth.pfm", 1, "empty", "disparity.pfm");
  expect_failure("evaluate estimate.pfm empty", 1, "empty", "gt_disp_lowres.pfm");
  expect_failure("evaluate cut.pfm truth.pfm", 1, "cut.pfm");
  expect_failure("evaluate other.pfm truth.pfm", 1, "other.pfm", "4 x 3");
  expect_failure("evaluate estimate.pfm truth.pfm", 1, "truth.pfm", "border of 15");
  expect_failure("evaluate estimate.pfm truth.pfm --border -1", 2, "border", "-1");
}

}  // namespace
}  // namespace gigaray
