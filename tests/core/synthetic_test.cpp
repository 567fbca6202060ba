// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/synthetic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <thread>

namespace gigaray {
namespace {

/// A float near the ends of the range and the closed forms behind it round to about this.
constexpr double kRounding = 1e-5;

SyntheticOptions small(const std::string& scene) {
  SyntheticOptions options;
  options.scene = scene;
  options.width = 93;
  options.height = 71;
  options.views_s = 5;
  options.samples = 2;
  return options;
}

SyntheticLightField render(const SyntheticOptions& options) {
  return render_synthetic(options, RunControl());
}

Image<std::uint16_t> picture(const SyntheticLightField& field, int view_idx) {
  return field.light_field.pixels->read(view_idx);
}

bool same_pictures(const SyntheticLightField& a, const SyntheticLightField& b) {
  for (int i = 0; i < a.light_field.num_views(); ++i)
    if (picture(a, i) != picture(b, i)) return false;
  return true;
}

float bilinear(const Image<std::uint16_t>& image, double u, double v, int c) {
  const int iu = int(std::floor(u)), iv = int(std::floor(v));
  const double ku = u - iu, kv = v - iv;
  return float((1 - kv) * ((1 - ku) * image(iu, iv, c) + ku * image(iu + 1, iv, c)) +
               kv * ((1 - ku) * image(iu, iv + 1, c) + ku * image(iu + 1, iv + 1, c)));
}

/// How well the pixels of one view are found again in another, over those that both see.
struct Agreement {
  double share_alike = 0;  ///< with a colour distance below the tolerance
  double mean_distance = 0;
  long visible = 0;
};

/// Follows every pixel by its disparity (times `sign`, 1 is right) from view a to view b.
Agreement follow(const SyntheticLightField& field, int a, int b, double tolerance,
                 double sign = 1) {
  const View &from = field.light_field.views[a], &to = field.light_field.views[b];
  const auto picture_a = picture(field, a), picture_b = picture(field, b);
  const FloatMap &truth_a = field.disparity[a], &truth_b = field.disparity[b];
  const double top = (1 << field.light_field.pixels->bit_depth()) - 1;
  Agreement result;
  long alike = 0;
  for (int v = 1; v < truth_a.height() - 1; ++v) {
    for (int u = 1; u < truth_a.width() - 1; ++u) {
      const double d = truth_a(u, v);
      const double u_b = u + sign * (from.s - to.s) * d, v_b = v + sign * (from.t - to.t) * d;
      if (u_b < 0 || v_b < 0 || u_b >= truth_a.width() - 1 || v_b >= truth_a.height() - 1) continue;
      // Both views see one smooth surface there: the disparities around agree.
      bool both = true;
      for (int dv = -1; dv <= 1; ++dv)
        for (int du = -1; du <= 1; ++du) both = both && std::abs(truth_a(u + du, v + dv) - d) < 0.1;
      for (int dv = 0; dv <= 1 && sign == 1; ++dv)
        for (int du = 0; du <= 1; ++du)
          both = both && std::abs(truth_b(int(u_b) + du, int(v_b) + dv) - d) < 0.1;
      if (!both) continue;
      double square = 0;
      for (int c = 0; c < 3; ++c) {
        const double e = (picture_a(u, v, c) - bilinear(picture_b, u_b, v_b, c)) / top;
        square += e * e;
      }
      ++result.visible;
      alike += std::sqrt(square) < tolerance;
      result.mean_distance += std::sqrt(square);
    }
  }
  result.share_alike = double(alike) / double(result.visible);
  result.mean_distance /= double(result.visible);
  return result;
}

class SyntheticScenes : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, SyntheticScenes, testing::ValuesIn(synthetic_scene_names()),
                         [](const auto& info) { return info.param; });

TEST_P(SyntheticScenes, EveryViewReachesTheDeclaredRangeAndStaysInside) {
  for (const DisparityRange range : {DisparityRange{-1, 1}, DisparityRange{0, 1.7},
                                     DisparityRange{2.5, 3}, DisparityRange{-4, -1}}) {
    SyntheticOptions options = small(GetParam());
    options.disparity = range;
    options.samples = 1;
    const SyntheticLightField field = render(options);
    for (const FloatMap& map : field.disparity) {
      const auto [low, high] = std::minmax_element(map.begin(), map.end());
      EXPECT_GE(*low, range.min - kRounding);
      EXPECT_LE(*high, range.max + kRounding);
      // A ball's foremost point may lie between pixel centres.
      EXPECT_NEAR(*low, range.min, kRounding);
      EXPECT_NEAR(*high, range.max, 1e-3 * (range.max - range.min));
    }
  }
}

TEST_P(SyntheticScenes, AVisiblePointHasTheSameColourInAnotherView) {
  SyntheticOptions options = small(GetParam());
  options.width = 201;
  options.height = 151;
  options.views_t = 3;
  options.bit_depth = 16;
  const SyntheticLightField field = render(options);
  const int centre = centre_view(field.light_field);
  // Bilinear interpolation of a texture with wavelengths down to three pixels costs some contrast.
  constexpr double kTolerance = 0.15;
  for (const int other : {0, centre + 1, field.light_field.num_views() - 1}) {
    const Agreement agreement = follow(field, centre, other, kTolerance);
    EXPECT_GT(agreement.visible, 0.5 * options.width * options.height);
    EXPECT_GE(agreement.share_alike, 0.95) << "view " << other;
    EXPECT_LT(agreement.mean_distance,
              0.5 * follow(field, centre, other, kTolerance, -1).mean_distance);
  }
}

TEST_P(SyntheticScenes, TheCentreViewDoesNotDependOnTheRig) {
  SyntheticOptions options = small(GetParam());
  const SyntheticLightField row = render(options);
  options.views_s = 3;
  options.views_t = 3;
  const SyntheticLightField grid = render(options);
  const int in_row = centre_view(row.light_field), in_grid = centre_view(grid.light_field);
  EXPECT_EQ(row.light_field.kind, LightFieldKind::k3D);
  EXPECT_EQ(grid.light_field.kind, LightFieldKind::k4D);
  EXPECT_EQ(picture(row, in_row), picture(grid, in_grid));
  EXPECT_EQ(row.disparity[in_row], grid.disparity[in_grid]);
}

TEST_P(SyntheticScenes, TheSameSeedGivesTheSamePixelsAndAnotherSeedOthers) {
  SyntheticOptions options = small(GetParam());
  options.noise = 0.01;
  options.outliers = 0.4;
  const SyntheticLightField first = render(options), second = render(options);
  EXPECT_TRUE(same_pictures(first, second));
  EXPECT_EQ(first.disparity, second.disparity);
  options.seed = 2;
  EXPECT_FALSE(same_pictures(first, render(options)));
}

TEST(Synthetic, ThePixelsAreTheSameOnEveryMachine) {
  SyntheticOptions options = small("garden");
  options.noise = 0.02;
  options.outliers = 0.4;
  const SyntheticLightField field = render(options);
  std::uint64_t digest = 0xcbf29ce484222325u;  // FNV-1a
  for (int i = 0; i < field.light_field.num_views(); ++i)
    for (const std::uint16_t value : picture(field, i)) digest = (digest ^ value) * 0x100000001b3u;
  EXPECT_EQ(digest, 2963109516144871639u)
      << "changes whenever the scene does; then state the new value";
}

TEST(Synthetic, ASlantedPlaneHasAffineDisparityInEveryView) {
  SyntheticOptions options = small("wall");
  options.width = 121;
  options.views_t = 3;
  const SyntheticLightField field = render(options);
  for (const FloatMap& map : field.disparity) {
    const int u = options.width - 2;  // right of everything that stands on the floor
    const int v0 = options.height - 2;
    const double d0 = map(u, v0), step = d0 - map(u, v0 - 1);
    EXPECT_GT(step, 0);
    for (int k = 0; k < 8; ++k) EXPECT_NEAR(map(u, v0 - k), d0 - k * step, kRounding);
  }
}

TEST(Synthetic, DisparityOfAPointIsTheSameInEveryViewThatSeesIt) {
  const SyntheticOptions options = small("sphere");
  const SyntheticLightField field = render(options);
  const FloatMap &centre = field.disparity[2], &next = field.disparity[3];
  for (int v = 0; v < options.height; ++v) {
    // The floor is constant along u, so its disparity is too, wherever a view looks.
    EXPECT_NEAR(centre(options.width - 1, v), next(options.width - 1, v), kRounding);
  }
}

TEST(Synthetic, TheHighlightMovesAgainstTheSurface) {
  SyntheticOptions options = small("specular");
  options.width = 201;
  options.height = 151;
  options.views_s = 9;
  const SyntheticLightField field = render(options);
  const auto brightest_u = [&](int view_idx) {
    const auto image = picture(field, view_idx);
    double sum = 0, weight = 0;
    for (int v = 20; v < 110; ++v)
      for (int u = 0; u < 120; ++u)
        if (image(u, v, 0) > 225 && image(u, v, 2) > 225) sum += u, ++weight;
    return sum / weight;
  };
  const double moved = brightest_u(8) - brightest_u(0);
  const double surface = 8 * field.disparity[4](76, 70);
  EXPECT_GT(std::abs(moved - surface), 5);
}

TEST(Synthetic, AnUntexturedWallIsFlat) {
  const SyntheticLightField field = render(small("wall"));
  const auto image = picture(field, 2);
  for (int u = 20; u < 60; ++u)
    for (int c = 0; c < 3; ++c) EXPECT_EQ(image(u, 1, c), image(20, 1, c));
}

TEST(Synthetic, TheLeftPlasterWallIsFlatAndTheRightOneAlmost) {
  SyntheticOptions options = small("plaster");
  options.width = 201;
  options.height = 151;
  const SyntheticLightField field = render(options);
  const auto image = picture(field, 2);
  const FloatMap& truth = field.disparity[2];
  int low = 255, high = 0;
  for (int u = 2; u < 60; ++u) {
    for (int c = 0; c < 3; ++c) EXPECT_EQ(image(u, 10, c), image(2, 10, c));
    EXPECT_GT(truth(u, 10), truth(u + 1, 10)) << "it slopes";
    low = std::min<int>(low, image(200 - u, 10, 1));
    high = std::max<int>(high, image(200 - u, 10, 1));
  }
  EXPECT_GE(high - low, 1);
  EXPECT_LE(high - low, 4);
}

TEST(Synthetic, SilhouettesDifferInDisparityAndNotInTone) {
  SyntheticOptions options = small("silhouettes");
  options.width = 201;
  options.height = 151;
  const SyntheticLightField field = render(options);
  const auto image = picture(field, 2);
  const FloatMap& truth = field.disparity[2];
  double tone[2] = {0, 0}, count[2] = {0, 0};
  for (int v = 0; v < options.height; ++v) {
    for (int u = 0; u < options.width; ++u) {
      const bool is_near = truth(u, v) > options.disparity.min + 0.2;
      tone[is_near] += image(u, v, 1);
      ++count[is_near];
    }
  }
  EXPECT_GT(count[1], 0.2 * count[0]);
  EXPECT_NEAR(tone[1] / count[1], tone[0] / count[0], 5) << "of 255";
}

TEST(Synthetic, WedgesHaveOneDisparityAndTipsBelowAPixel) {
  SyntheticOptions options = small("wedges");
  options.width = 201;
  options.height = 151;
  const SyntheticLightField field = render(options);
  const FloatMap& truth = field.disparity[2];
  // Width of the nearest wedge, the first that hangs from the upper rim, by row.
  const auto width_in_row = [&](int v) {
    int width = 0;
    for (int u = 0; u < options.width; ++u)
      width += std::abs(truth(u, v) - options.disparity.max) < kRounding;
    return width;
  };
  EXPECT_GE(width_in_row(0), 10);
  for (int v = 1; v < options.height; ++v) EXPECT_LE(width_in_row(v), width_in_row(v - 1) + 1);
  const int tip = int(0.86 * options.height);
  EXPECT_LE(width_in_row(tip - 3), 1);
  EXPECT_EQ(width_in_row(tip + 1), 0);
}

TEST(Synthetic, NoiseHasTheStatedDeviation) {
  SyntheticOptions options = small("wall");
  options.bit_depth = 16;
  const SyntheticLightField clean = render(options);
  options.noise = 0.03;
  const SyntheticLightField noisy = render(options);
  double sum = 0, squares = 0, product = 0;
  long count = 0;
  const auto noisy_0 = picture(noisy, 0), clean_0 = picture(clean, 0);
  const auto noisy_1 = picture(noisy, 1), clean_1 = picture(clean, 1);
  for (std::size_t i = 0; i < noisy_0.size(); ++i) {
    if (clean_0.data()[i] < 8000 || clean_0.data()[i] > 57000) continue;  // might be clipped
    const double e = (double(noisy_0.data()[i]) - clean_0.data()[i]) / 65535;
    sum += e;
    squares += e * e;
    product += e * (double(noisy_1.data()[i]) - clean_1.data()[i]) / 65535;
    ++count;
  }
  // Ten standard errors of each figure.
  const double limit = 10 * options.noise / std::sqrt(double(count));
  EXPECT_NEAR(sum / count, 0, limit);
  EXPECT_NEAR(std::sqrt(squares / count), options.noise, limit);
  EXPECT_NEAR(product / count, 0, limit * options.noise) << "noise of two views is correlated";
  EXPECT_EQ(clean.disparity, noisy.disparity);
}

TEST(Synthetic, OutliersCoverPartOfTheStatedShareOfViewsAndNotTheTruth) {
  SyntheticOptions options = small("rods");
  options.views_s = 20;
  const SyntheticLightField clean = render(options);
  options.outliers = 0.25;
  const SyntheticLightField walked = render(options);
  int changed_views = 0;
  for (int i = 0; i < 20; ++i) {
    const auto a = picture(clean, i), b = picture(walked, i);
    long changed = 0;
    for (std::size_t k = 0; k < a.size(); k += 3) changed += a.data()[k] != b.data()[k];
    changed_views += changed > 0;
    EXPECT_LT(changed, long(0.3 * options.width * options.height));
    EXPECT_TRUE(changed == 0 || changed > long(0.01 * options.width * options.height)) << changed;
  }
  EXPECT_EQ(changed_views, 5);
  EXPECT_EQ(clean.disparity, walked.disparity);
}

TEST(Synthetic, SixteenBitsRefineEight) {
  SyntheticOptions options = small("planes");
  const SyntheticLightField coarse = render(options);
  options.bit_depth = 16;
  const SyntheticLightField fine = render(options);
  EXPECT_EQ(fine.light_field.pixels->bit_depth(), 16);
  const auto a = picture(coarse, 1), b = picture(fine, 1);
  for (std::size_t i = 0; i < a.size(); ++i)
    EXPECT_NEAR(a.data()[i] / 255.0, b.data()[i] / 65535.0, 0.51 / 255);
}

TEST(Synthetic, DescribesWhatItRenders) {
  SyntheticOptions options = small("garden");
  options.views_s = 4;
  options.views_t = 3;
  const LightField light_field = render(options).light_field;
  check(light_field);
  ASSERT_EQ(light_field.num_views(), 12);
  EXPECT_EQ(light_field.views[5].name, "view_01_01");
  // The camera goes right and down as the numbers rise.
  EXPECT_EQ(light_field.views[5].s, -0.5);
  EXPECT_EQ(light_field.views[5].t, 0);
  EXPECT_EQ(light_field.declared_range, options.disparity);
  // The nearest surface stands at one metre, the farthest at two and a half.
  const RigGeometry& rig = light_field.rig;
  const double strength = *rig.focal_px * *rig.baseline;
  EXPECT_NEAR(strength / (options.disparity.max + strength / *rig.focus_distance), 1, 1e-12);
  EXPECT_NEAR(strength / (options.disparity.min + strength / *rig.focus_distance), 2.5, 1e-12);
}

TEST(Synthetic, ProgressIsToldOncePerViewOnTheCallersThread) {
  RunControl control;
  std::vector<double> told;
  const auto caller = std::this_thread::get_id();
  control.on_progress = [&](const std::string&, double done, double total) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    EXPECT_EQ(total, 5);
    told.push_back(done);
  };
  render_synthetic(small("planes"), control);
  EXPECT_EQ(told, (std::vector<double>{0, 1, 2, 3, 4, 5}));
}

TEST(Synthetic, CancelStopsTheRun) {
  RunControl control;
  control.on_progress = [&](const std::string&, double done, double) {
    if (done == 1) control.cancel();
  };
  SyntheticOptions options = small("garden");
  options.views_s = 200;
  std::atomic<int> rendered{0};
  try {
    render_synthetic_views(options, control,
                           [&](int, Image<std::uint16_t>, FloatMap) { ++rendered; });
    FAIL() << "was not stopped";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kCancelled);
  }
  EXPECT_LT(rendered, 200);
}

TEST(Synthetic, AFailingSinkStopsTheRun) {
  const auto fail = [](int, Image<std::uint16_t>, FloatMap) {
    throw Error(ErrorCode::kIo, "disk full");
  };
  EXPECT_THROW(render_synthetic_views(small("planes"), RunControl(), fail), Error);
}

TEST(Synthetic, ABadOptionIsNamedWithItsValue) {
  const auto message = [](auto change) {
    SyntheticOptions options;
    change(options);
    try {
      options.check();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::kInvalidArgument);
      return std::string(error.what());
    }
    return std::string();
  };
  const auto expect = [](const std::string& text, const char* field, const char* value) {
    EXPECT_NE(text.find(field), std::string::npos) << text;
    EXPECT_NE(text.find(value), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos);
  };
  using O = SyntheticOptions;
  EXPECT_EQ(message([](O&) {}), "");
  expect(message([](O& o) { o.scene = "gardn"; }), "scene", "gardn");
  expect(message([](O& o) { o.width = 15; }), "width", "15");
  expect(message([](O& o) { o.height = -3; }), "height", "-3");
  expect(message([](O& o) { o.views_s = 0; }), "views_s", "0");
  expect(message([](O& o) { o.views_t = 0; }), "views_t", "0");
  expect(message([](O& o) { o.views_s = 1; }), "views_s * views_t", "1");
  expect(message([](O& o) { o.disparity = {1, 1}; }), "disparity", "1 1");
  expect(message([](O& o) { o.disparity = {2, -2}; }), "disparity", "2 -2");
  expect(message([](O& o) { o.disparity = {std::nan(""), 1}; }), "disparity", "nan");
  expect(message([](O& o) { o.disparity = {0, 1e6}; }), "disparity", "1e+06");
  expect(message([](O& o) { o.noise = -0.1; }), "noise", "-0.1");
  expect(message([](O& o) { o.noise = std::nan(""); }), "noise", "nan");
  expect(message([](O& o) { o.outliers = 1.5; }), "outliers", "1.5");
  expect(message([](O& o) { o.bit_depth = 12; }), "bit_depth", "12");
  expect(message([](O& o) { o.samples = 0; }), "samples", "0");
}

}  // namespace
}  // namespace gigaray
