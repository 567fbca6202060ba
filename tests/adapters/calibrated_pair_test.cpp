// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "adapters/light_field_files.h"
#include "gigaray/adapters/shrunk.h"
#include "gigaray/core/metric_depth.h"

namespace gigaray {
namespace {

/// As Middlebury's sets of 2014 and ETH3D have it, for the pictures of the fixture.
constexpr const char* kMiddlebury =
    "cam0=[150.5 0 9; 0 150.5 8.25; 0 0 1]\ncam1=[150.5 0 12; 0 150.5 8.25; 0 0 1]\n"
    "doffs=3\nbaseline=176.252\nwidth=23\nheight=17\nndisp=16\nisint=0\nvmin=2\nvmax=9\n"
    "dyavg=0\ndymax=0\n";
constexpr const char* kEth3d =
    "cam0=[541.764 0 11.5; 0 541.764 8.5; 0 0 1]\ncam1=[541.764 0 11.5; 0 541.764 8.5; 0 0 1]\n"
    "doffs=0\nbaseline=59.9627\nwidth=23\nheight=17\n";

class CalibratedPair : public AdaptersTest {
 protected:
  void save_pair(const std::string& calibration, const std::string& extension = ".png") const {
    save("im0" + extension);
    save("im1" + extension);
    write("calib.txt", calibration);
  }
};

TEST_F(CalibratedPair, StatesTheRigAndTheRange) {
  save_pair(kMiddlebury);
  const LightField pair = open_light_field(folder);
  EXPECT_EQ(pair.format, "Middlebury stereo pair with calib.txt");
  EXPECT_EQ(pair.kind, LightFieldKind::k3D);
  ASSERT_EQ(pair.num_views(), 2);
  EXPECT_EQ(pair.views[centre_view(pair)].name, "im0");
  EXPECT_EQ(pair.views[1].s - pair.views[0].s, 1);
  EXPECT_FALSE(pair.sign_is_assumed);
  EXPECT_EQ(pair.rig.focal_px, 150.5);
  EXPECT_EQ(pair.rig.baseline, 176.252);
  EXPECT_EQ(pair.rig.unit, "mm");
  EXPECT_EQ(pair.declared_range, (DisparityRange{0, 16}));
  EXPECT_TRUE(pair.notes.empty());
}

TEST_F(CalibratedPair, DisparityIsOfPicturesWhosePrincipalPointsDiffer) {
  save_pair(kMiddlebury);
  const LightField pair = open_light_field(folder);
  FloatMap disparity(3, 1);
  disparity(0, 0) = 0;
  disparity(1, 0) = 7;
  disparity(2, 0) = -2;
  const FloatMap depth = depth_from_disparity(disparity, pair);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(depth(i, 0), 150.5 * 176.252 / (disparity(i, 0) + 3), 1e-3);
  // In the middle between the views; the left picture's own is half of doffs beside it.
  EXPECT_EQ(*pair.rig.principal_point, Eigen::Vector2d(10.5, 8.25));
}

TEST_F(CalibratedPair, Eth3dStatesLess) {
  save_pair(kEth3d);
  const LightField pair = open_light_field(folder);
  EXPECT_EQ(pair.rig.focal_px, 541.764);
  EXPECT_FALSE(pair.rig.focus_distance);
  EXPECT_EQ(pair.declared_range, (DisparityRange{0, 8}));
  ASSERT_EQ(pair.notes.size(), 1u);
  EXPECT_NE(pair.notes[0].find("ndisp"), std::string::npos);
}

TEST_F(CalibratedPair, IsReadWithReturnsSpacesAndWithoutDoffs) {
  std::string text = "\xef\xbb\xbf" + std::string(kMiddlebury);
  text.erase(text.find("doffs"), 8);
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
    text.insert(at, "\r");
  text.replace(text.find("baseline="), 9, "baseline = ");
  save_pair(text, ".jpg");
  const LightField pair = open_light_field(folder);
  EXPECT_EQ(pair.rig.baseline, 176.252);
  EXPECT_NEAR(*pair.rig.focus_distance, 150.5 * 176.252 / 3, 1e-9);  // of cam0 and cam1
}

TEST_F(CalibratedPair, IsScaledToPicturesOfAnotherSize) {
  save_pair(kMiddlebury);
  for (const char* name : {"im0.png", "im1.png"})
    save(name, picture(CV_8UC3, 2 * kWidth, 2 * kHeight));
  const LightField pair = open_light_field(folder);
  EXPECT_EQ(pair.rig.focal_px, 301);
  EXPECT_EQ(pair.declared_range, (DisparityRange{0, 32}));
  EXPECT_NEAR(*pair.rig.focus_distance, 150.5 * 176.252 / 3, 1e-9);
  EXPECT_NE(pair.notes.at(0).find("is scaled"), std::string::npos);
  const LightField small = shrunk(pair, kWidth);
  EXPECT_NEAR(small.rig.principal_point->x(), 10.5, 1e-9);
  save("im0.png", picture(CV_8UC3, 2 * kWidth, kHeight));
  save("im1.png", picture(CV_8UC3, 2 * kWidth, kHeight));
  expect_bad_input("23×17");
}

TEST_F(CalibratedPair, DamagedCalibrationIsOneLine) {
  const auto expect_named = [&](const std::string& from, const std::string& to,
                                const std::string& word) {
    std::string text = kMiddlebury;
    text.replace(text.find(from), from.size(), to);
    save_pair(text);
    expect_bad_input("calib.txt");
    expect_bad_input(word);
  };
  expect_named("176.252", "-3", "baseline");
  expect_named("176.252", "far", "'far'");
  expect_named("doffs=3", "doffs=nan", "doffs");
  expect_named("ndisp=16", "ndisp=0", "ndisp");
  expect_named("[150.5 0 9; 0", "[150.5 9; 0", "cam0");
  expect_named("width=23", "width=-1", "width");
}

TEST_F(CalibratedPair, AnotherCalibTxtIsNone) {
  save_pair("P0: 1 0 0 0 0 1 0 0 0 0 1 0\n");
  EXPECT_EQ(open_light_field(folder).format, "image sequence");
}

}  // namespace
}  // namespace gigaray
