// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// What all commands share: help, exit codes, one line per failure, Ctrl-C. And `info`.
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "cli/program_test.h"
#include "gigaray/adapters/pictures.h"

namespace gigaray {
namespace {

class Frame : public ProgramTest {
 protected:
  void save_pictures(const std::string& name) const {
    std::filesystem::create_directories(folder / name);
    for (const std::string picture : {"v1.png", "v2.png"})
      write_png(folder / name / picture, Image<std::uint16_t>(9, 7, 3, 77), 8);
  }
};

class Info : public ProgramTest {
 protected:
  void save(const std::string& name, int width = 9, int height = 7) const {
    std::filesystem::create_directories((folder / name).parent_path());
    write_png(folder / name, Image<std::uint16_t>(width, height, 3, 77), 8);
  }
};

TEST_F(Frame, HelpListsTheCommands) {
  const Result result = run("--help");
  EXPECT_EQ(result.exit_code, 0);
  for (const std::string command : {"info", "depth", "synth", "evaluate", "probe", "devices"})
    EXPECT_NE(result.out.find("  " + command), std::string::npos) << result.out;
  EXPECT_EQ(result.err, "");
}

TEST_F(Frame, EveryCommandHasHelp) {
  for (const std::string command : {"info", "depth", "synth", "evaluate", "probe", "devices"}) {
    const Result result = run(command + " --help");
    EXPECT_EQ(result.exit_code, 0) << command;
    EXPECT_NE(result.out.find("Usage: gigaray " + command), std::string::npos) << result.out;
  }
}

TEST_F(Frame, VersionIsPrinted) {
  const Result result = run("--version");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_TRUE(result.out.starts_with("gigaray 0.")) << result.out;
}

TEST_F(Frame, WrongUsageEndsWithTwo) {
  expect_failure("", 2, "gigaray:", "--help");
  expect_failure("nonsense", 2, "nonsense", "gigaray --help");
  expect_failure("info", 2, "gigaray info:", "INPUT");
  expect_failure("info . --nonsense", 2, "--nonsense", "gigaray info --help");
  expect_failure("info . --direction sideways", 2, "--direction", "sideways");
}

TEST_F(Frame, HelpGroupsTheCommandsInTheOrderOfUse) {
  const std::string help = run("--help").out;
  std::size_t before = 0;
  for (const std::string word :
       {"Look first", "  info ", "Make depth", "  depth ", "Use it:", "  segment ", "Keep it",
        "  encode ", "Measure it", "  evaluate ", "Try it", "  synth "}) {
    const std::size_t at = help.find(word);
    ASSERT_NE(at, std::string::npos) << word << "\n" << help;
    EXPECT_GT(at, before) << word << "\n" << help;
    before = at;
  }
}

TEST_F(Frame, HelpIsFoundWhereItIsLookedFor) {
  const std::string all = run("--help").out, of_depth = run("depth --help").out;
  EXPECT_EQ(run("help").out, all);
  EXPECT_EQ(run("-h").out, all);
  EXPECT_EQ(run("help --help").out, all);
  for (const std::string line :
       {"help depth", "depth help", "--help depth", "-h depth", "depth -h"}) {
    const Result result = run(line);
    EXPECT_EQ(result.exit_code, 0) << line;
    EXPECT_EQ(result.out, of_depth) << line;
  }
  expect_failure("help dpeth", 2, "no command 'dpeth'", "did you mean depth?");
  // A folder of this name is an input.
  save_pictures("help");
  EXPECT_NE(run("info help").out.find("image sequence"), std::string::npos);
}

TEST_F(Frame, TyposAreAnsweredWithWhatWasMeant) {
  expect_failure("dpeth made", 2, "no command 'dpeth'", "did you mean depth?");
  expect_failure("seg out", 2, "did you mean segment?");
  expect_failure("Depth", 2, "did you mean depth?");
  expect_failure("depth made -o out --disparty 0 1", 2, "--disparty", "did you mean --disparity?");
  expect_failure("depth made -o out --disparty=0", 2, "no option --disparty;", "--disparity?");
  expect_failure("depth made --ouput out", 2, "no option --ouput", "did you mean --output?");
  expect_failure("depth made -o out --max_size 9", 2, "did you mean --max-size?");
  expect_failure("segment out -o x --toleranz 1 --at 1 1", 2, "did you mean --tolerance?");
  expect_failure("--versoin", 2, "did you mean --version?");
  expect_failure("depth made -o out --format png61", 2, "--format", "did you mean png16?");
  expect_failure("depth made -o out --preset atuo", 2, "--preset", "did you mean auto?");
  expect_failure("mesh out -o x.ply --method possion", 2, "did you mean poisson?");
  expect_failure("synth gardn -o x", 2, "'gardn'", "did you mean garden?");
  expect_failure("synth planes -o x --path lnie", 2, "--path", "did you mean line?");
  expect_failure("info made --convention opengel", 2, "--convention", "did you mean opengl?");
  expect_failure("info made --direction rigth", 2, "--direction", "did you mean right?");
  save_pictures("row");
  expect_failure("depth row -o x --direction right --views v_1 --disparity 0 1", 2, "v_1", "v1");
}

TEST_F(Frame, WhatIsNearNothingGetsNoSuggestion) {
  for (const std::string line :
       {"nonsense", "info . --nonsense", "depth made -o out --format tiff", "x"}) {
    const Result result = run(line);
    EXPECT_EQ(result.exit_code, 2) << line;
    EXPECT_EQ(result.err.find("did you mean"), std::string::npos) << line << ": " << result.err;
  }
}

TEST_F(Frame, ResultThatCannotBePrintedIsAFailure) {
  for (int i = 1; i <= 2; ++i)
    write_png(folder / ("v" + std::to_string(i) + ".png"), Image<std::uint16_t>(9, 7, 3), 8);
  const int status = std::system(
      ("cd '" + folder.string() + "' && '" + GIGARAY_PROGRAM + "' info . >/dev/full 2>.err")
          .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_NE(text_of(".err").find("gigaray info:"), std::string::npos);
}

TEST_F(Frame, InterruptLeavesNothingBehind) {
  using namespace std::chrono_literals;
  std::filesystem::create_directory(folder / "work");
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const bool moved = chdir((folder / "work").c_str()) == 0;
    if (moved && std::freopen("../.out", "w", stdout) && std::freopen("../.err", "w", stderr))
      execl(GIGARAY_PROGRAM, "gigaray", "synth", "garden", "-o", "out", "--views", "400", nullptr);
    _exit(99);
  }
  const auto begin = std::chrono::steady_clock::now();
  while (names_in("work").empty() && std::chrono::steady_clock::now() - begin < 60s)
    std::this_thread::sleep_for(20ms);
  EXPECT_FALSE(names_in("work").empty()) << "it is at work now";
  kill(child, SIGINT);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_TRUE(names_in("work").empty());
  EXPECT_NE(text_of(".err").find("gigaray synth: stopped"), std::string::npos) << text_of(".err");
}

TEST_F(Info, TellsWhatAFolderIs) {
  for (const std::string number : {"9", "10", "11"}) save("v" + number + ".png");
  const Result result = run("info .");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  for (const std::string word : {"image sequence, 3D", "3, v9 … v11", "9 × 7 px, 8 bit", "-1 … 1",
                                 "v10", "assumed to move to the right"})
    EXPECT_NE(result.out.find(word), std::string::npos) << word << "\n" << result.out;
}

TEST_F(Info, DrawsTheGrid) {
  for (const std::string camera : {"036", "037", "040", "044", "004", "076"})
    save("input_Cam" + camera + ".png");
  const Result result = run("info .");
  EXPECT_NE(result.out.find(" . . . . x . . . .\n"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find(" x x . . O . . . x\n"), std::string::npos) << result.out;
}

TEST_F(Info, DrawsMeasuredPositionsAndHoles) {
  for (const std::string place : {"0_0_0.4_0.1", "0_1_-0.3_10.2", "0_2_0.2_19.7", "1_0_10.1_-0.4",
                                  "1_2_10.3_20.1", "2_0_19.8_0.2", "2_1_20.2_9.9", "2_2_20.0_20.3"})
    save("out_" + place + ".png");
  const Result result = run("info .");
  EXPECT_NE(result.out.find(" x . "), std::string::npos) << result.out;  // the hole
  EXPECT_NE(result.out.find("Stanford archive, 4D"), std::string::npos) << result.out;
}

TEST_F(Info, JsonHoldsTheViews) {
  save("v1.png");
  save("v2.png");
  const Result result = run("info . --direction left --json");
  const auto json = nlohmann::json::parse(result.out);
  EXPECT_EQ(json.at("kind"), "3D");
  EXPECT_EQ(json.at("width"), 9);
  EXPECT_EQ(json.at("sign_is_assumed"), false);
  EXPECT_TRUE(json.at("disparity_range").is_null());
  ASSERT_EQ(json.at("views").size(), 2);
  EXPECT_EQ(json.at("views")[0].at("name"), "v1");
  EXPECT_EQ(json.at("views")[0].at("s"), 0.5);
}

TEST_F(Info, BadInputEndsWithOne) {
  expect_failure("info nowhere", 1, "gigaray info: nowhere", "no such file");
  std::filesystem::create_directory(folder / "empty");
  expect_failure("info empty", 1, "empty", "no pictures");
  save("mixed/v1.png");
  expect_failure("info mixed", 1, "only one picture");
  save("mixed/v2.png", 9, 8);
  expect_failure("info mixed", 1, "v2.png", "9×8");
}

TEST_F(Info, OptionsThatContradictEndWithTwo) {
  save("v1.png");
  save("v2.png");
  expect_failure("info . --positions places.txt --direction left", 2, "--direction", "--positions");
}

}  // namespace
}  // namespace gigaray
