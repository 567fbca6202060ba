// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/parallel.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "gigaray/core/run_control.h"
#include "support/errors.h"

namespace gigaray {
namespace {

using testing_support::expect_error;
namespace fs = std::filesystem;

/// Loops on so many threads until the end of the scope.
struct ScopedThreads {
  explicit ScopedThreads(int threads) { set_num_threads(threads); }
  ~ScopedThreads() { set_num_threads(0); }
};

const auto kNoReport = [](int) {};

TEST(ParallelFor, RunsEveryJobOnceAndReportsThemInOrderOnThisThread) {
  for (const int threads : {1, 2, 5}) {
    const ScopedThreads scope(threads);
    std::vector<std::atomic<int>> runs(200);
    std::vector<int> reports;
    const auto here = std::this_thread::get_id();
    parallel_for(
        200, [&](int i) { ++runs[i]; },
        [&](int done) {
          EXPECT_EQ(std::this_thread::get_id(), here);
          reports.push_back(done);
        });
    for (const auto& count : runs) EXPECT_EQ(count, 1);
    std::vector<int> expected(200);
    std::iota(expected.begin(), expected.end(), 1);
    EXPECT_EQ(reports, expected);
  }
}

TEST(ParallelFor, OfNothingDoesNothing) {
  parallel_for(
      0, [](int) { FAIL(); }, [](int) { FAIL(); });
}

TEST(ParallelFor, KeepsToTheNumberOfThreads) {
  const ScopedThreads scope(3);
  EXPECT_EQ(num_threads(), 3);
  for (const int most : {0, 2}) {
    std::atomic<int> busy{0}, peak{0};
    const auto job = [&](int) {
      const int now = ++busy;
      for (int seen = peak; seen < now && !peak.compare_exchange_weak(seen, now);) {
      }
      // Until there is another one, on a busy machine after a while.
      for (int i = 0; i < 5000 && peak < 2; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      --busy;
    };
    parallel_for(40, job, kNoReport, most);
    EXPECT_LE(peak, most == 0 ? 3 : most);
    EXPECT_GE(peak, 2) << "on one thread alone";
  }
}

TEST(ParallelFor, TheFirstExceptionOfAJobStopsTheRest) {
  for (const int threads : {1, 4}) {
    const ScopedThreads scope(threads);
    std::atomic<int> runs{0};
    const auto job = [&](int i) {
      if (i == 3) throw std::runtime_error("job 3");
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      ++runs;
    };
    try {
      parallel_for(10000, job, kNoReport);
      FAIL() << "the exception was lost";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "job 3");
    }
    EXPECT_LT(runs, 100);
  }
}

TEST(ParallelFor, CancellingStopsItSoon) {
  const ScopedThreads scope(2);
  RunControl control;
  std::atomic<int> runs{0};
  const auto job = [&](int i) {
    if (i == 5) control.cancel();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ++runs;
  };
  expect_error(ErrorCode::kCancelled, {},
               [&] { parallel_for(10000, job, [&](int) { control.throw_if_cancelled(); }); });
  EXPECT_LT(runs, 100);
}

// A picture's rows in parallel, several pictures in parallel, and a lock around the inner loop.
TEST(ParallelFor, LoopsInsideJobsShareTheThreadsAndDontTakeJobsOfTheOuterOne) {
  const ScopedThreads scope(4);
  std::mutex mutex;
  std::atomic<int> sum{0};
  parallel_for(
      20,
      [&](int) {
        const std::lock_guard lock(mutex);
        parallel_for(
            50, [&](int i) { sum += i; }, kNoReport);
      },
      kNoReport);
  EXPECT_EQ(sum, 20 * 49 * 50 / 2);
}

TEST(Threads, BelowZeroIsRefused) {
  expect_error(ErrorCode::kInvalidArgument, {"-1"}, [] { set_num_threads(-1); });
  EXPECT_EQ(num_threads(), available_processors());
  EXPECT_GE(available_processors(), 1);
}

/// A tree with files of /proc and /sys.
class ProcessorLimit : public testing::Test {
 protected:
  ProcessorLimit() {
    std::string name = (fs::temp_directory_path() / "gigaray-test-XXXXXX").string();
    EXPECT_NE(mkdtemp(name.data()), nullptr);
    root = name;
  }
  ~ProcessorLimit() override { fs::remove_all(root); }
  void write(const std::string& file, const std::string& text) const {
    fs::create_directories((root / file).parent_path());
    std::ofstream(root / file) << text << '\n';
  }
  int left() const { return processors_left_by_groups(root); }

  fs::path root;
};

TEST_F(ProcessorLimit, WithoutAQuotaNothingIsSaid) {
  EXPECT_EQ(left(), 0);
  write("proc/self/cgroup", "0::/own");
  EXPECT_EQ(left(), 0);
  for (const char* quota : {"max 100000", "", "-1 100000", "1000", "many 5"}) {
    write("sys/fs/cgroup/own/cpu.max", quota);
    EXPECT_EQ(left(), 0) << quota;
  }
}

TEST_F(ProcessorLimit, TheLeastQuotaDecidesRoundedUp) {
  write("proc/self/cgroup", "0::/job/own");
  write("sys/fs/cgroup/job/own/cpu.max", "350000 100000");
  EXPECT_EQ(left(), 4);
  write("sys/fs/cgroup/cpu.max", "50000 100000");
  EXPECT_EQ(left(), 1);
}

TEST_F(ProcessorLimit, GroupsOfVersionOneDecide) {
  write("proc/self/cgroup", "4:cpu,cpuacct:/own\n3:memory:/other");
  write("sys/fs/cgroup/cpu/own/cpu.cfs_quota_us", "-1");
  write("sys/fs/cgroup/cpu/own/cpu.cfs_period_us", "100000");
  EXPECT_EQ(left(), 0);
  write("sys/fs/cgroup/cpu/own/cpu.cfs_quota_us", "200000");
  EXPECT_EQ(left(), 2);
}

}  // namespace
}  // namespace gigaray
