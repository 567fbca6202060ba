// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/program_test.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/pictures.h"

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

TEST_F(EvaluateCommand, SeveralEstimatesAreATable) {
  write_pfm(folder / "exact.pfm", FloatMap(5, 3, 1, 1.0f));
  const Result text = run("evaluate exact.pfm estimate.pfm truth.pfm --border 1");
  ASSERT_EQ(text.exit_code, 0) << text.err;
  const std::string head = text.out.substr(0, text.out.find('\n'));
  EXPECT_LT(head.find("exact"), head.find("estimate")) << text.out;
  const Result result = run("evaluate exact.pfm estimate.pfm truth.pfm --border 1 --json");
  const auto scores = nlohmann::json::parse(result.out)["scores"];
  ASSERT_EQ(scores.size(), 2u);
  EXPECT_EQ(scores[0]["estimate"], "exact");
  EXPECT_EQ(scores[0]["BadPix0.07"], 0);
  EXPECT_EQ(scores[1]["estimate"], "estimate");
  EXPECT_DOUBLE_EQ(scores[1]["BadPix0.07"], 200 / 3.0);
  EXPECT_FALSE(scores[1].contains("view"));
}

TEST_F(EvaluateCommand, EstimatesOfOneNameAreToldApartByTheirPath) {
  for (const char* name : {"a", "b"}) {
    std::filesystem::create_directory(folder / name);
    write_pfm(folder / name / "disparity.pfm", FloatMap(5, 3, 1, 1.0f));
  }
  const auto by_file = nlohmann::json::parse(
      run("evaluate a/disparity.pfm b/disparity.pfm truth.pfm --border 0 --json").out);
  EXPECT_EQ(by_file["scores"][1]["estimate"], "b/disparity.pfm");
  const auto by_folder =
      nlohmann::json::parse(run("evaluate a/ b truth.pfm --border 0 --json").out);
  EXPECT_EQ(by_folder["scores"][0]["estimate"], "a");
}

TEST_F(EvaluateCommand, CsvHasALinePerMap) {
  const std::string printed =
      run("evaluate estimate.pfm truth.pfm truth.pfm --border 1 --csv -").out;
  EXPECT_TRUE(printed.starts_with("estimate,view,BadPix0.07,BadPix0.03,")) << printed;
  EXPECT_NE(printed.find("\nestimate,,66.66666667,"), std::string::npos) << printed;
  EXPECT_NE(printed.find("\ntruth,,0,0,0,0,0,100,3"), std::string::npos) << printed;
  EXPECT_EQ(std::count(printed.begin(), printed.end(), '\n'), 3);
  ASSERT_EQ(run("evaluate estimate.pfm truth.pfm truth.pfm --border 1 --csv scores.csv").exit_code,
            0);
  EXPECT_EQ(text_of("scores.csv"), printed);
}

TEST_F(EvaluateCommand, MiddleburyMetricsHaveNoBorder) {
  const Result result = run("evaluate estimate.pfm truth.pfm --metrics middlebury --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto scores = nlohmann::json::parse(result.out);
  EXPECT_EQ(scores["scored"], 15);
  EXPECT_DOUBLE_EQ(scores["bad0.5"], 100 / 15.0);
  EXPECT_DOUBLE_EQ(scores["avgerr"], 0.5 / 14);
  EXPECT_FALSE(scores.contains("BadPix0.07"));
  const auto both = nlohmann::json::parse(
      run("evaluate estimate.pfm truth.pfm --metrics hci,middlebury --border 1 --json").out);
  EXPECT_DOUBLE_EQ(both["bad0.5"], 100 / 3.0);
  EXPECT_DOUBLE_EQ(both["coverage"], 200 / 3.0);
  EXPECT_DOUBLE_EQ(both["BadPix0.07"], 200 / 3.0);
}

TEST_F(EvaluateCommand, MasksAddScoresOfTheirPart) {
  Image<std::uint16_t> picture(5, 3);
  picture(2, 1) = 1;
  picture(3, 1) = 255;
  write_png(folder / "part.png", picture, 8);
  FloatMap map(5, 3);
  map(1, 1) = 0.25f;
  write_pfm(folder / "hole.pfm", map);
  const Result result =
      run("evaluate estimate.pfm truth.pfm --border 0 --json --mask part=part.png --mask "
          "hole=hole.pfm");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto scores = nlohmann::json::parse(result.out);
  EXPECT_EQ(scores["part.scored"], 2);
  EXPECT_EQ(scores["part.BadPix0.07"], 50);
  EXPECT_EQ(scores["hole.filled"], 0);
  EXPECT_TRUE(scores["hole.MSEx100"].is_null());
  EXPECT_EQ(scores["scored"], 15);
}

TEST_F(EvaluateCommand, MasksOfASceneGiveItsRegionMetrics) {
  std::filesystem::create_directory(folder / "hci");
  std::filesystem::copy_file(folder / "truth.pfm", folder / "hci/gt_disp_lowres.pfm");
  Image<std::uint16_t> picture(5, 3);
  picture(2, 1) = picture(3, 1) = 255;
  for (const char* name : {"discontinuities", "planes", "fine", "fine_surrounding", "weeds"})
    write_png(folder / "hci" / ("mask_" + std::string(name) + "_lowres.png"), picture, 8);
  const Result result = run("evaluate estimate.pfm hci --border 0 --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto scores = nlohmann::json::parse(result.out);
  EXPECT_EQ(scores["Discontinuities"], 50);
  EXPECT_EQ(scores["FineFattening"], 50);
  EXPECT_EQ(scores["FineThinning"], 0);
  EXPECT_TRUE(scores["MAEPlanes"].is_null()) << "the rig is not known";
  EXPECT_TRUE(scores.contains("BumpinessPlanes"));
  EXPECT_FALSE(scores.contains("BumpinessSurfaces"));
  EXPECT_FALSE(scores.contains("weeds.BadPix0.07"));
}

TEST_F(EvaluateCommand, ErrorMapsShowTheSignOfTheError) {
  FloatMap estimate(5, 3, 1, 1.0f);
  estimate(1, 1) = 1.5f;  // too near
  estimate(2, 1) = 0.5f;  // too far
  estimate(3, 1) = std::numeric_limits<float>::quiet_NaN();
  write_pfm(folder / "other.pfm", estimate);
  ASSERT_EQ(run("evaluate other.pfm truth.pfm --border 1 --error-map map.png").exit_code, 0);
  const auto picture = read_picture(folder / "map.png");
  EXPECT_GT(picture(1, 1, 2), picture(1, 1, 0) + 100);
  EXPECT_GT(picture(2, 1, 0), picture(2, 1, 2) + 100);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(picture(3, 1, c), 0);
    EXPECT_EQ(picture(0, 0, c), 128);
  }
  ASSERT_EQ(run("evaluate other.pfm estimate.pfm truth.pfm --border 1 --error-map map.png "
                "--error-range 4")
                .exit_code,
            0);
  EXPECT_TRUE(names_in(".").contains("map-other.png") &&
              names_in(".").contains("map-estimate.png"));
  EXPECT_GT(read_picture(folder / "map-other.png")(1, 1, 0), 200)
      << "a quarter of the range or less";
}

/// A folder of depth and one of truth with the views a, b and c.
class EvaluateViews : public EvaluateCommand {
 protected:
  EvaluateViews() {
    std::filesystem::create_directories(folder / "scene/truth");
    for (const char* view : {"a", "b", "c"}) {
      std::filesystem::create_directories(folder / "out" / view);
      write_pfm(folder / "out" / view / "disparity.pfm", FloatMap(5, 3, 1, *view == 'b' ? 2 : 1));
      write_pfm(folder / "scene/truth" / (std::string(view) + ".pfm"), FloatMap(5, 3, 1, 1.0f));
    }
  }
};

TEST_F(EvaluateViews, EachIsScoredAgainstItsOwnTruth) {
  const Result result = run("evaluate out scene --views all --border 0 --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const auto root = nlohmann::json::parse(result.out);
  ASSERT_EQ(root["scores"].size(), 3u);
  EXPECT_EQ(root["scores"][1]["view"], "b");
  EXPECT_EQ(root["scores"][0]["BadPix0.07"], 0);
  EXPECT_EQ(root["scores"][1]["BadPix0.07"], 100);
  EXPECT_DOUBLE_EQ(root["means"][0]["BadPix0.07"], 100 / 3.0);
  const std::string text = run("evaluate out scene --views all --border 0").out;
  EXPECT_NE(text.find("\nmean      33.333"), std::string::npos) << text;
  const std::string csv = run("evaluate out scene --views c,b --border 0 --csv -").out;
  EXPECT_LT(csv.find("\nout,c,0,"), csv.find("\nout,b,100,")) << csv;
}

TEST_F(EvaluateViews, AViewWithoutTruthIsLeftOutOfAllAndRefusedByName) {
  std::filesystem::remove(folder / "scene/truth/c.pfm");
  const Result result = run("evaluate out scene --views all --border 0 --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(nlohmann::json::parse(result.out)["scores"].size(), 2u);
  EXPECT_NE(result.err.find("left out"), std::string::npos) << result.err;
  expect_failure("evaluate out scene --views c", 1, "truth/c.pfm");
  expect_failure("evaluate out scene --views d", 1, "d.pfm");
  expect_failure("evaluate out scene/truth --views all", 1, "VIEW.pfm");
  expect_failure("evaluate estimate.pfm scene --views all", 1, "estimate.pfm", "folder");
  expect_failure("evaluate out truth.pfm --views all", 1, "truth.pfm", "folder");
  expect_failure("evaluate out scene --views ,", 2, "--views");
  expect_failure("evaluate out scene --views all --mask a=b.png", 2, "--mask", "--views");
}

TEST_F(EvaluateViews, AnotherViewThanTheCentreIsNotScoredAgainstItsTruth) {
  write_pfm(folder / "out/disparity.pfm", FloatMap(5, 3, 1, 1.0f));
  std::ofstream(folder / "out/gigaray.json") << R"({"centre": "b", "top_level_view": "a"})";
  expect_failure("evaluate out truth.pfm --border 0", 1, "view a", "centre b");
  EXPECT_EQ(run("evaluate out/disparity.pfm truth.pfm --border 0").exit_code, 0);
}

TEST_F(EvaluateCommand, ABadMaskOrOptionIsNamed) {
  write_png(folder / "large.png", Image<std::uint16_t>(7, 3), 8);
  write_png(folder / "empty.png", Image<std::uint16_t>(5, 3), 8);
  std::ofstream(folder / "broken.png") << "\x89PNG";
  const std::string maps = "evaluate estimate.pfm truth.pfm --border 0 ";
  expect_failure(maps + "--mask large.png", 2, "--mask", "NAME=FILE");
  expect_failure(maps + "--mask =large.png", 2, "--mask", "NAME=FILE");
  expect_failure(maps + "--mask a=large.png", 1, "large.png", "7 x 3");
  expect_failure(maps + "--mask a=empty.png", 1, "nothing to score", "mask");
  expect_failure(maps + "--mask a=broken.png", 1, "broken.png");
  expect_failure(maps + "--mask a=missing.png", 1, "missing.png");
  expect_failure(maps + "--mask a=truth.pfm --mask a=truth.pfm", 2, "twice");
  expect_failure(maps + "--metrics kitti", 2, "--metrics", "kitti");
  expect_failure(maps + "--error-range 0 --error-map a.png", 2, "--error-range");
  expect_failure(maps + "--error-map a.jpg", 2, "a.jpg", ".png");
  expect_failure(maps + "--json --csv -", 2, "--csv");
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
