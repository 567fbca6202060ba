// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "opencl/tuning.h"

#include <gtest/gtest.h>

#include "engine/cache_fixture.h"
#include "opencl/program_cache.h"

namespace gigaray::opencl {
namespace {

DeviceInfo cpu(const std::string& name = "pthread-test CPU") {
  DeviceInfo info;
  info.name = name;
  info.vendor = "AuthenticAMD";
  info.type = DeviceType::kCpu;
  return info;
}

using TuningTable = CacheFixture;

TEST_F(TuningTable, EmbeddedTableHasNoBadLine) {
  std::vector<std::string> rejected;
  EXPECT_FALSE(parse_tuning(kernel_source("kernel_tuning.txt"), &rejected).empty());
  EXPECT_EQ(rejected, std::vector<std::string>());
}

TEST_F(TuningTable, EveryKernelOfTheTableHasDefaultsOnAnUnknownDevice) {
  DeviceInfo unknown;
  unknown.name = "never seen";
  for (const auto& tuning : tuning_in_force(unknown)) {
    EXPECT_FALSE(tuning.parameters.empty()) << tuning.kernel;
    EXPECT_EQ(tuning.origin, "any") << tuning.kernel;
  }
}

TEST_F(TuningTable, CpuGetsWideLanesAndGpuOne) {
  EXPECT_EQ(lookup_tuning(cpu(), "density_score").at("LANES"), 16);
  DeviceInfo gpu;
  gpu.type = DeviceType::kGpu;
  EXPECT_EQ(lookup_tuning(gpu, "density_score").at("LANES"), 1);
}

TEST_F(TuningTable, RulesMatchByScopeIgnoringCase) {
  const auto rules = parse_tuning(
      "any | k | A=1\ntype CPU | k | A=2\nvendor authentic | k | A=3\n"
      "device PTHREAD-test | k | A=-4 B=5\ndevice h100 | k | A=6");
  ASSERT_EQ(rules.size(), 5u);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(rules[i].matches(cpu())) << i;
  EXPECT_FALSE(rules[4].matches(cpu()));
  EXPECT_EQ(rules[3].parameters, (Tuning{{"A", -4}, {"B", 5}}));
}

TEST_F(TuningTable, LinesThatAreNoRuleAreLeftOut) {
  const char* bad[] = {"any density_score | LANES=1",
                       "any | k |",
                       "any | k | A",
                       "any | k | A=x",
                       "any | k | A=1x",
                       "any | k | A=1 B",
                       "any | k k | A=1",
                       "planet x | k | A=1",
                       "device | k | A=1",
                       "any cpu | k | A=1",
                       "any | k | 1A=1",
                       "any | k | A=99999999999",
                       "any | k | A;rm=1",
                       "| k | A=1",
                       "any"};
  for (const char* line : bad) {
    std::vector<std::string> rejected;
    const auto rules =
        parse_tuning(std::string("# comment\n\n") + line + "\r\nany | k | A=7\n", &rejected);
    EXPECT_EQ(rejected, std::vector<std::string>{line});
    ASSERT_EQ(rules.size(), 1u) << line;
    EXPECT_EQ(rules[0].parameters.at("A"), 7);
  }
}

TEST_F(TuningTable, UsersResultWinsParameterByParameter) {
  const auto built_in = lookup_tuning(cpu(), "density_score");
  save_user_tuning(cpu(), "density_score", {{"LANES", 8}});
  auto expected = built_in;
  expected["LANES"] = 8;
  EXPECT_EQ(lookup_tuning(cpu(), "density_score"), expected);
  EXPECT_EQ(lookup_tuning(cpu("another"), "density_score"), built_in);
  for (const auto& tuning : tuning_in_force(cpu()))
    EXPECT_EQ(tuning.origin == "user", tuning.kernel == "density_score") << tuning.kernel;
}

TEST_F(TuningTable, SavingAgainReplacesOnlyThatDeviceAndKernel) {
  save_user_tuning(cpu("one"), "density_score", {{"LANES", 8}});
  save_user_tuning(cpu("two|x\ny"), "density_score", {{"LANES", 4}});
  save_user_tuning(cpu("one"), "winner", {{"GROUP", 3}});
  save_user_tuning(cpu("one"), "density_score", {{"LANES", 2}});
  EXPECT_EQ(lookup_tuning(cpu("one"), "density_score").at("LANES"), 2);
  EXPECT_EQ(lookup_tuning(cpu("two|x\ny"), "density_score").at("LANES"), 4);
  EXPECT_EQ(lookup_tuning(cpu("one"), "winner").at("GROUP"), 3);
  std::vector<std::string> rejected;
  EXPECT_EQ(parse_tuning(content(folder_ / "kernel_tuning.txt"), &rejected).size(), 3u);
  EXPECT_TRUE(rejected.empty());
}

TEST_F(TuningTable, DamagedUserFileIsIgnoredAndReplaced) {
  const auto built_in = lookup_tuning(cpu(), "density_score");
  overwrite(folder_ / "kernel_tuning.txt", "\xff|||=\n=|= garbage\nany | density_score");
  EXPECT_EQ(lookup_tuning(cpu(), "density_score"), built_in);
  save_user_tuning(cpu(), "density_score", {{"LANES", 4}});
  EXPECT_EQ(lookup_tuning(cpu(), "density_score").at("LANES"), 4);
}

TEST_F(TuningTable, SavingWithoutACacheSaysWhy) {
  const ScopedVariable off("GIGARAY_CACHE", "off");
  try {
    save_user_tuning(cpu(), "density_score", {{"LANES", 4}});
    FAIL() << "it saved";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::kIo);
    EXPECT_NE(std::string(error.what()).find("GIGARAY_CACHE"), std::string::npos);
  }
}

TEST_F(TuningTable, DefinesAreCompilerOptions) {
  EXPECT_EQ(defines({{"STAGE", 1}, {"LANES", 16}}), "-DLANES=16 -DSTAGE=1");
  EXPECT_EQ(defines({}), "");
}

}  // namespace
}  // namespace gigaray::opencl
