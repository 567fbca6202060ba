// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "gigaray/core/ray_sampler.h"

namespace gigaray::testing_support {

/// The laws of ray_sampler.h, for one sampler each:
///
///   struct EpiRigs {
///     using Sampler = EpiSampler;
///     static std::vector<Sampler> samplers();   // some rigs: regular, irregular, two views …
///     static HypothesisRange hypotheses();      // what the rigs can see, both signs if they can
///   };
///   INSTANTIATE_TYPED_TEST_SUITE_P(Epi, SamplerLaws, EpiRigs);
///
/// Law 3 compares samplers (samplers_test.cpp), law 5 needs a device
/// (tests/engine/parity_sampler_twins_test.cpp).
template <class Rigs>
class SamplerLaws : public testing::Test {
 protected:
  static constexpr int kWidth = 93, kHeight = 71, kLevels = 4;
  // Positions of a few hundred px in double precision, twice through a product.
  static constexpr double kTolerance = 1e-9;

  /// Calls visit(sampler, a, b) for all rigs, levels 0 … 3 and pairs of views.
  template <class Visit>
  void for_each_pair(Visit visit) {
    for (const auto& level0 : Rigs::samplers())
      for (int level = 0; level < kLevels; ++level) {
        const auto sampler = level0.at_level(level);
        for (int a = 0; a < sampler.num_views(); ++a)
          for (int b = 0; b < sampler.num_views(); ++b) visit(sampler, a, b);
      }
  }

  /// Odd sizes round up.
  static int size_at(int size, int level) { return (size + (1 << level) - 1) >> level; }
  double uniform(double low, double high) {
    return low + (high - low) * double(random_()) / 4294967295.0;
  }
  Ray random_ray() {
    const HypothesisRange range = Rigs::hypotheses();
    return {uniform(0, kWidth - 1), uniform(0, kHeight - 1), uniform(range.min, range.max)};
  }
  static void expect_same(const Ray& a, const Ray& b) {
    EXPECT_NEAR(a.u, b.u, kTolerance);
    EXPECT_NEAR(a.v, b.v, kTolerance);
    EXPECT_NEAR(a.hypothesis, b.hypothesis, kTolerance);
  }

 private:
  std::mt19937 random_{11};
};

TYPED_TEST_SUITE_P(SamplerLaws);

TYPED_TEST_P(SamplerLaws, Law1AViewSeesItsOwnRayAsItIs) {
  this->for_each_pair([&](const auto& sampler, int a, int) {
    const Ray ray = this->random_ray();
    const auto there = sampler.locate(a, a, ray);
    ASSERT_TRUE(there);
    EXPECT_EQ(there->u, ray.u);
    EXPECT_EQ(there->v, ray.v);
    EXPECT_EQ(there->hypothesis, ray.hypothesis);
  });
}

TYPED_TEST_P(SamplerLaws, Law2ThereAndBackIsTheIdentity) {
  int seen = 0, pairs = 0;
  this->for_each_pair([&](const auto& sampler, int a, int b) {
    ++pairs;
    const Ray ray = this->random_ray();
    const auto there = sampler.locate(a, b, ray);
    if (!there) return;  // behind the other camera
    ++seen;
    const auto back = sampler.locate(b, a, *there);
    ASSERT_TRUE(back);
    this->expect_same(*back, ray);
  });
  EXPECT_GT(2 * seen, pairs) << "the rigs see too little of each other to test anything";
}

TYPED_TEST_P(SamplerLaws, TheWayOverAThirdViewEndsAtTheSamePlace) {
  this->for_each_pair([&](const auto& sampler, int a, int b) {
    const Ray ray = this->random_ray();
    const auto direct = sampler.locate(a, b, ray);
    const auto middle = sampler.locate(a, 0, ray);
    if (!direct || !middle) return;
    const auto end = sampler.locate(0, b, *middle);
    ASSERT_TRUE(end);
    this->expect_same(*end, *direct);
  });
}

TYPED_TEST_P(SamplerLaws, Law4RowsNeededContainEveryRowReached) {
  const HypothesisRange range = TypeParam::hypotheses();
  for (const auto& level0 : TypeParam::samplers())
    for (int level = 0; level < this->kLevels; ++level) {
      const auto sampler = level0.at_level(level);
      const int width = this->size_at(this->kWidth, level);
      const int height = this->size_at(this->kHeight, level);
      const RowRange bands[] = {{0, 1}, {0, height}, {3, 7}, {height - 1, height}};
      for (int a = 0; a < sampler.num_views(); ++a)
        for (const RowRange& band : bands) {
          const RowRange needed = sampler.rows_needed(a, band, range, height);
          EXPECT_GE(needed.begin, 0);
          EXPECT_LE(needed.end, height);
          EXPECT_LE(needed.begin, band.begin);
          EXPECT_GE(needed.end, band.end);
          for (const int b : sampler.partners(a))
            for (const double h : {range.min, range.max, this->random_ray().hypothesis})
              for (const int v : {band.begin, band.end - 1})
                for (const int u : {0, width / 3, width - 1}) {
                  const auto there = sampler.locate(a, b, Ray{double(u), double(v), h});
                  if (!there || there->v < 0 || there->v > height - 1) continue;
                  // Linear interpolation takes the row above and the row below.
                  EXPECT_GE(int(std::floor(there->v)), needed.begin);
                  EXPECT_LT(int(std::ceil(there->v)), needed.end);
                }
        }
    }
}

TYPED_TEST_P(SamplerLaws, MoreRowsNeedNoFewerRows) {
  const HypothesisRange range = TypeParam::hypotheses();
  for (const auto& sampler : TypeParam::samplers())
    for (int begin = 0; begin < this->kHeight; begin += 7) {
      const RowRange small = sampler.rows_needed(0, {begin, begin + 1}, range, this->kHeight);
      const RowRange large =
          sampler.rows_needed(0, {begin, std::min(begin + 9, this->kHeight)}, range, this->kHeight);
      EXPECT_LE(large.begin, small.begin);
      EXPECT_GE(large.end, small.end);
    }
}

TYPED_TEST_P(SamplerLaws, ALevelHalvesPixelsAndKeepsHypotheses) {
  for (const auto& sampler : TypeParam::samplers())
    for (int level = 0; level < this->kLevels; ++level) {
      const auto coarse = sampler.at_level(level);
      EXPECT_EQ(coarse.num_views(), sampler.num_views());
      const double scale = std::ldexp(1.0, -level);
      for (int a = 0; a < sampler.num_views(); ++a)
        for (int b = 0; b < sampler.num_views(); ++b) {
          const Ray ray = this->random_ray();
          const auto fine_there = sampler.locate(a, b, ray);
          const auto there = coarse.locate(a, b, {ray.u * scale, ray.v * scale, ray.hypothesis});
          ASSERT_EQ(there.has_value(), fine_there.has_value());
          if (!there) continue;
          this->expect_same(*there,
                            {fine_there->u * scale, fine_there->v * scale, fine_there->hypothesis});
        }
    }
}

TYPED_TEST_P(SamplerLaws, RayTableHasItsWidthForEveryView) {
  for (const auto& sampler : TypeParam::samplers())
    for (int ref = 0; ref < sampler.num_views(); ++ref)
      EXPECT_EQ(int(sampler.ray_table(ref).size()),
                sampler.num_views() * int(TypeParam::Sampler::kRayTableWidth));
}

TYPED_TEST_P(SamplerLaws, PartnersAreAscendingViewsWithTheReferenceAmongThem) {
  for (const auto& sampler : TypeParam::samplers())
    for (int ref = 0; ref < sampler.num_views(); ++ref) {
      const std::vector<int> partners = sampler.partners(ref);
      EXPECT_TRUE(std::is_sorted(partners.begin(), partners.end()));
      EXPECT_TRUE(std::binary_search(partners.begin(), partners.end(), ref));
      EXPECT_GE(partners.front(), 0);
      EXPECT_LT(partners.back(), sampler.num_views());
    }
}

TYPED_TEST_P(SamplerLaws, ASubsetLocatesRaysAsAllDo) {
  for (const auto& all : TypeParam::samplers()) {
    std::vector<int> chosen;
    for (int view = 0; view < all.num_views(); ++view)
      if (view % 2 == 1 || view == 0) chosen.push_back(view);
    const auto some = all.subset(chosen);
    ASSERT_EQ(some.num_views(), int(chosen.size()));
    for (int a = 0; a < some.num_views(); ++a)
      for (int b = 0; b < some.num_views(); ++b) {
        const Ray ray = this->random_ray();
        const auto expected = all.locate(chosen[a], chosen[b], ray),
                   actual = some.locate(a, b, ray);
        ASSERT_EQ(expected.has_value(), actual.has_value());
        if (expected) this->expect_same(*expected, *actual);
      }
  }
}

REGISTER_TYPED_TEST_SUITE_P(SamplerLaws, Law1AViewSeesItsOwnRayAsItIs,
                            Law2ThereAndBackIsTheIdentity, TheWayOverAThirdViewEndsAtTheSamePlace,
                            Law4RowsNeededContainEveryRowReached, MoreRowsNeedNoFewerRows,
                            ALevelHalvesPixelsAndKeepsHypotheses, RayTableHasItsWidthForEveryView,
                            PartnersAreAscendingViewsWithTheReferenceAmongThem,
                            ASubsetLocatesRaysAsAllDo);

}  // namespace gigaray::testing_support
