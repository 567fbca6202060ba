// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/colmap_model.h"

#include <cstring>

#include "adapters/adapters_test.h"
#include "adapters/colmap_scene.h"

namespace gigaray {
namespace {

class ColmapModelFiles : public AdaptersTest {
 protected:
  void expect_bad_model(const std::string& word) const {
    expect_error(ErrorCode::kBadInput, word, [&] { read_colmap_model(folder); });
  }
  /// Writes text files of which one is replaced, and expects an error.
  void expect_bad_text(const std::string& file, const std::string& text,
                       const std::string& word) const {
    write_colmap_model(folder, colmap_scene(), ColmapFormat::kText);
    write(file, text);
    expect_bad_model(word);
  }
  void overwrite(const std::string& name, std::size_t at, const std::string& bytes) const {
    std::string all = read(name);
    all.replace(at, bytes.size(), bytes);
    write(name, all);
  }
  static std::string bytes_of(double value) {
    std::string bytes(sizeof value, 0);
    std::memcpy(bytes.data(), &value, sizeof value);
    return bytes;
  }
};

void expect_same(const ColmapModel& a, const ColmapModel& b) {
  EXPECT_EQ(a.cameras, b.cameras);
  ASSERT_EQ(a.images.size(), b.images.size());
  for (std::size_t i = 0; i < a.images.size(); ++i) {
    EXPECT_EQ(a.images[i].id, b.images[i].id);
    EXPECT_LT((a.images[i].rotation.coeffs() - b.images[i].rotation.coeffs()).norm(), 1e-15);
    EXPECT_EQ(a.images[i].translation, b.images[i].translation);
    EXPECT_EQ(a.images[i].camera_id, b.images[i].camera_id);
    EXPECT_EQ(a.images[i].name, b.images[i].name);
    EXPECT_EQ(a.images[i].features, b.images[i].features);
  }
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    EXPECT_EQ(a.points[i].id, b.points[i].id);
    EXPECT_EQ(a.points[i].position, b.points[i].position);
    EXPECT_EQ(a.points[i].rgb, b.points[i].rgb);
    EXPECT_EQ(a.points[i].error, b.points[i].error);
    EXPECT_EQ(a.points[i].track, b.points[i].track);
  }
}

TEST_F(ColmapModelFiles, BothFormatsAreReadBackWithoutLoss) {
  ColmapModel model = colmap_scene();
  model.cameras[3] = {"OPENCV", 640, 480, {500.1, 1.0 / 3 + 500, 320, 240, -0.1, 1e-17, 0, 2e-3}};
  model.images[1].name = "left camera, top/view 1.png";
  model.images[2].features.clear();
  for (const ColmapFormat format : {ColmapFormat::kText, ColmapFormat::kBinary}) {
    const CommaLocale locale;
    const auto target = folder / (format == ColmapFormat::kText ? "text" : "deep/binary");
    write_colmap_model(target, model, format);
    expect_same(read_colmap_model(target), model);
  }
  EXPECT_EQ(names(), (std::set<std::string>{"text", "deep"}));
}

TEST_F(ColmapModelFiles, TextOfColmapsManualIsUnderstood) {
  write("cameras.txt",
        "# Camera list with one line of data per camera:\r\n"
        "# Number of cameras: 2\r\n\r\n"
        "1 SIMPLE_PINHOLE 3072 2304 2559.81 1536 1152\r\n"
        "  \n"
        "3 SIMPLE_RADIAL 3072 2304 2559.69 1536 1152 -0.0218531\r\n");
  write("images.txt",
        "# Number of images: 2\n\n"
        "1 0.851773 0.0165051 0.503764 -0.142941 -0.737434 1.02973 3.74354 1 P 1180141.JPG \n"
        "2362.39 248.498 58396 1784.7 268.254 59027 1784.7 268.254 -1\n"
        "# between\n"
        "2 0.851773 0.0165051 0.503764 -0.142941 -0.737434 1.02973 3.74354 3 P1180142.JPG\n"
        "\n");
  const ColmapModel model = read_colmap_model(folder);
  ASSERT_EQ(model.images.size(), 2);
  EXPECT_EQ(model.cameras.at(3).params.at(3), -0.0218531);
  EXPECT_EQ(model.images[0].name, "P 1180141.JPG");
  ASSERT_EQ(model.images[0].features.size(), 3);
  EXPECT_EQ(model.images[0].features[1].point_id, 59027);
  EXPECT_EQ(model.images[0].features[2].point_id, ColmapModel::kNoPoint);
  EXPECT_NEAR(model.images[0].rotation.w(), 0.851773, 1e-5);
  EXPECT_NEAR(model.images[0].rotation.norm(), 1, 1e-15);
  EXPECT_TRUE(model.images[1].features.empty());
  EXPECT_TRUE(model.points.empty());
}

TEST_F(ColmapModelFiles, BinaryIsTakenBeforeText) {
  ColmapModel model = colmap_scene();
  write_colmap_model(folder, model, ColmapFormat::kText);
  model.images[0].name = "other.png";
  write_colmap_model(folder, model, ColmapFormat::kBinary);
  EXPECT_EQ(read_colmap_model(folder).images[0].name, "other.png");
  expect_error(ErrorCode::kInvalidArgument, "binary",
               [&] { write_colmap_model(folder, model, ColmapFormat::kText); });
}

TEST_F(ColmapModelFiles, RigsAndFramesAreIgnored) {
  write_colmap_model(folder, colmap_scene(), ColmapFormat::kBinary);
  write("rigs.bin", "anything");
  write("frames.bin", "anything");
  EXPECT_EQ(read_colmap_model(folder).images.size(), 3);
}

TEST_F(ColmapModelFiles, EveryCutOfABinaryFileIsNamed) {
  write_colmap_model(folder, colmap_scene(2, 3), ColmapFormat::kBinary);
  for (const std::string name : {"cameras.bin", "images.bin", "points3D.bin"}) {
    const std::string whole = read(name);
    for (std::size_t length = 0; length < whole.size(); length += 3) {
      write(name, whole.substr(0, length));
      expect_bad_model(name);
    }
    write(name, whole + "x");
    expect_bad_model("after its last entry");
    write(name, whole);
  }
  EXPECT_NO_THROW(read_colmap_model(folder));
}

TEST_F(ColmapModelFiles, AbsurdCountsAreRefusedBeforeAnythingIsAllocated) {
  write_colmap_model(folder, colmap_scene(), ColmapFormat::kBinary);
  const std::string huge("\xff\xff\xff\xff\xff\xff\xff\x7f", 8);
  for (const std::string name : {"cameras.bin", "images.bin", "points3D.bin"}) {
    const std::string whole = read(name);
    overwrite(name, 0, huge);
    expect_bad_model(name);
    expect_bad_model("more than fit");
    write(name, whole);
  }
  // The number of features of the first image, and of images of the first point.
  const std::string images = read("images.bin");
  overwrite("images.bin", 8 + 4 + 56 + 4 + 7, huge);
  expect_bad_model("points of an image");
  write("images.bin", images);
  overwrite("points3D.bin", 8 + 8 + 24 + 3 + 8, huge);
  expect_bad_model("images of a point");
}

TEST_F(ColmapModelFiles, NumbersThatAreNotFiniteAreNamed) {
  write_colmap_model(folder, colmap_scene(), ColmapFormat::kBinary);
  const double nan = std::nan("");
  const auto expect_bad_at = [&](const std::string& name, std::size_t at, const std::string& word) {
    const std::string whole = read(name);
    overwrite(name, at, bytes_of(nan));
    expect_bad_model(word);
    expect_bad_model("finite");
    write(name, whole);
  };
  expect_bad_at("cameras.bin", 8 + 4 + 4 + 16, "camera 7");
  expect_bad_at("images.bin", 8 + 4, "'v0.png'");
  expect_bad_at("images.bin", 8 + 4 + 32, "'v0.png'");
  expect_bad_at("images.bin", 8 + 4 + 56 + 4 + 7 + 8, "'v0.png'");
  expect_bad_at("points3D.bin", 8 + 8, "point 100");
}

TEST_F(ColmapModelFiles, QuaternionIsNormalisedOrRefused) {
  ColmapModel model = colmap_scene();
  const Eigen::Quaterniond unit = model.images[1].rotation;
  const auto with_length = [&](double length) {
    model.images[1].rotation.coeffs() = length * unit.coeffs();
    write_colmap_model(folder, model, ColmapFormat::kBinary);
  };
  for (const double length : {0.995, 1.005}) {
    with_length(length);
    const auto read = read_colmap_model(folder).images[1].rotation;
    EXPECT_LT((read.coeffs() - unit.coeffs()).norm(), 1e-15);
  }
  for (const double length : {0.0, 0.98, 1.02, 1e100}) {
    with_length(length);
    expect_bad_model("'v1.png'");
    expect_bad_model("quaternion");
  }
}

TEST_F(ColmapModelFiles, ContradictionsAreNamed) {
  const auto refused = [&](const ColmapModel& model, const std::string& word) {
    write_colmap_model(folder, model, ColmapFormat::kBinary);
    expect_bad_model(word);
  };
  ColmapModel model = colmap_scene();
  model.images[1].camera_id = 99;
  refused(model, "'v1.png' has camera 99");
  model = colmap_scene();
  model.images[2].id = model.images[0].id;
  refused(model, "number 10");
  model = colmap_scene();
  model.images[2].name = "v0.png";
  refused(model, "two images are named 'v0.png'");
  model = colmap_scene();
  model.points[2].id = model.points[0].id;
  refused(model, "two points have the number 100");
  model = colmap_scene();
  model.images.clear();
  model.points.clear();
  refused(model, "no image is registered");
  model = colmap_scene();
  model.images[1].name = "";
  refused(model, "has no name");
  model = colmap_scene();
  model.images[1].name = "a\nb";
  refused(model, "'a?b'");
  model = colmap_scene();
  model.cameras[7].params[0] = -3;
  refused(model, "camera 7: a focal length");
  model = colmap_scene();
  model.cameras[7].width = 0;
  refused(model, "0×17");
}

TEST_F(ColmapModelFiles, CameraModelsOfColmap4HaveTheirNumbers) {
  struct Case {
    int number;
    const char* name;
    std::vector<double> params;
  };
  for (const Case& one : std::vector<Case>{{12, "SIMPLE_DIVISION", {30, 11.5, 8.5, -0.01}},
                                           {13, "DIVISION", {30, 31, 11.5, 8.5, -0.01}},
                                           {14, "SIMPLE_FISHEYE", {30, 11.5, 8.5}},
                                           {15, "FISHEYE", {30, 31, 11.5, 8.5}},
                                           {16, "EUCM", {30, 31, 11.5, 8.5, 0.1, 1}}}) {
    ColmapModel model = colmap_scene();
    model.cameras[7] = {one.name, 23, 17, one.params};
    write_colmap_model(folder / one.name, model, ColmapFormat::kBinary);
    EXPECT_EQ(read(std::string(one.name) + "/cameras.bin").at(8 + 4), char(one.number));
    expect_same(read_colmap_model(folder / one.name), model);
    std::filesystem::remove_all(folder / one.name);
    write_colmap_model(folder / one.name, model, ColmapFormat::kText);
    expect_same(read_colmap_model(folder / one.name), model);
  }
}

TEST_F(ColmapModelFiles, PanoramasAreRefusedByName) {
  write_colmap_model(folder, colmap_scene(), ColmapFormat::kBinary);
  overwrite("cameras.bin", 8 + 4, std::string("\x11\0\0\0", 4));
  expect_bad_model("EQUIRECTANGULAR");
  std::filesystem::remove(folder / "cameras.bin");
  expect_bad_text("cameras.txt", "7 EQUIRECTANGULAR 40 20 40 20", "EQUIRECTANGULAR");
  expect_bad_text("cameras.txt", "7 SPHERICAL 40 20 40 20", "panorama");
}

TEST_F(ColmapModelFiles, TextOfOtherSystemsIsRead) {
  write_colmap_model(folder, colmap_scene(), ColmapFormat::kText);
  const ColmapModel model = read_colmap_model(folder);
  const auto rewrite = [&](auto change) {
    for (const char* name : {"cameras.txt", "images.txt", "points3D.txt"})
      write(name, change(read(name)));
  };
  const auto with_returns = [](std::string text) {
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
      text.insert(at, "\r");
    return text;
  };
  rewrite([&](const std::string& text) { return "\xef\xbb\xbf" + with_returns(text); });
  expect_same(read_colmap_model(folder), model);
  rewrite([](const std::string& text) {
    std::string wide = "\xff\xfe";
    for (const char c : text.substr(3)) wide += std::string{c, '\0'};
    return wide;
  });
  expect_same(read_colmap_model(folder), model);
  write("cameras.txt", "7 pinhole 23 17 30 31 11.5 8.5");
  expect_same(read_colmap_model(folder), model);
}

TEST_F(ColmapModelFiles, UnknownCameraModelsAreNamed) {
  write_colmap_model(folder, colmap_scene(), ColmapFormat::kBinary);
  overwrite("cameras.bin", 8 + 4, std::string("\x2a\0\0\0", 4));
  expect_bad_model("model number 42");
  overwrite("cameras.bin", 8 + 4, "\xff\xff\xff\xff");
  expect_bad_model("model number -1");
}

TEST_F(ColmapModelFiles, BadTextIsNamedWithItsLine) {
  const std::string pose = "1 0 0 0 0 0 0 ";
  expect_bad_text("cameras.txt", "# c\n7 PINHOLE 23 17 30 31 11.5", "4 parameters");
  expect_bad_text("cameras.txt", "7 PINHOLE 23", "line 1 ends before its height");
  expect_bad_text("cameras.txt", "7 PINHOLE 23 17.5 30 31 11.5 8.5", "'17.5'");
  expect_bad_text("cameras.txt", "7 PINHOLE 23 17 30 x 11.5 8.5", "'x'");
  expect_bad_text("cameras.txt", "-7 PINHOLE 23 17 30 31 11.5 8.5", "'-7'");
  expect_bad_text("cameras.txt", "7 PINHOLE 99999999999 17 30 31 11.5 8.5", "'99999999999'");
  expect_bad_text("cameras.txt", "7 PINHOLE 23 17 30 nan 11.5 8.5", "finite");
  expect_bad_text("cameras.txt", "7 BROWN 23 17 30 31 11.5 8.5", "'BROWN'");
  const std::string camera = "7 PINHOLE 23 17 30 31 11.5 8.5\n";
  expect_bad_text("cameras.txt", camera + camera, "camera 7: is there twice");
  expect_bad_text("cameras.txt", "", "camera 7, which is not in the model");
  expect_bad_text("images.txt", "", "no image is registered");
  expect_bad_text("images.txt", "# only\n\n", "no image is registered");
  expect_bad_text("images.txt", "1 " + pose + "7 \n\n", "no name");
  expect_bad_text("images.txt", "1 1 0 0", "line 1 ends before its quaternion");
  expect_bad_text("images.txt", "1 " + pose + "7 a.png\n1 2\n", "line 2 ends before");
  expect_bad_text("images.txt", "1 " + pose + "7 a.png\n1 2 3.5\n", "'3.5'");
  // The empty second line was dropped.
  expect_bad_text("images.txt", "1 " + pose + "7 a.png\n2 " + pose + "7 b.png\n", "line 2");
  expect_bad_text("points3D.txt", "1 0 0 1 256 0 0 1", "'256'");
  expect_bad_text("points3D.txt", "1 0 0 1 25 0 0 1 10", "line 1 ends before its feature");
  expect_bad_text("points3D.txt", "1 0 inf 1 25 0 0 1 10 0", "finite");
}

TEST_F(ColmapModelFiles, MissingFilesAreNamed) {
  expect_bad_model("cameras.bin");
  write_colmap_model(folder, colmap_scene(), ColmapFormat::kBinary);
  std::filesystem::remove(folder / "images.bin");
  expect_bad_model("images.bin");
  expect_error(ErrorCode::kIo, "can't be written", [&] {
    write_colmap_model(folder / "cameras.bin" / "x", colmap_scene(), ColmapFormat::kBinary);
  });
}

}  // namespace
}  // namespace gigaray
