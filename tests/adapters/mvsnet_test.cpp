// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <functional>

#include "adapters/adapters_test.h"
#include "adapters/colmap_scene.h"

namespace gigaray {
namespace {

class Mvsnet : public AdaptersTest {
 protected:
  static std::string number(double x) {
    char text[40];
    std::snprintf(text, sizeof text, " %.17g", x);
    return text;
  }
  /// k: fx, fy, cx, cy with pixel corners at integers.
  static std::string camera(const ColmapModel::Image& image, const std::string& depths,
                            const std::array<double, 4>& k = {30, 31, 11.5, 8.5}) {
    const Eigen::Matrix3d rotation = image.rotation.toRotationMatrix();
    std::string text = "extrinsic\n";
    for (int row = 0; row < 3; ++row)
      text += number(rotation(row, 0)) + number(rotation(row, 1)) + number(rotation(row, 2)) +
              number(image.translation[row]) + " \n";
    text += "0.0 0.0 0.0 1.0\n\nintrinsic\n" + number(k[0]) + " 0" + number(k[2]) + "\n0" +
            number(k[1]) + number(k[3]) + "\n0 0 1\n\n";
    return text + depths + "\n";
  }
  static std::string name(std::size_t i) { return "0000000" + std::to_string(i); }

  void save_scene(const std::string& pictures, const std::string& cameras,
                  const std::string& depths = "4 0.1 41 8") const {
    std::filesystem::create_directories(folder / cameras);
    for (std::size_t i = 0; i < model.images.size(); ++i) {
      save(pictures + name(i) + ".png");
      write(cameras + name(i) + "_cam.txt", camera(model.images[i], depths));
    }
    write("pair.txt", "3\n0\n2 1 9.5 2 8.5\n");
  }

  void expect_scene(const LightField& light_field, double scale = 1) const {
    EXPECT_EQ(light_field.format, "MVSNet cameras");
    EXPECT_EQ(light_field.kind, LightFieldKind::kUnstructured);
    ASSERT_EQ(light_field.num_views(), int(model.images.size()));
    for (int i = 0; i < light_field.num_views(); ++i)
      for (std::size_t k = 0; k < model.points.size(); ++k) {
        const Eigen::Vector3d at = light_field.cameras[i].project(model.points[k].position);
        const auto& feature = model.images[i].features[k];
        ASSERT_NEAR(at.x(), scale * feature.x - 0.5, 1e-9);
        ASSERT_NEAR(at.y(), scale * feature.y - 0.5, 1e-9);
      }
  }
  void expect_bad(const std::string& text, const std::string& word) const {
    write("cams/" + name(1) + "_cam.txt", text);
    OpenOptions strict;
    strict.strict = true;  // else it is left out
    expect_bad_input(name(1) + "_cam.txt", strict);
    expect_bad_input(word, strict);
  }

  ColmapModel model = colmap_scene();
};

TEST_F(Mvsnet, ShowsAKnownPointInItsPixelWhereverThePicturesLie) {
  const std::pair<const char*, const char*> layouts[] = {{"images/", "cams/"},
                                                         {"blended_images/", "cams/"},
                                                         {"images/", "cams_1/"},
                                                         {"", ""},
                                                         {"image/", "Cameras/"}};
  for (const auto& [pictures, cameras] : layouts) {
    SCOPED_TRACE(std::string(pictures) + " " + cameras);
    std::filesystem::remove_all(folder);
    std::filesystem::create_directory(folder);
    save_scene(pictures, cameras);
    expect_scene(open_light_field(folder));
    expect_scene(open_light_field(folder / cameras));
  }
}

TEST_F(Mvsnet, StatesTheRangeOfDepths) {
  const std::pair<const char*, double> ends[] = {
      {"4 0.1 41 8.25", 8.25}, {"4 0.1 41", 8}, {"4.0 0.1", 4 + 0.1 * 191}};
  for (const auto& [depths, farthest] : ends) {
    SCOPED_TRACE(depths);
    save_scene("images/", "cams/", depths);
    const LightField light_field = open_light_field(folder);
    for (const Camera& one : light_field.cameras) {
      ASSERT_TRUE(one.inverse_depth);
      EXPECT_DOUBLE_EQ(one.inverse_depth->max, 0.25);
      EXPECT_NEAR(one.inverse_depth->min, 1 / farthest, 1e-12);
    }
    EXPECT_NE(light_field.notes.back().find("depths from 4 to"), std::string::npos);
  }
}

TEST_F(Mvsnet, CamerasOfAReducedCopyAreScaled) {
  for (std::size_t i = 0; i < model.images.size(); ++i) {
    save("images/" + name(i) + ".png", picture(CV_8UC3, 4 * kWidth, 4 * kHeight));
    std::filesystem::create_directories(folder / "cams");
    write("cams/" + name(i) + "_cam.txt", camera(model.images[i], "4 0.1"));
  }
  const LightField light_field = open_light_field(folder);
  EXPECT_EQ(light_field.width, 4 * kWidth);
  expect_scene(light_field, 4);
  EXPECT_NE(light_field.notes.front().find("the cameras are scaled"), std::string::npos);
}

TEST_F(Mvsnet, TextOfOtherSystemsIsRead) {
  save_scene("images/", "cams/");
  std::string text = camera(model.images[1], "4 0.1 41 8");
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
    text.insert(at, "\r");
  write("cams/" + name(1) + "_cam.txt", "\xef\xbb\xbf" + text);
  expect_scene(open_light_field(folder));
}

TEST_F(Mvsnet, DamagedOnesAreOneLine) {
  save_scene("images/", "cams/");
  const std::string good = camera(model.images[1], "4 0.1");
  expect_bad("", "extrinsic");
  expect_bad(good.substr(0, good.size() / 3), "intrinsic");
  expect_bad(good.substr(0, good.size() - 8), "words");
  expect_bad(camera(model.images[1], "4 0.1 1 8 9"), "words");
  expect_bad(camera(model.images[1], "-4 0.1"), "range");
  expect_bad(camera(model.images[1], "4 -0.1"), "range");
  expect_bad(camera(model.images[1], "4 nan"), "'nan'");
  std::string changed = good;
  changed.replace(changed.find("0.0 0.0"), 3, "x.0");
  expect_bad(changed, "'x.0'");
  ColmapModel::Image bent = model.images[1];
  changed = camera(bent, "4 0.1");
  changed.replace(changed.find("extrinsic\n") + 10, 2, " 3");
  expect_bad(changed, "rotation");
  write("cams/" + name(1) + "_cam.txt", good);
  std::filesystem::remove(folder / "images" / (name(1) + ".png"));
  EXPECT_EQ(open_light_field(folder).num_views(), int(model.images.size()) - 1);
  OpenOptions strict;
  strict.strict = true;
  expect_error(ErrorCode::kBadInput, name(1), [&] { open_light_field(folder, strict); });
}

}  // namespace
}  // namespace gigaray
