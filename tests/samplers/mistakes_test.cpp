// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Arguments that cannot be meant, at every public call of the layer that could trip over them: an
// Error of one line, never an abort or a number out of nowhere.
#include <gtest/gtest.h>

#include <limits>

#include "gigaray/samplers/any_sampler.h"
#include "support/errors.h"

namespace gigaray {
namespace {

using testing_support::expect_mistake;

template <class Sampler>
void expect_views_to_be_checked(const Sampler& sampler) {
  for (const int view : {-1, sampler.num_views(), std::numeric_limits<int>::max()}) {
    expect_mistake("subset", [&] { sampler.subset({view}); });
    expect_mistake("ray_table", [&] { sampler.ray_table(view); });
  }
}

TEST(MistakesOfSamplers, AViewThatIsNotThere) {
  const std::vector<View> views{{"a", 0, 0}, {"b", 1, 0}};
  expect_views_to_be_checked(EpiSampler(views));
  expect_views_to_be_checked(GridSampler(views));
  expect_mistake("rows", [&] { GridSampler(views).rows_needed(2, {0, 1}, {0, 1, 2}, 5); });
  Camera camera;
  camera.width = camera.height = 8;
  camera.focal_u = camera.focal_v = 8;
  camera.inverse_depth = InverseDepthRange{0, 1};
  const UnstructuredSampler posed({camera, camera});
  expect_views_to_be_checked(posed);
  expect_mistake("partners", [&] { posed.nearest_partners(2, 1); });
  expect_mistake("rows", [&] { posed.rows_needed(2, {0, 1}, {0, 1, 2}, 5); });
  expect_mistake("way", [&] { posed.way(0, 2); });
  expect_mistake("travel", [&] { posed.travel(2, 0); });
}

TEST(MistakesOfSamplers, ALightFieldThatHasNoSampler) {
  expect_mistake("off the line", [] { EpiSampler({{"a", 0, 0}, {"b", 1, 1}}); });
  expect_mistake("no range", [] { UnstructuredSampler({Camera()}); });
  LightField field;
  field.kind = LightFieldKind(17);
  expect_mistake("kind", [&] { make_sampler(field); });
}

}  // namespace
}  // namespace gigaray
