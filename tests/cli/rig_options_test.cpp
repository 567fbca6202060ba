// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// --focal-px, --baseline, --focus-distance and --unit: metres for pictures that state no rig.
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/program_test.h"
#include "gigaray/adapters/maps.h"

namespace gigaray {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

class StatedRig : public ProgramTest {
 protected:
  StatedRig() { make("--views 5"); }

  /// "made", which states its rig, and its pictures alone, "bare".
  void make(const std::string& views) {
    EXPECT_EQ(run("synth planes -o made --samples 2 --width 48 --height 37 --disparity 0.5 2 " +
                  views + " --replace")
                  .exit_code,
              0);
    fs::remove_all(folder / "bare");
    fs::create_directory(folder / "bare");
    for (const auto& entry : fs::directory_iterator(folder / "made"))
      if (entry.path().extension() == ".png")
        fs::copy(entry.path(), folder / "bare" / entry.path().filename());
  }
  /// The options that state the rig of "made".
  std::string rig() const {
    const json about = json::parse(text_of("made/gigaray.json")).at("rig");
    return " --focal-px " + about.at("focal_px").dump() + " --baseline " +
           about.at("baseline").dump() + " --focus-distance " + about.at("focus_distance").dump() +
           " --unit m";
  }
};

TEST_F(StatedRig, GivesTheDepthThatTheFileWouldGive) {
  ASSERT_EQ(run("depth made -o a --disparity 0.2 2.3").exit_code, 0);
  const Result result = run("depth bare -o b --disparity 0.2 2.3" + rig());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const FloatMap a = read_pfm(folder / "a/depth.pfm"), b = read_pfm(folder / "b/depth.pfm");
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a.data()[i])) continue;
    ASSERT_NEAR(a.data()[i], b.data()[i], 1e-4);
  }
  const json about = json::parse(text_of("b/gigaray.json"));
  EXPECT_EQ(about.at("depth_unit"), "m");
  EXPECT_EQ(about.at("light_field").at("rig").at("unit"), "m");
}

TEST_F(StatedRig, ReachesWhatIsMadeOfTheResult) {
  for (const std::string views : {"--views 5", "--grid 3x3"}) {
    make(views);
    const std::string direction = views == "--views 5" ? "" : " --direction right,down";
    ASSERT_EQ(run("depth bare -o b --disparity 0.2 2.3 --replace" + direction + rig()).exit_code,
              0);
    for (const std::string command :
         {"cloud b -o s.ply --min-support 1", "mesh b -o s.glb --min-support 1",
          "render b --pose 0.5,0 -o novel"}) {
      const Result result = run(command);
      EXPECT_EQ(result.exit_code, 0) << command << "\n" << result.err;
      EXPECT_EQ(result.err.find("not known"), std::string::npos) << result.err;
    }
    const Result masks = run("segment b --near 0.1 --far 50 -o masks");
    EXPECT_NE(masks.out.find("depth 0.1 … 50"), std::string::npos) << masks.out << masks.err;
    const Result info = run("info b");
    EXPECT_NE(info.out.find(" m\n"), std::string::npos) << info.out;
  }
}

TEST_F(StatedRig, FocalLengthIsOfThePicturesBeforeTheyAreShrunk) {
  const json about =
      json::parse(run("info bare --json --max-size 24 --focal-px 60 --baseline 0.1").out);
  EXPECT_NEAR(about.at("rig").at("focal_px"), 30, 1e-6);
}

TEST_F(StatedRig, WinsOverTheInputWithANote) {
  const Result result = run("info made --focal-px 100 --baseline 2 --json");
  const json about = json::parse(result.out);
  EXPECT_EQ(about.at("rig").at("focal_px"), 100);
  EXPECT_EQ(about.at("rig").at("baseline"), 2);
  const std::string notes = about.at("notes").dump();
  EXPECT_NE(notes.find("--focal-px 100 in place of"), std::string::npos) << notes;
  EXPECT_NE(notes.find("--baseline 2 in place of"), std::string::npos) << notes;
  // What the input states already is no news.
  EXPECT_EQ(run("info made" + rig()).out.find("in place of"), std::string::npos);
  expect_failure("info made --unit mm", 2, "--unit mm", "--baseline");
}

TEST_F(StatedRig, HalfARigIsSaid) {
  EXPECT_NE(run("info bare --focal-px 100").out.find("--baseline states it"), std::string::npos);
  EXPECT_NE(run("info bare --baseline 1").out.find("--focal-px states it"), std::string::npos);
}

TEST_F(StatedRig, GoesWithEveryCommandThatTakesALightField) {
  EXPECT_NE(run("info bare" + rig()).out.find("focus at"), std::string::npos);
  EXPECT_EQ(run("probe bare --at 3 3" + rig()).exit_code, 0);
  ASSERT_EQ(run("encode bare -o b.grl" + rig()).exit_code, 0);
  EXPECT_NE(run("info b.grl").out.find(" m\n"), std::string::npos);
}

TEST_F(StatedRig, WhatCantBeMeantIsRefused) {
  expect_refusal("depth bare -o x --focal-px 2 --baseline 1", 2, "--focal-px 2", "field of view");
  expect_refusal("depth bare -o x --focal-px 1e9 --baseline 1", 2, "--focal-px", "in px");
  for (const std::string value : {"0", "-1", "nan", "inf", "far"})
    for (const std::string option : {"--focal-px", "--baseline", "--focus-distance"})
      expect_refusal("depth bare -o x " + option + " " + value, 2, option);
  for (const std::string unit : {"''", "3", "'a b'", "averyverylongwordfora"})
    expect_refusal("depth bare -o x --unit " + unit, 2, "--unit");
}

TEST_F(StatedRig, CamerasWithPosesStateTheirOwn) {
  ASSERT_EQ(run("synth plaster --path walk -o walk --views 3 --width 48 --height 36 --samples 1")
                .exit_code,
            0);
  for (const std::string option : {"--focal-px 100", "--baseline 1", "--focus-distance 1"})
    expect_refusal("depth walk -o x " + option, 2, option.substr(0, option.find(' ')),
                   "COLMAP workspace");
  // The unit is what such cameras may leave open.
  EXPECT_NE(run("info walk --unit cm").out.find(" cm"), std::string::npos);
  // Before COLMAP runs.
  expect_refusal("depth walk/images -o x --find-cameras --baseline 1", 2, "--baseline");
}

TEST_F(StatedRig, WhatLiesBeyondInfinityIsSaid) {
  const Result result = run("depth made -o a --disparity -1 2 --focal-px 50 --baseline 1");
  EXPECT_EQ(result.exit_code, 0);
  ASSERT_EQ(run("synth planes -o both --samples 2 --width 48 --height 37 --views 5").exit_code, 0);
  fs::remove(folder / "both/gigaray.json");
  fs::remove(folder / "both/truth.pfm");
  const Result beyond =
      run("depth both -o c --direction right --disparity -1 1 --focal-px 50 --baseline 1");
  EXPECT_NE(beyond.err.find("--focus-distance"), std::string::npos) << beyond.err;
}

}  // namespace
}  // namespace gigaray
