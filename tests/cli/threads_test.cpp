// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// --threads: what is computed does not depend on it.
#include "program_test.h"

namespace gigaray {
namespace {

using Threads = ProgramTest;

TEST_F(Threads, TheResultDoesNotDependOnTheirNumber) {
  ASSERT_EQ(run("synth garden -o made --width 96 --height 64 --views 5").exit_code, 0);
  for (const std::string device : {"", " --device reference"}) {
    for (const std::string threads : {"1", "2", "7"}) {
      const Result result = run("depth made -o out" + threads + " --views centre --hypotheses 9" +
                                device + " --threads " + threads);
      ASSERT_EQ(result.exit_code, 0) << result.err;
    }
    for (const std::string other : {"out2", "out7"})
      for (const std::string map : {"/disparity.pfm", "/confidence.pfm"})
        EXPECT_EQ(text_of("out1" + map), text_of(other + map)) << other << map << device;
    EXPECT_GT(text_of("out1/disparity.pfm").size(), 96u * 64 * 4);
  }
}

TEST_F(Threads, MustBeOneOrMore) {
  for (const std::string threads : {"0", "-1", "two", "1.5"})
    expect_failure("depth made -o out --threads " + threads, 2, "--threads");
}

TEST_F(Threads, GoWithTheCommandsThatHaveALimitOfMemory) {
  for (const std::string command : {"info", "depth", "probe", "encode", "render", "evaluate"})
    EXPECT_NE(run(command + " --help").out.find("--threads"), std::string::npos) << command;
  expect_failure("devices --threads 2", 2, "--threads");
}

}  // namespace
}  // namespace gigaray
