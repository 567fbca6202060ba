// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Rows and grids of which some pictures are damaged or of another size.
#include "adapters/adapters_test.h"
#include "gigaray/adapters/photographs.h"

namespace gigaray {
namespace {

class IncompleteSeries : public AdaptersTest {
 protected:
  void save_row(int count) const {
    for (int i = 1; i <= count; ++i) save("view_" + std::to_string(i) + ".png");
  }
  void save_grid(int rows, int columns) const {
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column)
        save("r" + std::to_string(row) + "_c" + std::to_string(column) + ".png");
  }
  static std::string note_of(const LightField& light_field, const std::string& words) {
    for (const std::string& note : light_field.notes)
      if (note.find(words) != std::string::npos) return note;
    return {};
  }
  /// A word of the note that names what is left out.
  LightField expect_left_out(const std::string& name, const std::string& why, int views) const {
    const LightField light_field = open_light_field(folder);
    const std::string note = note_of(light_field, "left out: ");
    EXPECT_NE(note.find(name), std::string::npos) << note;
    EXPECT_NE(note.find(why), std::string::npos) << note;
    EXPECT_EQ(light_field.num_views(), views);
    EXPECT_FALSE(light_field.left_out.empty());
    for (int view = 0; view < light_field.num_views(); ++view) read_view(light_field, view);
    OpenOptions strict;
    strict.strict = true;
    expect_bad_input(name, strict);
    return light_field;
  }
};

TEST_F(IncompleteSeries, ADamagedPictureOfARowIsLeftOutAndTheOthersStay) {
  for (const char* stated : {"", "no picture", "half"}) {
    const std::string bytes = stated;
    SCOPED_TRACE(bytes);
    save_row(5);
    if (bytes == "half")
      cut_short("view_3.png", 0.5);
    else
      write("view_3.png", bytes);
    const LightField light_field = expect_left_out("view_3.png", "(is damaged", 4);
    EXPECT_EQ(light_field.views[2].name, "view_4");
    EXPECT_EQ(light_field.views[2].s - light_field.views[1].s, 2);
    EXPECT_EQ(light_field.left_out[0].name, "view_3");
  }
}

TEST_F(IncompleteSeries, ADamagedPictureOfAGridIsLeftOut) {
  save_grid(3, 3);
  write("r1_c1.png", "");
  const LightField light_field = expect_left_out("r1_c1.png", "1 of 9 pictures", 8);
  EXPECT_EQ(light_field.kind, LightFieldKind::k4D);
}

TEST_F(IncompleteSeries, APictureOfAnotherSizeIsLeftOut) {
  save_row(5);
  save("view_1.png", picture(CV_8UC3, 7, 5));
  const LightField light_field = expect_left_out("view_1.png", "7×5", 4);
  EXPECT_EQ(light_field.width, kWidth);
}

TEST_F(IncompleteSeries, SeveralSizesAreAnError) {
  save_row(4);
  save("view_1.png", picture(CV_8UC3, 7, 5));
  save("view_3.png", picture(CV_8UC3, 7, 5));
  expect_bad_input("all views need one size");
}

TEST_F(IncompleteSeries, TooLittleThatIsLeftIsAnError) {
  save_row(3);
  for (const char* name : {"view_1.png", "view_3.png"}) write(name, "");
  expect_bad_input("of 3 pictures only one can be used");
  write("view_2.png", "");
  expect_bad_input("of 3 pictures none can be used");
}

TEST_F(IncompleteSeries, OnePictureOfAPairIsNoLightField) {
  save_row(2);
  cut_short("view_2.png", 0.4);
  expect_bad_input("view_2.png");
}

TEST_F(IncompleteSeries, ADamagedPictureMakesNoWalkOfARow) {
  save_row(4);
  write("view_2.png", "");
  EXPECT_EQ(why_no_series(folder, 0), "");
}

TEST_F(IncompleteSeries, AFileThatADescriptionNamesMayBeMissing) {
  save_row(3);
  std::filesystem::rename(folder / "view_2.png", folder / "other.png");
  write("gigaray.json", R"({"format": "gigaray light field", "version": 1, "kind": "3D",
    "width": 23, "height": 17, "views": [
    {"name": "a", "file": "view_1.png", "s": -1, "t": 0},
    {"name": "b", "file": "view_2.png", "s": 0, "t": 0},
    {"name": "c", "file": "view_3.png", "s": 1, "t": 0}]})");
  expect_left_out("view_2.png", "is missing", 2);
}

}  // namespace
}  // namespace gigaray
