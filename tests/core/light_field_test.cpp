// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/light_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace gigaray {
namespace {

LightField field_of(std::vector<View> views) {
  LightField field;
  field.width = 2;
  field.height = 3;
  field.pixels = pixels_in_memory(
      std::vector<Image<std::uint16_t>>(views.size(), Image<std::uint16_t>(2, 3, 3)), 8);
  field.kind = kind_from_positions(views);
  field.views = std::move(views);
  return field;
}

std::string complaint(const LightField& field) {
  try {
    check(field);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kBadInput);
    return error.what();
  }
  return "";
}

TEST(LightField, NormalisedRowIsCentredWithUnitSteps) {
  std::vector<View> views{{"a", 10, 2}, {"b", 14, 2}, {"c", 18, 2}, {"d", 22, 2}};
  EXPECT_DOUBLE_EQ(normalise_positions(views), 4);
  const double expected[] = {-1.5, -0.5, 0.5, 1.5};
  for (int i = 0; i < 4; ++i) {
    EXPECT_DOUBLE_EQ(views[i].s, expected[i]);
    EXPECT_EQ(views[i].t, 0);
  }
}

TEST(LightField, NormalisingUsesTheMedianStepOfAnIncompleteGrid) {
  // A cross with one measured position off and one gap.
  std::vector<View> views{{"w", -6, 0}, {"c", 0, 0.03}, {"e", 3, 0}, {"n", 0, -3}, {"s", 0, 3}};
  EXPECT_NEAR(normalise_positions(views), 3, 0.05);
  double s_min = 1e9, s_max = -1e9;
  for (const View& view : views) s_min = std::min(s_min, view.s), s_max = std::max(s_max, view.s);
  EXPECT_NEAR(s_min, -s_max, 1e-12);
}

TEST(LightField, NormalisingTwiceChangesNothing) {
  std::vector<View> views{{"a", 0.3, 1}, {"b", 1.1, 5}, {"c", 7, 2}, {"d", 4, 4.5}};
  normalise_positions(views);
  const std::vector<View> before = views;
  EXPECT_NEAR(normalise_positions(views), 1, 1e-12);
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_NEAR(views[i].s, before[i].s, 1e-12);
    EXPECT_NEAR(views[i].t, before[i].t, 1e-12);
  }
}

TEST(LightField, PositionsThatAreAllTheSameAreRefused) {
  std::vector<View> views{{"a", 1, 1}, {"b", 1, 1}};
  EXPECT_THROW(normalise_positions(views), Error);
}

TEST(LightField, ViewsAreOrderedFromTheCentre) {
  const LightField field =
      field_of({{"a", 1, 0}, {"b", 0, 1}, {"c", -1, 0}, {"d", 0, 0}, {"e", 1, 1}, {"f", 0, -1}});
  EXPECT_EQ(centre_view(field), 3);
  EXPECT_EQ(views_from_centre(field), (std::vector<int>{3, 2, 5, 1, 0, 4}));
}

TEST(LightField, AnEvenRowBeginsWithTheSmallerPosition) {
  EXPECT_EQ(
      views_from_centre(field_of({{"a", -1.5, 0}, {"b", -0.5, 0}, {"c", 0.5, 0}, {"d", 1.5, 0}})),
      (std::vector<int>{1, 2, 0, 3}));
}

TEST(LightField, KindFollowsFromThePositions) {
  EXPECT_EQ(kind_from_positions({{"a", 0, 2}, {"b", 1, 2}}), LightFieldKind::k3D);
  EXPECT_EQ(kind_from_positions({{"a", 0, 0}, {"b", 0, 1}}), LightFieldKind::k4D);
  EXPECT_STREQ(to_string(LightFieldKind::k4D), "4D");
}

TEST(LightField, CheckAcceptsAWholeOneAndNamesWhatIsWrong) {
  const LightField good = field_of({{"a", 0, 0}, {"b", 1, 0}});
  EXPECT_EQ(complaint(good), "");

  LightField bad = good;
  bad.pixels = nullptr;
  EXPECT_NE(complaint(bad), "");
  bad = good;
  bad.width = 0;
  EXPECT_NE(complaint(bad), "");
  EXPECT_NE(complaint(field_of({{"a", 0, 0}})), "");

  bad = field_of({{"same", 0, 0}, {"same", 1, 0}});
  EXPECT_NE(complaint(bad).find("same"), std::string::npos);
  bad = field_of({{"a", 0, 0}, {"twin", 0, 0}});
  EXPECT_NE(complaint(bad).find("twin"), std::string::npos);
  bad = field_of({{"a", 0, 0}, {"lost", std::numeric_limits<double>::quiet_NaN(), 0}});
  EXPECT_NE(complaint(bad).find("lost"), std::string::npos);
}

TEST(LightField, PicturesInMemoryAreReturnedAsGiven) {
  Image<std::uint16_t> first(2, 3, 3), second(2, 3, 3);
  second(1, 2, 0) = 77;
  const auto pixels = pixels_in_memory({first, second}, 16);
  EXPECT_EQ(pixels->bit_depth(), 16);
  EXPECT_EQ(pixels->read(0), first);
  EXPECT_EQ(pixels->read(1), second);
}

TEST(LightField, AViewOfAnotherSizeIsNamedWhenItIsRead) {
  LightField light_field;
  light_field.width = 7;
  light_field.height = 5;
  light_field.views = {{"left", -0.5, 0}, {"right", 0.5, 0}};
  light_field.pixels =
      pixels_in_memory({Image<std::uint16_t>(7, 5, 3), Image<std::uint16_t>(6, 5, 3)}, 8);
  EXPECT_EQ(read_view(light_field, 0).width(), 7);
  try {
    read_view(light_field, 1);
    FAIL() << "it was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kBadInput);
    EXPECT_STREQ(error.what(), "view right is 6x5, the others are 7x5");
  }
}

}  // namespace
}  // namespace gigaray
