// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/atomic_output.h"

#include "adapters/adapters_test.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

class AtomicOutput : public AdaptersTest {
 protected:
  // An output of the given kind with one file in it.
  void make_output(const std::string& name, const std::string& format, const std::string& file) {
    AtomicFolder out(folder / name, format);
    std::ofstream(out.path() / "gigaray.json") << "{\"format\": \"" + format + "\"}";
    std::ofstream(out.path() / file) << "x";
    out.commit();
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
  EXPECT_FALSE(fs::exists(folder / "out" / "old"));
  EXPECT_TRUE(fs::exists(folder / "out" / "new"));
}

TEST_F(AtomicOutput, EarlierOutputStaysWhenTheNewOneFails) {
  make_output("out", "kind", "old");
  { const AtomicFolder out(folder / "out", "kind"); }
  EXPECT_TRUE(fs::exists(folder / "out" / "old"));
  EXPECT_EQ(names(), std::set<std::string>{"out"});
}

TEST_F(AtomicOutput, EmptyFolderIsUsed) {
  fs::create_directory(folder / "out");
  make_output("out", "kind", "new");
  EXPECT_TRUE(fs::exists(folder / "out" / "new"));
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
  EXPECT_TRUE(fs::exists(folder / "other" / "precious"));
}

TEST_F(AtomicOutput, FolderThatIsFilledDuringTheRunIsRefused) {
  AtomicFolder out(folder / "out", "kind");
  fs::create_directory(folder / "out");
  write("out/precious", "x");
  expect_error(ErrorCode::kInvalidArgument, "out", [&] { out.commit(); });
  EXPECT_EQ(read("out/precious"), "x");
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
  expect_error(ErrorCode::kIo, "taken", [&] {
    AtomicFile file(folder / "taken");
    file.write("x");
    fs::create_directory(folder / "taken");
    file.commit();
  });
  EXPECT_EQ(names(), std::set<std::string>{"taken"});
}

}  // namespace
}  // namespace gigaray
