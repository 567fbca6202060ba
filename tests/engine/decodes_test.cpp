// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// A run decodes each picture once, whoever looks at it.
#include <gtest/gtest.h>

#include "gigaray/core/smoothing.h"
#include "gigaray/engine/reconstruct.h"
#include "support/analytic_field.h"
#include "support/counting_pixels.h"
#include "support/posed_field.h"

namespace gigaray::testing_support {
namespace {

const BackendChoice kReference{"reference", ""};

void expect_one_read_each(LightField light_field, const DepthOptions& options,
                          const std::string& what) {
  const RunControl control;
  const FloatMap plain =
      reconstruct(light_field, options, kReference, control).view(options.views.at(0)).disparity;
  const auto reads = count_reads(light_field);
  const FloatMap counted =
      reconstruct(light_field, options, kReference, control).view(options.views.at(0)).disparity;
  for (int view = 0; view < light_field.num_views(); ++view)
    EXPECT_EQ(reads->count(view), 1) << what << ", view " << view;
  ASSERT_EQ(plain.size(), counted.size());
  for (std::size_t i = 0; i < plain.size(); ++i)
    EXPECT_TRUE(plain.data()[i] == counted.data()[i] ||
                (std::isnan(plain.data()[i]) && std::isnan(counted.data()[i])))
        << what;
}

DepthOptions options_for(int view) {
  DepthOptions options = auto_options();
  options.hypotheses = 12;
  options.views = {view};
  return options;
}

TEST(Decodes, OfARowWhoseRangeAndNoiseAreEstimated) {
  expect_one_read_each(
      analytic_field(73, 45, row_of_views(11), {{0.4, 3}, Layer{1.7, 7}}).light_field,
      options_for(5), "row");
}

TEST(Decodes, OfAGrid) {
  expect_one_read_each(
      analytic_field(61, 49, grid_of_views(5, 5), {{-0.6, 3}, Layer{0.9, 7}}).light_field,
      options_for(12), "grid");
}

TEST(Decodes, OfPosedCamerasWithoutARange) {
  const std::vector<View> views = row_of_views(5);
  LightField light_field = posed_field(cameras_around(views, 90, 70), views).light_field;
  for (Camera& camera : light_field.cameras) camera.inverse_depth.reset();
  expect_one_read_each(light_field, options_for(2), "posed");
}

TEST(Decodes, OfNoisyPicturesThatAreSmoothed) {
  LightField light_field =
      analytic_field(61, 45, row_of_views(9), {{0.4, 3}, Layer{1.7, 7}}).light_field;
  std::vector<Image<std::uint16_t>> pictures;
  unsigned random = 1;
  for (int view = 0; view < light_field.num_views(); ++view) {
    pictures.push_back(light_field.pixels->read(view));
    for (std::uint16_t& value : pictures.back()) {
      random = random * 1664525u + 1013904223u;
      value = std::uint16_t(std::clamp(int(value) + int(random >> 24) % 61 - 30, 0, 255));
    }
  }
  light_field.pixels = pixels_in_memory(pictures, 8);
  DepthOptions options = options_for(4);
  options.disparity = DisparityRange{-0.5, 3};
  bool is_smoothed = false;
  RunControl control;
  control.on_message = [&](const std::string& text) {
    is_smoothed = is_smoothed || text.find("smoothed") != std::string::npos;
  };
  reconstruct(light_field, options, kReference, control);
  EXPECT_TRUE(is_smoothed) << "or this tests nothing";
  expect_one_read_each(light_field, options, "noisy");
}

}  // namespace
}  // namespace gigaray::testing_support
