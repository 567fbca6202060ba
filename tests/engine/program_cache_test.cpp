// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/program_cache.h"

#include <gtest/gtest.h>

#include <thread>

#include "engine/cache_fixture.h"
#include "opencl/buffer.h"
#include "opencl/pocl_cache.h"

namespace gigaray::opencl {
namespace {

constexpr SourcePart kParts[] = {
    {"helpers.cl", "inline int triple(int x) { return 3 * x; }"},
    {"triple.cl", "kernel void run(global int* x) { x[0] = triple(x[0]) + BIAS; }\n"}};

/// Builds the program with a bias and runs it on 5.
int result(Device& device, int bias = 1) {
  Kernel kernel(device, build_program(device, kParts, "-DBIAS=" + std::to_string(bias)), "run");
  int value = 5;
  Buffer buffer(device, std::span<const int>(&value, 1));
  kernel.set_args(buffer).run(1, 1);
  buffer.read(std::span(&value, 1));
  return value;
}

/// PoCL, which keeps its programs itself, as another driver, or whatever else there is.
Device open_another() {
  Device device = Device::open();
  device.hide_pocl();
  return device;
}

using ProgramCache = CacheFixture;

int files_of_pocl(const std::string& name) {
  int files = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(std::getenv("POCL_CACHE_DIR")))
    files += entry.path().filename() == name;
  return files;
}

TEST_F(ProgramCache, AKernelIsCompiledOnceAndKeptByPoclOrByUs) {
  const SourcePart part{"only_here.cl", "kernel void only_here(global int* x) { x[0] += 40; }"};
  for (int start = 0; start < 2; ++start) {
    auto device = Device::open();
    Kernel kernel(device, build_program(device, {&part, 1}), "only_here");
    int value = 2;
    Buffer buffer(device, std::span<const int>(&value, 1));
    kernel.set_args(buffer).run(1, 1);
    buffer.read(std::span(&value, 1));
    EXPECT_EQ(value, 42);
    const bool keeps_itself = device.is_pocl();
    EXPECT_EQ(device.counters().built, keeps_itself || start == 0 ? 1 : 0);
    EXPECT_EQ(program_files().size(), keeps_itself ? 0u : 1u);
    EXPECT_EQ(keeps_itself ? files_of_pocl("only_here.so") : 1, 1);
  }
}

TEST_F(ProgramCache, SecondBuildComesFromMemory) {
  auto device = open_another();
  EXPECT_EQ(result(device), 16);
  EXPECT_EQ(result(device), 16);
  EXPECT_EQ(device.counters().built, 1);
  EXPECT_EQ(device.counters().reused, 1);
}

TEST_F(ProgramCache, SecondStartComesFromDisk) {
  auto first = open_another();
  EXPECT_EQ(result(first), 16);
  auto second = open_another();
  EXPECT_EQ(result(second), 16);
  EXPECT_EQ(second.counters().built, 0);
  EXPECT_EQ(second.counters().loaded, 1);
  EXPECT_EQ(program_files().size(), 1u);
}

TEST_F(ProgramCache, OtherOptionsAndOtherSourceAreOtherPrograms) {
  auto device = open_another();
  EXPECT_EQ(result(device, 1), 16);
  EXPECT_EQ(result(device, 2), 17);
  // The same text cut into other parts: the lines of messages differ, so must the program.
  const SourcePart joined{"triple.cl", kParts[0].text};
  build_program(device, {&joined, 1});
  EXPECT_EQ(device.counters().built, 3);
  EXPECT_EQ(program_files().size(), 3u);
}

TEST_F(ProgramCache, DamagedFilesAreRebuiltAndReplaced) {
  auto first = open_another();
  ASSERT_EQ(result(first), 16);
  ASSERT_EQ(program_files().size(), 1u);
  const auto path = program_files().front();
  const std::string good = content(path);

  std::string flipped_payload = good;
  flipped_payload[good.size() - 7] ^= 1;
  std::string other_version = good;
  other_version[7] = '0';
  std::string other_key = good;
  other_key[8] ^= 1;
  for (const auto& damaged :
       {flipped_payload, other_version, other_key, good + "x", good.substr(0, good.size() - 1),
        good.substr(0, 48), good.substr(0, 47), std::string()}) {
    overwrite(path, damaged);
    auto device = open_another();
    EXPECT_EQ(result(device), 16);
    EXPECT_EQ(device.counters().built, 1);
    auto next = open_another();
    EXPECT_EQ(result(next), 16);
    EXPECT_EQ(next.counters().loaded, 1);
  }
}

TEST_F(ProgramCache, ConcurrentWritersLeaveOneGoodFile) {
  std::vector<std::thread> threads;
  std::vector<int> results(4);
  for (auto& value : results)
    threads.emplace_back([&value] {
      auto device = open_another();
      value = result(device);
    });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(results, std::vector<int>(4, 16));
  EXPECT_EQ(program_files().size(), 1u);
  auto device = open_another();
  result(device);
  EXPECT_EQ(device.counters().loaded, 1);
}

TEST_F(ProgramCache, OffLeavesNothingOnDisk) {
  const ScopedVariable off("GIGARAY_CACHE", "off");
  for (int start = 0; start < 2; ++start) {
    auto device = open_another();
    EXPECT_EQ(result(device), 16);
    EXPECT_EQ(device.counters().built, 1);
  }
  EXPECT_TRUE(program_files().empty());
  EXPECT_TRUE(kernel_cache_info().folder.empty());
}

TEST_F(ProgramCache, WorksWhereTheFolderCannotBeMade) {
  // Below a file no folder can be made, not even by root.
  overwrite(folder_ / "file", "");
  const ScopedVariable blocked("GIGARAY_CACHE_DIR", (folder_ / "file" / "below").c_str());
  auto device = open_another();
  EXPECT_EQ(result(device), 16);
  EXPECT_EQ(kernel_cache_info().programs, 0);
}

TEST_F(ProgramCache, BuildErrorCarriesFileLineAndOptions) {
  auto device = open_another();
  const SourcePart parts[] = {{"good.cl", "int good(void);"},
                              {"bad.cl", "kernel void run(global int* x) {\n  x[0] = nowhere;\n}"}};
  try {
    build_program(device, parts, "-DBIAS=3");
    FAIL() << "it built";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kDevice);
    const std::string message = error.what();
    for (const char* part : {"bad.cl:2", "nowhere", "-DBIAS=3", "CL_BUILD_PROGRAM_FAILURE"})
      EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
  }
  EXPECT_TRUE(program_files().empty());
}

TEST_F(ProgramCache, InfoCountsAndClearRemoves) {
  EXPECT_EQ(kernel_cache_info().programs, 0);
  auto device = open_another();
  result(device, 1);
  result(device, 2);
  overwrite(folder_ / "kernel_tuning.txt", "kept");
  const auto info = kernel_cache_info();
  EXPECT_EQ(info.folder, folder_.string());
  EXPECT_EQ(info.programs, 2);
  EXPECT_GT(info.bytes, 0u);

  clear_kernel_cache();
  EXPECT_EQ(kernel_cache_info().programs, 0);
  EXPECT_EQ(kernel_cache_info().bytes, 0u);
  EXPECT_EQ(content(folder_ / "kernel_tuning.txt"), "kept");
  auto fresh = open_another();
  EXPECT_EQ(result(fresh), 16);
  EXPECT_EQ(fresh.counters().built, 1);
}

TEST_F(ProgramCache, WhatARunUsesIsNotCleared) {
  auto device = open_another();
  result(device);
  std::filesystem::create_directory(folder_ / "gigaray-pocl");
  {
    const PoclCache other(folder_ / "gigaray-pocl");
    overwrite(folder_ / "gigaray-pocl/kernel", "of the other run");
    EXPECT_THROW(clear_kernel_cache(), Error);
    EXPECT_TRUE(std::filesystem::exists(folder_ / "gigaray-pocl/kernel"));
    EXPECT_EQ(program_files().size(), 1u);
  }
  clear_kernel_cache();
  EXPECT_FALSE(std::filesystem::exists(folder_ / "gigaray-pocl/kernel"));
  EXPECT_TRUE(program_files().empty());
}

TEST(KernelSource, EmbeddedTextIsTheFile) {
  const auto text = kernel_source("kernel_tuning.txt");
  EXPECT_TRUE(text.starts_with("# Compile-time parameters"));
  EXPECT_TRUE(text.ends_with('\n'));
  EXPECT_EQ(text.find('\0'), std::string_view::npos);
}

}  // namespace
}  // namespace gigaray::opencl
