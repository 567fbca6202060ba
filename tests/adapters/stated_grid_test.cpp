// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Grids that --grid or the numbers of the names tell, and dark views of grids in files.
#include <algorithm>

#include "adapters/adapters_test.h"

namespace gigaray {
namespace {

class StatedGrid : public AdaptersTest {
 protected:
  static OpenOptions grid(int rows, int columns) {
    OpenOptions options;
    options.grid = {rows, columns};
    return options;
  }
  void save_numbered(const std::string& before, int count, int first = 0) const {
    for (int i = first; i < first + count; ++i) {
      char number[16];
      std::snprintf(number, sizeof number, "%03d", i);
      save(before + number + ".png");
    }
  }
  static bool has_note(const LightField& light_field, const std::string& word) {
    return std::ranges::any_of(light_field.notes, [&](const std::string& note) {
      return note.find(word) != std::string::npos;
    });
  }
  void expect_refused(const OpenOptions& options, const std::string& word) const {
    expect_error(ErrorCode::kInvalidArgument, word, [&] { open_light_field(folder, options); });
  }
};

TEST_F(StatedGrid, NumbersGoThroughItRowByRow) {
  save_numbered("v", 15, 1);
  const LightField light_field = open_light_field(folder, grid(3, 5));
  EXPECT_EQ(light_field.kind, LightFieldKind::k4D);
  ASSERT_EQ(light_field.num_views(), 15);
  EXPECT_EQ(light_field.views[5].s, -2);
  EXPECT_EQ(light_field.views[5].t, 0);
  EXPECT_EQ(light_field.views[14].s, 2);
  EXPECT_EQ(light_field.views[14].t, 1);
  EXPECT_TRUE(light_field.sign_is_assumed);
  OpenOptions turned = grid(5, 3);
  turned.direction = Travel::kDown;
  turned.row_direction = Travel::kRight;
  EXPECT_EQ(open_light_field(folder, turned).views[1].t, 0);
  EXPECT_EQ(open_light_field(folder, turned).views[1].s, -2);
}

TEST_F(StatedGrid, AMissingNumberIsAnEmptyPlace) {
  save_numbered("v", 12);
  std::filesystem::remove(folder / "v004.png");
  const LightField light_field = open_light_field(folder, grid(3, 4));
  ASSERT_EQ(light_field.num_views(), 11);
  EXPECT_EQ(light_field.views[4].name, "v005");
  EXPECT_EQ(light_field.views[4].s, -0.5);
}

TEST_F(StatedGrid, WhatIsNoSuchGridIsRefused) {
  save_numbered("v", 12);
  expect_refused(grid(3, 3), "3 rows");
  expect_refused(grid(5, 3), "5 rows");
  OpenOptions placed = grid(3, 4);
  placed.positions = folder / "places.txt";
  expect_refused(placed, "OpenOptions::positions");
}

TEST_F(StatedGrid, OtherFormatsRefuseIt) {
  for (const char* name : {"0_0.png", "0_1.png", "1_0.png", "1_1.png"}) save(name);
  expect_refused(grid(2, 2), "grid of named views");
}

TEST_F(StatedGrid, InputCamsWithoutAGapFillASquare) {
  save_numbered("input_Cam", 25);
  const LightField light_field = open_light_field(folder);
  EXPECT_EQ(light_field.views[5].s, -2);
  EXPECT_EQ(light_field.views[5].t, -1);
  EXPECT_EQ(light_field.views[centre_view(light_field)].name, "input_Cam012");
  EXPECT_TRUE(has_note(light_field, "5×5"));
  // One more, or a gap, and the usual grid is left.
  save("input_Cam025.png");
  EXPECT_TRUE(has_note(open_light_field(folder), "9×9"));
}

TEST_F(StatedGrid, InputCamsTakeAStatedGrid) {
  save_numbered("input_Cam", 15);
  const LightField light_field = open_light_field(folder, grid(3, 5));
  EXPECT_EQ(light_field.views[5].s, -2);
  EXPECT_EQ(light_field.views[14].t, 1);
  expect_bad_input("OpenOptions::grid", grid(3, 4));
}

class DarkViews : public StatedGrid {
 protected:
  void save_grid(int side, const std::set<std::pair<int, int>>& dark) const {
    for (int row = 0; row < side; ++row)
      for (int column = 0; column < side; ++column)
        save(std::to_string(row) + "_" + std::to_string(column) + ".png",
             dark.contains({row, column}) ? cv::Mat(picture() / 8) : picture());
  }
};

TEST_F(DarkViews, CornersOfANamedGridAreLeftOut) {
  save_grid(5, {{0, 0}, {0, 4}, {4, 0}, {4, 4}});
  const LightField light_field = open_light_field(folder);
  ASSERT_EQ(light_field.num_views(), 21);
  ASSERT_EQ(light_field.left_out.size(), 4U);
  EXPECT_EQ(light_field.left_out[1].name, "0_4");
  EXPECT_EQ(light_field.left_out[1].s, 2);
  EXPECT_EQ(light_field.views[centre_view(light_field)].name, "2_2");
  EXPECT_TRUE(has_note(light_field, "4 of 25 views are left out"));
}

TEST_F(DarkViews, OneSideOfTheLensIsEnough) {
  save_grid(4, {{0, 0}, {0, 1}, {1, 0}});
  EXPECT_EQ(open_light_field(folder).num_views(), 13);
}

TEST_F(DarkViews, BrightGridsAreWhole) {
  save_grid(3, {});
  EXPECT_EQ(open_light_field(folder).num_views(), 9);
  EXPECT_FALSE(has_note(open_light_field(folder), "left out"));
}

TEST_F(DarkViews, NumberedPicturesOfAStatedGridToo) {
  save_numbered("v", 9);
  save("v000.png", picture() / 8);
  EXPECT_EQ(open_light_field(folder, grid(3, 3)).num_views(), 8);
}

}  // namespace
}  // namespace gigaray
