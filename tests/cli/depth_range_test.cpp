// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// --depth NEAR FAR beside --disparity MIN MAX, and ranges that are stated as the other kind.
#include <cmath>
#include <nlohmann/json.hpp>

#include "cli/program_test.h"
#include "gigaray/adapters/maps.h"

namespace gigaray {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

class DepthRange : public ProgramTest {
 protected:
  DepthRange() {
    EXPECT_EQ(run("synth planes -o made --samples 2 --views 5 --width 48 --height 37").exit_code,
              0);
    EXPECT_EQ(run("synth plaster --path walk -o walk --views 4 --width 64 --height 48 --samples 1")
                  .exit_code,
              0);
  }
  /// What `depth INPUT --views centre OPTIONS` searched.
  std::pair<double, double> searched(const std::string& input, const std::string& options) {
    const Result result = run("depth " + input + " -o out --views centre --json " + options);
    EXPECT_EQ(result.exit_code, 0) << options << "\n" << result.err;
    if (result.exit_code != 0) return {};
    const json range = json::parse(result.out).at("options").at("disparity_range");
    return {range.at(0), range.at(1)};
  }
};

TEST_F(DepthRange, OfARigIsThatOfItsDisparities) {
  // Metric depth of the ends of what was searched, the other way.
  ASSERT_EQ(run("depth made -o first --disparity -0.8 0.9 --views centre").exit_code, 0);
  const json rig = json::parse(text_of("first/gigaray.json")).at("light_field").at("rig");
  const double scale = rig.at("focal_px").get<double>() * rig.at("baseline").get<double>();
  const double shift = scale / rig.at("focus_distance").get<double>();
  const std::string near = std::to_string(scale / (0.9 + shift)),
                    far = std::to_string(scale / (-0.8 + shift));
  const auto [least, most] = searched("made", "--depth " + near + " " + far);
  EXPECT_NEAR(least, -0.8, 1e-3);
  EXPECT_NEAR(most, 0.9, 1e-3);
  const auto [infinite, same] = searched("made", "--depth " + near + " inf");
  EXPECT_NEAR(infinite, -shift, 1e-3);
  EXPECT_NEAR(same, 0.9, 1e-3);
}

TEST_F(DepthRange, OfAStatedRigToo) {
  fs::remove(folder / "made/gigaray.json");
  fs::remove(folder / "made/truth.pfm");
  const auto [least, most] =
      searched("made", "--direction right --focal-px 50 --baseline 0.1 --depth 2.5 inf");
  EXPECT_NEAR(least, 0, 1e-6);
  EXPECT_NEAR(most, 2, 1e-6);
  expect_refusal("depth made -o x --direction right --depth 2 3", 2, "--focal-px", "--baseline");
}

TEST_F(DepthRange, OfPhotographsIsThatOfInverseDepths) {
  const auto [least, most] = searched("walk", "--depth 0.8 4");
  EXPECT_NEAR(least, 0.25, 1e-6);
  EXPECT_NEAR(most, 1.25, 1e-6);
  EXPECT_NEAR(searched("walk", "--depth 0.8 inf").first, 0, 1e-6);
}

TEST_F(DepthRange, GoesWithInfoProbeAndCompare) {
  EXPECT_EQ(run("info walk --depth 0.8 4").exit_code, 0);
  const json probe = json::parse(run("probe walk --at 30 20 --depth 0.8 4 --json").out);
  EXPECT_NE(probe.dump().find("1.25"), std::string::npos) << probe.dump().substr(0, 500);
  if (run("compare --help").exit_code == 0) {
    EXPECT_EQ(run("compare made -o compared --depth 0.5 3 --methods auto").exit_code, 0);
  }
  // There it is the depth that was computed.
  EXPECT_EQ(run("encode made -o made.grl --depth nowhere").exit_code, 1);
}

TEST_F(DepthRange, ThatCantBeMeantIsRefused) {
  for (const std::string command :
       {"depth walk -o x ", "depth made -o x ", "probe walk --at 1 1 "}) {
    expect_refusal(command + "--depth 3 2", 2, "--depth 3 2", "less than FAR");
    expect_refusal(command + "--depth 2 2", 2, "--depth 2 2", "less than FAR");
    expect_refusal(command + "--depth 0 2", 2, "--depth 0 2", "above 0");
    expect_refusal(command + "--depth -1 2", 2, "--depth -1 2", "above 0");
    expect_refusal(command + "--depth nan 2", 2, "--depth nan 2");
    expect_refusal(command + "--depth 1 nan", 2, "--depth 1 nan");
    expect_refusal(command + "--depth inf inf", 2, "--depth inf inf");
    expect_refusal(command + "--depth 1", 2, "--depth");
    expect_refusal(command + "--depth near far", 2, "--depth");
    expect_refusal(command + "--depth 1 2 --disparity 0 1", 2, "--depth", "--disparity");
  }
}

TEST_F(DepthRange, DistancesStatedAsInverseDepthsAreRefused) {
  // The scene is 1 to 2.5 m away: inverse depths of 0.26 … 1.15.
  expect_refusal("depth walk -o x --disparity 1.5 3.5", 2, "inverse depth", "--depth 1.5 3.5");
  expect_refusal("probe walk --at 3 3 --disparity 1.5 3.5", 2, "--depth 1.5 3.5");
  const Result unsure = run("depth walk -o a --views centre --disparity 0.9 3.7");
  EXPECT_EQ(unsure.exit_code, 0) << unsure.err;
  EXPECT_NE(unsure.err.find("--depth 0.9 3.7"), std::string::npos) << unsure.err;
  const Result right = run("depth walk -o b --views centre --disparity 0.3 1.2");
  EXPECT_EQ(right.exit_code, 0) << right.err;
  EXPECT_EQ(right.err.find("--depth"), std::string::npos) << right.err;
}

}  // namespace
}  // namespace gigaray
