// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// `gigaray render` on scenes with exact truth.
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "cli/program_test.h"

namespace gigaray {
namespace {

using nlohmann::json;

class RenderCommand : public ProgramTest {
 protected:
  RenderCommand() { make("made", ""); }

  void make(const std::string& name, const std::string& options) const {
    const Result made =
        run("synth planes -o " + name + " --samples 2 --views 5 --width 64 --height 48 " + options);
    EXPECT_EQ(made.exit_code, 0) << made.err;
    const Result depth = run("depth " + name + " -o " + name + "_depth");
    EXPECT_EQ(depth.exit_code, 0) << depth.err;
  }
  cv::Mat picture(const std::string& name) const {
    return cv::imread((folder / name).string(), cv::IMREAD_UNCHANGED);
  }
  double psnr(const std::string& a, const std::string& b) const {
    return cv::PSNR(picture(a), picture(b));
  }
  json quality(const std::string& options) const {
    const Result result = run("render " + options + " --json -o left_out");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return json::parse(result.out).at("quality");
  }
};

TEST_F(RenderCommand, APlaceBetweenTheViews) {
  const Result result = run("render made_depth --pose 0.5,0 -o out");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(names_in("out"),
            (std::set<std::string>{"view.png", "inverse_depth.pfm", "gigaray.json"}));
  // At a view it is that view, half a step beside it is not.
  ASSERT_EQ(run("render made_depth --pose 0,0 -o centre").exit_code, 0);
  ASSERT_EQ(run("render made_depth --pose view_002 -o named").exit_code, 0);
  EXPECT_TRUE(text_of("centre/view.png") == text_of("named/view.png"));
  EXPECT_GT(psnr("centre/view.png", "made/view_002.png"), 40);
  EXPECT_LT(psnr("out/view.png", "made/view_002.png"), 35);
}

TEST_F(RenderCommand, AViewThatWasLeftOutOfTheDepth) {
  ASSERT_EQ(run("depth made -o without --without view_002").exit_code, 0);
  const json scores = quality("without --leave-out view_002");
  EXPECT_GT(scores.at("rendered").at("psnr"), 30);
  EXPECT_GT(scores.at("rendered").at("psnr"), scores.at("nearest_two").at("psnr"));
  EXPECT_GT(scores.at("rendered").at("ssim"), scores.at("nearest_two").at("ssim"));
  EXPECT_EQ(json::parse(text_of("left_out/gigaray.json")).at("took_part_in_depth"), false);
  EXPECT_EQ(cv::norm(picture("left_out/real.png"), picture("made/view_002.png"), cv::NORM_INF), 0);
}

TEST_F(RenderCommand, LeavingAViewOfTheDepthOutSaysThatItTookPart) {
  const Result result = run("render made_depth --leave-out centre -o out");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("depth --without"), std::string::npos) << result.err;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 3) << result.out;
}

TEST_F(RenderCommand, APathOfKeyFrames) {
  const Result result = run("render made_depth --path '-2,0;2,0;view_002' --frames 9 -o frames");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(names_in("frames").size(), 10u);
  EXPECT_GT(psnr("frames/frame_00000.png", "made/view_000.png"), 38);
  EXPECT_GT(psnr("frames/frame_00004.png", "made/view_004.png"), 38);
  EXPECT_GT(psnr("frames/frame_00008.png", "made/view_002.png"), 38);
}

TEST_F(RenderCommand, ASparseLightFieldGivesViewsToo) {
  ASSERT_EQ(run("encode made -o made.grl").exit_code, 0);
  ASSERT_EQ(run("render made.grl --pose 0.5,0 -o a").exit_code, 0);
  ASSERT_EQ(run("render made_depth --pose 0.5,0 -o b").exit_code, 0);
  EXPECT_GT(psnr("a/view.png", "b/view.png"), 30);
}

TEST_F(RenderCommand, PhotographsFromAnywhere) {
  make("walk", "--path walk");
  const json scores = quality("walk_depth --leave-out centre");
  EXPECT_GT(scores.at("rendered").at("psnr"), scores.at("nearest_two").at("psnr"));
  // A camera that a result names, moved to the right and back.
  const json about = json::parse(text_of("walk_depth/gigaray.json"));
  std::ofstream(folder / "camera.json") << json{{"camera", about.at("views")[1].at("camera")}};
  ASSERT_EQ(run("render walk_depth --pose camera.json -o a").exit_code, 0);
  ASSERT_EQ(run("render walk_depth --pose 1 -o b").exit_code, 0);
  ASSERT_EQ(run("render walk_depth --pose 1+0.02,0,0 -o c").exit_code, 0);
  EXPECT_TRUE(text_of("a/view.png") == text_of("b/view.png"));
  EXPECT_FALSE(text_of("a/view.png") == text_of("c/view.png"));
  ASSERT_EQ(run("render walk_depth --refocus 0.5 -o d").exit_code, 0);
  expect_refusal("render walk_depth --pose 0,0 -o x", 2, "S,T");
}

TEST_F(RenderCommand, Refocus) {
  ASSERT_EQ(run("render made_depth --refocus 0 --aperture 0 -o one").exit_code, 0);
  EXPECT_EQ(cv::norm(picture("one/view.png"), picture("made/view_002.png"), cv::NORM_INF), 0);
  ASSERT_EQ(run("render made_depth --refocus 0.7 0.001 0 -o plane --view 1").exit_code, 0);
  EXPECT_EQ(json::parse(text_of("plane/gigaray.json")).at("view"), "view_001");
}

TEST_F(RenderCommand, WhatCantBeMeantIsRefused) {
  expect_refusal("render made_depth -o x", 2, "--pose, --path");
  expect_refusal("render made_depth --pose 0,0 --refocus 1 -o x", 2, "say one of");
  expect_refusal("render made_depth --pose 0,zero -o x", 2, "no view has this name");
  expect_refusal("render made_depth --pose 0,0+1,2 -o x", 2, "three numbers");
  expect_refusal("render made_depth --pose nowhere.json -o x", 1, "nowhere.json");
  expect_refusal("render made_depth --pose made/gigaray.json -o x", 1, "holds no camera");
  expect_refusal("render made_depth --path 0,0 -o x", 2, "two key frames");
  expect_refusal("render made_depth --refocus 1 2 -o x", 2, "--refocus");
  expect_refusal("render made --pose 0,0 -o x", 1, "no result of `gigaray depth`");
  expect_refusal("render nowhere --pose 0,0 -o x", 1, "nowhere");
  expect_refusal("render made_depth --leave-out view_099 -o x", 2, "view_099");
  expect_refusal("render made_depth --pose 0,0 -o made", 2, "name another folder");
  expect_failure("render made_depth --pose 0,0 -o x --sources 0", 2, "--sources");
  expect_refusal("depth made -o x --without 0-3", 2, "--without");
}

}  // namespace
}  // namespace gigaray
