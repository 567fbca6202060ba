// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "src/level_rows.h"

#include <gtest/gtest.h>

#include "engine/cache_fixture.h"
#include "gigaray/samplers/any_sampler.h"
#include "src/make_workspace.h"
#include "support/analytic_field.h"

namespace gigaray::testing_support {
namespace {

constexpr int kRows = 9, kViews = 5, kBytes = 7;

std::byte value(int v, int view, int i) { return std::byte(v * 50 + view * 10 + i); }

/// Rows in the three places, all bytes different.
class LevelRowsIn : public testing::TestWithParam<Place> {
 protected:
  LevelRowsIn()
      : workspace_(make_reference_workspace(EpiSampler(row_of_views(kViews)), WorkspaceSetup{})) {
    const auto store = std::make_shared<RowStore>(
        kRows, kViews * kBytes, GetParam() == Place::kFile ? work_.path.string() : std::string());
    for (int v = 0; v < kRows; ++v)
      for (int view = 0; view < kViews; ++view)
        for (int i = 0; i < kBytes; ++i) {
          const std::byte byte = value(v, view, i);
          store->write(v, view * kBytes + i, 1, &byte);
        }
    rows_ = LevelRows(*workspace_, store, RowRange{0, kRows}, kViews, GetParam());
  }
  std::size_t offset(const RowsOnDevice& rows, int v, int at, int bytes = kBytes) const {
    return (std::size_t(v - rows.begin) * rows.stored_views + at) * bytes;
  }
  std::byte at(const RowsOnDevice& rows, std::size_t offset) const {
    std::byte byte{};
    workspace_->read(*rows.memory, {&byte, 1}, offset);
    return byte;
  }

  const ScopedFolder work_;
  std::unique_ptr<Workspace> workspace_;
  LevelRows rows_;
};

TEST_P(LevelRowsIn, SomeViewsAreChangedAndNoOthers) {
  const RowRange range{2, 6};
  const std::vector<int> views{1, 3};
  std::vector<int> places;
  const RowsOnDevice opened = rows_.open(range, views, places);
  for (int v = range.begin; v < range.end; ++v)
    for (std::size_t k = 0; k < views.size(); ++k) {
      const std::size_t begin = offset(opened, v, places[k]);
      EXPECT_EQ(at(opened, begin + 3), value(v, views[k], 3));
      workspace_->write(*opened.memory, std::vector(kBytes, std::byte(1)), begin);
    }
  rows_.close(range, views, opened);
  const RowsOnDevice all = rows_.open({0, kRows});
  for (int v = 0; v < kRows; ++v)
    for (int view = 0; view < kViews; ++view) {
      const bool changed = range.contains(v) && (view == 1 || view == 3);
      EXPECT_EQ(at(all, offset(all, v, view) + 6), changed ? std::byte(1) : value(v, view, 6));
    }
}

TEST_P(LevelRowsIn, OfACoarserLevelOnlyWhatItHasIsBrought) {
  if (rows_.on_device()) return;
  constexpr int kShift = 2, kCoarseRows = 3, kCoarseBytes = 2;  // of 9 and of 7
  const RowRange range{1, kCoarseRows};
  const std::vector<int> views{0, 4};
  std::vector<int> places;
  const RowsOnDevice opened = rows_.open_coarse(range, kShift, views, places);
  EXPECT_EQ(opened.memory->bytes(), std::size_t(range.size()) * views.size() * kCoarseBytes);
  for (int v = range.begin; v < range.end; ++v)
    for (std::size_t k = 0; k < views.size(); ++k)
      for (int i = 0; i < kCoarseBytes; ++i)
        EXPECT_EQ(at(opened, offset(opened, v, places[k], kCoarseBytes) + i),
                  value(v << kShift, views[k], i << kShift));
}

INSTANTIATE_TEST_SUITE_P(Places, LevelRowsIn,
                         testing::Values(Place::kDevice, Place::kHost, Place::kFile));

}  // namespace
}  // namespace gigaray::testing_support
