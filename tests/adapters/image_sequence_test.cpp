// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "adapters/adapters_test.h"

namespace gigaray {
namespace {

class ImageSequence : public AdaptersTest {
 protected:
  void save_numbered(int from, int to) const {
    for (int i = from; i <= to; ++i) save("view" + std::to_string(i) + ".png");
  }
  LightField open(Travel direction = Travel::kAuto) const {
    return open_light_field(folder, {"", direction});
  }
  LightField open_at(const std::string& positions) const {
    write("places.txt", positions);
    return open_light_field(folder, {folder / "places.txt", Travel::kAuto});
  }
  void expect_bad_positions(const std::string& positions, const std::string& word) const {
    write("places.txt", positions);
    expect_bad_input(word, {folder / "places.txt", Travel::kAuto});
    expect_bad_input("places.txt", {folder / "places.txt", Travel::kAuto});
  }
  static bool has_note(const LightField& light_field, const std::string& word) {
    for (const std::string& note : light_field.notes)
      if (note.find(word) != std::string::npos) return true;
    return false;
  }
};

TEST_F(ImageSequence, NumbersAreSortedAsNumbers) {
  save_numbered(8, 12);
  const LightField light_field = open();
  ASSERT_EQ(light_field.num_views(), 5);
  EXPECT_EQ(light_field.views[0].name, "view8");
  EXPECT_EQ(light_field.views[4].name, "view12");
  EXPECT_EQ(light_field.kind, LightFieldKind::k3D);
  EXPECT_EQ(light_field.width, kWidth);
  EXPECT_EQ(light_field.height, kHeight);
  EXPECT_EQ(light_field.format, "image sequence");
}

TEST_F(ImageSequence, PixelsComeFromTheViewOfTheName) {
  for (int i = 9; i <= 11; ++i)
    save("v" + std::to_string(i) + ".png", picture() + cv::Scalar::all(i));
  const LightField light_field = open();
  const cv::Mat expected = picture() + cv::Scalar::all(10);
  EXPECT_EQ(light_field.pixels->read(1)(3, 2, 0), expected.at<cv::Vec3b>(2, 3)[2]);
  EXPECT_EQ(light_field.pixels->bit_depth(), 8);
}

TEST_F(ImageSequence, KeptPicturesAreDecodedOnceHoweverOftenTheFolderIsOpened) {
  for (int i = 1; i <= 6; ++i)
    save("v" + std::to_string(i) + ".png", picture() + cv::Scalar::all(i));
  OpenOptions options;
  options.kept = std::make_shared<KeptPictures>();
  const LightField row = open_light_field(folder, options);
  const LightField plain = open();
  for (int view = 0; view < 4; ++view) EXPECT_EQ(read_view(row, view), read_view(plain, view));
  EXPECT_EQ(options.kept->num_decoded(), 4);
  options.grid = {2, 3, true};
  const LightField grid = open_light_field(folder, options);
  for (int view = 0; view < 6; ++view) EXPECT_EQ(read_view(grid, view), read_view(plain, view));
  EXPECT_EQ(options.kept->num_decoded(), 6);
  // Masked they are others.
  save("masks/v1.png", cv::Mat(kHeight, kWidth, CV_8UC1, cv::Scalar(255)));
  options.masks = folder / "masks";
  options.grid = {};
  EXPECT_EQ(read_view(open_light_field(folder, options), 0).channels(), 4);
  EXPECT_EQ(options.kept->num_decoded(), 7);
}

TEST_F(ImageSequence, CameraIsAssumedToMoveRight) {
  save_numbered(1, 3);
  const LightField light_field = open();
  EXPECT_EQ(light_field.views[0].s, -1);
  EXPECT_EQ(light_field.views[1].s, 0);
  EXPECT_EQ(light_field.views[2].s, 1);
  EXPECT_TRUE(light_field.sign_is_assumed);
  EXPECT_TRUE(has_note(light_field, "right"));
}

TEST_F(ImageSequence, StatedDirectionIsNoAssumption) {
  save_numbered(1, 4);
  EXPECT_EQ(open(Travel::kRight).views[0].s, -1.5);
  const LightField left = open(Travel::kLeft);
  EXPECT_EQ(left.views[0].s, 1.5);
  EXPECT_FALSE(left.sign_is_assumed);
}

TEST_F(ImageSequence, ConstantNumbersDoNotCount) {
  save("scan2_step10_cam7.png");
  save("scan2_step5_cam7.png");
  const LightField light_field = open();
  EXPECT_EQ(light_field.views[0].name, "scan2_step5_cam7");
}

TEST_F(ImageSequence, EveryFifthNumberIsOneStep) {
  for (const std::string number : {"005", "010", "015"}) save("v" + number + ".png");
  EXPECT_EQ(open().views[2].s, 1);
}

TEST_F(ImageSequence, GapsInTheNumbersAreGapsInSpace) {
  for (const std::string number : {"1", "2", "3", "6", "7"}) save("v" + number + ".png");
  const LightField light_field = open();
  EXPECT_EQ(light_field.views[3].s - light_field.views[2].s, 3);
  EXPECT_EQ(light_field.views.front().s, -light_field.views.back().s);
  EXPECT_TRUE(has_note(light_field, "missing"));
}

TEST_F(ImageSequence, TimesAreNotPlaces) {
  for (const std::string time : {"120001", "120013", "120020"}) save("v" + time + ".png");
  const LightField light_field = open();
  EXPECT_EQ(light_field.views[1].s, 0);
  EXPECT_TRUE(has_note(light_field, "irregular"));
}

TEST_F(ImageSequence, WhatIsNoViewIsIgnored) {
  save_numbered(1, 3);
  save("thumbnail.png");
  save("depth/disparity1.png");
  write("notes1.txt", "x");
  write(".view4.png", "x");
  const LightField light_field = open();
  EXPECT_EQ(light_field.num_views(), 3);
  EXPECT_TRUE(has_note(light_field, "left out"));
}

TEST_F(ImageSequence, SixteenBitGreyAndAlphaAreNoted) {
  save("v1.png", picture(CV_16UC1));
  save("v2.png", picture(CV_8UC4));
  const LightField light_field = open();
  EXPECT_EQ(light_field.pixels->bit_depth(), 16);
  EXPECT_TRUE(has_note(light_field, "grey"));
  EXPECT_TRUE(has_note(light_field, "alpha"));
  EXPECT_TRUE(has_note(light_field, "16 bit"));
  const auto grey = light_field.pixels->read(0);
  EXPECT_EQ(grey(4, 3, 0), picture(CV_16UC1).at<std::uint16_t>(3, 4));
  EXPECT_EQ(grey(4, 3, 2), grey(4, 3, 0));
  EXPECT_EQ(light_field.pixels->read(1)(4, 3, 2), 257 * picture(CV_8UC4).at<cv::Vec4b>(3, 4)[0]);
}

TEST_F(ImageSequence, PositionsAreNormalised) {
  save_numbered(1, 4);
  const LightField light_field = open_at("# millimetres\n100\n+110.0\n120, 0\n\n140 # far\n");
  EXPECT_EQ(light_field.kind, LightFieldKind::k3D);
  EXPECT_EQ(light_field.views[0].s, -2);
  EXPECT_EQ(light_field.views[1].s, -1);
  EXPECT_EQ(light_field.views[3].s, 2);
  EXPECT_EQ(light_field.rig.baseline, 10);
  EXPECT_FALSE(light_field.sign_is_assumed);
}

TEST_F(ImageSequence, NamedPositionsMakeAGridOfAnyNames) {
  for (const std::string name : {"a", "b", "c", "d"}) save(name + ".png");
  const LightField light_field = open_at("d 2 2\nb.png 2 0\na 0 0\nc 0 2\n");
  EXPECT_EQ(light_field.kind, LightFieldKind::k4D);
  EXPECT_EQ(light_field.views[1].name, "b");
  EXPECT_EQ(light_field.views[1].s, 0.5);
  EXPECT_EQ(light_field.views[1].t, -0.5);
}

TEST_F(ImageSequence, PositionsDoNotDependOnTheLocale) {
  const CommaLocale locale;
  save_numbered(1, 3);
  EXPECT_EQ(open_at("0.5\n1.0\n1.5\n").rig.baseline, 0.5);
}

TEST_F(ImageSequence, BadPositionsNameTheFile) {
  save_numbered(1, 3);
  expect_bad_positions("1\n2\n", "2 positions for 3 pictures");
  expect_bad_positions("1\n2\n3\n4\n", "4 positions for 3 pictures");
  expect_bad_positions("1\nnan\n3\n", "places.txt:2");
  expect_bad_positions("1\ninf\n3\n", "finite");
  expect_bad_positions("1\n2x\n3\n", "places.txt:2");
  expect_bad_positions("1 2 3 4\n2\n3\n", "places.txt:1");
  expect_bad_positions("view1 1\nview2 2\nview9 3\n", "view9");
  expect_bad_positions("view1 1\nview2 2\nview2 3\n", "view2");
  expect_bad_positions("view1 1\n2\n3\n", "name");
  expect_bad_positions("1\n2\n2\n", "places.txt:3: the same position as line 2");
  expect_error(ErrorCode::kIo, "none.txt", [&] {
    open_light_field(folder, {folder / "none.txt", Travel::kAuto});
  });
  expect_error(ErrorCode::kInvalidArgument, "OpenOptions::direction", [&] {
    open_light_field(folder, {folder / "none.txt", Travel::kLeft});
  });
}

TEST_F(ImageSequence, FolderWithoutALightFieldIsNamed) {
  expect_bad_input("no pictures");
  expect_bad_input(folder.string());
  save("deep/v1.png");
  expect_bad_input("no pictures");
  save("v1.png");
  expect_bad_input("only one picture, v1.png");
  expect_error(ErrorCode::kBadInput, "one picture", [&] { open_light_field(folder / "v1.png"); });
  expect_error(ErrorCode::kBadInput, "nowhere", [&] { open_light_field(folder / "nowhere"); });
}

TEST_F(ImageSequence, UnclearNamesAreRefused) {
  save("left.png");
  save("right.png");
  expect_bad_input("OpenOptions::positions");
  save("a1.jpg");
  save("a2.jpg");
  save("a3.jpg");
  save("b1.jpg");
  save("b2.jpg");
  expect_bad_input("more than one series");
}

TEST_F(ImageSequence, ChangingNumbersThatFormNoGridAreRefused) {
  save("v1_1_1.png");
  save("v1_2_1.png");
  save("v2_1_2.png");
  expect_bad_input("more than one number");
}

TEST_F(ImageSequence, DatesWithTimesAreNoGrid) {
  save("20260101_120001.png");
  save("20260101_120013.png");
  save("20260102_120020.png");
  EXPECT_EQ(open().kind, LightFieldKind::k3D);
}

TEST_F(ImageSequence, AVerticalRailIsStated) {
  save_numbered(1, 3);
  const LightField down = open(Travel::kDown);
  EXPECT_EQ(down.kind, LightFieldKind::k4D);
  EXPECT_EQ(down.views[2].t, 1);
  EXPECT_EQ(down.views[2].s, 0);
  EXPECT_EQ(open(Travel::kUp).views[2].t, -1);
  expect_error(ErrorCode::kInvalidArgument, "one way", [&] {
    open_light_field(folder, {"", Travel::kLeft, Travel::kDown});
  });
}

TEST_F(ImageSequence, SameNumberTwiceIsRefused) {
  save_numbered(1, 2);
  save("view01.png");
  expect_bad_input("same number");
}

TEST_F(ImageSequence, MixedSizesNameTheFile) {
  save_numbered(1, 2);
  save("view3.png", picture(CV_8UC3, kWidth + 1));
  expect_bad_input("view3.png");
  expect_bad_input("24×17");
}

TEST_F(ImageSequence, PictureThatIsNoneIsNamed) {
  save_numbered(1, 2);
  write("view3.png", "no picture");
  EXPECT_TRUE(has_note(open(), "left out: view3.png"));
  write("view2.png", "no picture");
  expect_bad_input("view2.png");
}

TEST_F(ImageSequence, PictureThatIsDamagedInsideIsNamedWhenItIsRead) {
  save_numbered(1, 3);
  std::string bytes = read("view2.png");
  for (std::size_t i = bytes.size() / 2; i < bytes.size() / 2 + 60; ++i) bytes[i] = char(0xff);
  write("view2.png", bytes);
  const LightField light_field = open();
  EXPECT_NO_THROW(light_field.pixels->read(0));
  expect_error(ErrorCode::kBadInput, "view2.png", [&] { light_field.pixels->read(1); });
}

TEST_F(ImageSequence, PictureThatChangesLaterIsNoticed) {
  save_numbered(1, 3);
  const LightField light_field = open();
  light_field.pixels->read(1);
  save("view2.png", picture(CV_8UC3, kWidth, kHeight + 2));
  expect_error(ErrorCode::kBadInput, "view2.png", [&] { light_field.pixels->read(1); });
}

TEST_F(ImageSequence, TimesInNamesOrderTheViews) {
  struct Case {
    std::vector<std::string> names;  // in the order of the views
    bool are_times;
  };
  for (const Case& names :
       {Case{{"IMG_20240501_235958", "IMG_20240501_235959", "IMG_20240502_000003"}, true},
        Case{{"IMG_20240501_120358", "IMG_20240501_120402", "IMG_20240501_120406"}, true},
        Case{{"PXL_20230101_123456789", "PXL_20230101_123459001", "PXL_20230102_003459001"}, true},
        Case{{"1717171717.123", "1717171717.5", "1717171718.02"}, true},
        Case{{"frame_0001_2024-05-01T12-00-50", "frame_0002_2024-05-01T12-00-55",
              "frame_0003_2024-05-01T12-01-00"},
             false},
        Case{{"2024-05-01T12-00-50_0007", "2024-05-01T12-00-55_0008", "2024-05-01T12-01-00_0009"},
             false},
        Case{{"2024-05-01 12.00.00", "2024-05-01 12.00.30", "2024-05-01 12.01.00",
              "2024-05-01 12.01.30"},
             true},
        Case{{"signal-2024-05-01-120301", "signal-2024-05-01-120302", "signal-2024-06-01-000000"},
             true},
        Case{{"20240501120301", "20240501120302", "20240501120410"}, true},
        Case{{"cam_01_2024-05-01T12-00-00.100", "cam_02_2024-05-01T12-00-00.900",
              "cam_03_2024-05-01T12-00-01.000"},
             false},
        Case{{"a001_0008", "a002_0016", "a003_0024"}, false}}) {
    SCOPED_TRACE(names.names.front());
    for (const std::string& name : names.names) save(name + ".png");
    const LightField light_field = open();
    EXPECT_EQ(light_field.format, "image sequence");
    ASSERT_EQ(light_field.num_views(), int(names.names.size()));
    for (int i = 0; i < light_field.num_views(); ++i) {
      EXPECT_EQ(light_field.views[i].name, names.names[i]);
      EXPECT_EQ(light_field.views[i].s - light_field.views[0].s, i);
    }
    EXPECT_EQ(has_note(light_field, "the names hold times"), names.are_times);
    for (const std::string& name : names.names) std::filesystem::remove(folder / (name + ".png"));
  }
}

TEST_F(ImageSequence, CountersThatDisagreeAreNoSeries) {
  for (const char* name : {"a1_b9.png", "a2_b7.png", "a3_b8.png"}) save(name);
  expect_bad_input("more than one number changes");
}

TEST_F(ImageSequence, NumbersThatOnlyLookLikeDatesAreAGrid) {
  for (const char* name :
       {"lf2016_01_01.png", "lf2016_01_02.png", "lf2016_02_01.png", "lf2016_02_02.png"})
    save(name);
  EXPECT_EQ(open().kind, LightFieldKind::k4D);
  for (const std::string& name : names()) std::filesystem::remove(folder / name);
  for (const char* name :
       {"20240501_03_05.png", "20240501_03_06.png", "20240501_04_05.png", "20240501_04_06.png"})
    save(name);
  EXPECT_EQ(open().kind, LightFieldKind::k4D);
}

}  // namespace
}  // namespace gigaray
