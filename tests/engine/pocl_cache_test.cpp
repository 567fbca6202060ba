// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/pocl_cache.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <chrono>

#include "engine/cache_fixture.h"
#include "opencl/cache_folder.h"

namespace gigaray::opencl {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, std::size_t size) {
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << std::string(size, 'x');
}

class PoclCacheTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directory(folder_); }

  /// A run that makes files and comes to its end.
  template <class Make>
  void run(Make make) const {
    const PoclCache cache(folder_);
    make();
  }

  const ScopedFolder scope_;
  const fs::path folder_ = scope_.path / "pocl";
};

TEST_F(PoclCacheTest, ProgramsThatAreNotAsRecordedAreRemoved) {
  const char* const so = "kernel/1-1-1/kernel.so";
  run([&] {
    for (const char* program : {"CUT", "GONE", "ZERO", "FLIPPED", "LONGER", "WHOLE"}) {
      write(folder_ / "AB" / program / "program.bc", 100);
      write(folder_ / "AB" / program / so, 5000);
    }
  });

  write(folder_ / "AB/CUT" / so, 77);
  fs::remove(folder_ / "AB/GONE/program.bc");
  // As a power cut leaves it: the size is there, the content never arrived.
  std::ofstream(folder_ / "AB/ZERO" / so, std::ios::binary) << std::string(5000, 0);
  std::ofstream(folder_ / "AB/FLIPPED" / so, std::ios::binary) << std::string(4999, 'x') + 'y';
  std::ofstream(folder_ / "AB/LONGER" / so, std::ios::binary) << std::string(5000, 'x') + '\0';
  const PoclCache cache(folder_);

  for (const char* program : {"CUT", "GONE", "ZERO", "FLIPPED", "LONGER"})
    EXPECT_FALSE(fs::exists(folder_ / "AB" / program)) << program;
  EXPECT_TRUE(fs::exists(folder_ / "AB/WHOLE" / so));
}

// A run that was killed wrote nothing down: what it made may be half a file.
TEST_F(PoclCacheTest, WhatWasNeverRecordedIsRemoved) {
  run([&] {
    write(folder_ / "AB/OLD/program.bc", 100);
    write(folder_ / "AB/MORE/program.bc", 100);
  });
  write(folder_ / "AB/MORE/kernel/1-1-1/kernel.so", 30);
  write(folder_ / "AB/NEW/program.bc", 3);
  write(folder_ / "tempfile_x1y2z3.so", 3);
  {
    const PoclCache cache(folder_);
    EXPECT_TRUE(fs::exists(folder_ / "AB/OLD/program.bc"));
    EXPECT_FALSE(fs::exists(folder_ / "AB/MORE"));
    EXPECT_FALSE(fs::exists(folder_ / "AB/NEW"));
    EXPECT_FALSE(fs::exists(folder_ / "tempfile_x1y2z3.so"));
  }
  const PoclCache again(folder_);
  EXPECT_TRUE(fs::exists(folder_ / "AB/OLD/program.bc"));
}

TEST_F(PoclCacheTest, ADamagedRecordVouchesForNothing) {
  const fs::path file = folder_ / "AB/SOME/program.bc", records = folder_.string() + ".record";
  for (const char damage : {'\0', '\n', 'x'}) {
    run([&] { write(file, 100); });
    ASSERT_TRUE(fs::exists(file));
    const auto size = fs::file_size(records);
    std::ofstream(records, std::ios::binary) << std::string(size, damage);
    const PoclCache cache(folder_);
    EXPECT_FALSE(fs::exists(file));
  }
}

// PoCL aborts when its program vanishes while it compiles.
TEST_F(PoclCacheTest, NothingIsRemovedWhileAnotherUsesIt) {
  run([&] { write(folder_ / "AB/PROGRAM/program.bc", 100); });
  {
    const PoclCache other(folder_);
    write(folder_ / "AB/PROGRAM/program.bc", 200);
    const PoclCache cache(folder_);
    EXPECT_TRUE(fs::exists(folder_ / "AB/PROGRAM/program.bc"));
  }
  write(folder_ / "AB/PROGRAM/program.bc", 300);
  const PoclCache cache(folder_);
  EXPECT_FALSE(fs::exists(folder_ / "AB/PROGRAM"));
}

TEST_F(PoclCacheTest, OnlyTheLastUserRecords) {
  {
    const PoclCache other(folder_);
    write(folder_ / "AB/PROGRAM/program.bc", 10);  // as far as it has been written
    run([] {});
    EXPECT_FALSE(fs::exists(folder_.string() + ".record"));
    write(folder_ / "AB/PROGRAM/program.bc", 100);
  }
  const PoclCache cache(folder_);
  EXPECT_TRUE(fs::exists(folder_ / "AB/PROGRAM/program.bc"));
}

TEST_F(PoclCacheTest, IsInUseWhileThereIsAUser) {
  EXPECT_FALSE(PoclCacheAlone(folder_).is_in_use());
  {
    const PoclCache user(folder_);
    EXPECT_TRUE(PoclCacheAlone(folder_).is_in_use());
  }
  EXPECT_FALSE(PoclCacheAlone(folder_).is_in_use());
}

TEST_F(PoclCacheTest, AFolderWithoutRoomSaysWhy) {
  EXPECT_EQ(why_no_room(folder_ / "made", 1 << 20), "");
  std::ofstream(scope_.path / "file") << "x";
  EXPECT_NE(why_no_room(scope_.path / "file/below", 1).find("file/below"), std::string::npos);
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  const rlimit small{1 << 20, old.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  const std::string why = why_no_room(folder_, 2 << 20);
  setrlimit(RLIMIT_FSIZE, &old);
  EXPECT_NE(why.find(folder_.string()), std::string::npos) << why;
  EXPECT_NE(why.find("2 MiB"), std::string::npos) << why;
}

// Three of PoCL's programs a kernel, and the kernels of some inputs: 40 MB in 300 files.
TEST_F(PoclCacheTest, CheckingIsQuick) {
  run([&] {
    for (int i = 0; i < 300; ++i)
      write(folder_ / "AB" / std::to_string(i) / "kernel/1-1-1/kernel.so", 140'000);
  });
  const auto begin = std::chrono::steady_clock::now();
  const PoclCache cache(folder_);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  // Takes 0.03 s; more is left for machines with other work.
  EXPECT_LT(seconds.count(), 1);
  RecordProperty("milliseconds", int(seconds.count() * 1000));
  EXPECT_TRUE(fs::exists(folder_ / "AB/299"));
}

}  // namespace
}  // namespace gigaray::opencl
