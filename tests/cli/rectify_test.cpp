// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <nlohmann/json.hpp>

#include "cli/program_test.h"
#include "gigaray/adapters/reader.h"

namespace gigaray {
namespace {

using nlohmann::json;
using Names = std::set<std::string>;

class RectifyCommand : public ProgramTest {
 protected:
  RectifyCommand() {
    const Result result =
        run("synth planes -o rail --path line --views 6 --width 320 --height 214 --extent 0.15 "
            "--spacing-noise 0.12 --rotation-noise 0.3 --distortion -0.1 --samples 2");
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  json report(const std::string& out) const {
    return json::parse(text_of(out + "/gigaray.json")).at("rectify");
  }
};

TEST_F(RectifyCommand, TheOrderOfPhotographsIsEnough) {
  const Result result = run("rectify rail/images -o out --poses order --focal 384 --rail-step 30");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("6 views"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("the order of the photographs"), std::string::npos) << result.out;
  EXPECT_EQ(names_in("."), (Names{"out", "rail"}));
  const LightField light_field = open_light_field(folder / "out");
  EXPECT_EQ(light_field.kind, LightFieldKind::k3D);
  EXPECT_EQ(light_field.num_views(), 6);
  EXPECT_EQ(light_field.rig.unit, "mm");
  EXPECT_NEAR(*light_field.rig.focal_px, 384, 1e-6);
  EXPECT_GT(light_field.views[5].s, light_field.views[0].s);  // the camera goes right
  const json found = report("out");
  EXPECT_EQ(found.at("poses"), "known order");
  EXPECT_GT(found.at("vertical_residual_before").at("median_px"), 1);
  EXPECT_LT(found.at("vertical_residual_after").at("median_px"), 0.3);
  EXPECT_EQ(found.at("photographs").size(), 6u);

  // Its own output is replaced, JSON is printed on demand.
  const Result again = run("rectify rail/images -o out --poses order --focal 384 --json");
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(json::parse(again.out).at("cameras"), 6);
}

TEST_F(RectifyCommand, ColmapFindsTheCameras) {
  const Result result = run("rectify rail -o out --poses auto");  // a workspace, nothing to find
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(report("out").at("poses"), "COLMAP");
  EXPECT_FALSE(names_in(".").contains("out.colmap"));

  const Result found = run("rectify rail/images -o found --poses colmap --focal 384");
  ASSERT_EQ(found.exit_code, 0) << found.err;
  EXPECT_NE(found.err.find("COLMAP found the cameras of 6 of 6"), std::string::npos) << found.err;
  EXPECT_EQ(report("found").at("poses"), "COLMAP");
  EXPECT_LT(report("found").at("vertical_residual_after").at("median_px"), 0.3);
  EXPECT_TRUE(names_in("found.colmap").contains("colmap.log"));
}

TEST_F(RectifyCommand, WithoutColmapTheOrderIsTheStart) {
  const std::string nowhere = "PATH=/nowhere";
  const Result result = run("rectify rail/images -o out --focal 384", nowhere);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("colmap"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("the order of the photographs is the start instead"), std::string::npos)
      << result.err;
  EXPECT_EQ(report("out").at("poses"), "known order");
  std::filesystem::remove_all(folder / "out");
  std::filesystem::remove_all(folder / "out.colmap");
  expect_refusal("rectify rail/images -o out --focal 384 --poses colmap", 1, "colmap",
                 "not installed", nowhere);
}

TEST_F(RectifyCommand, WhatCannotBeRectifiedIsOneLine) {
  expect_failure("rectify", 2, "INPUT");
  expect_failure("rectify rail/images", 2, "--output");
  expect_failure("rectify nowhere -o out --poses order", 1, "nowhere");
  expect_failure("rectify rail/truth -o out --poses order", 1, "rail/truth", "no photographs");
  expect_failure("rectify rail/images -o out --poses order --rail-step -3", 2, "--rail-step");
  expect_failure("rectify rail/images -o out --poses order --lens RADIAL 800", 2, "the lens");
  expect_failure("rectify rail/images -o out --poses guess", 2, "--poses");
  EXPECT_EQ(names_in("."), Names{"rail"});
}

}  // namespace
}  // namespace gigaray
