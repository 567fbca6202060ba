// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// transforms.json, poses_bounds.npy, *_par.txt, *.camera: the cameras of one scene in each of them.
#include <functional>
#include <nlohmann/json.hpp>

#include "adapters/adapters_test.h"
#include "adapters/colmap_scene.h"
#include "gigaray/adapters/photographs.h"
#include "gigaray/adapters/registry.h"

namespace gigaray {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using nlohmann::json;

std::string number(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

class StatedCameras : public AdaptersTest {
 protected:
  StatedCameras() {
    // Every format here can state it: the principal point of LLFF is the middle, its pixels square.
    model.cameras[7].params = {30, 30, 11.5, 8.5};
    for (std::size_t i = 0; i < model.images.size(); ++i)
      for (std::size_t k = 0; k < model.points.size(); ++k) {
        const Vector3d at =
            model.images[i].rotation * model.points[k].position + model.images[i].translation;
        model.images[i].features[k].x = 30 * at.x() / at.z() + 11.5;
        model.images[i].features[k].y = 30 * at.y() / at.z() + 8.5;
      }
  }

  void save_pictures(const std::string& below) const {
    for (const auto& image : model.images) save(below + image.name);
  }
  void write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder / name).parent_path());
    std::ofstream(folder / name, std::ios::binary) << text;
  }

  /// Right, down, ahead as columns, in the scene.
  static Matrix3d axes(const ColmapModel::Image& image) {
    return image.rotation.toRotationMatrix().transpose();
  }
  static Vector3d position(const ColmapModel::Image& image) {
    return -(axes(image) * image.translation);
  }

  json transforms() const {
    json root = {{"camera_model", "OPENCV"},
                 {"w", 23},
                 {"h", 17},
                 {"fl_x", 30},
                 {"fl_y", 30},
                 {"cx", 11.5},
                 {"cy", 8.5}};
    for (const auto& image : model.images) {
      Matrix3d gl = axes(image);
      gl.col(1) *= -1;
      gl.col(2) *= -1;
      const Vector3d place = position(image);
      json matrix = json::array();
      for (int r = 0; r < 3; ++r) matrix.push_back({gl(r, 0), gl(r, 1), gl(r, 2), place[r]});
      matrix.push_back({0, 0, 0, 1});
      root["frames"].push_back(
          {{"file_path", "./images/" + image.name}, {"transform_matrix", matrix}});
    }
    return root;
  }

  std::vector<double> llff_rows() const {
    std::vector<double> values;
    for (const auto& image : model.images) {
      const Matrix3d a = axes(image);
      const Vector3d place = position(image);
      const double size[3] = {17, 23, 30};
      for (int r = 0; r < 3; ++r)
        values.insert(values.end(), {a(r, 1), a(r, 0), -a(r, 2), place[r], size[r]});
      values.insert(values.end(), {4, 8});
    }
    return values;
  }
  static std::string npy(const std::vector<double>& values, int columns = 17) {
    std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" +
                         std::to_string(values.size() / columns) + ", " + std::to_string(columns) +
                         "), }\n";
    std::string bytes("\x93NUMPY\x01\x00", 8);
    bytes += {char(header.size() & 0xff), char(header.size() >> 8)};
    bytes += header;
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double));
    return bytes;
  }

  std::string par() const {
    std::string text = std::to_string(model.images.size()) + "\n";
    for (const auto& image : model.images) {
      text += image.name + " 30 0 11 0 30 8 0 0 1";
      const Matrix3d rotation = image.rotation.toRotationMatrix();
      for (int i = 0; i < 9; ++i) text += " " + number(rotation(i / 3, i % 3));
      for (int i = 0; i < 3; ++i) text += " " + number(image.translation[i]);
      text += "\n";
    }
    return text;
  }

  static std::string strecha(const ColmapModel::Image& image) {
    std::string text = "30 0 11\n0 30 8\n0 0 1\n0 0 0\n";
    const Matrix3d a = axes(image);
    for (int i = 0; i < 9; ++i) text += number(a(i / 3, i % 3)) + (i % 3 == 2 ? "\n" : " ");
    const Vector3d place = position(image);
    return text + number(place.x()) + " " + number(place.y()) + " " + number(place.z()) +
           "\n23 17\n";
  }
  void write_strecha(const std::string& below) const {
    for (const auto& image : model.images) write(below + image.name + ".camera", strecha(image));
  }

  void expect_points_in_their_pixels(const LightField& light_field) const {
    EXPECT_EQ(light_field.kind, LightFieldKind::kUnstructured);
    ASSERT_EQ(light_field.num_views(), int(model.images.size()));
    for (int i = 0; i < light_field.num_views(); ++i) {
      EXPECT_EQ(light_field.views[i].name, "v" + std::to_string(i));
      for (std::size_t k = 0; k < model.points.size(); ++k) {
        const Vector3d at = light_field.cameras[i].project(model.points[k].position);
        const auto& feature = model.images[i].features[k];
        ASSERT_NEAR(at.x(), feature.x - 0.5, 1e-9) << i << " " << k;
        ASSERT_NEAR(at.y(), feature.y - 0.5, 1e-9) << i << " " << k;
        ASSERT_GT(at.z(), 0);
      }
    }
    EXPECT_EQ(read_view(light_field, 1).width(), kWidth);
  }

  void expect_bad(const std::string& input, const std::string& word,
                  const std::string& other = "") const {
    SCOPED_TRACE(word);
    OpenOptions options;
    options.strict = true;  // else one camera of several is left out
    expect_error(ErrorCode::kBadInput, word, [&] { open_light_field(folder / input, options); });
    if (!other.empty())
      expect_error(ErrorCode::kBadInput, other, [&] { open_light_field(folder / input, options); });
  }

  ColmapModel model = colmap_scene();
};

TEST_F(StatedCameras, TransformsJsonShowsAKnownPointInItsPixel) {
  save_pictures("images/");
  write("transforms.json", transforms().dump());
  expect_points_in_their_pixels(open_light_field(folder));
  expect_points_in_their_pixels(open_light_field(folder / "transforms.json"));
  EXPECT_EQ(open_light_field(folder).format, "transforms.json");
}

TEST_F(StatedCameras, TransformsJsonHasLensesOfEachFrame) {
  save_pictures("images/");
  json root = transforms();
  for (const char* key : {"fl_x", "fl_y", "cx", "cy", "w", "h"}) {
    for (json& frame : root["frames"]) frame[key] = root[key];
    root.erase(key);
  }
  root["frames"][1]["k1"] = 0.05;
  root["frames"][2]["k1"] = 0.02;
  root["frames"][2]["camera_model"] = "OPENCV_FISHEYE";
  write("transforms.json", root.dump());
  const LightField light_field = open_light_field(folder);
  expect_points_in_their_pixels(light_field);
  ASSERT_FALSE(light_field.notes.empty());
  EXPECT_NE(light_field.notes.front().find("2 of 3 pictures are undistorted (FULL_OPENCV, "
                                           "OPENCV_FISHEYE)"),
            std::string::npos)
      << light_field.notes.front();
}

TEST_F(StatedCameras, TransformsJsonOfBlenderStatesAnAngleAndNoExtension) {
  save_pictures("images/");
  json root = transforms();
  for (const char* key : {"fl_x", "fl_y", "cx", "cy", "w", "h", "camera_model"}) root.erase(key);
  root["camera_angle_x"] = 2 * std::atan(11.5 / 30);
  for (json& frame : root["frames"]) {
    std::string path = frame["file_path"];
    frame["file_path"] = path.substr(0, path.size() - 4);
  }
  write("transforms.json", root.dump());
  expect_points_in_their_pixels(open_light_field(folder));
}

TEST_F(StatedCameras, TransformsJsonNamesMasks) {
  save_pictures("images/");
  json root = transforms();
  root["frames"][1]["mask_path"] = "masks/v1.png";
  write("transforms.json", root.dump());
  expect_bad(".", "masks/v1.png");
  save("masks/v1.png");
  EXPECT_EQ(open_light_field(folder).pixels->read(0).channels(), 4);
}

TEST_F(StatedCameras, PicturesMayLieElsewhere) {
  save_pictures("far/away/");
  write("transforms.json", transforms().dump());
  expect_bad(".", "none of the 3 pictures", "OpenOptions::images");
  OpenOptions options;
  options.images = folder / "far/away";
  expect_points_in_their_pixels(open_light_field(folder, options));
  std::filesystem::remove(folder / "far/away/v1.png");
  EXPECT_EQ(open_light_field(folder, options).num_views(), 2);
  options.strict = true;
  expect_error(ErrorCode::kBadInput, "v1.png", [&] { open_light_field(folder, options); });
}

TEST_F(StatedCameras, DamagedTransformsJsonIsOneLine) {
  save_pictures("images/");
  const auto expect_named = [&](const std::function<void(json&)>& change, const std::string& word,
                                const std::string& other = "") {
    json root = transforms();
    change(root);
    write("transforms.json", root.dump());
    expect_bad(".", word, other);
  };
  write("transforms.json", transforms().dump().substr(0, 200));
  expect_bad(".", "damaged");
  expect_named([](json& j) { j.erase("frames"); }, "frames");
  expect_named([](json& j) { j["frames"] = json::array(); }, "no camera");
  expect_named([](json& j) { j["frames"].erase(1), j["frames"].erase(1); }, "only one");
  expect_named([](json& j) { j["frames"][1] = 3; }, "frame 1");
  expect_named([](json& j) { j["frames"][2].erase("file_path"); }, "frame 2", "file_path");
  expect_named([](json& j) { j["frames"][2]["file_path"] = j["frames"][1]["file_path"]; }, "twice");
  expect_named([](json& j) { j.erase("fl_x"); }, "fl_x", "camera_angle_x");
  expect_named([](json& j) { j["fl_x"] = "long"; }, "fl_x");
  expect_named([](json& j) { j["fl_x"] = -30; }, "frame 0");
  expect_named([](json& j) { j.erase("w"); }, "w and h");
  expect_named([](json& j) { j["w"] = 1e9; }, "size");
  expect_named([](json& j) { j["k4"] = 0.1; }, "k4");
  expect_named([](json& j) { j["camera_model"] = "EQUIRECTANGULAR"; }, "EQUIRECTANGULAR");
  expect_named([](json& j) { j["frames"][1].erase("transform_matrix"); }, "transform_matrix");
  expect_named([](json& j) { j["frames"][1]["transform_matrix"][0][0] = 2; }, "rotation");
  expect_named([](json& j) { j["frames"][1]["transform_matrix"][0] = "x"; }, "4 × 4");
}

TEST_F(StatedCameras, TransformsJsonOfNerfsScenesIsReadUnderItsOtherNames) {
  save_pictures("train/");
  json root = transforms();
  for (const char* key : {"fl_x", "fl_y", "cx", "cy", "w", "h", "camera_model"}) root.erase(key);
  root["camera_angle_x"] = 2 * std::atan(11.5 / 30);
  for (std::size_t i = 0; i < model.images.size(); ++i)
    root["frames"][i]["file_path"] = "./train/v" + std::to_string(i);
  write("transforms_train.json", root.dump());
  write("transforms_test.json", root.dump());
  write("transforms_val.json", root.dump());
  const LightField light_field = open_light_field(folder);
  expect_points_in_their_pixels(light_field);
  EXPECT_EQ(light_field.notes.at(0),
            "the cameras are those of transforms_train.json; name a file as INPUT for those of "
            "transforms_test.json, transforms_val.json");
  expect_points_in_their_pixels(open_light_field(folder / "transforms_val.json"));
  // Any name will do for a file that is named.
  write("my cameras.JSON", root.dump());
  expect_points_in_their_pixels(open_light_field(folder / "my cameras.JSON"));
  write("transforms.json", transforms().dump());
  expect_bad(".", "none of the 3 pictures");
}

TEST_F(StatedCameras, NamesOfPicturesAreThoseOfOtherSystems) {
  save_pictures("images/");
  const auto expect_read = [&](auto name) {
    json root = transforms();
    for (std::size_t i = 0; i < model.images.size(); ++i)
      root["frames"][i]["file_path"] = name("v" + std::to_string(i));
    SCOPED_TRACE(std::string(root["frames"][1]["file_path"]));
    write("transforms.json", root.dump());
    expect_points_in_their_pixels(open_light_field(folder));
  };
  expect_read([](const std::string& v) { return ".\\images\\" + v + ".png"; });
  expect_read([](const std::string& v) { return "images\\" + v; });
  expect_read([](const std::string& v) { return "Images/" + v + ".PNG"; });
  expect_read([](const std::string& v) { return v + ".png"; });
  expect_read([](const std::string& v) { return "images/" + v + ".jpg"; });
  expect_read([](const std::string& v) { return "C:\\Users\\me\\scene\\images\\" + v + ".png"; });
  expect_read([](const std::string& v) { return "/home/me/scene/images/" + v + ".png"; });
  expect_read([](const std::string& v) { return "../other/rgb/" + v + ".png"; });
  // One that is missing is not another one elsewhere.
  json root = transforms();
  std::filesystem::rename(folder / "images/v1.png", folder / "v1.png");
  write("transforms.json", root.dump());
  OpenOptions strict;
  strict.strict = true;
  expect_bad_input("images/v1.png: is missing", strict);
}

TEST_F(StatedCameras, TransformsJsonIsReadInTheSpellingOfOtherWriters) {
  save_pictures("images/");
  const auto expect_read = [&](auto change, const std::string& text_before = "") {
    json root = transforms();
    change(root);
    SCOPED_TRACE(root.dump().substr(0, 300));
    write("transforms.json", text_before + root.dump());
    expect_points_in_their_pixels(open_light_field(folder));
  };
  for (const char* name : {"SIMPLE_RADIAL", "perspective", "pinhole", "radial", "opencv",
                           "FULL_OPENCV", "simple_pinhole", ""})
    expect_read([&](json& j) { j["camera_model"] = name; });
  const auto without = [](json& j, std::initializer_list<const char*> keys) {
    for (const char* key : keys) j.erase(key);
  };
  expect_read([&](json& j) { without(j, {"w", "h"}); });
  expect_read([&](json& j) { without(j, {"w", "h", "cx", "cy", "fl_y"}); });
  expect_read([&](json& j) {
    without(j, {"fl_x", "fl_y", "cx", "cy"});
    j["K"] = {{30, 0, 11.5}, {0, 30, 8.5}, {0, 0, 1}};
  });
  expect_read([&](json& j) {
    without(j, {"w", "h"});
    j["fl_x"] = j["fl_y"] = 99;
    for (json& frame : j["frames"]) {
      frame["intrinsics"] = {30, 0, 11.5, 0, 0, 30, 8.5, 0, 0, 0, 1, 0, 0, 0, 0, 1};
      frame["w"] = 23;
      frame["h"] = 17;
    }
  });
  expect_read([&](json& j) {
    for (json& frame : j["frames"]) {
      json flat = json::array();
      for (const json& row : frame["transform_matrix"])
        for (const json& value : row) flat.push_back(value);
      frame["transform_matrix"] = flat;
    }
  });
  expect_read([](json&) {}, "\xef\xbb\xbf");
  json skewed = transforms();
  skewed["K"] = {{30, 2, 11.5}, {0, 30, 8.5}, {0, 0, 1}};
  write("transforms.json", skewed.dump());
  expect_bad(".", "skew");
}

TEST_F(StatedCameras, PosesBoundsShowAKnownPointInItsPixelAndStateTheRange) {
  save_pictures("images/");
  write("poses_bounds.npy", npy(llff_rows()));
  const LightField light_field = open_light_field(folder);
  expect_points_in_their_pixels(light_field);
  expect_points_in_their_pixels(open_light_field(folder / "poses_bounds.npy"));
  // 4 … 8, a fifth of 1/4 - 1/8 more on both sides.
  ASSERT_TRUE(light_field.cameras[2].inverse_depth);
  EXPECT_NEAR(light_field.cameras[2].inverse_depth->min, 0.1, 1e-12);
  EXPECT_NEAR(light_field.cameras[2].inverse_depth->max, 0.275, 1e-12);
}

TEST_F(StatedCameras, AModelOfColmapWinsOverPosesBounds) {
  save_pictures("images/");
  write("poses_bounds.npy", npy(llff_rows()));
  write_colmap_model(folder / "sparse/0", model, ColmapFormat::kBinary);
  EXPECT_EQ(open_light_field(folder).format, "COLMAP workspace");
  EXPECT_EQ(open_light_field(folder / "poses_bounds.npy").format, "LLFF poses_bounds.npy");
}

TEST_F(StatedCameras, DamagedPosesBoundsAreOneLine) {
  save_pictures("images/");
  const auto expect_named = [&](const std::string& bytes, const std::string& word) {
    write("poses_bounds.npy", bytes);
    expect_bad(".", word);
  };
  const std::vector<double> rows = llff_rows();
  expect_named(npy(rows).substr(0, 300), "cut short");
  expect_named(npy(std::vector<double>(rows.begin(), rows.begin() + 34)), "3 pictures");
  expect_named(npy(std::vector<double>(48, 1.0), 16), "not 17");
  std::vector<double> changed = rows;
  changed[17] = std::nan("");
  write("poses_bounds.npy", npy(changed));
  OpenOptions strict;
  strict.strict = true;
  expect_bad_input("row 1", strict);
  changed = rows;
  changed[17] = 0.5;
  expect_named(npy(changed), "rotation");
  changed = rows;
  changed[4] = -17;
  expect_named(npy(changed), "size");
  changed = rows;
  changed[14] = 0;
  expect_named(npy(changed), "row 0");
}

TEST_F(StatedCameras, MiddleburyParShowsAKnownPointInItsPixel) {
  save_pictures("");
  save("other.png");  // not in the list
  write("scene_par.txt", par());
  expect_points_in_their_pixels(open_light_field(folder));
  expect_points_in_their_pixels(open_light_field(folder / "scene_par.txt"));
  EXPECT_FALSE(open_light_field(folder).cameras[0].inverse_depth);
  write("scene2_par.txt", par());
  expect_bad(".", "name one of them");
  // They don't stand in the way of what tells more.
  write_colmap_model(folder / "sparse/0", model, ColmapFormat::kText);
  EXPECT_EQ(open_light_field(folder).format, "COLMAP workspace");
}

TEST_F(StatedCameras, DamagedMiddleburyParIsOneLine) {
  save_pictures("");
  const auto expect_named = [&](const std::string& text, const std::string& word) {
    write("scene_par.txt", text);
    expect_bad(".", word);
  };
  const std::string good = par();
  expect_named("", "empty");
  expect_named("three\n", "scene_par.txt:1");
  expect_named(good.substr(0, good.rfind("v2.png")), "cut short");
  expect_named(good.substr(0, good.size() - 30), "scene_par.txt:4");
  std::string changed = good;
  changed.replace(changed.find(" 30 0 11"), 8, " 30 9 11");
  expect_named(changed, "its K");
  changed = good;
  changed.replace(changed.find(" 30 0 11"), 8, " 30 0 nan");
  expect_named(changed, "'nan'");
  changed = good;
  changed.replace(changed.find("v1.png"), 6, "v9.png");
  write("scene_par.txt", changed);
  OpenOptions strict;
  strict.strict = true;
  expect_bad_input("v9.png", strict);
}

TEST_F(StatedCameras, StrechaCamerasShowAKnownPointInItsPixel) {
  save_pictures("images/");
  write_strecha("cameras/");
  expect_points_in_their_pixels(open_light_field(folder / "cameras"));
  write_strecha("images/");
  expect_points_in_their_pixels(open_light_field(folder / "images"));
}

TEST_F(StatedCameras, DamagedStrechaCameraIsOneLine) {
  save_pictures("c/");
  write_strecha("c/");
  const std::string good = strecha(model.images[1]);
  const auto expect_named = [&](const std::string& text, const std::string& word) {
    write("c/v1.png.camera", text);
    expect_bad("c", "v1.png.camera", word);
  };
  expect_named("", "0 numbers");
  expect_named(good.substr(0, good.size() - 4), "25");
  std::string changed = good;
  changed.replace(changed.find("0 0 0\n"), 5, "0.1 0 0");
  expect_named(changed, "distortion");
  changed = good;
  changed.replace(changed.find("23 17"), 5, "23 -1");
  expect_named(changed, "size");
  changed = good;
  changed.replace(0, 2, "x0");
  expect_named(changed, "'x0'");
}

TEST_F(StatedCameras, PlainPicturesBelowImagesArePhotographs) {
  save_pictures("images/");
  EXPECT_EQ(folder_of_photographs(folder), folder / "images");
  EXPECT_EQ(folder_of_photographs(folder / "images"), folder / "images");
  write("transforms.json", transforms().dump());
  EXPECT_EQ(folder_of_photographs(folder), folder);
}

}  // namespace
}  // namespace gigaray
