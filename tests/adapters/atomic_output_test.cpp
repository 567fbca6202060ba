// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/atomic_output.h"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <thread>

#include "adapters/adapters_test.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

class AtomicOutput : public AdaptersTest {
 protected:
  // An output of the given kind with one file in it.
  void make_output(const std::string& name, const std::string& kind, const std::string& file,
                   const OutputRules& rules = {}) {
    AtomicFolder out(folder / name, kind, rules);
    fs::create_directory(out.path() / "view");
    std::ofstream(out.path() / "view" / file) << "x";
    out.commit();
  }
  void make_file(const std::string& name, const std::string& text, const OutputRules& rules = {}) {
    AtomicFile file(folder / name, rules, {});
    file.write(text);
    file.commit();
  }
  void expect_refused(const std::string& name, const std::string& word,
                      const OutputRules& rules = {}) {
    expect_error(ErrorCode::kInvalidArgument, word,
                 [&] { AtomicFolder(folder / name, "kind", rules); });
  }
};

TEST_F(AtomicOutput, FolderAppearsWhenItIsComplete) {
  AtomicFolder out(folder / "a" / "b" / "out", "kind");
  std::ofstream(out.path() / "file") << "x";
  EXPECT_FALSE(fs::exists(folder / "a" / "b" / "out"));
  out.commit();
  EXPECT_EQ(read("a/b/out/file"), "x");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder / "a" / "b"), {}), 1);
}

TEST_F(AtomicOutput, NothingIsLeftWithoutCommit) {
  try {
    const AtomicFolder out(folder / "out", "kind");
    std::ofstream(out.path() / "file") << "x";
    throw std::runtime_error("stop");
  } catch (const std::runtime_error&) {
  }
  EXPECT_TRUE(names().empty());
}

TEST_F(AtomicOutput, EarlierOutputOfTheSameKindIsReplaced) {
  make_output("out", "kind", "old");
  make_output("out/", "kind", "new");
  EXPECT_EQ(names(), std::set<std::string>{"out"});
  EXPECT_FALSE(fs::exists(folder / "out" / "view" / "old"));
  EXPECT_TRUE(fs::exists(folder / "out" / "view" / "new"));
}

TEST_F(AtomicOutput, EarlierOutputStaysWhenTheNewOneFails) {
  make_output("out", "kind", "old");
  { const AtomicFolder out(folder / "out", "kind"); }
  EXPECT_TRUE(fs::exists(folder / "out" / "view" / "old"));
  EXPECT_EQ(names(), std::set<std::string>{"out"});
}

TEST_F(AtomicOutput, EmptyFolderIsUsed) {
  fs::create_directory(folder / "out");
  make_output("out", "kind", "new");
  EXPECT_TRUE(fs::exists(folder / "out" / "view" / "new"));
}

TEST_F(AtomicOutput, WhatSomebodyElseWroteIsRefused) {
  make_output("other", "other kind", "precious");
  fs::create_directory(folder / "photos");
  write("photos/precious.png", "x");
  write("file", "x");
  const auto before = names();
  for (const std::string name : {"other", "photos", "file"})
    expect_error(ErrorCode::kInvalidArgument, name, [&] { AtomicFolder(folder / name, "kind"); });
  EXPECT_EQ(names(), before);
  EXPECT_TRUE(fs::exists(folder / "other" / "view" / "precious"));
}

TEST_F(AtomicOutput, FolderThatIsFilledDuringTheRunIsRefused) {
  AtomicFolder out(folder / "out", "kind");
  fs::create_directory(folder / "out");
  write("out/precious", "x");
  expect_error(ErrorCode::kInvalidArgument, "out", [&] { out.commit(); });
  EXPECT_EQ(read("out/precious"), "x");
}

TEST_F(AtomicOutput, WhatWasAddedOrChangedInAnOutputIsKept) {
  for (const std::string added : {"notes.txt", "view/notes.txt", ".hidden", "empty/"}) {
    SCOPED_TRACE(added);
    make_output("out", "kind", "ours");
    if (added.ends_with('/'))
      fs::create_directory(folder / "out" / added);
    else
      write("out/" + added, "thesis");
    expect_refused("out", "OutputRules::replace");
    EXPECT_TRUE(fs::exists(folder / "out" / added));
    fs::remove_all(folder / "out");
  }
  make_output("out", "kind", "ours");
  write("out/view/ours", "retouched");
  expect_refused("out", "view/ours");
  EXPECT_EQ(read("out/view/ours"), "retouched");
}

TEST_F(AtomicOutput, ALinkInPlaceOfAnOutputsFolderLeadsNowhereElse) {
  make_output("out", "kind", "ours");
  fs::rename(folder / "out" / "view", folder / "elsewhere");
  fs::create_directory_symlink(folder / "elsewhere", folder / "out" / "view");
  expect_refused("out", "out");
  make_output("out", "kind", "new", {{}, true});
  EXPECT_EQ(read("elsewhere/ours"), "x");
}

TEST_F(AtomicOutput, AManifestFromSomewhereElseRemovesNothing) {
  write("precious", "x");
  make_output("out", "kind", "ours");
  std::string manifest = read("out/.gigaray-output.json");
  manifest.replace(manifest.find("view/ours"), 9, "../precious");
  write("out/.gigaray-output.json", manifest);
  expect_refused("out", "view");
  EXPECT_EQ(read("precious"), "x");
}

TEST_F(AtomicOutput, ReplaceMovesWhatIsInTheWayAside) {
  const OutputRules replace{{}, true};
  fs::create_directory(folder / "out");
  write("out/thesis", "x");
  make_output("out", "kind", "first", replace);
  write("out/notes", "y");
  make_output("out", "kind", "second", replace);
  EXPECT_EQ(names(), (std::set<std::string>{"out", "out.old-1", "out.old-2"}));
  EXPECT_EQ(read("out.old-1/thesis"), "x");
  EXPECT_EQ(read("out.old-2/notes"), "y");
  EXPECT_TRUE(fs::exists(folder / "out/view/second"));
}

TEST_F(AtomicOutput, InputAndOutputMayNotOverlap) {
  make_output("light field", "kind", "view.png");
  fs::create_directory_symlink(folder / "light field", folder / "link");
  for (const std::string input : {"light field", "light field/", "link", "light field/../link/."}) {
    const OutputRules rules{{folder / input}, true};
    SCOPED_TRACE(input);
    expect_refused("light field", "is what is read too", rules);
    expect_refused("link", "is what is read too", rules);
    expect_refused("light field/out", "lies in", rules);
    expect_refused("link/out", "lies in", rules);
  }
  fs::create_directory(folder / "all");
  fs::rename(folder / "light field", folder / "all" / "light field");
  expect_refused("all", "holds", {{folder / "all" / "light field"}, true});
  EXPECT_TRUE(fs::exists(folder / "all/light field/view/view.png"));
  // A name that begins alike is another one.
  make_output("all 2", "kind", "x", {{folder / "all"}, false});
}

TEST_F(AtomicOutput, TheFolderOneIsInIsRefused) {
  const fs::path before = fs::current_path();
  fs::create_directories(folder / "here" / "below");
  fs::current_path(folder / "here");
  for (const std::string name : {".", "./", "..", "../here", "below/.."})
    expect_error(ErrorCode::kInvalidArgument, "the folder you are in",
                 [&] { AtomicFolder(name, "kind"); });
  { AtomicFolder("below", "kind").commit(); }
  fs::current_path(before);
  EXPECT_TRUE(fs::exists(folder / "here/below/.gigaray-output.json"));
}

TEST_F(AtomicOutput, NamesThatCannotBeAreRefusedBeforeTheWork) {
  expect_error(ErrorCode::kInvalidArgument, "empty", [] { AtomicFolder("", "kind"); });
  expect_error(ErrorCode::kInvalidArgument, "empty", [] { AtomicFile("", {}, {}); });
  const std::string too_long(300, 'x');
  expect_error(ErrorCode::kIo, "too long", [&] { AtomicFolder(folder / too_long, "kind"); });
  expect_error(ErrorCode::kIo, "too long", [&] { AtomicFile(folder / too_long, {}, {}); });
  fs::create_symlink(folder / "nowhere", folder / "dangling");
  expect_refused("dangling", "leads nowhere");
  EXPECT_EQ(names(), std::set<std::string>{"dangling"});
}

TEST_F(AtomicOutput, AnyOtherNameIsFine) {
  const std::set<std::string> all{std::string(255, 'y'), "two\nlines", "caf\xe9", "-", "a%41 b"};
  for (const std::string& name : all) {
    make_output(name, "kind", "caf\xe9%");
    make_output(name, "kind", "caf\xe9%");
    EXPECT_TRUE(fs::exists(folder / name / "view" / "caf\xe9%"));
  }
  EXPECT_EQ(names(), all);
}

TEST_F(AtomicOutput, WhatADeadProcessLeftIsRemoved) {
  // A folder and a file that are being written, and an older output whose removal had begun.
  const pid_t child = fork();
  if (child == 0) {
    AtomicFolder out(folder / "out", "kind");
    std::ofstream(out.path() / "half") << "x";
    write(".gigaray-partial-file-abcdef", "x");
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(names().size(), 2u);
  make_output("other", "kind", "ours");
  fs::rename(folder / "other", folder / ".gigaray-partial-out-abcdef");
  make_output("out", "kind", "new");
  EXPECT_EQ(names(), std::set<std::string>{"out"});
}

TEST_F(AtomicOutput, WhatALivingProcessWritesIsLeftAlone) {
  AtomicFolder first(folder / "first", "kind");
  std::ofstream(first.path() / "half") << "x";
  make_output("second", "kind", "new");
  EXPECT_TRUE(fs::exists(first.path() / "half"));
  first.commit();
  EXPECT_EQ(names(), (std::set<std::string>{"first", "second"}));
}

TEST_F(AtomicOutput, AnOutputThatLostItsNameBetweenTwoRenamesGetsItBack) {
  make_output("out", "kind", "older");
  fs::rename(folder / "out", folder / ".gigaray-partial-out-abcdef");
  make_output("another", "kind", "new");
  EXPECT_EQ(names(), (std::set<std::string>{"out", "another"}));
  EXPECT_TRUE(fs::exists(folder / "out/view/older"));
}

TEST_F(AtomicOutput, FoldersAboveAreRemovedWithoutCommit) {
  { const AtomicFolder out(folder / "a" / "b" / "out", "kind"); }
  EXPECT_TRUE(names().empty());
}

TEST_F(AtomicOutput, ACancelledRunIsKeptOnceItIsInPlaceOnly) {
  RunControl early;
  early.cancel();
  {
    AtomicFolder out(folder / "out", "kind");
    expect_error(ErrorCode::kCancelled, "nothing was kept", [&] { out.commit(early); });
  }
  EXPECT_TRUE(names().empty());
  RunControl late;
  AtomicFolder out(folder / "out", "kind");
  out.commit(late);
  late.cancel();
  EXPECT_NO_THROW(late.progress("write", 1, 1));
}

TEST_F(AtomicOutput, PlaceThatCannotBeWrittenIsNamed) {
  write("file", "x");
  expect_error(ErrorCode::kIo, "file/out", [&] { AtomicFolder(folder / "file" / "out", "kind"); });
}

TEST_F(AtomicOutput, FileIsReplacedWhole) {
  write_file_atomically(folder / "file", "first");
  write_file_atomically(folder / "file", "second");
  EXPECT_EQ(read("file"), "second");
  EXPECT_EQ(names(), std::set<std::string>{"file"});
}

TEST_F(AtomicOutput, FolderIsNoNameForAFile) {
  fs::create_directory(folder / "taken");
  expect_error(ErrorCode::kInvalidArgument, "taken: is a folder",
               [&] { write_file_atomically(folder / "taken", "x"); });
  EXPECT_EQ(names(), std::set<std::string>{"taken"});
}

TEST_F(AtomicOutput, TemporaryFileIsRemovedWhenTheNameIsTakenMeanwhile) {
  expect_error(ErrorCode::kInvalidArgument, "taken: is a folder", [&] {
    AtomicFile file(folder / "taken");
    file.write("x");
    fs::create_directory(folder / "taken");
    file.commit();
  });
  EXPECT_EQ(names(), std::set<std::string>{"taken"});
}

TEST_F(AtomicOutput, AFileOfSomebodyElseIsRefused) {
  write("scene.ply", "mine");
  expect_error(ErrorCode::kInvalidArgument, "OutputRules::replace",
               [&] { make_file("scene.ply", "new"); });
  EXPECT_EQ(read("scene.ply"), "mine");
  make_file("scene.ply", "new", {{}, true});
  EXPECT_EQ(read("scene.ply"), "new");
  EXPECT_EQ(read("scene.ply.old-1"), "mine");
  make_file("scene.ply", "newer");
  EXPECT_EQ(names(), (std::set<std::string>{"scene.ply", "scene.ply.old-1"}));
  write("scene.ply", "edited");
  expect_error(ErrorCode::kInvalidArgument, "OutputRules::replace",
               [&] { make_file("scene.ply", "x"); });
  EXPECT_EQ(read("scene.ply"), "edited");
}

TEST_F(AtomicOutput, AFileThatAppearsDuringTheRunIsKept) {
  AtomicFile file(folder / "scene.ply", {}, {".ply"});
  file.write("new");
  write("scene.ply", "mine");
  expect_error(ErrorCode::kInvalidArgument, "scene.ply", [&] { file.commit(); });
  EXPECT_EQ(read("scene.ply"), "mine");
}

TEST_F(AtomicOutput, AFileThatIsReadIsRefused) {
  make_file("a.grl", "x");
  fs::create_symlink("a.grl", folder / "link.grl");
  for (const std::string name : {"a.grl", "link.grl"})
    expect_error(ErrorCode::kInvalidArgument, "is what is read too", [&] {
      make_file(name, "y", {{folder / "a.grl"}, true});
    });
}

TEST_F(AtomicOutput, TheNameOfAFileEndsInOneOfItsFormats) {
  expect_error(ErrorCode::kInvalidArgument, ".ply, .obj", [&] {
    AtomicFile(folder / "picture.png", {}, {".ply", ".obj"});
  });
  AtomicFile(folder / "UPPER.PLY", {}, {".ply"}).commit();
  EXPECT_EQ(names(), std::set<std::string>{"UPPER.PLY"});
}

TEST_F(AtomicOutput, AnEmptyFileIsAPlaceForOne) {
  write("made by mktemp", "");
  make_file("made by mktemp", "x");
  EXPECT_EQ(read("made by mktemp"), "x");
}

TEST_F(AtomicOutput, ALinkStaysALink) {
  make_file("real", "old");
  fs::create_symlink("real", folder / "link");
  make_file("link", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(read("real"), "new");
}

TEST_F(AtomicOutput, DevicesAndPipesAreWrittenTo) {
  make_file("/dev/null", "x");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  expect_error(ErrorCode::kIo, "/dev/full", [&] { make_file("/dev/full", "x"); });
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  std::string got;
  std::thread reader([&] { got = read("pipe"); });
  make_file("pipe", "through");
  reader.join();
  EXPECT_EQ(got, "through");
  EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
}

}  // namespace
}  // namespace gigaray
