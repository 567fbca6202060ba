// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// `gigaray info` of what other commands wrote.
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/program_test.h"
#include "gigaray/adapters/maps.h"

namespace gigaray {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

class ResultInfo : public ProgramTest {
 protected:
  ResultInfo() {
    EXPECT_EQ(run("synth planes -o made --samples 2 --views 5 --width 48 --height 37").exit_code,
              0);
    EXPECT_EQ(run("depth made -o \"it's depth\"").exit_code, 0);
  }
  const std::string depth = "\"it's depth\"";

  void expect_words(const std::string& text, const std::vector<std::string>& words) const {
    for (const std::string& word : words)
      EXPECT_NE(text.find(word), std::string::npos) << word << " in:\n" << text;
  }
};

TEST_F(ResultInfo, TellsWhatTheMapsHold) {
  const Result result = run("info " + depth + " --json");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json about = json::parse(result.out);
  const FloatMap map = read_pfm(folder / "it's depth/disparity.pfm");
  std::vector<float> sorted;
  for (const float value : map)
    if (!std::isnan(value)) sorted.push_back(value);
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(about.at("kind"), "3D");
  EXPECT_EQ(about.at("views"), 5);
  EXPECT_EQ(about.at("top_level_view"), "view_002");
  EXPECT_EQ(about.at("disparity").at("unit"), "px per view step");
  EXPECT_NEAR(about.at("disparity").at("median"), sorted[sorted.size() / 2], 1e-6);
  EXPECT_NEAR(about.at("disparity").at("high"), sorted[sorted.size() * 95 / 100], 0.05);
  EXPECT_EQ(about.at("depth").at("unit"), "m");
  EXPECT_LT(about.at("depth").at("low"), about.at("depth").at("high"));
  EXPECT_EQ(about.at("coverage"), double(sorted.size()) / double(map.size()));
  EXPECT_GT(about.at("confidence").at("median"), 0);
  EXPECT_LE(about.at("confidence").at("above_half"), 1);
  EXPECT_GT(about.at("seconds"), 0);
}

TEST_F(ResultInfo, ItsNextLinesRun) {
  const Result result = run("info " + depth);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  expect_words(result.out, {"made (gigaray light field, 3D)", "px per view step", " m\n",
                            "coverage", "confidence", "opencl", "gigaray segment 'it'\\''s depth'",
                            "gigaray cloud", "gigaray mesh", "gigaray render"});
  const json about = json::parse(run("info " + depth + " --json").out);
  const std::string name = "gigaray ";
  ASSERT_EQ(about.at("next").size(), 4u);
  for (const std::string line : about.at("next")) {
    EXPECT_NE(result.out.find(line), std::string::npos) << line;
    const Result next = run(line.substr(name.size()));
    EXPECT_EQ(next.exit_code, 0) << line << "\n" << next.err;
  }
  // What these wrote is known too.
  expect_words(run("info scene.ply").out, {"point cloud", "points", "CloudCompare"});
  expect_words(run("info scene.glb").out, {"surface", "triangles", "Blender"});
  expect_words(run("info masks").out, {"masks of disparity", "it's depth", "% of the pixels"});
  expect_words(run("info novel").out, {"gigaray render", "view.png"});
  EXPECT_EQ(json::parse(run("info scene.ply --json").out).at("format"), "gigaray cloud");
  ASSERT_EQ(run("cloud " + depth + " -o scene.pcd").exit_code, 0);
  EXPECT_EQ(json::parse(run("info scene.pcd --json").out).at("vertices"),
            json::parse(run("info scene.ply --json").out).at("vertices"));
}

TEST_F(ResultInfo, OneViewNeedsNoWitnesses) {
  ASSERT_EQ(run("depth made -o one --views centre").exit_code, 0);
  const json about = json::parse(run("info one --json").out);
  const std::string cloud = about.at("next").at(0);
  EXPECT_NE(cloud.find("--min-support 0"), std::string::npos) << cloud;
  EXPECT_EQ(run(cloud.substr(8)).exit_code, 0);
}

TEST_F(ResultInfo, PhotographsHaveInverseDepthInTheirOwnUnit) {
  ASSERT_EQ(run("synth plaster --path walk -o walk --views 4 --width 64 --height 48 --samples 1")
                .exit_code,
            0);
  ASSERT_EQ(run("depth walk -o walked").exit_code, 0);
  const Result result = run("info walked");
  expect_words(result.out, {"inverse depth", "units of the cameras", "not in metres"});
  const json about = json::parse(run("info walked --json").out);
  EXPECT_NEAR(about.at("disparity").at("median").get<double>() *
                  about.at("depth").at("median").get<double>(),
              1, 0.02);
  for (const std::string line : about.at("next")) {
    const Result next = run(line.substr(8));
    EXPECT_EQ(next.exit_code, 0) << line << "\n" << next.err;
  }
}

TEST_F(ResultInfo, ASparseFileIsALightFieldWithDepth) {
  ASSERT_EQ(run("encode made -o made.grl --depth " + depth).exit_code, 0);
  const Result result = run("info made.grl");
  expect_words(result.out, {"sparse light field, 3D", "takes", "lossless", "px per view step",
                            "gigaray decode made.grl -o views", "gigaray cloud made.grl"});
  const json about = json::parse(run("info made.grl --json").out);
  EXPECT_EQ(about.at("kind"), "3D");
  EXPECT_EQ(about.at("views").size(), 5u);
  EXPECT_EQ(about.at("sparse").at("file_bytes"), fs::file_size(folder / "made.grl"));
}

TEST_F(ResultInfo, ALightFieldIsStillOne) {
  const Result result = run("info made --max-size 32");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  expect_words(result.out, {"gigaray light field, 3D", "32 × 25 px", "takes"});
  EXPECT_EQ(result.out.find("next"), std::string::npos);
}

TEST_F(ResultInfo, WhatIsDamagedOrDoesntGoWithItIsNamed) {
  expect_failure("info " + depth + " --max-size 100", 2, "--max-size", "gigaray depth");
  expect_failure("info " + depth + " --disparity 0 1", 2, "--disparity");
  const fs::path map = folder / "it's depth/view_002/disparity.pfm";
  fs::resize_file(map, fs::file_size(map) / 2);
  expect_failure("info " + depth, 1, "view_002/disparity.pfm");
  fs::remove(map);
  expect_failure("info " + depth, 1, "view_002/disparity.pfm");
  std::ofstream(folder / "it's depth/gigaray.json") << R"({"format": "gigaray depth"})";
  expect_failure("info " + depth, 1, "gigaray.json", "missing");
  std::ofstream(folder / "it's depth/gigaray.json") << "{\"format\": ";
  expect_failure("info " + depth, 1, "gigaray.json", "damaged");
  fs::create_directory(folder / "masks");
  std::ofstream(folder / "masks/gigaray.json") << R"({"format": "gigaray segment", "views": 3})";
  expect_failure("info masks", 1, "masks/gigaray.json", "missing");
  std::ofstream(folder / "half.ply") << "ply\nformat";
  expect_failure("info half.ply", 1, "half.ply");
  std::ofstream(folder / "half.glb") << std::string("glTF\2\0\0\0\xff\xff\xff\xff", 12);
  expect_failure("info half.glb", 1, "half.glb");
  fs::remove_all(folder / "made");
}

TEST_F(ResultInfo, AnInputThatIsGoneIsSaid) {
  fs::rename(folder / "made", folder / "moved");
  const Result result = run("info " + depth);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  expect_words(result.out, {"not there any more"});
}

}  // namespace
}  // namespace gigaray
