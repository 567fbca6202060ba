// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "cli/program_test.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/pictures.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

class CompareCommand : public ProgramTest {
 protected:
  void make(const std::string& name, const std::string& options) const {
    const Result made =
        run("synth planes --samples 2 --width 97 --height 71 -o " + name + " " + options);
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  nlohmann::json compare(const std::string& arguments) const {
    const Result result = run("compare " + arguments + " --json");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(result.out, nullptr, false);
  }
};

TEST_F(CompareCommand, AllMethodsAgainstTheTruth) {
  make("made", "--views 7");
  const auto root = compare("made -o out");
  EXPECT_EQ(root["format"], "gigaray compare");
  EXPECT_EQ(root["measure"], "BadPix0.07");
  ASSERT_EQ(root["methods"].size(), 10u);
  EXPECT_EQ(root["methods"][0]["name"], "gigaray_auto");
  EXPECT_EQ(root["verdict"].size(), 5u);
  for (const auto& method : root["methods"]) {
    const std::string name = method["name"];
    for (const char* key : {"title", "reference", "parameters", "views"})
      EXPECT_NE(method[key], "") << name;
    EXPECT_LT(method["scores"]["bad1.0"], 40) << name;
    for (const char* file : {"disparity.pfm", "disparity.png", "error.png", "disparity-1.png"})
      EXPECT_TRUE(fs::exists(folder / "out" / name / file)) << name << "/" << file;
    // The scores are those of the map that is there.
    const Result scores = run("evaluate out/" + name + "/disparity.pfm made --json");
    EXPECT_EQ(nlohmann::json::parse(scores.out)["BadPix0.07"], method["scores"]["BadPix0.07"]);
  }
  EXPECT_EQ(nlohmann::json::parse(text_of("out/compare.json")), root);
  const std::string csv = text_of("out/compare.csv");
  EXPECT_EQ(std::ranges::count(csv, '\n'), 11);
}

TEST_F(CompareCommand, ThePageNeedsNoOtherFile) {
  make("made", "--views 5");
  compare("made -o out --methods auto,sgbm");
  const std::string page = text_of("out/index.html");
  EXPECT_NE(page.find("Semi-global block matching"), std::string::npos);
  EXPECT_NE(page.find("</html>"), std::string::npos);
  std::size_t pictures = 0;
  for (std::size_t at = page.find("src=\""); at != std::string::npos;
       at = page.find("src=\"", at + 1), ++pictures)
    EXPECT_EQ(page.substr(at + 5, 22), "data:image/png;base64,");
  EXPECT_GE(pictures, 8u);
  EXPECT_EQ(page.find("href="), std::string::npos);
}

TEST_F(CompareCommand, TheBestSeparationIsChosen) {
  make("made", "--views 9");
  const auto root = compare("made -o out --methods bm");
  const auto& method = root["methods"][0];
  ASSERT_EQ(method["choices"].size(), 3u);
  double least = 1e9;
  std::string best;
  for (const auto& choice : method["choices"])
    if (choice["measure"] < least) least = choice["measure"], best = choice["views"];
  EXPECT_EQ(method["views"], best);
  EXPECT_EQ(method["scores"]["BadPix0.07"], least);
}

TEST_F(CompareCommand, WithoutTruthMapsAreComparedWithEachOther) {
  make("made", "--views 5");
  fs::remove(folder / "made/truth.pfm");
  fs::remove_all(folder / "made/truth");
  const auto root = compare("made -o out --methods auto,sgbm");
  EXPECT_TRUE(root["truth"].is_null());
  EXPECT_EQ(root["measure"], "PhotoConsistency");
  EXPECT_EQ(root["agreement"]["percent"]["sgbm"]["sgbm"], 100);
  const double both = root["agreement"]["percent"]["sgbm"]["gigaray_auto"];
  EXPECT_GT(both, 10);
  EXPECT_LT(both, 100);
  EXPECT_FALSE(fs::exists(folder / "out/sgbm/error.png"));
}

TEST_F(CompareCommand, AMiddleburyStereoPair) {
  make("made", "--views 2 --disparity 4 12");
  fs::create_directory(folder / "pair");
  const auto picture = [&](const char* from, const char* to) {
    fs::copy_file(folder / "made" / from, folder / "pair" / to);
  };
  picture("view_000.png", "im2.png");
  picture("view_001.png", "im6.png");
  const FloatMap truth = read_pfm(folder / "made/truth/view_000.pfm");
  Image<std::uint16_t> grey(truth.width(), truth.height());
  for (std::size_t i = 0; i < truth.size(); ++i)
    grey.data()[i] = std::uint16_t(std::lround(4 * truth.data()[i]));
  write_png(folder / "pair/disp2.png", grey, 8);
  const auto root = compare("pair -o out --methods sgbm,bm");
  EXPECT_EQ(root["light_field"], "Middlebury stereo pair");
  EXPECT_EQ(root["view"], "im2");
  EXPECT_EQ(root["disparity_range"], (nlohmann::json{0, 16}));
  EXPECT_LT(root["methods"][1]["scores"]["bad1.0"], 30);
  EXPECT_EQ(root["methods"].size(), 2u);
}

TEST_F(CompareCommand, AProgramOutsideTakesPart) {
  make("made", "--views 3");
  // Any program that writes a map of the right size will do: here the truth, copied.
  const auto describe = [&](const std::string& command) {
    std::ofstream(folder / "other.json") << R"({"name": "other", "command": )" + command + "}";
  };
  const std::string truth = (folder / "made/truth.pfm").string();
  describe(R"(["sh", "-c", "test -s $0 && test -s $1 && cp $3 $2", "{left}", "{right}",)"
           R"("{disparity}", ")" +
           truth + "\"]");
  const auto root = compare("made -o out --methods bm --external other.json");
  ASSERT_EQ(root["methods"].size(), 2u);
  EXPECT_EQ(root["methods"][1]["name"], "other");
  EXPECT_EQ(root["methods"][1]["scores"]["BadPix0.07"], 0);
  fs::remove_all(folder / "out");

  const std::string arguments = "compare made -o out --methods bm --external other.json";
  describe(R"(["no-such-program", "{left}", "{right}", "{disparity}"])");
  expect_refusal(arguments, 1, "no-such-program", "not installed");
  describe(R"(["sh", "-c", "echo out of luck; exit 3", "{left}", "{right}", "{disparity}"])");
  expect_refusal(arguments, 1, "status 3", "out of luck");
  describe(R"(["true", "{left}", "{right}", "{disparity}"])");
  expect_refusal(arguments, 1, "other: wrote no", "disparity.pfm");
  describe(R"(["true", "{left}", "{right}"])");
  expect_refusal(arguments, 1, "other.json", "{disparity}");
  std::ofstream(folder / "other.json") << "{";
  expect_refusal(arguments, 1, "other.json", "JSON");
  expect_refusal("compare made -o out --external missing.json", 1, "missing.json");
}

TEST_F(CompareCommand, AProgramOutsideIsToldWhatItIsGiven) {
  // The last view: the other one is to its left, both are mirrored. Grey pictures, another scale.
  make("made", "--views 3 --disparity 1 2");
  std::ofstream(folder / "other.json")
      << R"({"name": "other", "title": "<b>\"A&B\"</b>", "pictures": "pgm", "scale": 0.5,)"
      << R"("command": ["sh", "-c", "head -c 2 $0 >> seen; echo $3 $4 >> seen; cp twice.pfm $2",)"
      << R"("{left}", "{right}", "{disparity}", "{min}", "{max}"]})";
  FloatMap map(97, 71, 1, 3.0f);  // 1.5 px per pair
  map(0, 0) = std::numeric_limits<float>::infinity();
  write_pfm(folder / "twice.pfm", map);
  const auto root = compare("made -o out --methods bm --external other.json --without 2");
  EXPECT_EQ(root["methods"][1]["views"], "views view_001 and view_000");
  const FloatMap found = read_pfm(folder / "out/other/disparity.pfm");
  EXPECT_EQ(found(40, 30), 1.5f);
  EXPECT_EQ(found(0, 0), 1.5f) << "a hole";
  EXPECT_EQ(text_of("seen"), "P50 3\nP50 3\n") << "once to check, once to time";
  const std::string page = text_of("out/index.html");
  EXPECT_NE(page.find("&lt;b&gt;&quot;A&amp;B&quot;"), std::string::npos);
  EXPECT_EQ(page.find("<b>"), std::string::npos);
}

TEST_F(CompareCommand, ARepeatThatGivesAnotherMapIsNotTimed) {
  make("made", "--views 3");
  write_pfm(folder / "1.pfm", FloatMap(97, 71, 1, 0.5f));
  write_pfm(folder / "2.pfm", FloatMap(97, 71, 1, 0.6f));
  // The second map when the first has been taken.
  std::ofstream(folder / "other.json")
      << R"json({"name": "other", "command": ["sh", "-c", "mv 1.pfm $2 || mv 2.pfm $2",)json"
      << R"json( "{left}", "{right}", "{disparity}"]})json";
  const Result result = run("compare made -o out --methods bm --external other.json");
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("other: gives another map"), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(folder / "out"));
}

class CompareCaptures : public CompareCommand {
 protected:
  void SetUp() override {
    CompareCommand::SetUp();
    make("walk", "--path walk --extent 0.3 --views 7");
  }
};

TEST_F(CompareCaptures, PairsOfPhotographsAreRectified) {
  const auto root = compare("walk -o out");
  EXPECT_EQ(root["kind"], "unstructured");
  const std::string view = root["view"];
  EXPECT_EQ(root["measure"], "BadPix0.07");
  EXPECT_EQ(root["methods"].size(), 7u);
  for (const auto& method : root["methods"]) {
    EXPECT_LT(method["scores"]["bad1.0"], 30) << method["name"];
    EXPECT_GT(method["scores"]["filled"], 95) << method["name"];
  }
  // Inverse depth is what depth gives, in another unit.
  const double unit = root["disparity_of_inverse_depth"];
  EXPECT_EQ(run("depth walk -o depth --views " + view).exit_code, 0);
  const FloatMap ours = read_pfm(folder / "out/gigaray_auto/disparity.pfm"),
                 depth = read_pfm(folder / "depth/depth.pfm");
  for (std::size_t i = 0; i < ours.size(); ++i) {
    ASSERT_EQ(std::isfinite(ours.data()[i]), std::isfinite(depth.data()[i]));
    if (!std::isfinite(depth.data()[i])) continue;
    EXPECT_NEAR(ours.data()[i] * depth.data()[i] / unit, 1, 1e-4);
  }
}

TEST_F(CompareCaptures, TheRangeMayBeStated) {
  const auto root = compare("walk -o out --methods sgbm --disparity 0.3 1.5");
  const double unit = root["disparity_of_inverse_depth"];
  EXPECT_DOUBLE_EQ(root["disparity_range"][0], 0.3 * unit);
  EXPECT_DOUBLE_EQ(root["disparity_range"][1], 1.5 * unit);
}

TEST_F(CompareCaptures, TruthIsDepth) {
  fs::rename(folder / "walk/truth", folder / "exact");
  const auto root = compare("walk -o out --methods bm");
  EXPECT_TRUE(root["truth"].is_null());
  const std::string map = root["view"].get<std::string>() + ".pfm";
  const double of_folder =
      compare("walk -o out --methods bm --truth exact")["methods"][0]["scores"]["BadPix0.07"];
  EXPECT_EQ(compare("walk -o out --methods bm --truth exact/" +
                    map)["methods"][0]["scores"]["BadPix0.07"],
            of_folder);
  fs::remove_all(folder / "out");
  fs::remove(folder / "exact" / map);
  expect_refusal("compare walk -o out --methods bm --truth exact", 1, "exact", map);
  expect_refusal("compare walk -o out --methods bm --truth nowhere", 1, "nowhere");
  expect_refusal("compare walk -o out --methods edge_lines", 1, "none of the methods");
}

TEST_F(CompareCommand, TruthOfAnotherViewOrSizeIsNotUsed) {
  make("made", "--views 5");
  EXPECT_TRUE(compare("made -o out --methods bm --without 2")["truth"].is_null());
  EXPECT_TRUE(compare("made -o out --methods bm --max-size 64")["truth"].is_null());
  EXPECT_FALSE(compare("made -o out --methods bm --without 0")["truth"].is_null());
}

TEST_F(CompareCommand, WhatCannotBeComparedIsOneLine) {
  make("made", "--views 5");
  expect_refusal("compare nowhere -o out", 1, "nowhere");
  expect_refusal("compare made -o out --truth nowhere", 1, "nowhere");
  expect_refusal("compare made -o out --methods elas", 2, "--methods", "elas");
  expect_refusal("compare made -o out --repeats 0", 2, "--repeats");
  write_pfm(folder / "small.pfm", FloatMap(5, 4, 1, 1.0f));
  expect_refusal("compare made -o out --truth small.pfm", 1, "small.pfm", "5 x 4");
  fs::create_directory(folder / "full");
  write_pfm(folder / "full/mine.pfm", FloatMap(5, 4, 1, 1.0f));
  expect_refusal("compare made -o full", 2, "full");
  expect_refusal("compare made -o out --truth full", 1, "full");
}

}  // namespace
}  // namespace gigaray
