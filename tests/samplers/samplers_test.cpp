// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <gtest/gtest.h>

#include "gigaray/samplers/any_sampler.h"
#include "samplers/sampler_laws.h"
#include "support/analytic_field.h"
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
      EXPECT_EQ(epi.rows_needed(rows, EpiRigs::hypotheses(), 71),
                grid.rows_needed(rows, EpiRigs::hypotheses(), 71));
  }
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
  expect_error(ErrorCode::kBadInput, {"unstructured"}, [&] { make_sampler(light_field); });
}

// Compile-fail twins of the concept: each type lacks or bends one member of a sampler.
struct NoLocate {
  static constexpr int kViewTableWidth = 1;
  static constexpr std::string_view kKernelFile = "x.cl";
  int num_views() const;
  RowRange rows_needed(RowRange, HypothesisRange, int) const;
  std::vector<float> view_table() const;
};
template <class Self>
struct Locates : NoLocate {
  std::optional<Ray> locate(int, int, Ray) const;
  Self at_level(int) const;
};
struct Complete : Locates<Complete> {};
struct LocateWithoutBehind : Complete {
  Ray locate(int, int, Ray) const;
  LocateWithoutBehind at_level(int) const;
};
struct LevelOfAnotherType : Complete {
  Complete at_level(int) const;
};
struct ChangesWhenAsked : Complete {
  int num_views();
  ChangesWhenAsked at_level(int) const;
};
struct TableOfDoubles : Complete {
  std::vector<double> view_table() const;
  TableOfDoubles at_level(int) const;
};
struct NoKernelFile : Complete {
  static constexpr int kKernelFile = 7;
  NoKernelFile at_level(int) const;
};
struct CannotBeCopied : Complete {
  CannotBeCopied(const CannotBeCopied&) = delete;
  CannotBeCopied at_level(int) const;
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
