// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/pocl_cache.h"

#include <gtest/gtest.h>

#include "engine/cache_fixture.h"

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

  /// Leaves a record of what the folder holds.
  void record() const { const PoclCache cache(folder_); }

  const ScopedFolder scope_;
  const fs::path folder_ = scope_.path / "pocl";
};

TEST_F(PoclCacheTest, ProgramsWithAFileOfAnotherSizeAreRemoved) {
  write(folder_ / "AB/CUT/program.bc", 100);
  write(folder_ / "AB/CUT/kernel/1-1-1/kernel.so", 5000);
  write(folder_ / "AB/GONE/program.bc", 100);
  write(folder_ / "AB/WHOLE/kernel/1-1-1/kernel.so", 5000);
  record();

  write(folder_ / "AB/CUT/kernel/1-1-1/kernel.so", 77);
  fs::remove(folder_ / "AB/GONE/program.bc");
  write(folder_ / "AB/NEW/program.bc", 3);  // not recorded
  const PoclCache cache(folder_);

  EXPECT_FALSE(fs::exists(folder_ / "AB/CUT"));
  EXPECT_FALSE(fs::exists(folder_ / "AB/GONE"));
  EXPECT_TRUE(fs::exists(folder_ / "AB/WHOLE/kernel/1-1-1/kernel.so"));
  EXPECT_TRUE(fs::exists(folder_ / "AB/NEW/program.bc"));
}

TEST_F(PoclCacheTest, NothingIsRemovedWithoutARecord) {
  write(folder_ / "AB/SOME/program.bc", 100);
  const PoclCache cache(folder_);
  EXPECT_TRUE(fs::exists(folder_ / "AB/SOME/program.bc"));
}

// PoCL aborts when its program vanishes while it compiles.
TEST_F(PoclCacheTest, NothingIsRemovedWhileAnotherUsesIt) {
  write(folder_ / "AB/PROGRAM/program.bc", 100);
  record();
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

TEST_F(PoclCacheTest, NothingIsRecordedWhileAnotherUsesIt) {
  {
    const PoclCache other(folder_);
    write(folder_ / "AB/PROGRAM/program.bc", 10);  // as far as it has been written
    record();
    EXPECT_FALSE(fs::exists(folder_.string() + ".sizes"));
    write(folder_ / "AB/PROGRAM/program.bc", 100);
  }
  const PoclCache cache(folder_);
  EXPECT_TRUE(fs::exists(folder_ / "AB/PROGRAM/program.bc"));
}

}  // namespace
}  // namespace gigaray::opencl
