// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Limits of memory, the folder of temporary files and the cache of kernels, as a user meets them.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/program_test.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Memory : public ProgramTest {
 protected:
  void make(const std::string& options, const std::string& name = "made",
            const std::string& size = "--width 120 --height 90") const {
    const Result result = run("synth planes -o " + name + " " + size + " " + options);
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
  /// MiB that a line advises to give at least; −1: none.
  static double least_in(const std::string& text) {
    const auto at = text.find("at least ");
    return at == std::string::npos ? -1 : std::stod(text.substr(at + 9));
  }
  static std::string memory(double mib) { return " --memory " + std::to_string(mib / 1024); }

  /// A tiny limit is refused in one line; the limit that this names will do.
  void expect_budget(const std::string& command) const {
    expect_refusal(command + " --memory 0.001", 1, "at least", "MiB");
    const double least = least_in(run(command + " --memory 0.001").err);
    ASSERT_GT(least, 0) << command;
    const Result enough = run(command + memory(least));
    EXPECT_EQ(enough.exit_code, 0) << command << ": " << enough.err;
    const Result help = run(command.substr(0, command.find(' ')) + " --help");
    EXPECT_NE(help.out.find("--memory"), std::string::npos) << command;
  }
  void depth_of_made() const {
    const Result result = run("depth made -o out --hypotheses 9");
    ASSERT_EQ(result.exit_code, 0) << result.err;
  }
};

TEST_F(Memory, InfoAndDepthNameTheSameLeastLimitAndItWillDo) {
  make("--views 5", "row");
  make("--grid 3x3", "grid");
  make("--path walk --views 5", "posed");
  fs::create_directory(folder / "plain");
  for (int i = 0; i < 5; ++i)
    fs::copy_file(folder / "row" / ("view_00" + std::to_string(i) + ".png"),
                  folder / "plain" / (std::to_string(i) + ".png"));
  for (const std::string options : {"row", "row --preset paper", "row --hypotheses 300",
                                    "row --views centre", "grid", "posed", "plain"}) {
    const Result info = run("info --json --memory 0.01 " + options);
    ASSERT_EQ(info.exit_code, 0) << info.err;
    const json forecast = json::parse(info.out).at("forecast");
    ASSERT_TRUE(forecast.contains("refusal")) << options;
    const double least = least_in(forecast.at("refusal"));
    expect_refusal("depth -o out --memory 0.01 " + options, 1,
                   "at least " + std::to_string(int(least)) + " MiB");
    const Result depth = run("depth -o out --json " + options + memory(least));
    ASSERT_EQ(depth.exit_code, 0) << options << ": " << depth.err;
    const json report = json::parse(depth.out);
    EXPECT_LE(report.at("peak_memory_mib"), least) << options;
    EXPECT_LE(report.at("forecast_memory_mib"), least) << options;
    fs::remove_all(folder / "out");
  }
}

TEST_F(Memory, TheForecastIsNearThePeakWithKernelsAndWithout) {
  make("--views 9");
  const std::string cache = "GIGARAY_CACHE_DIR=$PWD/cache";
  for (const char* state : {"cold", "warm"}) {
    const Result result = run("depth made -o out --json --hypotheses 40", cache);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json report = json::parse(result.out);
    const double peak = report.at("peak_memory_mib"), told = report.at("forecast_memory_mib");
    EXPECT_NEAR(told / peak, 1, 0.2) << state << ": " << told << " of " << peak << " MiB";
  }
}

TEST_F(Memory, EveryCommandHasABudget) {
  make("--views 5");
  depth_of_made();
  make("--path line --views 5 --extent 0.2", "photos");
  for (const std::string command :
       {"encode made -o out.grl --depth out", "encode made -o out.grl --hypotheses 9",
        "cloud out -o out.ply", "mesh out -o mesh.ply", "mesh out -o mesh.ply --method front",
        "render out -o pictures --pose 0.5,0", "render out -o pictures --refocus 0.5",
        "render out -o pictures --leave-out centre", "evaluate out made",
        "compare made -o compared --methods auto,bm --hypotheses 9",
        "rectify photos/images -o rail --poses order"})
    expect_budget(command);
}

TEST_F(Memory, LimitsOfTheProcessCount) {
  make("--views 5");
  for (const char* limit : {"ulimit -v 850000 &&", "ulimit -d 150000 &&"})
    expect_refusal("depth made -o out", 1, "memory of", "at least", limit);
}

TEST_F(Memory, WithoutTemporaryFolderOnlyRunsThatNeedOneStop) {
  make("--views 9", "made", "--width 300 --height 200");
  const std::string none = "TMPDIR=/nonexistent";
  Result result = run("depth made -o out --hypotheses 9 --views 0", none);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const double least = least_in(run("depth made -o out --hypotheses 9 --memory 0.01").err);
  const std::string little = "depth made -o little --hypotheses 9 --views 0" + memory(least + 1);
  expect_refusal(little, 1, "TMPDIR", "--work", none);
  fs::create_directory(folder / "work");
  result = run(little + " --work work", none);
  EXPECT_EQ(result.exit_code, 0) << result.err;
}

TEST_F(Memory, DamagedKernelsAreCompiledAgain) {
  make("--views 3");
  const std::string cache = "GIGARAY_CACHE_DIR=$PWD/cache";
  const std::string depth = "depth made -o out --hypotheses 9 --views 0 --preset paper";
  ASSERT_EQ(run(depth, cache).exit_code, 0);
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "cache/gigaray-pocl")) {
    if (entry.path().extension() != ".so" && entry.path().extension() != ".bc") continue;
    // As a power cut leaves it: the size is there, the content never arrived.
    const std::string zeros(fs::file_size(entry.path()), '\0');
    std::ofstream(entry.path(), std::ios::binary) << zeros;
    ++files;
  }
  ASSERT_GT(files, 3);
  const Result zeroed = run(depth, cache);
  EXPECT_EQ(zeroed.exit_code, 0) << zeroed.err;
  // A run that was killed recorded nothing of what it left.
  fs::remove(folder / "cache/gigaray-pocl.record");
  for (const auto& entry : fs::recursive_directory_iterator(folder / "cache/gigaray-pocl"))
    if (entry.path().extension() == ".so") fs::resize_file(entry.path(), 100);
  const Result killed = run(depth, cache);
  EXPECT_EQ(killed.exit_code, 0) << killed.err;
}

TEST_F(Memory, ACacheWithoutRoomFallsBackOrSaysSo) {
  make("--views 3");
  const std::string depth = "depth made -o out --hypotheses 9 --views 0 --preset paper";
  std::ofstream(folder / "file") << "x";
  const Result elsewhere = run(depth, "GIGARAY_CACHE_DIR=$PWD/file/below");
  EXPECT_EQ(elsewhere.exit_code, 0) << elsewhere.err;
  fs::remove_all(folder / "out");
  // Neither folder will do.
  expect_refusal(depth, 1, "GIGARAY_CACHE_DIR", "TMPDIR",
                 "GIGARAY_CACHE_DIR=$PWD/file/below TMPDIR=$PWD/file/too");
  expect_refusal(depth, 1, "GIGARAY_CACHE_DIR", "TMPDIR", "GIGARAY_CACHE=off TMPDIR=/nonexistent");
}

TEST_F(Memory, KernelsInUseAreNotCleared) {
  make("--views 9");
  ASSERT_EQ(setenv("GIGARAY_CACHE_DIR", (folder / "cache").c_str(), 1), 0);
  const std::string cache = "GIGARAY_CACHE_DIR=$PWD/cache";
  const pid_t child = start({"depth", "made", "-o", "out", "--hypotheses", "40"});
  ASSERT_GT(child, 0);
  ASSERT_TRUE(wait_until([&] {
    std::error_code error;
    for (fs::recursive_directory_iterator it(folder / "cache/gigaray-pocl", error), end;
         !error && it != end; it.increment(error))
      if (it->path().extension() == ".bc") return true;
    return false;
  }));
  const Result clear = [&] {
    const int status = std::system(("cd '" + folder.string() + "' && " + cache + " '" +
                                    GIGARAY_PROGRAM + "' devices --clear-cache >.o2 2>.e2")
                                       .c_str());
    return Result{WEXITSTATUS(status), text_of(".o2"), text_of(".e2")};
  }();
  EXPECT_EQ(clear.exit_code, 1);
  EXPECT_NE(clear.err.find("in use"), std::string::npos) << clear.err;
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 0) << text_of(".err");
  EXPECT_EQ(run("devices --clear-cache", cache).exit_code, 0);
  unsetenv("GIGARAY_CACHE_DIR");
}

}  // namespace
}  // namespace gigaray
