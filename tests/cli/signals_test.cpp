// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <fcntl.h>
#include <signal.h>

#include "cli/program_test.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

class Signals : public ProgramTest {
 protected:
  /// A run that takes long, at work.
  pid_t begin() const {
    const pid_t child = start({"synth", "garden", "-o", "out", "--views", "400"});
    EXPECT_TRUE(wait_until([&] { return !names_in(".").empty(); }));
    return child;
  }
  static int status_of(pid_t child) {
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    return status;
  }
};

TEST_F(Signals, EachEndsWithItsOwnCodeAndLeavesNothing) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXCPU}) {
    const pid_t child = begin();
    kill(child, signal);
    const int status = status_of(child);
    ASSERT_TRUE(WIFEXITED(status)) << signal;
    EXPECT_EQ(WEXITSTATUS(status), 128 + signal);
    EXPECT_NE(text_of(".err").find("gigaray synth: stopped"), std::string::npos) << signal;
    EXPECT_TRUE(names_in(".").empty()) << signal;
  }
}

TEST_F(Signals, UnderNohupAHangupIsNone) {
  signal(SIGHUP, SIG_IGN);
  const pid_t child = begin();
  signal(SIGHUP, SIG_DFL);
  kill(child, SIGHUP);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(waitpid(child, nullptr, WNOHANG), 0) << "it goes on";
  kill(child, SIGTERM);
  EXPECT_EQ(WEXITSTATUS(status_of(child)), 143);
  EXPECT_TRUE(names_in(".").empty());
}

TEST_F(Signals, AtAnyMomentEitherNothingOrAllWasKept) {
  // A signal every few milliseconds of a run: before, around and after the commit.
  const std::vector<std::string> command{"synth", "planes",  "-o", "out",      "--views",
                                         "3",     "--width", "64", "--height", "48"};
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  ASSERT_EQ(WEXITSTATUS(status_of(start(command))), 0);
  const auto whole = Clock::now() - begin;
  fs::remove_all(folder / "out");
  constexpr int kMoments = 60;
  int stopped = 0;
  for (int i = 0; i < kMoments; ++i) {
    const pid_t child = start(command);
    std::this_thread::sleep_for(whole * i / kMoments * 1.2);
    kill(child, i % 2 ? SIGTERM : SIGINT);
    const int status = status_of(child);
    const bool kept = fs::exists(folder / "out/gigaray.json");
    // Killed before or after the program listens, or as it says.
    if (WIFEXITED(status)) {
      EXPECT_EQ(kept, WEXITSTATUS(status) == 0) << text_of(".err");
      EXPECT_EQ(text_of(".err").find("nothing was kept") != std::string::npos,
                WEXITSTATUS(status) > 128);
    }
    stopped += !kept;
    fs::remove_all(folder / "out");
    EXPECT_TRUE(names_in(".").empty());
  }
  EXPECT_GT(stopped, 0);
}

TEST_F(Signals, WhileKernelsAreBuiltIsAStopToo) {
  // LLVM, which PoCL builds with, handles signals too while it does: it throws away its files.
  ASSERT_EQ(run("synth planes -o made --views 3 --width 48 --height 37").exit_code, 0);
  for (int i = 0; i < 30; ++i) {
    const pid_t child = start({"depth", "made", "-o", "out"});
    ASSERT_TRUE(wait_until([&] { return text_of(".err").find("level 0") != std::string::npos; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(5 * i));
    kill(child, SIGINT);
    const int status = status_of(child);
    const bool kept = fs::exists(folder / "out/gigaray.json");
    if (WIFEXITED(status)) {
      EXPECT_EQ(WEXITSTATUS(status), kept ? 0 : 130) << text_of(".err");
    }
    EXPECT_TRUE(kept || !fs::exists(folder / "out"));
    fs::remove_all(folder / "out");
  }
}

TEST_F(Signals, APipeThatNobodyReadsDoesNotStopTheWork) {
  const std::string command = "cd '" + folder.string() + "' && '" + GIGARAY_PROGRAM +
                              "' synth planes -o out --views 5 2>&1 | head -c 1 >.out";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_TRUE(fs::exists(folder / "out/gigaray.json"));
}

}  // namespace
}  // namespace gigaray
