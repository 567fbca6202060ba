// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// HCI scenes, Stanford archives, gigaray.json.
#include "adapters/adapters_test.h"
#include "gigaray/adapters/light_field_json.h"
#include "gigaray/adapters/registry.h"

namespace gigaray {
namespace {

const char* const kParameters = R"([intrinsics]
focal_length_mm = 100.0
sensor_size_mm = 40.0
[extrinsics]
num_cams_x = 5
num_cams_y = 3
baseline_mm = 25.0
focus_distance_m = 4.25
[meta]
scene = test
disp_min = -1.5
disp_max = 2
)";

class Formats : public AdaptersTest {
 protected:
  void save_camera(int number) const {
    char name[32];
    std::snprintf(name, sizeof name, "input_Cam%03d.png", number);
    save(name);
  }
  static const View& view_named(const LightField& light_field, const std::string& name) {
    for (const View& view : light_field.views)
      if (view.name == name) return view;
    throw std::out_of_range(name);
  }
};
class Hci : public Formats {};
class Stanford : public Formats {};
class GigarayJson : public Formats {};
class Registry : public Formats {};

TEST_F(Hci, NumberIsRowTimesColumnsPlusColumn) {
  for (int number = 0; number < 15; ++number) save_camera(number);
  write("parameters.cfg", kParameters);
  save("objectids_highres.png");
  const LightField light_field = open_light_field(folder);
  EXPECT_EQ(light_field.format, "HCI scene");
  EXPECT_EQ(light_field.kind, LightFieldKind::k4D);
  ASSERT_EQ(light_field.num_views(), 15);
  EXPECT_EQ(light_field.views[centre_view(light_field)].name, "input_Cam007");
  const View& corner = view_named(light_field, "input_Cam013");
  EXPECT_EQ(corner.s, 1);
  EXPECT_EQ(corner.t, 1);
  EXPECT_FALSE(light_field.sign_is_assumed);
  EXPECT_TRUE(light_field.notes.empty());
}

TEST_F(Hci, ParametersGiveRangeAndRig) {
  save_camera(6);
  save_camera(7);
  write("parameters.cfg", kParameters);
  const CommaLocale locale;
  const LightField light_field = open_light_field(folder);
  EXPECT_EQ(light_field.declared_range, (DisparityRange{-1.5, 2}));
  EXPECT_DOUBLE_EQ(light_field.rig.focal_px.value(), 2.5 * kWidth);
  EXPECT_DOUBLE_EQ(light_field.rig.baseline.value(), 0.025);
  EXPECT_DOUBLE_EQ(light_field.rig.focus_distance.value(), 4.25);
  EXPECT_EQ(light_field.rig.unit, "m");
}

TEST_F(Hci, ParametersComeInDialects) {
  save_camera(6);
  save_camera(7);
  for (const std::string text :
       {"\xef\xbb\xbf[intrinsics]\r\nfocal_length_mm: 100.0\r\nsensor_size_mm: 40\r\n"
        "disp_min: -1.5\r\ndisp_max: 2\r\nbaseline_mm: 25",
        "Focal_Length_MM = 100 ; mm\nSENSOR_SIZE_MM=40 # of the longer side\n"
        "DISP_MIN = \"-1.5\"\ndisp_max = '2' ; px\nbaseline_mm = 25 ; mm: between neighbours\n"
        "# disp_max = 9\n; disp_min = -9\n",
        "\"focal_length_mm\" : \"100\"\n'sensor_size_mm' : 40\n disp_min\t:\t-1.5\n"
        "disp_max :2\nbaseline_mm : 25\n"}) {
    SCOPED_TRACE(text);
    write("parameters.cfg", text);
    const LightField light_field = open_light_field(folder);
    EXPECT_EQ(light_field.declared_range, (DisparityRange{-1.5, 2}));
    EXPECT_DOUBLE_EQ(light_field.rig.focal_px.value(), 2.5 * kWidth);
    EXPECT_DOUBLE_EQ(light_field.rig.baseline.value(), 0.025);
  }
}

TEST_F(Hci, CrossWithoutParametersIsPlacedInNineByNine) {
  for (const int number : {4, 36, 38, 39, 40, 44, 76}) save_camera(number);
  const LightField light_field = open_light_field(folder);
  EXPECT_EQ(view_named(light_field, "input_Cam004").t, -4);
  EXPECT_EQ(view_named(light_field, "input_Cam036").s, -4);
  EXPECT_EQ(view_named(light_field, "input_Cam038").s, -2);
  EXPECT_FALSE(light_field.declared_range.has_value());
  ASSERT_EQ(light_field.notes.size(), 2);
  EXPECT_NE(light_field.notes[0].find("9×9"), std::string::npos);
}

TEST_F(Hci, OneRowIs3D) {
  for (int number = 18; number < 27; ++number) save_camera(number);
  const LightField light_field = open_light_field(folder);
  EXPECT_EQ(light_field.kind, LightFieldKind::k3D);
  EXPECT_EQ(light_field.views.front().s, -4);
  EXPECT_EQ(light_field.views.front().t, 0);
}

TEST_F(Hci, PartOnOneSideOfTheGridIsCentred) {
  for (const int number : {0, 1, 2, 9, 10, 11}) save_camera(number);
  const LightField light_field = open_light_field(folder);
  EXPECT_EQ(light_field.views.front().s, -1);
  EXPECT_EQ(light_field.views.front().t, -0.5);
}

TEST_F(Hci, ContradictionsAreNamed) {
  save_camera(0);
  save_camera(81);
  expect_bad_input("input_Cam081");
  write("parameters.cfg", "num_cams_x = nine\n");
  expect_bad_input("num_cams_x");
  write("parameters.cfg", "num_cams_x = 0\n");
  expect_bad_input("num_cams_x");
  expect_error(ErrorCode::kInvalidArgument, "OpenOptions::direction", [&] {
    open_light_field(folder, {"", Travel::kLeft, Travel::kDown});
  });
}

TEST_F(Hci, OneCameraIsNotEnough) {
  save_camera(40);
  expect_bad_input("two views");
}

TEST_F(Stanford, PositionsComeFromTheNames) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      save("out_0" + std::to_string(row) + "_0" + std::to_string(column) + "_" +
           std::to_string(-380.0 - 10 * row) + "_" + std::to_string(1100.0 - 10 * column) + ".jpg");
  const LightField light_field = open_light_field(folder);
  EXPECT_EQ(light_field.format, "Stanford archive");
  EXPECT_EQ(light_field.kind, LightFieldKind::k4D);
  EXPECT_EQ(light_field.num_views(), 9);
  EXPECT_TRUE(light_field.sign_is_assumed);
  EXPECT_DOUBLE_EQ(light_field.rig.baseline.value(), 10);
  EXPECT_DOUBLE_EQ(light_field.views.front().s, 1) << "X is to the right";
  EXPECT_DOUBLE_EQ(light_field.views.front().t, 1) << "Y is downwards";
}

TEST_F(Stanford, SpellingsOfTheArchiveDiffer) {
  const auto expect_read = [&](const char* pattern) {
    SCOPED_TRACE(pattern);
    std::filesystem::remove_all(folder);
    std::filesystem::create_directory(folder);
    for (int row = 0; row < 2; ++row)
      for (int column = 0; column < 3; ++column) {
        char name[64];
        std::snprintf(name, sizeof name, pattern, row, column, -700 + 10 * row, 500 + 10 * column);
        save(name);
      }
    const LightField light_field = open_light_field(folder);
    EXPECT_EQ(light_field.format, "Stanford archive");
    ASSERT_EQ(light_field.num_views(), 6);
    EXPECT_EQ(light_field.views[5].s, 1);
    EXPECT_EQ(light_field.views[5].t, 0.5);
    EXPECT_NEAR(light_field.rig.baseline.value(), 10, 1e-9);
  };
  expect_read("out_%02d_%02d__%d.25_%d.75_.png");
  expect_read("out_%02d_%02d_%d.25__%d.75.png");
  expect_read("out_%02d_%02d_%d_%d_.png");
  expect_read("out__%02d_%02d__%d__%d.png");
  expect_read("amethyst_%02d_%02d_%d_%d.5.png");
}

TEST_F(Stanford, FourWholeNumbersAreNoPositions) {
  for (const char* name : {"IMG_2024_01_05_1201.png", "IMG_2024_01_05_1202.png"}) save(name);
  EXPECT_EQ(open_light_field(folder).format, "image sequence");
}

TEST_F(Stanford, WobbleOfOneRowIsIgnoredAndNoted) {
  save("out_08_00_-450.5_1100.0.png");
  save("out_08_01_-449.5_1090.0.png");
  save("out_08_02_-450.0_1080.0.png");
  const LightField light_field = open_light_field(folder);
  EXPECT_EQ(light_field.kind, LightFieldKind::k3D);
  EXPECT_DOUBLE_EQ(light_field.views[0].s, 1);
  ASSERT_EQ(light_field.notes.size(), 1);
  EXPECT_NE(light_field.notes[0].find("0.10 view steps"), std::string::npos);
}

TEST_F(Stanford, OneColumnIs4DWithoutWobble) {
  save("out_00_08_-400.5_1100.0.png");
  save("out_01_08_-410.5_1101.0.png");
  save("out_02_08_-420.5_1100.0.png");
  const LightField light_field = open_light_field(folder);
  EXPECT_EQ(light_field.kind, LightFieldKind::k4D);
  EXPECT_DOUBLE_EQ(light_field.views[0].t, 1);
  EXPECT_EQ(light_field.views[0].s, light_field.views[1].s);
}

TEST_F(Stanford, StatedDirectionsTurnTheAxes) {
  save("out_00_00_10.0_100.0.png");
  save("out_00_01_10.0_110.0.png");
  save("out_01_00_20.0_100.0.png");
  const LightField up = open_light_field(folder, {"", Travel::kLeft, Travel::kUp});
  EXPECT_FALSE(up.sign_is_assumed);
  EXPECT_EQ(up.views[1].s, -0.5);
  EXPECT_EQ(up.views[2].t, -0.5);
  const LightField swapped = open_light_field(folder, {"", Travel::kDown, Travel::kRight});
  EXPECT_EQ(swapped.views[1].t, 0.5);
  EXPECT_EQ(swapped.views[1].s, -0.5);
  expect_error(ErrorCode::kInvalidArgument, "right,down", [&] {
    open_light_field(folder, {"", Travel::kLeft});
  });
  expect_error(ErrorCode::kInvalidArgument, "same line", [&] {
    open_light_field(folder, {"", Travel::kLeft, Travel::kRight});
  });
}

TEST_F(Stanford, OtherWordsInTheNameAreAllowed) {
  save("Original Camera_09_09_123.076923_123.076923_30_36.png");
  save("Original Camera_09_10_123.076923_92.307692_30_36.png");
  EXPECT_DOUBLE_EQ(open_light_field(folder).rig.baseline.value(), 30.769231);
}

class WrittenLightField : public GigarayJson {
 protected:
  WrittenLightField() {
    save("pictures/a.png");
    save("pictures/b.png");
    LightField light_field;
    light_field.kind = LightFieldKind::k3D;
    light_field.width = kWidth;
    light_field.height = kHeight;
    light_field.views = {{"first", -0.5, 0}, {"second", 0.5, 0}};
    light_field.declared_range = DisparityRange{-1.25, 0.1};
    light_field.rig.focal_px = 800.5;
    light_field.rig.unit = "mm";
    write_light_field_json(folder / "gigaray.json", light_field,
                           {"pictures/a.png", "pictures/b.png"});
  }
  void replace(const std::string& from, const std::string& to) const {
    std::string text = read("gigaray.json");
    const auto place = text.find(from);
    ASSERT_NE(place, std::string::npos) << from;
    write("gigaray.json", text.replace(place, from.size(), to));
  }
};

TEST_F(WrittenLightField, IsReadBack) {
  for (const auto& input : {folder, folder / "gigaray.json"}) {
    const LightField light_field = open_light_field(input);
    EXPECT_EQ(light_field.kind, LightFieldKind::k3D);
    ASSERT_EQ(light_field.num_views(), 2);
    EXPECT_EQ(light_field.views[1].name, "second");
    EXPECT_EQ(light_field.views[1].s, 0.5);
    EXPECT_EQ(light_field.declared_range, (DisparityRange{-1.25, 0.1}));
    EXPECT_EQ(light_field.rig.focal_px, 800.5);
    EXPECT_FALSE(light_field.rig.baseline.has_value());
    EXPECT_EQ(light_field.rig.unit, "mm");
    EXPECT_FALSE(light_field.sign_is_assumed);
    EXPECT_EQ(light_field.pixels->read(0).width(), kWidth);
  }
}

TEST_F(WrittenLightField, NewerVersionIsRefused) {
  replace("\"version\": 1", "\"version\": 2");
  expect_bad_input("version '2'");
}

TEST_F(WrittenLightField, OtherDescriptionIsRefused) {
  replace(kLightFieldFormat, "gigaray depth");
  expect_bad_input("gigaray depth");
}

TEST_F(WrittenLightField, DamageIsNamed) {
  cut_short("gigaray.json", 0.5);
  expect_bad_input("gigaray.json");
}

TEST_F(WrittenLightField, MissingEntryIsNamed) {
  replace("\"views\"", "\"vjews\"");
  expect_bad_input("views");
}

TEST_F(WrittenLightField, ContradictionIsNamed) {
  replace("\"width\": 23", "\"width\": 24");
  expect_bad_input("size");
  replace("\"kind\": \"3D\"", "\"kind\": \"4D\"");
  expect_bad_input("kind");
}

TEST_F(WrittenLightField, NameThatLeavesTheOutputFolderIsRefused) {
  replace("\"first\"", "\"../first\"");
  expect_bad_input("../first");
}

TEST_F(WrittenLightField, MissingPictureIsNamed) {
  std::filesystem::remove(folder / "pictures/b.png");
  expect_bad_input("b.png");
}

TEST_F(Registry, EveryReaderRefusesAnEmptyFolderAndAMissingOne) {
  for (const auto& reader : readers()) {
    EXPECT_EQ(reader->probe(folder).score, 0) << reader->name();
    EXPECT_EQ(reader->probe(folder / "nowhere").score, 0) << reader->name();
  }
}

TEST_F(Registry, FileOfAnotherKindIsNamed) {
  write("notes.txt", "x");
  expect_error(ErrorCode::kBadInput, "notes.txt", [&] { open_light_field(folder / "notes.txt"); });
}

}  // namespace
}  // namespace gigaray
