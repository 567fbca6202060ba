// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Captures of which a part is missing, damaged, without a pose, or at the place of another one.
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "adapters/adapters_test.h"
#include "adapters/colmap_scene.h"
#include "gigaray/samplers/unstructured_sampler.h"

namespace gigaray {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

class IncompleteCapture : public AdaptersTest {
 protected:
  void save_pictures(const std::string& below, const std::string& ending = ".png") const {
    for (std::size_t i = 0; i < model.images.size(); ++i)
      save(below + "v" + std::to_string(i) + ending, picture(CV_8UC3, 46, 34));
  }
  void save_model() const { write_colmap_model(folder / "sparse/0", model, ColmapFormat::kText); }

  json transforms() const {
    json root = {{"w", 46}, {"h", 34}, {"fl_x", 60}};
    for (std::size_t i = 0; i < model.images.size(); ++i)
      root["frames"].push_back(
          {{"file_path", "images/" + model.images[i].name},
           {"transform_matrix",
            {{1, 0, 0, 0.3 * double(i)}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}});
    return root;
  }

  /// Rows of LLFF's poses: down, right, back, place, size.
  static std::string poses_bounds(int views) {
    std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" +
                         std::to_string(views) + ", 17), }\n";
    std::string bytes("\x93NUMPY\x01\x00", 8);
    bytes += {char(header.size() & 0xff), char(header.size() >> 8)};
    bytes += header;
    for (int i = 0; i < views; ++i)
      for (const double value :
           {0., 1., 0., 0.3 * i, 34., 1., 0., 0., 0., 46., 0., 0., -1., 0., 60., 4., 8.})
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    return bytes;
  }

  /// All but view `without` are read, a note names it, and --strict makes it an error.
  void expect_left_out(int without, const std::string& why) const {
    const LightField light_field = open_light_field(folder);
    const std::string name = "v" + std::to_string(without);
    ASSERT_EQ(light_field.num_views(), int(model.images.size()) - 1);
    for (const View& view : light_field.views) EXPECT_NE(view.name, name);
    for (int view = 0; view < light_field.num_views(); ++view) read_view(light_field, view);
    EXPECT_TRUE(std::ranges::any_of(light_field.notes, [&](const std::string& note) {
      return note.find("1 of " + std::to_string(model.images.size()) + " pictures") !=
                 std::string::npos &&
             note.find(name) != std::string::npos && note.find(why) != std::string::npos;
    })) << testing::PrintToString(light_field.notes);
    OpenOptions strict;
    strict.strict = true;
    expect_bad_input("", strict);
  }

  ColmapModel model = [] {
    ColmapModel scene = colmap_scene(5);
    scene.cameras[7] = {"PINHOLE", 46, 34, {60, 62, 23, 17}};
    return scene;
  }();
};

TEST_F(IncompleteCapture, AMissingPictureOfAModelIsLeftOut) {
  save_pictures("images/");
  save_model();
  fs::remove(folder / "images/v2.png");
  expect_left_out(2, "missing");
}

TEST_F(IncompleteCapture, ADamagedPictureIsLeftOut) {
  save_pictures("images/");
  save_model();
  write("images/v0.png", "no picture");
  expect_left_out(0, "damaged");
  save_pictures("images/");
  cut_short("images/v4.png", 0.7);
  expect_left_out(4, "cut short");
}

TEST_F(IncompleteCapture, AJpegThatIsCutShortIsLeftOut) {
  save_pictures("images/", ".jpg");
  for (auto& image : model.images) image.name.replace(2, 4, ".jpg");
  save_model();
  EXPECT_EQ(open_light_field(folder).num_views(), 5);
  cut_short("images/v1.jpg", 0.8);
  expect_left_out(1, "cut short");
}

TEST_F(IncompleteCapture, APoseThatIsNotFiniteIsLeftOut) {
  save_pictures("images/");
  for (const auto format : {ColmapFormat::kText, ColmapFormat::kBinary}) {
    const double before = model.images[3].translation.y();
    model.images[3].translation.y() = std::numeric_limits<double>::quiet_NaN();
    write_colmap_model(folder / "sparse/0", model, format);
    model.images[3].translation.y() = before;
    expect_left_out(3, "not finite");
  }
}

TEST_F(IncompleteCapture, AnImageWithoutAPossibleCameraIsLeftOut) {
  save_pictures("images/");
  model.images[1].camera_id = 99;
  write_colmap_model(folder / "sparse/0", model, ColmapFormat::kText);
  expect_left_out(1, "camera 99, which is not in the model");
  save_model();
  write("sparse/0/cameras.txt",
        read("sparse/0/cameras.txt") + "99 SPHERICAL 46 34 1 2\n8 PINHOLE 46 34 -60 62 23 17\n");
  expect_left_out(1, "panorama");
  model.images[1].camera_id = 8;
  const std::string cameras = read("sparse/0/cameras.txt");
  save_model();
  write("sparse/0/cameras.txt", cameras);
  expect_left_out(1, "focal length");
  write("sparse/0/cameras.txt", "# none\n");
  expect_bad_input("not in the model");
}

TEST_F(IncompleteCapture, APointThatIsNotFiniteIsLeftOut) {
  save_pictures("images/");
  model.points[4].position.x() = std::numeric_limits<double>::infinity();
  save_model();
  const LightField light_field = open_light_field(folder);
  EXPECT_EQ(light_field.num_views(), 5);
  EXPECT_NE(light_field.notes.front().find("1 points of the model"), std::string::npos);
}

TEST_F(IncompleteCapture, AFrameThatCannotBeReadIsLeftOut) {
  save_pictures("images/");
  using Change = std::function<void(json&)>;
  for (const Change& change : {Change([](json& frame) { frame["camera_model"] = "PANORAMA"; }),
                               Change([](json& frame) { frame["transform_matrix"] = "x"; }),
                               Change([](json& frame) { frame.erase("transform_matrix"); }),
                               Change([](json& frame) { frame["transform_matrix"][0][0] = 3; }),
                               Change([](json& frame) { frame["fl_x"] = -1; })}) {
    json root = transforms();
    change(root["frames"][1]);
    write("transforms.json", root.dump());
    expect_left_out(1, "frame 1");
  }
  json root = transforms();
  for (json& frame : root["frames"]) frame.erase("transform_matrix");
  write("transforms.json", root.dump());
  expect_bad_input("frame 0: has no transform_matrix");
}

TEST_F(IncompleteCapture, FramesWithoutAPictureOrAFinitePoseAreLeftOut) {
  save_pictures("images/");
  json root = transforms();
  write("transforms.json", root.dump());
  EXPECT_EQ(open_light_field(folder).num_views(), 5);
  std::string text = root.dump();
  const auto place = text.find("0.6");
  ASSERT_NE(place, std::string::npos);
  for (const char* number : {"NaN", "-Infinity", "null"}) {
    write("transforms.json", std::string(text).replace(place, 3, number));
    expect_left_out(2, "not finite");
  }
  write("transforms.json", text);
  fs::remove(folder / "images/v4.png");
  expect_left_out(4, "missing");
}

TEST_F(IncompleteCapture, RowsOfPosesBoundsGoWithTheNumbersThatAreThere) {
  save_pictures("images/");
  write("poses_bounds.npy", poses_bounds(5));
  EXPECT_EQ(open_light_field(folder).num_views(), 5);
  fs::remove(folder / "images/v2.png");
  const LightField light_field = open_light_field(folder);
  ASSERT_EQ(light_field.num_views(), 4);
  EXPECT_NEAR(light_field.cameras[2].position().x(), 0.9, 1e-12) << light_field.views[2].name;
  // The last one, or one before the first: nothing tells.
  save("images/v2.png", picture(CV_8UC3, 46, 34));
  fs::remove(folder / "images/v4.png");
  expect_bad_input("4 pictures");
}

TEST_F(IncompleteCapture, FewerThanTwoAreAnError) {
  save_pictures("images/");
  save_model();
  for (const char* name : {"v0.png", "v1.png", "v2.png"}) fs::remove(folder / "images" / name);
  EXPECT_EQ(open_light_field(folder).num_views(), 2);
  write("images/v3.png", "no picture");
  expect_bad_input("only one can be used");
  fs::remove(folder / "images/v3.png");
  expect_bad_input("is missing, one of 4 of the 5 pictures");
}

TEST_F(IncompleteCapture, PicturesFromOnePlaceAreNoStepAndNoPartners) {
  save_pictures("images/");
  ColmapModel twice = model;
  for (ColmapModel::Image image : model.images) {
    fs::copy(folder / "images" / image.name, folder / "images" / ("b" + image.name));
    image.id += 100;
    image.name = "b" + image.name;
    image.features.clear();
    twice.images.push_back(image);
  }
  write_colmap_model(folder / "sparse/0", twice, ColmapFormat::kText);
  const LightField light_field = open_light_field(folder);
  ASSERT_EQ(light_field.num_views(), 10);
  // bv0 … bv4, v0 … v4.
  EXPECT_NEAR(std::abs(light_field.views[1].s - light_field.views[0].s), 1, 1e-6);
  const UnstructuredSampler sampler(light_field.cameras);
  for (int view = 0; view < 10; ++view) {
    const std::vector<int> partners = sampler.partners(view);
    EXPECT_EQ(std::ranges::count(partners, (view + 5) % 10), 0) << view;
    EXPECT_GT(partners.size(), 3U) << view;
  }
}

TEST_F(IncompleteCapture, CamerasThatAllStandAtOnePlaceAreRefused) {
  save_pictures("images/");
  for (auto& image : model.images) image.translation.setZero();
  save_model();
  expect_bad_input("one place");
}

}  // namespace
}  // namespace gigaray
