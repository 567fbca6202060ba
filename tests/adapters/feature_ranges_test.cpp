// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Ranges of depths from features that posed views share.
#include "gigaray/adapters/feature_ranges.h"

#include "adapters/adapters_test.h"
#include "adapters/textured_planes.h"
#include "gigaray/core/light_field.h"

namespace gigaray {
namespace {

/// Planes at z = 4, 5.5 and 7 from cameras at z = 0 … 0.25: inverse depths of about 0.14 … 0.27.
class FeatureRanges : public testing::Test {
 protected:
  static constexpr double kNear = 0.25, kFar = 1 / 7.3;

  FeatureRanges() {
    control.on_message = [this](const std::string& text) { messages.push_back(text); };
  }

  static Image<std::uint16_t> rgb(const cv::Mat& picture) {
    Image<std::uint16_t> image(picture.cols, picture.rows, 3);
    for (int v = 0; v < picture.rows; ++v)
      for (int u = 0; u < picture.cols; ++u)
        for (int c = 0; c < 3; ++c) image(u, v, c) = picture.at<cv::Vec3b>(v, u)[2 - c];
    return image;
  }
  static LightField field_of(const std::vector<Camera>& cameras,
                             const std::vector<cv::Mat>& pictures) {
    LightField field;
    field.kind = LightFieldKind::kUnstructured;
    field.width = cameras.front().width;
    field.height = cameras.front().height;
    field.cameras = cameras;
    std::vector<Image<std::uint16_t>> all;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      field.views.push_back({"v" + std::to_string(i), 0, 0});
      all.push_back(rgb(pictures[i]));
    }
    field.pixels = pixels_in_memory(std::move(all), 8);
    place_by_cameras(field);
    return field;
  }
  static std::vector<cv::Mat> photograph(const std::vector<Camera>& cameras) {
    std::vector<cv::Mat> pictures;
    for (const Camera& camera : cameras) pictures.push_back(textured_planes(camera));
    return pictures;
  }
  /// Holds all planes, and little more.
  static void expect_tight(const std::optional<InverseDepthRange>& range, const std::string& view) {
    ASSERT_TRUE(range) << view;
    EXPECT_LE(range->min, kFar) << view;
    EXPECT_GE(range->max, kNear) << view;
    EXPECT_GT(range->min, kFar / 1.6) << view;
    EXPECT_LT(range->max, kNear * 1.3) << view;
  }

  RunControl control;
  std::vector<std::string> messages;
};

TEST_F(FeatureRanges, HoldAllThatIsSeenAndLittleMore) {
  for (const int count : {2, 3, 7}) {
    const std::vector<Camera> cameras = cameras_before_planes(count);
    LightField field = field_of(cameras, photograph(cameras));
    messages.clear();
    take_range_of_features(field, control);
    for (const Camera& camera : field.cameras)
      expect_tight(camera.inverse_depth, std::to_string(count));
    ASSERT_EQ(messages.size(), 1u);
    EXPECT_NE(messages[0].find("features"), std::string::npos) << messages[0];
  }
}

TEST_F(FeatureRanges, ABareViewTakesWhatItsNeighboursSeeAndAStrayOneThatOfAll) {
  std::vector<Camera> cameras = cameras_before_planes(7);
  std::vector<cv::Mat> pictures = photograph(cameras);
  pictures[2] = cv::Mat(300, 400, CV_8UC3, cv::Scalar::all(128));
  // Something else, and the camera looks away.
  cv::flip(pictures[5], pictures[5], 0);
  cameras[5].rotation = Eigen::AngleAxisd(2.5, Eigen::Vector3d::UnitY()) * cameras[5].rotation;
  LightField field = field_of(cameras, pictures);
  take_range_of_features(field, control);
  for (int i = 0; i < 7; ++i) expect_tight(field.cameras[i].inverse_depth, std::to_string(i));
}

TEST_F(FeatureRanges, PosesOffByTwoPixelsDoNoHarm) {
  std::vector<Camera> cameras = cameras_before_planes(7);
  const std::vector<cv::Mat> pictures = photograph(cameras);
  for (int i = 0; i < 7; ++i)
    cameras[i].rotation =
        Eigen::AngleAxisd(2.0 / 380 * (i % 2 ? 1 : -1) / 2, Eigen::Vector3d::UnitX()) *
        cameras[i].rotation;
  LightField field = field_of(cameras, pictures);
  take_range_of_features(field, control);
  for (int i = 0; i < 7; ++i) expect_tight(field.cameras[i].inverse_depth, std::to_string(i));
}

TEST_F(FeatureRanges, WhatIsStatedStays) {
  const std::vector<Camera> cameras = cameras_before_planes(4);
  LightField field = field_of(cameras, photograph(cameras));
  field.cameras[1].inverse_depth = InverseDepthRange{0.01, 0.9};
  take_range_of_features(field, control);
  EXPECT_EQ(field.cameras[1].inverse_depth, (InverseDepthRange{0.01, 0.9}));
  expect_tight(field.cameras[0].inverse_depth, "0");
  for (Camera& camera : field.cameras) camera.inverse_depth = InverseDepthRange{0.01, 0.9};
  messages.clear();
  take_range_of_features(field, control);
  EXPECT_TRUE(messages.empty());
}

TEST_F(FeatureRanges, PicturesOfNothingInCommonAreLeftToTheEngine) {
  const std::vector<Camera> cameras = cameras_before_planes(3);
  std::vector<cv::Mat> pictures = photograph(cameras);
  cv::flip(pictures[1], pictures[1], 0);
  pictures[2] = cv::Mat(300, 400, CV_8UC3, cv::Scalar::all(128));
  LightField field = field_of(cameras, pictures);
  take_range_of_features(field, control);
  for (const Camera& camera : field.cameras) EXPECT_FALSE(camera.inverse_depth);
  EXPECT_TRUE(messages.empty());
}

TEST_F(FeatureRanges, CanBeCancelled) {
  const std::vector<Camera> cameras = cameras_before_planes(3);
  LightField field = field_of(cameras, photograph(cameras));
  control.cancel();
  testing_support::expect_error(ErrorCode::kCancelled, {},
                                [&] { take_range_of_features(field, control); });
}

}  // namespace
}  // namespace gigaray
