// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <numeric>
#include <thread>

#include "engine/cache_fixture.h"
#include "opencl/buffer.h"
#include "opencl/program_cache.h"
#include "support/errors.h"

namespace gigaray::opencl {
namespace {

using testing_support::expect_error;

template <class F>
Error error_of(F f) {
  try {
    f();
  } catch (const Error& error) {
    return error;
  }
  return Error(ErrorCode::kCancelled, "no error");
}

TEST(Devices, ListNamesEveryDevice) {
  const auto devices = list_devices();
  ASSERT_FALSE(devices.empty());
  for (std::size_t i = 0; i < devices.size(); ++i) {
    EXPECT_EQ(devices[i].index, int(i));
    EXPECT_FALSE(devices[i].name.empty());
    EXPECT_FALSE(devices[i].platform.empty());
    EXPECT_GT(devices[i].compute_units, 0);
    EXPECT_GT(devices[i].max_group_size, 0u);
    EXPECT_GT(devices[i].local_memory, 0u);
    EXPECT_LE(devices[i].max_allocation, devices[i].global_memory);
  }
}

TEST(Devices, PoclKeepsItsKernelsWhereTheUserOrTheKernelCacheSays) {
  list_devices();
  ASSERT_NE(std::getenv("POCL_CACHE_DIR"), nullptr);
  EXPECT_TRUE(std::filesystem::is_directory(std::getenv("POCL_CACHE_DIR")));
}

TEST(Devices, IndexPartOfNameAndTypeSelect) {
  const ScopedVariable none("GIGARAY_DEVICE", nullptr);
  for (const auto& device : list_devices())
    EXPECT_EQ(select_device(std::to_string(device.index)).index, device.index);
  const auto first = list_devices().front();
  std::string part = first.name.substr(0, 5);
  for (char& c : part) c = char(std::toupper(c));
  EXPECT_EQ(select_device(part).index, 0);
  EXPECT_EQ(select_device(to_string(first.type)).type, first.type);
}

TEST(Devices, ListsAreCutAtCommasAndNameNoneTwice) {
  const ScopedVariable none("GIGARAY_DEVICE", nullptr);
  const auto devices = list_devices();
  std::string list;
  for (const auto& device : devices)
    list += (list.empty() ? "" : ", ") + std::to_string(device.index);
  const auto selected = select_devices(list);
  ASSERT_EQ(selected.size(), devices.size());
  for (std::size_t i = 0; i < devices.size(); ++i) EXPECT_EQ(selected[i].index, int(i));
  expect_error(ErrorCode::kDevice, {"'0,0'", "twice", devices.front().name},
               [] { select_devices("0,0"); });
  expect_error(ErrorCode::kDevice, {"'99'", "matches no"}, [] { Device::open_each("0,99"); });
  expect_error(ErrorCode::kDevice, {"''", "matches no"}, [] { select_devices("0, "); });
  ASSERT_EQ(select_devices().size(), 1u);
  EXPECT_EQ(select_devices().front().index, select_device().index);
  const auto all = select_devices("ALL");
  for (const auto& device : all) EXPECT_EQ(device.type, select_device().type);
  EXPECT_EQ(long(all.size()),
            std::count_if(devices.begin(), devices.end(),
                          [&](const auto& device) { return device.type == select_device().type; }));
  {
    const ScopedVariable every("GIGARAY_DEVICE", "all");
    EXPECT_EQ(select_device().index, all.front().index) << "one of several is the first";
  }
  const ScopedVariable list_of_one("GIGARAY_DEVICE", "0");
  EXPECT_EQ(select_devices().size(), 1u);
}

TEST(Devices, ThreadsThatStartTogetherAllFindThem) {
  std::vector<std::size_t> counts(4);
  std::vector<std::thread> threads;
  for (auto& count : counts) threads.emplace_back([&count] { count = list_devices().size(); });
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(counts, std::vector<std::size_t>(4, list_devices().size()));
}

TEST(Devices, DefaultPrefersAGpu) {
  const ScopedVariable none("GIGARAY_DEVICE", nullptr);
  bool has_gpu = false;
  for (const auto& device : list_devices()) has_gpu |= device.type == DeviceType::kGpu;
  EXPECT_EQ(select_device().type == DeviceType::kGpu, has_gpu);
}

TEST(Devices, UnknownSelectionListsWhatThereIs) {
  const auto error = error_of([] { Device::open("no such device"); });
  EXPECT_EQ(error.code(), ErrorCode::kDevice);
  const std::string message = error.what();
  EXPECT_NE(message.find("'no such device'"), std::string::npos);
  EXPECT_NE(message.find("0: " + list_devices().front().name), std::string::npos);
  EXPECT_EQ(error_of([] { select_device("99"); }).code(), ErrorCode::kDevice);
  EXPECT_EQ(error_of([] { select_device("-1"); }).code(), ErrorCode::kDevice);
}

TEST(Devices, EnvironmentIsTheFallbackAndNamedWhenWrong) {
  const ScopedVariable variable("GIGARAY_DEVICE", "nonsense");
  const std::string message = error_of([] { select_device(); }).what();
  EXPECT_TRUE(message.starts_with("GIGARAY_DEVICE 'nonsense'")) << message;
  EXPECT_EQ(select_device("0").index, 0);
}

TEST(Devices, FailedCallCarriesItsTextAndTheErrorsName) {
  const auto error = error_of([] { GIGARAY_CL(clFinish(nullptr)); });
  EXPECT_EQ(error.code(), ErrorCode::kDevice);
  const std::string message = error.what();
  EXPECT_NE(message.find("clFinish(nullptr)"), std::string::npos) << message;
  EXPECT_NE(message.find("CL_INVALID_COMMAND_QUEUE (-36)"), std::string::npos) << message;
  EXPECT_EQ(error_of([] { check_cl(CL_OUT_OF_HOST_MEMORY, "x"); }).code(), ErrorCode::kOutOfMemory);
}

TEST(Devices, WhatIsHiddenStaysHiddenInAnotherQueue) {
  Device device = Device::open();
  device.hide_fp64();
  device.hide_int64_atomics();
  for (const Device& other : {device, device.with_own_queue()}) {
    EXPECT_FALSE(other.info().has_fp64);
    EXPECT_FALSE(other.info().has_int64_atomics);
  }
}

using Buffers = CacheFixture;

TEST_F(Buffers, RoundTripAtAnOffsetAndClear) {
  const auto device = Device::open();
  std::vector<std::int32_t> values(93);
  std::iota(values.begin(), values.end(), 7);
  Buffer buffer(device, std::span<const std::int32_t>(values));
  const std::int32_t other[] = {-1, -2, -3};
  buffer.write(std::span<const std::int32_t>(other), 5 * sizeof(std::int32_t));
  std::copy(std::begin(other), std::end(other), values.begin() + 5);
  std::vector<std::int32_t> read(93);
  buffer.read(std::span(read));
  EXPECT_EQ(read, values);

  buffer.clear();
  buffer.read(std::span(read));
  EXPECT_EQ(read, std::vector<std::int32_t>(93, 0));
}

TEST_F(Buffers, KernelsWorkOverHostMemory) {
  auto device = Device::open();
  alignas(64) float memory[144];
  std::iota(std::begin(memory), std::end(memory), 0.0f);
  auto buffer = Buffer::over_host_memory(device, std::as_writable_bytes(std::span(memory)));
  const SourcePart part{"twice.cl",
                        "kernel void twice(global float* x, float by, local float* t) {"
                        "  t[get_local_id(0)] = x[get_global_id(0)];"
                        "  x[get_global_id(0)] = by * t[get_local_id(0)]; }"};
  Kernel kernel(device, build_program(device, {&part, 1}), "twice");
  kernel.set_args(buffer, 2.0f, LocalMemory{16 * sizeof(float)}).run(144, 16);
  const float one = 1;
  buffer.write(std::span(&one, 1), 143 * sizeof(float));
  kernel.run(144, 16);
  std::vector<float> values(144);
  buffer.read(std::span(values));
  for (int i = 0; i < 143; ++i) ASSERT_EQ(values[i], 4.0f * float(i));
  EXPECT_EQ(values[143], 2.0f);
}

TEST_F(Buffers, TooLargeAllocationNamesTheSizes) {
  const auto device = Device::open();
  const auto error =
      error_of([&] { Buffer(device, std::size_t(device.info().max_allocation) + 1); });
  EXPECT_EQ(error.code(), ErrorCode::kOutOfMemory);
  const std::string message = error.what();
  EXPECT_NE(message.find("largest allocation of"), std::string::npos) << message;
  EXPECT_NE(message.find("iB"), std::string::npos) << message;
}

TEST_F(Buffers, OutliveTheDeviceTheyWereMadeWith) {
  std::optional<Device> device = Device::open();
  const int value = 42;
  const Buffer buffer(*device, std::span(&value, 1));
  device.reset();
  int read = 0;
  buffer.read(std::span(&read, 1));
  EXPECT_EQ(read, 42);
}

using Kernels = CacheFixture;

TEST_F(Kernels, FailuresNameTheKernelAndTheArgument) {
  auto device = Device::open();
  const SourcePart part{"one.cl", "kernel void one(global int* x, int n) { x[0] = n; }"};
  const auto program = build_program(device, {&part, 1});
  const std::string unknown = error_of([&] { Kernel(device, program, "two"); }).what();
  EXPECT_NE(unknown.find("two"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("CL_INVALID_KERNEL_NAME"), std::string::npos) << unknown;

  Kernel kernel(device, program, "one");
  const Buffer buffer(device, sizeof(int));
  const std::string wrong = error_of([&] { kernel.set_args(buffer, std::int64_t(1)); }).what();
  EXPECT_NE(wrong.find("argument 1 of kernel one (8 bytes)"), std::string::npos) << wrong;
  kernel.set_args(buffer, 1);
  const std::string size = error_of([&] { kernel.run({7, 3}, {2, 1}); }).what();
  EXPECT_NE(size.find("kernel one over 7 x 3 items in groups of 2 x 1"), std::string::npos) << size;
}

TEST_F(Kernels, ProfilingTellsTheTimeOfAStage) {
  auto device = Device::open();
  const SourcePart part{"one.cl", "kernel void one(global int* x, int n) { x[0] = n; }"};
  Kernel kernel(device, build_program(device, {&part, 1}), "one");
  const Buffer buffer(device, sizeof(int));
  device.log()->begin_stage("stage");
  kernel.set_args(buffer, 1).run(1, 1);
  device.finish();
  device.log()->collect();
  EXPECT_GT(device.log()->seconds().at("stage"), 0.0);
}

}  // namespace
}  // namespace gigaray::opencl
