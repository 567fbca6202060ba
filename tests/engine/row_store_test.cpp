// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "src/row_store.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "engine/cache_fixture.h"
#include "src/tuple_store.h"
#include "support/errors.h"

namespace gigaray {
namespace {

using testing_support::expect_error;

/// Both kinds: rows in memory and in a file.
class RowStores : public testing::TestWithParam<bool> {
 protected:
  std::string folder() const { return GetParam() ? work_.path.string() : ""; }
  const ScopedFolder work_;
};
INSTANTIATE_TEST_SUITE_P(Kinds, RowStores, testing::Bool(),
                         [](const auto& info) { return info.param ? "File" : "Memory"; });

TEST_P(RowStores, AreZeroAtFirst) {
  const RowStore store(7, 93, folder());
  std::vector<std::uint8_t> row(93, 1);
  for (int v = 0; v < 7; ++v) {
    store.read(v, 0, 93, row.data());
    EXPECT_EQ(row, std::vector<std::uint8_t>(93, 0));
  }
}

TEST_P(RowStores, KeepWhatWasWritten) {
  RowStore store(7, 93, folder());
  std::vector<std::uint8_t> part(31);
  std::iota(part.begin(), part.end(), 1);
  store.write(5, 60, 31, part.data());
  std::vector<std::uint8_t> row(93);
  store.read(5, 0, 93, row.data());
  EXPECT_TRUE(std::equal(part.begin(), part.end(), row.begin() + 60));
  EXPECT_EQ(std::accumulate(row.begin(), row.end(), 0),
            std::accumulate(part.begin(), part.end(), 0));
  store.read(4, 0, 93, row.data());
  EXPECT_EQ(std::accumulate(row.begin(), row.end(), 0), 0);
}

TEST(RowStore, RowsInMemoryAreOnePieceThatDriversNeedNotCopy) {
  RowStore store(9, 16, "");
  const std::uint8_t value = 42;
  store.write(3, 15, 1, &value);
  EXPECT_EQ(store.bytes().size(), 9u * 16);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(store.bytes().data()) % 64, 0u);
  EXPECT_EQ(store.bytes()[3 * 16 + 15], std::byte(42));
}

TEST_P(RowStores, MoveTakesTheRowsAlong) {
  RowStore store(2, 8, folder());
  const double value = 0.25;
  store.write(1, 0, 8, &value);
  RowStore moved = std::move(store);
  RowStore assigned;
  EXPECT_TRUE(assigned.empty());
  assigned = std::move(moved);
  double read = 0;
  assigned.read(1, 0, 8, &read);
  EXPECT_EQ(read, value);
  EXPECT_FALSE(assigned.empty());
}

TEST_P(RowStores, NoFileHasAName) {
  const RowStore store(100, 1000, folder());
  EXPECT_TRUE(std::filesystem::is_empty(work_.path));
}

TEST(RowStore, AFolderThatDoesNotExistIsNamed) {
  const ScopedFolder work;
  const std::string folder = work.path / "none";
  expect_error(ErrorCode::kIo, {folder, "No such file"}, [&] { RowStore(2, 8, folder); });
}

/// No file may grow beyond a size, as on a full disk, until the end of the scope.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    handler_ = signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &old_);
    rlimit limited = old_;
    limited.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limited);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &old_);
    signal(SIGXFSZ, handler_);
  }

 private:
  rlimit old_{};
  void (*handler_)(int);
};

TEST(RowStore, NoRoomShowsWhenItIsMadeAndLeavesNothing) {
  const ScopedFolder work;
  const FileSizeLimit limit(1 << 20);
  EXPECT_NO_THROW(RowStore(10, 1000, work.path));
  expect_error(ErrorCode::kIo, {work.path, "no room for 5 MiB"},
               [&] { RowStore(5, 1 << 20, work.path); });
  EXPECT_TRUE(std::filesystem::is_empty(work.path));
}

TEST(TupleStore, KeepsTheOrderInMemoryAndInAFile) {
  const ScopedFolder work;
  constexpr int kMany = (1 << 20) + 4099;  // more than are held in memory
  for (const std::string& folder : {std::string(), work.path.string()}) {
    TupleStore store(folder);
    const std::set<int> begins{0, 5, 1 << 18, kMany - 7};  // of views
    for (int i = 0; i < kMany; ++i) {
      if (begins.count(i) > 0) store.begin_view();
      std::vector<RayTuple> tuples(1);
      tuples[0].u = i;
      store.append(tuples);
    }
    store.begin_view();  // without any
    EXPECT_EQ(store.size(), std::size_t(kMany));
    ASSERT_EQ(store.num_views(), int(begins.size()) + 1);
    for (int pass = 0; pass < 2; ++pass) {
      int next = 0, wrong = 0;
      for (int view = 0; view < store.num_views(); ++view) {
        wrong += view < int(begins.size()) && begins.count(next) == 0;
        store.for_each(view, [&](const RayTuple& tuple) { wrong += tuple.u != next++; });
      }
      EXPECT_EQ(next, kMany);
      EXPECT_EQ(wrong, 0);
    }
    EXPECT_TRUE(std::filesystem::is_empty(work.path));
  }
}

TEST(RunTuples, OfEveryViewOnePartitionAfterTheOther) {
  RunTuples all;
  for (const int partition : {0, 1}) {
    TupleStore store("");
    for (const int view : {0, 1, 2}) {
      store.begin_view();
      std::vector<RayTuple> tuples(view == 1 && partition == 0 ? 0 : 2);
      for (RayTuple& tuple : tuples) {
        tuple.view = view;
        tuple.v = partition;
      }
      store.append(tuples);
    }
    all.add(std::move(store));
  }
  std::vector<std::pair<int, int>> order;
  all.for_each([&](const RayTuple& tuple) { order.emplace_back(tuple.view, tuple.v); });
  EXPECT_EQ(all.size(), 10u);
  EXPECT_EQ(order.size(), all.size());
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
}

TEST(TupleStore, NoRoomIsAnErrorThatNamesTheFolder) {
  const ScopedFolder work;
  const FileSizeLimit limit(1 << 20);
  TupleStore store(work.path);
  expect_error(ErrorCode::kIo, {work.path}, [&] {
    for (int i = 0; i < 3 << 20; ++i) store.append(std::vector<RayTuple>(1));
  });
}

}  // namespace
}  // namespace gigaray
