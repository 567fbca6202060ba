// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// HDF5 light fields: the old HCI benchmark and the Light Field Toolbox.
#include "adapters/light_field_files.h"
#include "gigaray/adapters/hci_old.h"

namespace gigaray {
namespace {

constexpr int kRows = 3, kColumns = 5;

class Hdf5 : public AdaptersTest {
 protected:
  Hdf5() : truth(planes_seen_from(testing_support::grid_of_views(kColumns, kRows))) {
    for (int i = 0; i < truth.num_views(); ++i) pictures.push_back(truth.pixels->read(i));
  }
  std::vector<hsize_t> sizes(hsize_t channels = 3) const {
    return {kRows, kColumns, hsize_t(truth.height), hsize_t(truth.width), channels};
  }
  /// The camera goes left as s rises.
  double old_hci(const std::vector<int>& at) const {
    return pictures[at[0] * kColumns + (kColumns - 1 - at[1])](at[3], at[2], at[4]);
  }
  void write_old_hci() const {
    Hdf5Writer file(folder / "lf.h5");
    file.dataset("LF", H5T_STD_U8LE, sizes(), [&](const auto& at) { return old_hci(at); });
    auto depth_sizes = sizes();
    depth_sizes.pop_back();
    file.dataset("GT_DEPTH", H5T_IEEE_F32LE, depth_sizes, [](const std::vector<int>& at) {
      if (at[0] != 1 || at[1] != 2) return 1.0;  // another view than the centre
      return at[3] == 0 ? 0.0 : 4.0 + at[2];     // no depth in the first column
    });
    file.attribute("dH", 0.25);
    file.attribute("dV", 0.25);
    file.attribute("focalLength", 64);
    file.attribute("shift", 2);
  }
  LightField open(const std::string& name) const { return open_light_field(folder / name); }
  void expect_bad(const std::string& name, const std::string& word) const {
    expect_error(ErrorCode::kBadInput, word, [&] { open(name); });
    expect_error(ErrorCode::kBadInput, name, [&] { open(name); });
  }

  LightField truth;
  std::vector<Image<std::uint16_t>> pictures;
};

TEST_F(Hdf5, OldHciColumnsGoLeft) {
  write_old_hci();
  for (const auto& input : {folder, folder / "lf.h5"}) {
    const LightField light_field = open_light_field(input);
    EXPECT_EQ(light_field.format, "HDF5 light field");
    EXPECT_EQ(light_field.pixels->bit_depth(), 8);
    EXPECT_FALSE(light_field.sign_is_assumed);
    EXPECT_EQ(light_field.views.front().s, 2);
    EXPECT_EQ(light_field.views.front().t, -1);
    expect_places(light_field, truth);
  }
}

TEST_F(Hdf5, OldHciAttributesGiveTheRig) {
  write_old_hci();
  const RigGeometry rig = open("lf.h5").rig;
  EXPECT_EQ(rig.baseline, 0.25);
  EXPECT_EQ(rig.focal_px, 64);
  EXPECT_EQ(rig.focus_distance, 8) << "where dH · f / z equals the shift";
}

TEST_F(Hdf5, OldHciTruthIsTheDisparityOfTheCentreView) {
  write_old_hci();
  const FloatMap disparity = read_hci_old_truth(folder);
  ASSERT_EQ(disparity.width(), truth.width);
  ASSERT_EQ(disparity.height(), truth.height);
  EXPECT_FLOAT_EQ(disparity(1, 0), 16 / 4.0 - 2);
  EXPECT_FLOAT_EQ(disparity(5, 4), 16 / 8.0 - 2);
  EXPECT_TRUE(std::isnan(disparity(0, 3)));
}

TEST_F(Hdf5, OldHciTruthNamesWhatIsMissing) {
  {
    Hdf5Writer file(folder / "none.h5");
    file.dataset("LF", H5T_STD_U8LE, sizes(), [&](const auto& at) { return old_hci(at); });
  }
  expect_error(ErrorCode::kBadInput, "GT_DEPTH", [&] { read_hci_old_truth(folder / "none.h5"); });
  {
    Hdf5Writer file(folder / "bare.h5");
    file.dataset("GT_DEPTH", H5T_IEEE_F32LE, {3, 4}, [](const auto&) { return 1; });
    file.attribute("dH", 1);
  }
  expect_error(ErrorCode::kBadInput, "focalLength",
               [&] { read_hci_old_truth(folder / "bare.h5"); });
}

TEST_F(Hdf5, WithoutAttributesDirectionsAreFound) {
  {
    Hdf5Writer file(folder / "any.h5");
    file.dataset("LF", H5T_STD_U8LE, sizes(), [&](const auto& at) { return old_hci(at); });
  }
  const LightField light_field = open("any.h5");
  EXPECT_TRUE(light_field.sign_is_assumed);
  expect_places(light_field, truth);
}

TEST_F(Hdf5, ToolboxFileIsInMatlabOrder) {
  {
    auto reversed = sizes(4);
    std::reverse(reversed.begin(), reversed.end());
    Hdf5Writer file(folder / "IMG__Decoded.mat", 512);
    file.dataset("LF", H5T_STD_U8LE, reversed, [&](const std::vector<int>& at) {  // c u v s t
      if (at[0] == 3) return 77.0;
      return double(pictures[at[4] * kColumns + at[3]](at[1], at[2], at[0]));
    });
  }
  const LightField light_field = open("IMG__Decoded.mat");
  EXPECT_EQ(light_field.width, truth.width);
  EXPECT_EQ(light_field.height, truth.height);
  expect_places(light_field, truth);
}

TEST_F(Hdf5, ToolboxLeavesOutDarkCorners) {
  {
    auto reversed = sizes();
    std::reverse(reversed.begin(), reversed.end());
    Hdf5Writer file(folder / "lf.mat");
    file.dataset("LF", H5T_STD_U16LE, reversed, [&](const std::vector<int>& at) {
      const bool corner = at[4] != 1 && (at[3] == 0 || at[3] == kColumns - 1);
      return corner ? 9.0 : 257.0 * pictures[at[4] * kColumns + at[3]](at[1], at[2], at[0]);
    });
  }
  const LightField light_field = open("lf.mat");
  EXPECT_EQ(light_field.left_out.size(), 4);
  EXPECT_EQ(light_field.num_views(), kRows * kColumns - 4);
  EXPECT_EQ(light_field.pixels->bit_depth(), 16);
  EXPECT_EQ(light_field.pixels->read(0)(4, 3, 1), 257 * pictures[1](4, 3, 1));
}

TEST_F(Hdf5, FloatingPointIsZeroToOne) {
  {
    Hdf5Writer file(folder / "f.h5");
    file.dataset("LF", H5T_IEEE_F32LE, {1, 2, 3, 4, 1},
                 [](const auto& at) { return at[1] == 0 ? 0.5 : 1.5; });
  }
  const LightField light_field = open("f.h5");
  EXPECT_EQ(light_field.pixels->read(0)(3, 2, 2), 32768);
  EXPECT_EQ(light_field.pixels->read(1)(3, 2, 0), 65535);
}

TEST_F(Hdf5, BadInputIsNamed) {
  write_old_hci();
  cut_short("lf.h5", 0.5);
  expect_bad("lf.h5", "cut short");
  write("text.h5", "no HDF5");
  expect_bad("text.h5", "no HDF5");
  {
    Hdf5Writer file(folder / "empty.h5");
    file.attribute("dH", 1);
  }
  expect_bad("empty.h5", "no dataset LF");
  const auto zero = [](const auto&) { return 0.0; };
  {
    Hdf5Writer(folder / "rank.h5").dataset("LF", H5T_STD_U8LE, {3, 5, 7}, zero);
    Hdf5Writer(folder / "channels.h5").dataset("LF", H5T_STD_U8LE, {3, 3, 5, 7, 2}, zero);
    Hdf5Writer(folder / "type.h5").dataset("LF", H5T_STD_I32LE, {3, 3, 5, 7, 3}, zero);
    Hdf5Writer(folder / "black.mat").dataset("LF", H5T_STD_U8LE, {3, 7, 5, 3, 3}, zero);
    Hdf5Writer(folder / "one.h5").dataset("LF", H5T_STD_U8LE, {1, 1, 5, 7, 3}, zero);
  }
  expect_bad("rank.h5", "3 axes");
  expect_bad("channels.h5", "2 channels");
  expect_bad("type.h5", "type");
  expect_bad("black.mat", "black");
  expect_bad("one.h5", "two views");
  write("old.mat", "MATLAB 5.0 MAT-file, Platform: GLNXA64");
  expect_bad("old.mat", "-v7.3");
}

}  // namespace
}  // namespace gigaray
