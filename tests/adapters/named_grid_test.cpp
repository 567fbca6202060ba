// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <array>

#include "adapters/light_field_files.h"

namespace gigaray {
namespace {

class NamedGrid : public AdaptersTest {
 protected:
  /// Two columns, three rows, of any pictures.
  void save_pattern(const char* pattern, int rows = 3, int columns = 2) const {
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        std::array<char, 64> name{};
        std::snprintf(name.data(), name.size(), pattern, row, column);
        save(name.data());
      }
  }
  static bool has_note(const LightField& light_field, const std::string& word) {
    for (const std::string& note : light_field.notes)
      if (note.find(word) != std::string::npos) return true;
    return false;
  }
};

TEST_F(NamedGrid, UsualSpellingsAreRowThenColumn) {
  for (const char* pattern : {"view_%02d_%02d.png", "%02d_%02d.png", "r%02d_c%02d.png",
                              "lf_%d_%d.png", "input_Cam_%02d_%02d.png", "SAI_%02d_%02d.png",
                              "row%d col%d.png", "y%d_x%d.png", "scene7-%d-%d.png", "t%ds%d.png"}) {
    for (const std::string& name : names()) std::filesystem::remove(folder / name);
    save_pattern(pattern);
    const LightField light_field = open_light_field(folder);
    EXPECT_EQ(light_field.format, "grid of named views") << pattern;
    ASSERT_EQ(light_field.num_views(), 6) << pattern;
    EXPECT_EQ(light_field.kind, LightFieldKind::k4D);
    EXPECT_EQ(light_field.views[1].s, 0.5) << pattern;
    EXPECT_EQ(light_field.views[1].t, -1) << pattern;
    EXPECT_TRUE(light_field.sign_is_assumed);
  }
}

TEST_F(NamedGrid, LettersTellTheRowFromTheColumn) {
  save_pattern("img_x%d_y%d.png", 3, 2);  // the first number is x here
  const LightField light_field = open_light_field(folder);
  EXPECT_EQ(light_field.views[1].s, -1);
  EXPECT_EQ(light_field.views[1].t, 0.5);
  EXPECT_FALSE(has_note(light_field, "taken as the row"));
}

TEST_F(NamedGrid, NumbersWithoutLettersAreNoted) {
  save_pattern("%02d_%02d.png");
  EXPECT_TRUE(has_note(open_light_field(folder), "first number of the names is taken as the row"));
}

TEST_F(NamedGrid, OneNamedColumnGoesDown) {
  for (const std::string row : {"1", "2", "3"}) save("r" + row + "_c7.png");
  const LightField light_field = open_light_field(folder);
  EXPECT_EQ(light_field.kind, LightFieldKind::k4D);
  EXPECT_EQ(light_field.views[2].t, 1);
  EXPECT_EQ(light_field.views[2].s, 0);
}

TEST_F(NamedGrid, EverySecondViewIsOneStep) {
  for (const std::string name : {"02_04", "02_06", "04_04", "08_06"}) save(name + ".png");
  const LightField light_field = open_light_field(folder);
  EXPECT_EQ(light_field.views[1].s - light_field.views[0].s, 1);
  EXPECT_EQ(light_field.views[3].t - light_field.views[2].t, 2);
  EXPECT_TRUE(has_note(light_field, "4 of 8 views of the grid are there"));
}

TEST_F(NamedGrid, ASeriesIsNoGrid) {
  for (const std::string number : {"1", "2", "3"}) save("scan2_v" + number + ".png");
  EXPECT_EQ(open_light_field(folder).format, "image sequence");
}

TEST_F(NamedGrid, SamePlaceTwiceIsRefused) {
  save_pattern("%02d_%02d.png");
  save("0_1.png");
  expect_bad_input("same row and column");
}

TEST_F(NamedGrid, TwoSetsAreRefused) {
  save_pattern("left_%d_%d.png");
  save_pattern("right_%d_%d.png");
  expect_bad_input("more than one set of views");
}

TEST_F(NamedGrid, MixedSizesNameTheFile) {
  save_pattern("%02d_%02d.png");
  save("03_00.png", picture(CV_8UC3, kWidth, kHeight + 1));
  save("03_01.png", picture(CV_8UC3, kWidth, kHeight + 1));
  save("03_02.png", picture(CV_8UC3, kWidth, kHeight + 1));
  expect_bad_input("03_00.png");
}

TEST_F(NamedGrid, StatedDirectionsAreNoAssumption) {
  save_pattern("%02d_%02d.png");
  const LightField light_field = open_light_field(folder, {"", Travel::kUp, Travel::kLeft});
  EXPECT_FALSE(light_field.sign_is_assumed);
  EXPECT_EQ(light_field.views[1].t, -0.5);
  EXPECT_EQ(light_field.views[1].s, 1);
  expect_error(ErrorCode::kInvalidArgument, "two ways", [&] {
    open_light_field(folder, {"", Travel::kUp});
  });
}

TEST_F(NamedGrid, PhotoConsistencyFindsEveryNumbering) {
  const LightField truth = planes_seen_from(testing_support::grid_of_views(3, 3));
  for (const bool column_first : {false, true})
    for (const int row_sign : {1, -1})
      for (const int column_sign : {1, -1}) {
        for (int i = 0; i < 9; ++i) {
          const int row = 1 + row_sign * int(truth.views[i].t);
          const int column = 1 + column_sign * int(truth.views[i].s);
          save(std::to_string(column_first ? column : row) + "_" +
                   std::to_string(column_first ? row : column) + ".png",
               to_mat(truth.pixels->read(i)));
        }
        expect_places(open_light_field(folder), truth);
      }
}

class Lenslet : public AdaptersTest {
 protected:
  /// Interleaves the views of a grid, row by row; the dark ones at a tenth of their brightness.
  static cv::Mat interleaved(const LightField& views, int rows, int columns,
                             const std::set<int>& dark = {}) {
    cv::Mat all(views.height * rows, views.width * columns, CV_8UC3);
    for (int i = 0; i < rows * columns; ++i) {
      const cv::Mat view = to_mat(views.pixels->read(i)) * (dark.contains(i) ? 0.1 : 1);
      for (int v = 0; v < views.height; ++v)
        for (int u = 0; u < views.width; ++u)
          all.at<cv::Vec3b>(v * rows + i / columns, u * columns + i % columns) =
              view.at<cv::Vec3b>(v, u);
    }
    return all;
  }
  LightField open(int columns, int rows) const {
    return open_light_field(folder / "raw.png",
                            {"", Travel::kAuto, Travel::kAuto, {columns, rows}});
  }
};

TEST_F(Lenslet, ViewsAreTakenApart) {
  const LightField truth = planes_seen_from(testing_support::grid_of_views(3, 5));
  save("raw.png", interleaved(truth, 5, 3));
  const LightField light_field = open(3, 5);
  EXPECT_EQ(light_field.format, "lenslet picture");
  EXPECT_EQ(light_field.width, truth.width);
  EXPECT_EQ(light_field.views[1].name, "view_00_01");
  expect_places(light_field, truth);
}

TEST_F(Lenslet, EslfHasFourteenViewsPerAxis) {
  save("flower_eslf.png", cv::Mat(14 * 5, 14 * 7, CV_8UC3, cv::Scalar(50, 60, 70)));
  const LightField light_field = open_light_field(folder / "flower_eslf.png");
  EXPECT_EQ(light_field.num_views(), 196);
  EXPECT_EQ(light_field.width, 7);
  EXPECT_EQ(light_field.height, 5);
}

TEST_F(Lenslet, VignettedViewsAreLeftOutWithTheirPlaces) {
  const LightField truth = planes_seen_from(testing_support::grid_of_views(3, 3));
  save("raw.png", interleaved(truth, 3, 3, {0, 2, 6, 8}));
  const LightField light_field = open(3, 3);
  ASSERT_EQ(light_field.num_views(), 5);
  ASSERT_EQ(light_field.left_out.size(), 4);
  EXPECT_EQ(light_field.left_out[1].name, "view_00_02");
  EXPECT_EQ(light_field.left_out[1].s, 1);
  EXPECT_EQ(light_field.views[0].name, "view_00_01");
  EXPECT_NE(light_field.notes.back().find("4 of 9"), std::string::npos);
}

TEST_F(Lenslet, BadInputIsNamed) {
  save("raw.png", cv::Mat(30, 28, CV_8UC3, cv::Scalar(50, 60, 70)));
  expect_error(ErrorCode::kBadInput, "28×30", [&] { open(14, 14); });
  expect_error(ErrorCode::kBadInput, "OpenOptions::lenslet",
               [&] { open_light_field(folder / "raw.png"); });
  expect_error(ErrorCode::kInvalidArgument, "OpenOptions::lenslet", [&] { open(1, 1); });
  expect_error(ErrorCode::kInvalidArgument, "not one picture", [&] {
    open_light_field(folder, {"", Travel::kAuto, Travel::kAuto, {14, 14}});
  });
  save("raw.png", cv::Mat(28, 28, CV_8UC3, cv::Scalar(0, 0, 0)));
  expect_error(ErrorCode::kBadInput, "black", [&] { open(14, 14); });
  cut_short("raw.png", 0.6);
  expect_error(ErrorCode::kBadInput, "raw.png", [&] { open(14, 14); });
}

}  // namespace
}  // namespace gigaray
