// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <gtest/gtest.h>

#include <numbers>

#include "gigaray/samplers/any_sampler.h"
#include "samplers/sampler_laws.h"
#include "support/analytic_field.h"
#include "support/cameras.h"
#include "support/errors.h"

namespace gigaray::testing_support {

struct EpiRigs {
  using Sampler = EpiSampler;
  static std::vector<Sampler> samplers() {
    return {Sampler(row_of_views(2)), Sampler(row_of_views(9)), Sampler(irregular_row())};
  }
  static HypothesisRange hypotheses() { return {-2.3, 3.1, 55}; }
};

struct GridRigs {
  using Sampler = GridSampler;
  static std::vector<Sampler> samplers() {
    const std::vector<View> cross = {
        {"w", -1, 0}, {"m", 0, 0}, {"e", 1, 0}, {"n", 0, -1}, {"s", 0, 1}};
    return {Sampler(grid_of_views(3, 4)), Sampler(cross), Sampler(irregular_grid()),
            Sampler(irregular_row())};
  }
  static HypothesisRange hypotheses() { return {-2.3, 3.1, 55}; }
};

INSTANTIATE_TYPED_TEST_SUITE_P(Epi, SamplerLaws, EpiRigs);
INSTANTIATE_TYPED_TEST_SUITE_P(Grid, SamplerLaws, GridRigs);

struct UnstructuredRigs {
  using Sampler = UnstructuredSampler;
  static std::vector<Sampler> samplers() {
    return {Sampler(cameras_around(row_of_views(2), 93, 71)),
            Sampler(cameras_around(irregular_grid(), 93, 71)),
            Sampler(cameras_around(grid_of_views(3, 4), 93, 71), 5)};
  }
  static HypothesisRange hypotheses() { return {0, 1, 55}; }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Unstructured, SamplerLaws, UnstructuredRigs);

namespace {

TEST(Samplers, Law3EpiIsGridWhereAllTAreEqual) {
  std::vector<View> views = irregular_row();
  for (View& view : views) view.t = 0.371;
  for (int level = 0; level < 4; ++level) {
    const EpiSampler epi = EpiSampler(views).at_level(level);
    const GridSampler grid = GridSampler(views).at_level(level);
    for (int a = 0; a < epi.num_views(); ++a)
      for (int b = 0; b < epi.num_views(); ++b) {
        const Ray ray{41.0 + a, 7.0 + b, 1.37 - 0.31 * b};
        const auto in_epi = epi.locate(a, b, ray), in_grid = grid.locate(a, b, ray);
        ASSERT_TRUE(in_epi && in_grid);
        EXPECT_EQ(in_epi->u, in_grid->u);
        EXPECT_EQ(in_epi->v, in_grid->v);
        EXPECT_EQ(in_epi->hypothesis, in_grid->hypothesis);
      }
    for (const RowRange rows : {RowRange{0, 1}, RowRange{5, 17}, RowRange{0, 71}})
      EXPECT_EQ(epi.rows_needed(0, rows, EpiRigs::hypotheses(), 71),
                grid.rows_needed(0, rows, EpiRigs::hypotheses(), 71));
  }
}

TEST(Samplers, AWayOfManyRaysIsThatOfEach) {
  for (const UnstructuredSampler& sampler : UnstructuredRigs::samplers())
    for (int a = 0; a < sampler.num_views(); ++a)
      for (int b = 0; b < sampler.num_views(); ++b) {
        const auto way = sampler.way(a, b);
        for (const double h : {-0.1, 0.0, 0.37, 1.2}) {
          const Ray ray{9.0 + a, 33.0 - 2.0 * b, h};
          const auto expected = sampler.locate(a, b, ray), actual = way(ray);
          ASSERT_EQ(actual.has_value(), expected.has_value());
          if (!expected) continue;
          EXPECT_NEAR(actual->u, expected->u, 1e-9);
          EXPECT_NEAR(actual->v, expected->v, 1e-9);
          EXPECT_NEAR(actual->hypothesis, expected->hypothesis, 1e-9);
        }
      }
}

/// Parallel cameras at the positions of views; disparity d is inverse depth d / (focal · step).
std::vector<Camera> rectified_cameras(const std::vector<View>& views, DisparityRange disparity,
                                      double focal, double step) {
  std::vector<Camera> cameras;
  for (const View& view : views) {
    Camera camera;
    camera.width = 93;
    camera.height = 71;
    camera.focal_u = camera.focal_v = focal;
    camera.centre_u = 45.5;
    camera.centre_v = 33.25;
    camera.translation = {-step * view.s, -step * view.t, 0};
    camera.inverse_depth =
        InverseDepthRange{disparity.min / (focal * step), disparity.max / (focal * step)};
    cameras.push_back(camera);
  }
  return cameras;
}

TEST(Samplers, Law3UnstructuredIsGridOnARectifiedRig) {
  const std::vector<View> views = irregular_grid();
  const DisparityRange range{0.2, 3.1};
  const UnstructuredSampler all(rectified_cameras(views, range, 110, 0.04));
  const GridSampler all_in_grid(views);
  for (int level = 0; level < 4; ++level) {
    const auto sampler = all.at_level(level);
    const auto grid = all_in_grid.at_level(level);
    for (int a = 0; a < sampler.num_views(); ++a)
      for (int b = 0; b < sampler.num_views(); ++b)
        for (const double h : {0.0, 0.37, 1.0}) {
          const double u = 9.0 + a, v = 3.0 + b;
          const auto there = sampler.locate(a, b, {u, v, h});
          const double d = range.min + h * (range.max - range.min);
          const auto in_grid = grid.locate(a, b, {u, v, d});
          ASSERT_TRUE(there && in_grid);
          EXPECT_NEAR(there->u, in_grid->u, 1e-9);
          EXPECT_NEAR(there->v, in_grid->v, 1e-9);
          EXPECT_NEAR(there->hypothesis, h, 1e-9);
        }
  }
}

TEST(Samplers, PartnersShareTheSceneUnderSmallAngles) {
  // A ring of cameras that look at its middle, 30 degrees apart.
  std::vector<Camera> ring;
  for (int i = 0; i < 12; ++i) {
    Camera camera = testing_support::centred_camera(93, 71, 100);
    const double angle = i * std::numbers::pi / 6;
    camera.rotation = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
    camera.translation = {0, 0, 10};
    camera.inverse_depth = InverseDepthRange{1.0 / 11, 1.0 / 9};
    ring.push_back(camera);
  }
  EXPECT_EQ(UnstructuredSampler(ring).partners(3), (std::vector<int>{2, 3, 4}));
  EXPECT_EQ(UnstructuredSampler(ring).partners(0), (std::vector<int>{0, 1, 11}));
  EXPECT_EQ(UnstructuredSampler(ring, 1).partners(5).size(), 2u);
}

TEST(Samplers, RowsOfARectifiedRowStayThoseOfTheBandForAnyNumberOfViews) {
  const UnstructuredSampler sampler(rectified_cameras(row_of_views(40), {1, 3}, 100, 0.1));
  ASSERT_GT(sampler.partners(20).size(), 30u);
  const RowRange needed = sampler.rows_needed(20, {30, 35}, {0, 1, 9}, 71);
  EXPECT_GE(needed.begin, 28);  // rounding
  EXPECT_LE(needed.end, 37);
}

TEST(Samplers, UnstructuredSeesNothingBehindACamera) {
  std::vector<Camera> cameras = rectified_cameras(row_of_views(2), {1, 3}, 100, 0.1);
  cameras[1].rotation =
      Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const UnstructuredSampler sampler(cameras);
  EXPECT_FALSE(sampler.locate(0, 1, {40, 30, 0.5}));
  EXPECT_EQ(sampler.rows_needed(0, {3, 5}, {0, 1, 9}, 71), (RowRange{3, 5})) << "no partner";
}

TEST(Samplers, NearPointsMoveLeftWhenTheCameraMovesRight) {
  const GridSampler grid(std::vector<View>{{"left", 0, 0}, {"right", 2, 0}, {"below", 0, 3}});
  const Ray near{50, 20, 1.5};
  EXPECT_EQ(grid.locate(0, 1, near)->u, 50 - 2 * 1.5);
  EXPECT_EQ(grid.locate(0, 1, near)->v, 20);
  EXPECT_EQ(grid.locate(0, 2, near)->v, 20 - 3 * 1.5);
  EXPECT_EQ(EpiSampler(std::vector<View>{{"left", 0, 0}, {"right", 2, 0}}).locate(0, 1, near)->u,
            47);
}

TEST(Samplers, EpiRefusesAViewOffTheLine) {
  std::vector<View> views = row_of_views(3);
  views[2].t = 0.5;
  expect_error(ErrorCode::kBadInput, {"view2", "line"}, [&] { EpiSampler{views}; });
}

TEST(Samplers, TheKindOfTheLightFieldChoosesTheSampler) {
  LightField light_field;
  light_field.views = row_of_views(3);
  EXPECT_TRUE(std::holds_alternative<EpiSampler>(make_sampler(light_field)));
  light_field.kind = LightFieldKind::k4D;
  EXPECT_TRUE(std::holds_alternative<GridSampler>(make_sampler(light_field)));
  light_field.kind = LightFieldKind::kUnstructured;
  light_field.cameras = cameras_around(light_field.views, 93, 71);
  EXPECT_TRUE(std::holds_alternative<UnstructuredSampler>(make_sampler(light_field)));
}

// Compile-fail twins of the concept: each type lacks or bends one member of a sampler.
struct NoLocate {
  static constexpr int kRayTableWidth = 1;
  static constexpr bool kRaysShiftAlike = true;
  static constexpr std::string_view kKernelFile = "x.cl";
  int num_views() const;
  std::vector<int> partners(int) const;
  RowRange rows_needed(int, RowRange, HypothesisRange, int) const;
  std::vector<float> ray_table(int) const;
};
template <class Self>
struct Locates : NoLocate {
  std::optional<Ray> locate(int, int, Ray) const;
  Self at_level(int) const;
  Self subset(const std::vector<int>&) const;
};
struct Complete : Locates<Complete> {};
struct LocateWithoutBehind : Complete {
  Ray locate(int, int, Ray) const;
  LocateWithoutBehind at_level(int) const;
  LocateWithoutBehind subset(const std::vector<int>&) const;
};
struct LevelOfAnotherType : Complete {
  Complete at_level(int) const;
  LevelOfAnotherType subset(const std::vector<int>&) const;
};
struct ChangesWhenAsked : Complete {
  int num_views();
  ChangesWhenAsked at_level(int) const;
  ChangesWhenAsked subset(const std::vector<int>&) const;
};
struct TableOfDoubles : Complete {
  std::vector<double> ray_table(int) const;
  TableOfDoubles at_level(int) const;
  TableOfDoubles subset(const std::vector<int>&) const;
};
struct NoKernelFile : Complete {
  static constexpr int kKernelFile = 7;
  NoKernelFile at_level(int) const;
  NoKernelFile subset(const std::vector<int>&) const;
};
struct CannotBeCopied : Complete {
  CannotBeCopied(const CannotBeCopied&) = delete;
  CannotBeCopied at_level(int) const;
  CannotBeCopied subset(const std::vector<int>&) const;
};
static_assert(RaySampler<Complete>);
static_assert(!RaySampler<int>);
static_assert(!RaySampler<NoLocate>);
static_assert(!RaySampler<LocateWithoutBehind>);
static_assert(!RaySampler<LevelOfAnotherType>);
static_assert(!RaySampler<ChangesWhenAsked>);
static_assert(!RaySampler<TableOfDoubles>);
static_assert(!RaySampler<NoKernelFile>);
static_assert(!RaySampler<CannotBeCopied>);

}  // namespace
}  // namespace gigaray::testing_support
