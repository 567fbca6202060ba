// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>

#include "support/errors.h"

namespace gigaray {
namespace {

using Eigen::Vector2d;
using testing_support::expect_error;

constexpr int kWidth = 641, kHeight = 479;
constexpr double kPixels = 1e-8;  // what double precision leaves at these sizes

Lens lens(const std::string& model, std::vector<double> params) {
  return {model, kWidth, kHeight, std::move(params)};
}

// One of each model, with every distortion parameter in use.
std::vector<Lens> lenses() {
  return {
      lens("SIMPLE_PINHOLE", {500, 322, 238}),
      lens("PINHOLE", {500, 510, 322, 238}),
      lens("SIMPLE_RADIAL", {500, 322, 238, -0.11}),
      lens("RADIAL", {500, 322, 238, -0.2, 0.07}),
      lens("OPENCV", {500, 510, 322, 238, -0.21, 0.06, 0.003, -0.002}),
      lens("OPENCV_FISHEYE", {310, 305, 322, 238, 0.04, -0.01, 0.006, -0.002}),
      lens("FULL_OPENCV", {500, 510, 322, 238, 0.3, -0.2, 0.002, -0.001, 0.05, 0.4, -0.1, 0.03}),
      lens("FOV", {400, 405, 322, 238, 0.9}),
      lens("SIMPLE_RADIAL_FISHEYE", {310, 322, 238, 0.03}),
      lens("RADIAL_FISHEYE", {310, 322, 238, 0.03, -0.01}),
      lens("THIN_PRISM_FISHEYE",
           {310, 305, 322, 238, 0.04, -0.01, 0.002, -0.001, 0.006, -0.002, 0.003, -0.002}),
      lens("RAD_TAN_THIN_PRISM_FISHEYE", {310, 305, 322, 238, 0.04, -0.02, 0.01, -0.004, 0.001,
                                          -0.0002, 0.002, -0.001, 0.003, -0.001, -0.002, 0.001}),
      lens("SIMPLE_DIVISION", {500, 322, 238, -0.2}),
      lens("DIVISION", {500, 510, 322, 238, 0.15}),
      lens("SIMPLE_FISHEYE", {310, 322, 238}),
      lens("FISHEYE", {310, 305, 322, 238}),
      lens("EUCM", {310, 305, 322, 238, 0.6, 1.2})};
}

TEST(Lens, EveryModelOfColmapIsKnownByItsNumber) {
  ASSERT_EQ(lens_models().size(), 17);
  EXPECT_EQ(lens_models()[4], "OPENCV");
  EXPECT_EQ(lens_models()[7], "FOV");
  EXPECT_EQ(lens_models()[11], "RAD_TAN_THIN_PRISM_FISHEYE");
  EXPECT_EQ(lens_models()[13], "DIVISION");
  EXPECT_EQ(lens_models()[16], "EUCM");
  for (std::size_t i = 0; i < lenses().size(); ++i) {
    EXPECT_EQ(lenses()[i].model, lens_models()[i]);
    EXPECT_EQ(int(lenses()[i].params.size()), num_lens_params(lens_models()[i]));
    EXPECT_NO_THROW(check(lenses()[i], "lens"));
  }
  EXPECT_EQ(num_lens_params("ORTHOGRAPHIC"), 0);
}

TEST(Lens, UndistortIsTheInverseOfDistortAllOverThePicture) {
  for (const Lens& one : lenses()) {
    SCOPED_TRACE(one.model);
    const LensMap map(one);
    for (int v = 0; v < kHeight; v += 17)
      for (int u = 0; u < kWidth; u += 23) {
        const Vector2d pixel(u, v);
        const auto direction = map.undistort(pixel);
        ASSERT_TRUE(direction.has_value()) << u << " " << v;
        const auto again = map.distort(*direction);
        ASSERT_TRUE(again.has_value()) << u << " " << v;
        EXPECT_LT((*again - pixel).norm(), kPixels) << u << " " << v;
      }
  }
}

TEST(Lens, PrincipalPointSeesStraightAheadHalfAPixelBeforeColmapsNumber) {
  for (const Lens& one : lenses()) {
    SCOPED_TRACE(one.model);
    EXPECT_LT((distort(one, {0, 0}).value() - Vector2d(321.5, 237.5)).norm(), kPixels);
    EXPECT_LT(undistort(one, {321.5, 237.5}).value().norm(), kPixels);
  }
}

TEST(Lens, PinholeKeepsStraightLines) {
  const Lens one = lens("PINHOLE", {500, 510, 322, 238});
  EXPECT_LT((distort(one, {0.2, -0.1}).value() - Vector2d(421.5, 186.5)).norm(), kPixels);
  EXPECT_TRUE(is_pinhole(one));
  EXPECT_TRUE(is_pinhole(lens("OPENCV", {500, 510, 322, 238, 0, 0, 0, 0})));
  EXPECT_FALSE(is_pinhole(lens("OPENCV", {500, 510, 322, 238, 0, 0, 0, 1e-9})));
  EXPECT_FALSE(is_pinhole(lens("OPENCV_FISHEYE", {500, 510, 322, 238, 0, 0, 0, 0})));
}

TEST(Lens, SimpleRadialScalesByOnePlusKTimesRSquared) {
  const Lens one = lens("SIMPLE_RADIAL", {500, 322, 238, -0.1});
  const Vector2d seen = distort(one, {0.3, 0.4}).value();
  EXPECT_LT((seen - Vector2d(321.5 + 500 * 0.3 * 0.975, 237.5 + 500 * 0.4 * 0.975)).norm(),
            kPixels);
}

TEST(Lens, FieldOfViewModelIsTheArcTangent) {
  const Lens one = lens("FOV", {400, 400, 322, 238, 0.9});
  const Vector2d seen = distort(one, {0.7, 0}).value();
  EXPECT_NEAR(seen.x(), 321.5 + 400 * std::atan(1.4 * std::tan(0.45)) / 0.9, kPixels);
  // 0 is a pinhole, and so is nearly what comes close to it.
  EXPECT_TRUE(is_pinhole(lens("FOV", {400, 400, 322, 238, 0})));
  for (const double omega : {0.0, 1e-12, 1e-5}) {
    const Lens weak = lens("FOV", {400, 400, 322, 238, omega});
    EXPECT_NEAR(distort(weak, {0.5, 0}).value().x(), 521.5, 1e-6) << omega;
    EXPECT_NEAR(undistort(weak, {521.5, 237.5}).value().x(), 0.5, 1e-8) << omega;
  }
}

TEST(Lens, EquidistantFisheyeIsTheAngle) {
  const Lens one = lens("SIMPLE_RADIAL_FISHEYE", {200, 322, 238, 0});
  const Vector2d seen = distort(one, {std::tan(1.2), 0}).value();
  EXPECT_NEAR(seen.x(), 321.5 + 200 * 1.2, kPixels);
}

TEST(Lens, ThinPrismAddsTheSquareOfTheAngle) {
  const Lens one = lens("THIN_PRISM_FISHEYE", {200, 200, 322, 238, 0, 0, 0, 0, 0, 0, 0.01, -0.02});
  const Vector2d seen = distort(one, {0, std::tan(0.5)}).value();
  EXPECT_NEAR(seen.x(), 321.5 + 200 * 0.01 * 0.25, kPixels);
  EXPECT_NEAR(seen.y(), 237.5 + 200 * (0.5 - 0.02 * 0.25), kPixels);
}

TEST(Lens, AriaDistortsWhatIsRadiallyDistortedAlready) {
  const Lens one = lens("RAD_TAN_THIN_PRISM_FISHEYE",
                        {200, 200, 322, 238, 0.1, 0, 0, 0, 0, 0, 0.01, 0, 0, 0, 0, 0.02});
  const double bent = 0.5 * (1 + 0.1 * 0.25);
  const Vector2d seen = distort(one, {std::tan(0.5), 0}).value();
  EXPECT_NEAR(seen.x(), 321.5 + 200 * (bent + 0.01 * 3 * bent * bent), kPixels);
  EXPECT_NEAR(seen.y(), 237.5 + 200 * 0.02 * std::pow(bent, 4), kPixels);
}

TEST(Lens, DivisionDividesWhatIsSeenByOnePlusKTimesRSquared) {
  for (const double k : {-0.3, 0.3}) {
    const Vector2d seen(0.3, 0.4);  // r² = 0.25
    for (const Lens& one :
         {lens("SIMPLE_DIVISION", {500, 322, 238, k}), lens("DIVISION", {500, 500, 322, 238, k})}) {
      const Vector2d direction = undistort(one, {321.5 + 150, 237.5 + 200}).value();
      EXPECT_LT((direction - seen / (1 + 0.25 * k)).norm(), kPixels);
    }
  }
  EXPECT_TRUE(is_pinhole(lens("DIVISION", {500, 510, 322, 238, 0})));
  // Nothing is ahead where the divisor is 0, and the picture folds back at the radius 1 / √k.
  EXPECT_FALSE(undistort(lens("SIMPLE_DIVISION", {100, 322, 238, -0.25}), {321.5 + 201, 237.5}));
  EXPECT_FALSE(undistort(lens("SIMPLE_DIVISION", {100, 322, 238, 0.25}), {321.5 + 201, 237.5}));
  EXPECT_FALSE(distort(lens("SIMPLE_DIVISION", {100, 322, 238, 0.25}), {1.01, 0}));
}

TEST(Lens, FisheyeWithoutParametersIsTheAngle) {
  for (const Lens& one :
       {lens("SIMPLE_FISHEYE", {200, 322, 238}), lens("FISHEYE", {200, 210, 322, 238})})
    EXPECT_NEAR(distort(one, {std::tan(1.2), 0}).value().x(), 321.5 + 200 * 1.2, kPixels);
  EXPECT_FALSE(is_pinhole(lens("FISHEYE", {200, 210, 322, 238})));
}

TEST(Lens, EnhancedUnifiedModelBlendsTheDepthWithADistance) {
  const double alpha = 0.6, beta = 1.2;
  const Lens one = lens("EUCM", {200, 210, 322, 238, alpha, beta});
  // The point (3, -4, 2): its distance is √(β (9 + 16) + 4).
  const double depth = alpha * std::sqrt(beta * 25 + 4) + (1 - alpha) * 2;
  const Vector2d seen = distort(one, {1.5, -2}).value();
  EXPECT_LT((seen - Vector2d(321.5 + 200 * 3 / depth, 237.5 - 210 * 4 / depth)).norm(), kPixels);
  EXPECT_TRUE(is_pinhole(lens("EUCM", {200, 210, 322, 238, 0, 1.2})));
  EXPECT_NEAR(distort(lens("EUCM", {200, 210, 322, 238, 0, 1.2}), {0.5, 0}).value().x(), 421.5,
              kPixels);
}

std::vector<cv::Point3d> directions() {
  std::vector<cv::Point3d> points;
  for (double y = -0.45; y <= 0.45; y += 0.15)
    for (double x = -0.6; x <= 0.6; x += 0.1) points.emplace_back(x, y, 1);
  return points;
}

void expect_same(const Lens& one, const std::vector<cv::Point3d>& points,
                 const std::vector<cv::Point2d>& seen) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto mine = distort(one, {points[i].x, points[i].y});
    ASSERT_TRUE(mine.has_value());
    EXPECT_LT((*mine - Vector2d(seen[i].x, seen[i].y)).norm(), kPixels) << points[i];
  }
}

TEST(Lens, OpenCvModelsAgreeWithOpenCv) {
  const cv::Mat zero = cv::Mat::zeros(3, 1, CV_64F);
  const cv::Matx33d matrix(500, 0, 321.5, 0, 510, 237.5, 0, 0, 1);
  for (const char* model : {"OPENCV", "FULL_OPENCV"}) {
    SCOPED_TRACE(model);
    const Lens one = lenses()[std::string(model) == "OPENCV" ? 4 : 6];
    const std::vector<double> distortion(one.params.begin() + 4, one.params.end());
    std::vector<cv::Point2d> seen;
    cv::projectPoints(directions(), zero, zero, matrix, distortion, seen);
    expect_same(one, directions(), seen);
  }
}

TEST(Lens, FisheyeAgreesWithOpenCv) {
  const cv::Mat zero = cv::Mat::zeros(3, 1, CV_64F);
  const cv::Matx33d matrix(310, 0, 321.5, 0, 305, 237.5, 0, 0, 1);
  const Lens one = lenses()[5];
  const std::vector<double> distortion(one.params.begin() + 4, one.params.end());
  std::vector<cv::Point2d> seen;
  cv::fisheye::projectPoints(directions(), seen, zero, zero, matrix, distortion);
  expect_same(one, directions(), seen);
}

TEST(Lens, NothingIsSeenBeyondWhereTheModelFoldsBack) {
  // r (1 - 0.25 r²) rises up to r = √(4/3) and reaches 0.7698 there.
  const Lens one = lens("SIMPLE_RADIAL", {300, 322, 238, -0.25});
  EXPECT_TRUE(distort(one, {1.15, 0}).has_value());
  EXPECT_FALSE(distort(one, {1.16, 0}).has_value());
  EXPECT_TRUE(undistort(one, {321.5 + 300 * 0.769, 237.5}).has_value());
  EXPECT_FALSE(undistort(one, {321.5 + 300 * 0.770, 237.5}).has_value());
  EXPECT_FALSE(undistort(lens("FOV", {400, 400, 322, 238, 0.9}), {321.5 + 400 * 1.75, 237.5}));
  // A fisheye picture shows more than a plane can.
  const Lens fisheye = lens("SIMPLE_RADIAL_FISHEYE", {100, 322, 238, 0});
  EXPECT_TRUE(undistort(fisheye, {321.5 + 157, 237.5}).has_value());
  EXPECT_FALSE(undistort(fisheye, {321.5 + 158, 237.5}).has_value());
  EXPECT_FALSE(distort(one, {std::nan(""), 0}).has_value());
  EXPECT_FALSE(undistort(one, {std::nan(""), 0}).has_value());
}

TEST(Lens, AbsurdDistortionEndsTheIterationToo) {
  for (const double k : {1e300, -1e300, 1e30, -1e30, 1e-300})
    for (const Lens& one : lenses()) {
      Lens absurd = one;
      for (std::size_t i = one.params.size() - 1; i > 3; --i) {
        absurd.params[i] = i % 2 ? k : -k;
        if (one.model == "FOV") break;
        const LensMap map(absurd);
        for (const Vector2d& pixel : {Vector2d(0, 0), Vector2d(321.5, 237.5), Vector2d(640, 3)})
          if (const auto direction = map.undistort(pixel)) {
            EXPECT_TRUE(direction->allFinite());
          }
      }
    }
}

TEST(Lens, RationalModelEndsAtItsPole) {
  const Lens one = lens("FULL_OPENCV", {300, 300, 322, 238, 0, 0, 0, 0, 0, -0.5, 0, 0});
  EXPECT_TRUE(distort(one, {1.41, 0}).has_value());
  EXPECT_FALSE(distort(one, {1.42, 0}).has_value());
}

TEST(Lens, IsScaledWithItsPicture) {
  const Lens one = lens("OPENCV", {500, 510, 322, 238, -0.21, 0.06, 0.003, -0.002});
  const LensMap half(one, 2 * kWidth, 2 * kHeight);
  const Vector2d direction(0.31, -0.22);
  const Vector2d small = distort(one, direction).value(), large = half.distort(direction).value();
  EXPECT_LT((2 * (small + Vector2d(0.5, 0.5)) - (large + Vector2d(0.5, 0.5))).norm(), kPixels);
}

TEST(Lens, AbsurdOnesAreRefused) {
  const auto refused = [](const Lens& one, const std::string& word) {
    expect_error(ErrorCode::kBadInput, {"camera 3", word}, [&] { check(one, "camera 3"); });
  };
  refused(lens("ORTHOGRAPHIC", {1}), "ORTHOGRAPHIC");
  refused(lens("", {}), "unknown");
  refused(lens("ORTHOGRAPHIC", {1}), "image_undistorter");
  refused(lens("EQUIRECTANGULAR", {640, 480}), "EQUIRECTANGULAR is that of a panorama");
  refused(lens("EUCM", {500, 500, 320, 240, 1.5, 1}), "alpha");
  refused(lens("EUCM", {500, 500, 320, 240, 0.5, 0}), "beta");
  refused(lens("PINHOLE", {500, 500, 320}), "4 parameters");
  refused(lens("PINHOLE", {500, std::nan(""), 320, 240}), "finite");
  refused(lens("PINHOLE", {-500, 500, 320, 240}), "focal length");
  refused(lens("PINHOLE", {500, 0, 320, 240}), "focal length");
  refused(lens("PINHOLE", {500, 1e9, 320, 240}), "focal length");
  refused(lens("PINHOLE", {500, 500, 320, 1e9}), "principal point");
  refused(lens("FOV", {500, 500, 320, 240, 3.2}), "180");
  refused({"PINHOLE", 0, 480, {500, 500, 320, 240}}, "0×480");
  refused({"PINHOLE", 640, 2000000000, {500, 500, 320, 240}}, "640×2000000000");
}

}  // namespace
}  // namespace gigaray
