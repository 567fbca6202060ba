// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/synthetic_capture.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/program_test.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/reader.h"

namespace gigaray {
namespace {

using SynthCommand = ProgramTest;
using Names = std::set<std::string>;

constexpr const char* kSmall = " --width 40 --height 31 --samples 2 ";

TEST_F(SynthCommand, WritesARowThatOpensAsItWasRendered) {
  const Result result = run(std::string("synth sphere -o made --views 3 --seed 5 --noise 0.01 "
                                        "--disparity -2 1.5") +
                            kSmall);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(names_in("made"), (Names{"gigaray.json", "truth", "truth.pfm", "view_000.png",
                                     "view_001.png", "view_002.png"}));
  EXPECT_EQ(names_in("made/truth"), (Names{"view_000.pfm", "view_001.pfm", "view_002.pfm"}));

  SyntheticOptions options;
  options.scene = "sphere";
  options.width = 40;
  options.height = 31;
  options.views_s = 3;
  options.samples = 2;
  options.seed = 5;
  options.noise = 0.01;
  options.disparity = {-2, 1.5};
  const SyntheticLightField rendered = render_synthetic(options, RunControl());
  const LightField opened = open_light_field(folder / "made");
  EXPECT_EQ(opened.kind, LightFieldKind::k3D);
  EXPECT_EQ(opened.declared_range, options.disparity);
  EXPECT_FALSE(opened.sign_is_assumed);
  for (int i = 0; i < 3; ++i) {
    const View &read = opened.views[i], &made = rendered.light_field.views[i];
    EXPECT_EQ(read.name, made.name);
    EXPECT_EQ(read.s, made.s);
    EXPECT_EQ(read.t, made.t);
    EXPECT_EQ(opened.pixels->read(i), rendered.light_field.pixels->read(i));
    EXPECT_EQ(read_pfm(folder / "made/truth" / (made.name + ".pfm")), rendered.disparity[i]);
  }
  EXPECT_EQ(read_pfm(folder / "made/truth.pfm"), rendered.disparity[1]);
}

TEST_F(SynthCommand, WritesAGridOfSixteenBits) {
  ASSERT_EQ(run(std::string("synth wall -o made --grid 2x3 --bit-depth 16") + kSmall).exit_code, 0);
  const LightField opened = open_light_field(folder / "made");
  EXPECT_EQ(opened.kind, LightFieldKind::k4D);
  EXPECT_EQ(opened.num_views(), 6);
  EXPECT_EQ(opened.pixels->bit_depth(), 16);
  EXPECT_TRUE(names_in("made").contains("view_02_01.png"));
}

TEST_F(SynthCommand, WritesPhotographsThatOpenWithTheirCameras) {
  const Result result = run(std::string("synth planes -o made --path walk --views 3 --extent 0.4 "
                                        "--off-line 0.01 --rotation-noise 1") +
                            kSmall);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(names_in("made"), (Names{"images", "sparse", "synthetic.json", "truth"}));
  EXPECT_EQ(names_in("made/truth"), (Names{"view_000.pfm", "view_001.pfm", "view_002.pfm"}));

  SyntheticOptions options;
  options.scene = "planes";
  options.width = 40;
  options.height = 31;
  options.views_s = 3;
  options.samples = 2;
  SyntheticPath path;
  path.extent = 0.4;
  path.off_line = 0.01;
  path.rotation_noise = 1;
  const SyntheticCapture capture = describe_synthetic_capture(options, path);
  const LightField opened = open_light_field(folder / "made");
  EXPECT_EQ(opened.kind, LightFieldKind::kUnstructured);
  ASSERT_EQ(opened.num_views(), 3);
  for (int i = 0; i < 3; ++i) {
    const Camera &read = opened.cameras[i], &made = capture.cameras[i];
    EXPECT_EQ(opened.views[i].name, capture.names[i]);
    EXPECT_TRUE(read.rotation.isApprox(made.rotation, 1e-9));
    EXPECT_TRUE(read.translation.isApprox(made.translation, 1e-9));
    EXPECT_NEAR(read.focal_u, made.focal_u, 1e-9);
    EXPECT_NEAR(read.centre_v, made.centre_v, 1e-9);
    ASSERT_TRUE(read.inverse_depth);
    EXPECT_LT(read.inverse_depth->max, 1.3);  // nothing is nearer than 0.9
  }
  render_synthetic_capture(
      options, path, RunControl(), [&](int i, Image<std::uint16_t> picture, FloatMap depth) {
        EXPECT_EQ(opened.pixels->read(i), picture);
        EXPECT_EQ(read_pfm(folder / "made/truth" / (capture.names[i] + ".pfm")), depth);
      });

  // Its own output is replaced; the lens is in the model.
  ASSERT_EQ(
      run(std::string("synth planes -o made --path line --views 2 --distortion -0.1") + kSmall)
          .exit_code,
      0);
  EXPECT_EQ(names_in("made/images"), (Names{"view_000.png", "view_001.png"}));
  EXPECT_NE(text_of("made/sparse/0/cameras.txt").find("SIMPLE_RADIAL"), std::string::npos);
  expect_failure("synth planes -o made --views 3", 2, "made", "not empty");
}

TEST_F(SynthCommand, StepsAndExposuresAreTakenAndTold) {
  const Result result = run(std::string("synth figure -o made --path arc --views 4 --step 20 "
                                        "--exposure-noise 0.5") +
                            kSmall);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  SyntheticOptions options;
  options.scene = "figure";
  options.width = 40;
  options.height = 31;
  options.views_s = 4;
  options.samples = 2;
  SyntheticPath path;
  path.shape = SyntheticPath::Shape::kArc;
  path.step = 20;
  path.exposure_noise = 0.5;
  const SyntheticCapture capture = describe_synthetic_capture(options, path);
  const auto told = nlohmann::json::parse(text_of("made/synthetic.json"));
  EXPECT_EQ(told["step"], 20);
  EXPECT_FALSE(told.contains("extent"));
  EXPECT_EQ(told["exposures"].get<std::vector<double>>(), capture.exposures);
  const LightField opened = open_light_field(folder / "made");
  ASSERT_EQ(opened.num_views(), 4);
  EXPECT_TRUE(opened.cameras[3].rotation.isApprox(capture.cameras[3].rotation, 1e-9));
  render_synthetic_capture(
      options, path, RunControl(), [&](int i, Image<std::uint16_t> picture, FloatMap depth) {
        EXPECT_EQ(opened.pixels->read(i), picture);
        EXPECT_EQ(read_pfm(folder / "made/truth" / (capture.names[i] + ".pfm")), depth);
      });
}

TEST_F(SynthCommand, ReplacesItsOwnOutputAndNothingElse) {
  ASSERT_EQ(run(std::string("synth wall -o made --views 5") + kSmall).exit_code, 0);
  ASSERT_EQ(run(std::string("synth wall -o made --views 2") + kSmall).exit_code, 0);
  EXPECT_FALSE(names_in("made").contains("view_002.png"));

  std::filesystem::create_directory(folder / "mine");
  std::ofstream(folder / "mine/diary.txt") << "dear";
  expect_failure("synth wall -o mine", 2, "mine", "not empty");
  EXPECT_EQ(names_in("mine"), (Names{"diary.txt"}));
}

TEST_F(SynthCommand, WrongUsageIsOneLineAndLeavesNothing) {
  expect_failure("synth", 2, "SCENE");
  expect_failure("synth wall", 2, "--output");
  expect_failure("synth wal -o x", 2, "wal", "garden");
  expect_failure("synth wall -o x --width 3", 2, "width", "3");
  expect_failure("synth wall -o x --grid 3by3", 2, "--grid", "3by3");
  expect_failure("synth wall -o x --grid 3x3x3", 2, "--grid", "3x3x3");
  expect_failure("synth wall -o x --grid 3x3 --views 4", 2, "--grid", "--views");
  expect_failure("synth wall -o x --views 1", 2, "views", "1");
  expect_failure("synth wall -o x --disparity 1 0", 2, "disparity", "1 0");
  expect_failure("synth wall -o x --seed -1", 2, "--seed", "-1");
  expect_failure("synth wall -o x --noise lots", 2, "--noise", "lots");
  expect_failure("synth wall -o x --path circle", 2, "--path", "circle");
  expect_failure("synth wall -o x --path walk --grid 3x3", 2, "--grid", "--path");
  expect_failure("synth wall -o x --extent 1", 2, "--extent", "--path");
  expect_failure("synth wall -o x --path walk --extent 9", 2, "extent", "9");
  expect_failure("synth wall -o x --step 5", 2, "--step", "--path");
  expect_failure("synth wall -o x --path arc --step 5 --extent 1", 2, "--step", "--extent");
  expect_failure("synth wall -o x --path arc --step 30", 2, "step", "30");
  expect_failure("synth wall -o x --path arc --step 20 --views 9", 2, "step", "160");
  expect_failure("synth wall -o x --path line --step 5 --views 3", 2, "step", "line");
  expect_failure("synth wall -o x --exposure-noise 0.3", 2, "--exposure-noise", "--path");
  expect_failure("synth wall -o x --path walk --exposure-noise 3", 2, "exposure_noise", "3");
  EXPECT_EQ(names_in("."), Names{});
}

TEST_F(SynthCommand, APlaceThatCannotBeWrittenIsNamed) {
  std::ofstream(folder / "file") << "x";
  expect_failure("synth wall -o file/out", 1, "file/out");
  EXPECT_EQ(names_in("."), (Names{"file"}));
}

TEST_F(SynthCommand, InterruptLeavesNothing) {
  const std::string command = "cd '" + folder.string() + "' && exec timeout -s INT 1.5 '" +
                              GIGARAY_PROGRAM +
                              "' synth garden -o made --views 4000 --width 900 --height 700 2>.err";
  std::system(command.c_str());
  EXPECT_NE(text_of(".err").find("stopped"), std::string::npos) << text_of(".err");
  EXPECT_EQ(names_in("."), Names{});
}

}  // namespace
}  // namespace gigaray
