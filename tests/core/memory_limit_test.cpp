// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/memory_limit.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

namespace gigaray {
namespace {

namespace fs = std::filesystem;

constexpr double kMiB = 1 << 20;

/// A tree with files of /proc and /sys. The machine has 7777 MiB.
class MemoryLimit : public testing::Test {
 protected:
  MemoryLimit() {
    std::string name = (fs::temp_directory_path() / "gigaray-test-XXXXXX").string();
    EXPECT_NE(mkdtemp(name.data()), nullptr);
    root = name;
    write("proc/meminfo", "MemTotal: 9000000 kB\nMemFree: 12 kB\nMemAvailable: 7963648 kB\n");
  }
  ~MemoryLimit() override { fs::remove_all(root); }

  void write(const std::string& file, const std::string& text) const {
    fs::create_directories((root / file).parent_path());
    std::ofstream(root / file) << text;
  }
  /// A group of version 2 or, with the name of its controller before it, of version 1.
  void group_2(const std::string& path, const std::string& max, const std::string& high,
               double used_mib, double cached_mib = 0) const {
    const std::string folder = "sys/fs/cgroup/" + path;
    write(folder + "/memory.max", max + "\n");
    write(folder + "/memory.high", high + "\n");
    write(folder + "/memory.current", bytes(used_mib) + "\n");
    write(folder + "/memory.stat", "anon 5\ninactive_file " + bytes(cached_mib / 2) +
                                       "\nactive_file " + bytes(cached_mib / 2) + "\n");
  }
  void group_1(const std::string& path, const std::string& limit, double used_mib,
               double cached_mib = 0) const {
    const std::string folder = "sys/fs/cgroup/memory/" + path;
    write(folder + "/memory.limit_in_bytes", limit + "\n");
    write(folder + "/memory.usage_in_bytes", bytes(used_mib) + "\n");
    write(folder + "/memory.stat",
          "inactive_file 1\ntotal_inactive_file " + bytes(cached_mib) + "\n");
  }
  static std::string bytes(double mib) { return std::to_string((long long)(mib * kMiB)); }
  double left_mib() const { return memory_left_by_system(root) / kMiB; }

  fs::path root;
};

TEST_F(MemoryLimit, WithoutGroupsTheMachineDecides) { EXPECT_EQ(left_mib(), 7777); }

TEST_F(MemoryLimit, WithoutAnyFileNothingIsKnown) {
  fs::remove_all(root / "proc");
  EXPECT_TRUE(std::isinf(left_mib()));
}

TEST_F(MemoryLimit, TheOwnGroupDecides) {
  write("proc/self/cgroup", "0::/job/own\n");
  group_2("job/own", bytes(512), "max", 100);
  EXPECT_EQ(left_mib(), 412);
}

TEST_F(MemoryLimit, AGroupAroundDecidesWhereItLeavesLess) {
  write("proc/self/cgroup", "0::/job/own:with colon\n");
  group_2("job/own:with colon", bytes(512), "max", 100);
  group_2("job", bytes(700), "max", 600);
  EXPECT_EQ(left_mib(), 100);
  group_2("", bytes(150), "max", 60);
  EXPECT_EQ(left_mib(), 90);
}

TEST_F(MemoryLimit, WhatSlowsDownCountsLikeALimit) {
  write("proc/self/cgroup", "0::/own\n");
  group_2("own", bytes(512), bytes(300), 100);
  EXPECT_EQ(left_mib(), 200);
  group_2("own", "max", bytes(300), 100);
  EXPECT_EQ(left_mib(), 200);
}

TEST_F(MemoryLimit, CachedFilesAreFree) {
  write("proc/self/cgroup", "0::/own\n");
  group_2("own", bytes(512), "max", 500, 450);
  EXPECT_EQ(left_mib(), 462);
  // A count of cached files that is behind the other one gives no more than the limit.
  group_2("own", bytes(512), "max", 300, 400);
  EXPECT_EQ(left_mib(), 512);
}

TEST_F(MemoryLimit, AFullGroupLeavesNothing) {
  write("proc/self/cgroup", "0::/own\n");
  group_2("own", bytes(512), "max", 520);
  EXPECT_EQ(left_mib(), 0);
}

TEST_F(MemoryLimit, MaxAndGarbageLimitNothing) {
  write("proc/self/cgroup", "0::/own\n");
  for (const char* limit : {"max", "", "many", "-1", "12e3", "99999999999999999999"}) {
    group_2("own", limit, "max", 100);
    EXPECT_EQ(left_mib(), 7777) << limit;
  }
  write("proc/self/cgroup", "garbage\n0\n::\n\n:memory");
  EXPECT_EQ(left_mib(), 7777);
}

TEST_F(MemoryLimit, ALimitWithoutUsageIsStillALimit) {
  write("proc/self/cgroup", "0::/own\n");
  write("sys/fs/cgroup/own/memory.max", bytes(512));
  EXPECT_EQ(left_mib(), 512);
}

TEST_F(MemoryLimit, GroupsOfVersionOneDecide) {
  write("proc/self/cgroup", "4:cpu:/\n3:hugetlb,memory:/job/own\n1:name=systemd:/\n0::/\n");
  group_1("", "9223372036854771712", 4000);
  group_1("job", bytes(1024), 700);
  group_1("job/own", "9223372036854771712", 100);
  EXPECT_EQ(left_mib(), 324);
  group_1("job/own", bytes(300), 250, 200);
  EXPECT_EQ(left_mib(), 250);
}

TEST_F(MemoryLimit, OfBothVersionsTheLesserDecides) {
  write("proc/self/cgroup", "3:memory:/own\n0::/own\n");
  fs::create_directories(root / "sys/fs/cgroup/unified");
  group_1("own", bytes(512), 100);
  group_2("unified/own", bytes(300), "max", 100);
  EXPECT_EQ(left_mib(), 200);
}

// Docker without a name space of groups: the path is the machine's, the files are at the root.
TEST_F(MemoryLimit, InAContainerTheRootDecides) {
  write("proc/self/cgroup", "0::/docker/0123abc\n");
  group_2("", bytes(512), "max", 100);
  EXPECT_EQ(left_mib(), 412);
  write("proc/self/cgroup", "0::/../../other\n");
  EXPECT_EQ(left_mib(), 412);
}

/// A resource limit until the end of the scope.
class ScopedLimit {
 public:
  ScopedLimit(int resource, rlim_t bytes) : resource_(resource) {
    getrlimit(resource, &old_);
    const rlimit limit{bytes, old_.rlim_max};
    EXPECT_EQ(setrlimit(resource, &limit), 0);
  }
  ~ScopedLimit() { setrlimit(resource_, &old_); }

 private:
  int resource_;
  rlimit old_{};
};

TEST_F(MemoryLimit, TheProcessesOwnLimitsDecide) {
  write("proc/self/statm", "25600 9 9 9 0 12800 0\n");  // 100 MiB mapped, 50 MiB of data
  EXPECT_TRUE(std::isinf(memory_left_by_limits(root)));
  {
    // Far above what the shadow memory of a sanitizer takes.
    constexpr double kSpace = 1 << 30, kData = 1 << 29;  // MiB
    const ScopedLimit space(RLIMIT_AS, rlim_t(kSpace * kMiB));
    EXPECT_EQ(memory_left_by_limits(root) / kMiB, kSpace - 100 - 300);
    const ScopedLimit data(RLIMIT_DATA, rlim_t(kData * kMiB));
    EXPECT_EQ(memory_left_by_limits(root) / kMiB, kData - 50);
  }
}

TEST_F(MemoryLimit, OfThisProcessItIsAboveZeroAndTheDefaultIsThreeQuarters) {
  EXPECT_GT(available_memory(), 0);
  EXPECT_LE(default_memory_limit(), available_memory());
  // What the process has mapped, the shadow memory of a sanitizer too, and a GiB.
  std::ifstream statm("/proc/self/statm");
  double pages[6] = {};
  for (double& count : pages) statm >> count;
  const double mapped = pages[5] * double(sysconf(_SC_PAGESIZE));
  const ScopedLimit data(RLIMIT_DATA, rlim_t(mapped + 1024 * kMiB));
  EXPECT_LE(available_memory(), 1024 * kMiB);
}

}  // namespace
}  // namespace gigaray
