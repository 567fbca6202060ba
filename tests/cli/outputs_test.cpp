// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Nothing of a user's is lost: what commands do to what is in their way, and to what is left when
// they are killed.
#include <sys/stat.h>

#include <map>

#include "cli/program_test.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

/// Every file below a folder with its bytes, every link with its target.
using Snapshot = std::map<std::string, std::string>;

class Outputs : public ProgramTest {
 protected:
  Outputs() {
    make("lf", "--views 5");
    make("other", "--views 3");
    expect_done("depth lf -o out --device reference --preset paper --hypotheses 16");
  }

  void make(const std::string& name, const std::string& options) const {
    expect_done("synth planes --width 48 --height 37 --samples 1 -o " + name + " " + options);
  }
  void expect_done(const std::string& arguments, const std::string& environment = "") const {
    const Result result = run(arguments, environment);
    ASSERT_EQ(result.exit_code, 0) << arguments << ": " << result.err;
  }
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder / name).parent_path());
    std::ofstream(folder / name, std::ios::binary) << text;
  }
  Snapshot snapshot() const {
    Snapshot all;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const std::string name = entry.path().lexically_relative(folder).string();
      if (name == ".out" || name == ".err") continue;
      all[name] = entry.is_symlink()        ? "-> " + fs::read_symlink(entry).string()
                  : entry.is_regular_file() ? text_of(name)
                  : entry.is_directory()    ? "folder"
                                            : "special";
    }
    return all;
  }
  /// Refused with one line, and every byte below the folder is what it was.
  void expect_untouched(const std::string& arguments, const std::string& word) const {
    const Snapshot before = snapshot();
    expect_refusal(arguments, 2, word);
    EXPECT_EQ(snapshot(), before) << arguments;
  }
  std::set<std::string> visible_and_hidden() const { return names_in("."); }
};

TEST_F(Outputs, ForeignFilesInOutputFoldersStay) {
  const std::map<std::string, std::string> commands{
      {"depth", "depth lf --device reference --preset paper --hypotheses 8 --views centre"},
      {"decode", "decode lf.grl"},
      {"segment", "segment out --near 0.5 --far -0.5"},
      {"render", "render out --pose 0.5,0"},
      {"probe", "probe lf --at 3 3 --device reference"},
      {"synth", "synth planes --width 48 --height 37 --views 3 --samples 1"},
      {"photographs", "synth planes --path line --width 64 --height 48 --views 3 --samples 1"}};
  expect_done("encode lf -o lf.grl --depth out");
  for (const auto& [name, command] : commands) {
    SCOPED_TRACE(name);
    const std::string target = name + "_out";
    // A folder of somebody else, also one that calls itself ours.
    write(target + "/thesis.tex", "mine");
    expect_untouched(command + " -o " + target, target + ": is not empty");
    write(target + "/gigaray.json", text_of("out/gigaray.json"));
    expect_untouched(command + " -o " + target, target);
    fs::remove_all(folder / target);
    // An output of ours in which somebody keeps something, or changed something.
    expect_done(command + " -o " + target);
    expect_done(command + " -o " + target);
    write(target + "/points.ply", "mine");
    expect_untouched(command + " -o " + target, "points.ply");
    fs::remove(folder / target / "points.ply");
    fs::create_directory(folder / target / "notes");
    expect_untouched(command + " -o " + target, "notes");
    expect_done(command + " --replace -o " + target);
    EXPECT_TRUE(fs::exists(folder / (target + ".old-1") / "notes"));
    EXPECT_FALSE(fs::exists(folder / target / "notes"));
  }
}

TEST_F(Outputs, InputsAreNeverReplaced) {
  expect_done("encode lf -o lf.grl --depth out");
  fs::create_directory_symlink("lf", folder / "link");
  for (const std::string target : {"lf", "lf/", "./lf", "link", "lf/truth/../"})
    expect_untouched("depth lf --device reference -o " + target, "is what is read too");
  expect_untouched("depth link --device reference -o lf --replace", "is what is read too");
  expect_untouched("depth lf --device reference -o lf/new", "lies in");
  expect_untouched("segment out --near 1 --far 0 -o out", "is what is read too");
  expect_untouched("render out --pose 0,0 -o out/frames --replace", "lies in");
  expect_untouched("rectify lf -o lf --replace", "is what is read too");
  expect_untouched("compare lf -o lf", "is what is read too");
  fs::create_directory(folder / "project");
  fs::rename(folder / "lf.grl", folder / "project" / "lf.grl");
  expect_untouched("decode project/lf.grl -o project --replace", "holds");
  expect_untouched("encode project/lf.grl -o project/lf.grl", "is what is read too");
  expect_untouched("encode project/lf.grl -o project/lf.grl --replace", "is what is read too");
}

TEST_F(Outputs, ALightFieldThatAnotherCommandWroteIsNoPlace) {
  expect_untouched("depth other --device reference -o lf", "another kind");
  expect_untouched("synth planes -o out", "another kind");
}

TEST_F(Outputs, ForeignFilesInPlaceOfOutputFilesStay) {
  const std::map<std::string, std::string> commands{
      {"a.grl", "encode lf --depth out -o "},
      {"a.ply", "cloud out --min-support 0 --min-confidence 0 -o "},
      {"a.glb", "mesh out --min-support 0 --min-confidence 0 -o "},
      {"a.csv", "evaluate out lf --border 2 --csv "},
      {"a.png", "evaluate out lf --border 2 --error-map "}};
  for (const auto& [file, command] : commands) {
    SCOPED_TRACE(file);
    write(file, "mine");
    expect_untouched(command + file, "did not write it");
    fs::create_symlink(file, folder / ("link_" + file));
    expect_untouched(command + "link_" + file, "did not write it");
    expect_untouched(command + "lf/view_000.png", "lf/view_000.png");
    expect_untouched(command + "lf", "lf");
    ASSERT_EQ(mknod((folder / "socket").c_str(), S_IFSOCK | 0600, 0), 0);
    expect_untouched(command + "socket", "socket");
    fs::remove(folder / "socket");
    expect_done(command + file + " --replace");
    EXPECT_EQ(text_of(file + ".old-1"), "mine");
    expect_done(command + file);
    EXPECT_FALSE(fs::exists(folder / (file + ".old-2")));
  }
  EXPECT_EQ(run("cloud out -o /dev/null --min-support 0 --min-confidence 0").exit_code, 0);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(Outputs, SeveralFilesOfACommandAppearTogetherOrNotAtAll) {
  write("b.png", "mine");
  expect_untouched("evaluate out lf --border 2 --csv a.csv --error-map b.png", "b.png");
}

TEST_F(Outputs, NamesThatAreNoneAreRefusedBeforeTheWork) {
  expect_untouched("depth lf -o ''", "empty");
  expect_untouched("cloud out -o ''", "empty");
  expect_untouched("depth lf -o .", "the folder you are in");
  expect_untouched("cloud out -o .", ".");
  const std::string longest(255, 'n');
  expect_done("synth planes --width 48 --height 37 --views 3 -o " + longest);
  expect_refusal("synth planes -o " + longest + "n", 1, "too long");
}

TEST_F(Outputs, NamesInLatin1AreFoundAgain) {
  fs::rename(folder / "lf", folder / "caf\xe9");
  for (const std::string view : {"000", "001", "002", "003", "004"})
    fs::rename(folder / "caf\xe9" / ("view_" + view + ".png"),
               folder / "caf\xe9" / ("vue_\xe9_" + view + ".png"));
  fs::remove(folder / "caf\xe9/gigaray.json");
  expect_done("depth caf\xe9 -o r\xe9sultat --disparity -1 1 --device reference");
  EXPECT_TRUE(fs::exists(folder / "r\xe9sultat/vue_%E9_002/disparity.pfm"));
  expect_done("render r\xe9sultat --pose vue_%E9_002 -o rendu");
  expect_done("depth caf\xe9 -o r\xe9sultat --disparity -1 1 --device reference --views centre");
}

TEST_F(Outputs, WhereverItIsKilledTheOldOrTheNewResultIsThere) {
  const std::string preload = std::string("LD_PRELOAD=") + GIGARAY_KILL_AT_RENAME;
  struct Case {
    std::string command, output, file;
  };
  const std::vector<Case> cases{
      {"synth planes --width 48 --height 37 --samples 1 --views 2 --seed ", "made",
       "made/truth.pfm"},
      {"encode made --device reference --preset paper --hypotheses 8 --band ", "a.grl", "a.grl"}};
  for (const Case& c : cases) {
    SCOPED_TRACE(c.command);
    const auto once = [&](int variant, const std::string& environment) {
      return run(c.command + std::to_string(variant) + " -o " + c.output, environment).exit_code;
    };
    ASSERT_EQ(once(11, ""), 0);
    const std::string first = text_of(c.file);
    fs::remove_all(folder / c.output);
    ASSERT_EQ(once(12, ""), 0);
    const std::string second = text_of(c.file);
    ASSERT_NE(first, second);
    const std::set<std::string> names = names_in(".");
    bool old = false, anew = false, ended = false;
    for (int at = 1; !ended && at < 200; ++at)
      for (const std::string after : {"", "+"}) {
        SCOPED_TRACE(std::to_string(at) + after);
        ASSERT_EQ(once(12, ""), 0);
        // Every name but that of a dead process's remains, which the next run removes.
        ASSERT_EQ(names_in("."), names);
        const int code =
            once(11, preload + " GIGARAY_KILL_AT=" + std::to_string(at) + after + " exec");
        ended = code == 0;
        const std::string now = text_of(c.file);
        ASSERT_TRUE(now == first || now == second);
        old = old || now == second;
        anew = anew || (now == first && !ended);
      }
    EXPECT_TRUE(ended && old && anew) << "kills before and after the exchange were met";
  }
}

TEST_F(Outputs, WithoutAnExistingResultAKillLeavesNoneOrAWholeOne) {
  const std::string preload = std::string("LD_PRELOAD=") + GIGARAY_KILL_AT_RENAME;
  const std::string command = "synth planes --width 48 --height 37 --samples 1 --views 2 -o made";
  const std::set<std::string> before = names_in(".");
  bool ended = false;
  for (int at = 1; !ended && at < 200; ++at) {
    ended =
        run(command, preload + " GIGARAY_KILL_AT=" + std::to_string(at) + " exec").exit_code == 0;
    EXPECT_EQ(fs::exists(folder / "made"), ended);
    expect_done(command);
    EXPECT_TRUE(fs::exists(folder / "made/gigaray.json"));
    fs::remove_all(folder / "made");
    EXPECT_EQ(names_in("."), before);
  }
  EXPECT_TRUE(ended);
}

TEST_F(Outputs, ClosedAndFullDescriptorsDoNotChangeTheResult) {
  const std::string encode = "encode lf --device reference --preset paper --hypotheses 8 -o ";
  expect_done(encode + "right.grl");
  const std::string right = text_of("right.grl");
  const auto run_with = [&](const std::string& redirections, const std::string& name) {
    const std::string command = "cd '" + folder.string() + "' && '" + GIGARAY_PROGRAM + "' " +
                                encode + name + " " + redirections;
    const int status = std::system(command.c_str());
    EXPECT_TRUE(WIFEXITED(status)) << redirections;
    EXPECT_EQ(text_of(name), right) << redirections;
    return WEXITSTATUS(status);
  };
  EXPECT_EQ(run_with(">.out 2>&-", "a.grl"), 0);
  EXPECT_EQ(run_with(">.out 2>/dev/full", "b.grl"), 0);
  EXPECT_EQ(run_with("<&- >.out 2>.err", "c.grl"), 0);
  // What was asked for on stdout is missing: a failure, with the file in place all the same.
  EXPECT_EQ(run_with(">&- 2>.err", "d.grl"), 1);
  EXPECT_NE(text_of(".err").find("the output itself is in place"), std::string::npos);
  EXPECT_EQ(run_with(">/dev/full 2>.err", "e.grl"), 1);
  EXPECT_EQ(run_with("<&- >&- 2>&-", "f.grl"), 1);
  EXPECT_EQ(run_with("2>&1 | head -c 0; exit 0", "g.grl"), 0);
  for (const std::string command : {"", "--help", "nonsense", "info nowhere", "depth"}) {
    const int status = std::system(("cd '" + folder.string() + "' && '" + GIGARAY_PROGRAM + "' " +
                                    command + " >/dev/full 2>/dev/full")
                                       .c_str());
    EXPECT_TRUE(WIFEXITED(status)) << command;
    EXPECT_LE(WEXITSTATUS(status), 2) << command;
  }
}

}  // namespace
}  // namespace gigaray
