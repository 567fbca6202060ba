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

TEST(PoclCache, ProgramsWithAFileOfAnotherSizeAreRemoved) {
  const ScopedFolder scope;
  const fs::path folder = scope.path / "pocl";
  write(folder / "AB/CUT/program.bc", 100);
  write(folder / "AB/CUT/kernel/1-1-1/kernel.so", 5000);
  write(folder / "AB/GONE/program.bc", 100);
  write(folder / "AB/WHOLE/kernel/1-1-1/kernel.so", 5000);
  record_pocl_programs(folder);

  write(folder / "AB/CUT/kernel/1-1-1/kernel.so", 77);
  fs::remove(folder / "AB/GONE/program.bc");
  write(folder / "AB/NEW/program.bc", 3);  // of another process, not recorded
  remove_damaged_pocl_programs(folder);

  EXPECT_FALSE(fs::exists(folder / "AB/CUT"));
  EXPECT_FALSE(fs::exists(folder / "AB/GONE"));
  EXPECT_TRUE(fs::exists(folder / "AB/WHOLE/kernel/1-1-1/kernel.so"));
  EXPECT_TRUE(fs::exists(folder / "AB/NEW/program.bc"));
}

TEST(PoclCache, NothingHappensWithoutARecord) {
  const ScopedFolder scope;
  const fs::path folder = scope.path / "pocl";
  write(folder / "AB/SOME/program.bc", 100);
  remove_damaged_pocl_programs(folder);
  EXPECT_TRUE(fs::exists(folder / "AB/SOME/program.bc"));
}

}  // namespace
}  // namespace gigaray::opencl
