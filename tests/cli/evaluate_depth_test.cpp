// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/program_test.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/pictures.h"

namespace gigaray {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A result with the views a and b of 4 x 2 pixels, and the folder of their true depth, 2 and 4
/// units. a is exact but for one pixel that is 3 % off; half of b is twice too far and unsure.
class EvaluateDepth : public ProgramTest {
 protected:
  EvaluateDepth() {
    FloatMap a(4, 2, 1, 2.0f), b(4, 2, 1, 4.0f), sure(4, 2, 1, 0.9f);
    a(0, 0) = 2.06f;
    write_view("a", a, sure);
    for (int u = 0; u < 4; ++u) {
      b(u, 1) = 8;
      sure(u, 1) = 0.2f;
    }
    b(0, 1) = kNaN;
    write_view("b", b, sure);
    std::filesystem::create_directories(folder / "truth");
    write_pfm(folder / "truth/a.pfm", FloatMap(4, 2, 1, 2.0f));
    FloatMap truth(4, 2, 1, 4.0f);
    truth(3, 0) = kInfinity;
    truth(3, 1) = 0;
    write_pfm(folder / "truth/b.pfm", truth);
  }

  void write_view(const std::string& view, const FloatMap& depth, const FloatMap& confidence) {
    std::filesystem::create_directories(folder / "out" / view);
    write_pfm(folder / "out" / view / "depth.pfm", depth);
    write_pfm(folder / "out" / view / "confidence.pfm", confidence);
  }

  nlohmann::json json_of(const std::string& arguments) const {
    const Result result = run("evaluate " + arguments + " --metrics depth --json");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(result.out, nullptr, false);
  }
};

TEST_F(EvaluateDepth, EveryViewIsScoredAndAllPixelsTogether) {
  const auto scores = json_of("out truth");
  ASSERT_EQ(scores["scores"].size(), 2u);
  const auto &a = scores["scores"][0], &b = scores["scores"][1], &all = scores["all"][0];
  EXPECT_EQ(a["view"], "a");
  EXPECT_EQ(a["within2"], 87.5);
  EXPECT_EQ(a["within5"], 100);
  EXPECT_EQ(a["median"], 0);
  EXPECT_EQ(b["scored"], 6);
  EXPECT_EQ(b["within5"], 50);
  EXPECT_NEAR(b["filled"], 500 / 6.0, 1e-9);
  EXPECT_EQ(b["filled.within0.5"], 60);
  EXPECT_EQ(all["estimate"], "out");
  EXPECT_EQ(all["scored"], 14);
  EXPECT_NEAR(all["within0.5"], 1000 / 14.0, 1e-9);
  EXPECT_NEAR(all["within5"], 1100 / 14.0, 1e-9);
  EXPECT_FALSE(scores.contains("means"));
}

TEST_F(EvaluateDepth, TheMostConfidentAreScoredOfThemselvesAndOfAll) {
  const auto all = json_of("out truth --kept 50,100")["all"][0];
  EXPECT_EQ(all["kept50.filled"], 50);
  EXPECT_EQ(all["kept50.within5"], 100) << "the unsure ones are gone";
  EXPECT_EQ(all["kept50.all5"], 50);
  EXPECT_NEAR(all["kept100.filled"], 1300 / 14.0, 1e-9);
  EXPECT_FALSE(all.contains("kept75.within1"));
  EXPECT_TRUE(json_of("out truth")["all"][0].contains("kept75.within1"));
  std::filesystem::remove(folder / "out/b/confidence.pfm");
  EXPECT_TRUE(json_of("out truth")["all"][0]["kept75.within1"].is_null());
}

TEST_F(EvaluateDepth, TruthMayBeScaledPicturesOrOtherMaps) {
  const auto expected = json_of("out truth");
  std::filesystem::create_directories(folder / "mm/truth");
  Image<std::uint16_t> picture(4, 2);
  std::fill(picture.begin(), picture.end(), std::uint16_t(2000));
  write_png(folder / "mm/truth/a.png", picture, 16);
  FloatMap b = read_pfm(folder / "truth/b.pfm");
  for (float& value : b) value *= 1000;
  write_exr(folder / "mm/truth/b.exr", b);
  EXPECT_EQ(json_of("out mm --truth-scale 0.001"), expected);
  EXPECT_EQ(json_of("out mm")["all"][0]["within5"], 0) << "a unit is a unit";
}

TEST_F(EvaluateDepth, ALargerTruthIsReadAtThePixelsCentres) {
  FloatMap large(12, 6);
  for (int v = 0; v < 6; ++v)
    for (int u = 0; u < 12; ++u) large(u, v) = u % 3 == 1 && v % 3 == 1 ? 2 : 100;
  write_pfm(folder / "truth/a.pfm", large);
  const Result result = run("evaluate out truth --views a --metrics depth --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(nlohmann::json::parse(result.out)["all"][0]["within5"], 100);
  EXPECT_NE(result.err.find("12 x 6"), std::string::npos) << result.err;
  write_pfm(folder / "truth/a.pfm", FloatMap(12, 12, 1, 2.0f));
  expect_failure("evaluate out truth --views a --metrics depth", 1, "12 x 12", "4 x 2");
}

TEST_F(EvaluateDepth, MapsOfOtherProgramsAndSingleMapsAreScoredToo) {
  std::filesystem::create_directories(folder / "theirs");
  FloatMap map(4, 2, 1, 2.0f);
  map(1, 1) = 0;  // none
  write_npy(folder / "theirs/a.npy", map);
  const auto scores = json_of("out theirs truth --views a");
  ASSERT_EQ(scores["all"].size(), 2u);
  EXPECT_EQ(scores["all"][1]["estimate"], "theirs");
  EXPECT_EQ(scores["all"][1]["filled"], 87.5);
  EXPECT_TRUE(scores["all"][1]["kept75.filled"].is_null());
  const auto one = json_of("out/b/depth.pfm truth/b.pfm");
  EXPECT_EQ(one["within5"], 50);
  EXPECT_EQ(one["kept75.filled"], 500 / 6.0);
}

TEST_F(EvaluateDepth, TextAndCsvHaveViewsAndAll) {
  const std::string text = run("evaluate out truth --metrics depth").out;
  EXPECT_NE(text.find("\na       "), std::string::npos) << text;
  EXPECT_NE(text.find("\nkept75.within1"), std::string::npos) << text;
  EXPECT_EQ(text.find("mean"), std::string::npos) << text;
  const std::string csv = run("evaluate out truth --metrics depth --csv -").out;
  EXPECT_TRUE(csv.starts_with("estimate,view,within0.5,within1,within2,within5,median,filled,"))
      << csv;
  EXPECT_NE(csv.find("\nout,a,87.5,87.5,87.5,100,0,100,8,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\nout,all,"), std::string::npos) << csv;
}

TEST_F(EvaluateDepth, ASyntheticWalkIsScoredAsItWasWritten) {
  ASSERT_EQ(run("synth figure -o walk --path arc --step 4 --views 4 --width 64 --height 48 "
                "--samples 2")
                .exit_code,
            0);
  ASSERT_EQ(run("depth walk -o walked").exit_code, 0);
  const auto in_folder = json_of("walked walk"), itself = json_of("walked walk/truth");
  EXPECT_EQ(in_folder, itself);
  ASSERT_EQ(in_folder["scores"].size(), 4u);
  EXPECT_GT(in_folder["all"][0]["within5"], 50);
  EXPECT_LT(in_folder["all"][0]["scored"], 0.4 * 4 * 64 * 48) << "white is not scored";
  const auto centre = json_of("walked walk --views centre");
  ASSERT_EQ(centre["scores"].size(), 1u);
  EXPECT_TRUE(centre["scores"][0]["view"].get<std::string>().starts_with("view_00"));
}

TEST_F(EvaluateDepth, WhatIsMissingOrWrongIsOneLine) {
  const std::string depth = " --metrics depth";
  std::filesystem::create_directories(folder / "empty");
  expect_failure("evaluate out empty" + depth, 1, "empty", "a.pfm");
  expect_failure("evaluate empty truth" + depth, 1, "empty", "depth.pfm");
  expect_failure("evaluate out nowhere" + depth, 1, "nowhere", "no such");
  expect_failure("evaluate out truth --views c" + depth, 1, "view c");
  expect_failure("evaluate out truth --views centre" + depth, 1, "gigaray.json");
  expect_failure("evaluate out truth/a.pfm" + depth, 1, "truth/a.pfm", "folder");
  expect_failure("evaluate truth/a.pfm truth" + depth, 1, "map");
  expect_failure("evaluate out truth --truth-scale 0" + depth, 2, "--truth-scale", "0");
  expect_failure("evaluate out truth --truth-scale nan" + depth, 2, "--truth-scale", "nan");
  expect_failure("evaluate out truth --kept 0" + depth, 2, "--kept", "0");
  expect_failure("evaluate out truth --kept 75,101" + depth, 2, "--kept", "101");
  expect_failure("evaluate out truth --mask x=y.png" + depth, 2, "--mask");
  expect_failure("evaluate out truth --error-map x.png" + depth, 2, "--error-map");
  expect_failure("evaluate out truth --metrics depth,hci", 2, "--metrics");
  expect_failure("evaluate truth/a.pfm truth/b.pfm --kept 50", 2, "--kept", "depth");
  expect_failure("evaluate truth/a.pfm truth/b.pfm --truth-scale 2", 2, "--truth-scale", "depth");
  write_png(folder / "truth/a.png", Image<std::uint16_t>(4, 2), 8);
  std::filesystem::remove(folder / "truth/a.pfm");
  expect_failure("evaluate out truth --views a" + depth, 1, "a.png", "16 bits");
  write_png(folder / "truth/a.png", Image<std::uint16_t>(4, 2), 16);
  expect_failure("evaluate out truth --views a" + depth, 1, "nothing to score");
  std::ofstream(folder / "truth/a.png") << "\x89PNG";
  expect_failure("evaluate out truth --views a" + depth, 1, "a.png");
}

}  // namespace
}  // namespace gigaray
