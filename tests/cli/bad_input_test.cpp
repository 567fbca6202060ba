// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// What a user may do wrong, and what may go wrong under a run: one line that names the file or the
// option, the right exit code, and nothing that looks like a result.
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <opencv2/imgcodecs.hpp>

#include "cli/program_test.h"
#include "gigaray/adapters/pictures.h"

namespace gigaray {
namespace {

using Names = std::set<std::string>;
namespace fs = std::filesystem;

class BadInput : public ProgramTest {
 protected:
  BadInput() { make("--views 5 --width 48 --height 37"); }

  void make(const std::string& options) const {
    const Result result = run("synth planes -o made --samples 2 " + options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
  }
  /// A picture in which every pixel has another colour.
  void save(const std::string& name, int width = 40, int height = 30) const {
    fs::create_directories((folder / name).parent_path());
    cv::Mat picture(height, width, CV_8UC3);
    for (int v = 0; v < height; ++v)
      for (int u = 0; u < width; ++u)
        picture.at<cv::Vec3b>(v, u) = cv::Vec3b(uchar(37 * u + 5 * v), uchar(11 * v), uchar(7 * u));
    ASSERT_TRUE(cv::imwrite((folder / name).string(), picture));
  }
  void cut_short(const std::string& name) const {
    fs::resize_file(folder / name, fs::file_size(folder / name) / 2);
  }
};

TEST_F(BadInput, AFolderThatIsNoLightFieldIsNamed) {
  fs::create_directory(folder / "empty");
  save("one/v1.png");
  save("mixed/v1.png");
  save("mixed/v2.png", 40, 31);
  for (const std::string command : {"depth ", "probe "}) {
    const std::string rest = command == "probe " ? " -o out --at 1 1" : " -o out";
    expect_refusal(command + "nowhere" + rest, 1, "nowhere");
    expect_refusal(command + "empty" + rest, 1, "empty");
    expect_refusal(command + "one" + rest, 1, "one", "only one picture");
    expect_refusal(command + "mixed" + rest, 1, "v2.png", "40×31");
  }
}

TEST_F(BadInput, APictureThatWasCutShortIsNamed) {
  for (const std::string extension : {".png", ".jpg"}) {
    const std::string name = "cut" + extension.substr(1);
    for (int i = 1; i <= 3; ++i) save(name + "/v" + std::to_string(i) + extension);
    cut_short(name + "/v2" + extension);
    // Without --strict it is left out.
    expect_refusal("depth " + name + " -o out --disparity -1 1 --strict", 1, "v2" + extension);
    expect_refusal("probe " + name + " -o out --at 1 1 --disparity -1 1 --strict", 1,
                   "v2" + extension);
    fs::resize_file(folder / name / ("v2" + extension), 0);
    expect_refusal("depth " + name + " -o out --strict", 1, "v2" + extension);
  }
}

TEST_F(BadInput, APositionsFileThatDoesNotFitIsNamed) {
  for (int i = 1; i <= 3; ++i) save("row/v" + std::to_string(i) + ".png");
  const auto write = [&](const std::string& text) { std::ofstream(folder / "places.txt") << text; };
  const std::string command = "depth row -o out --positions places.txt";
  expect_refusal(command, 1, "places.txt");
  write("0\n1\n");
  expect_refusal(command, 1, "places.txt");
  write("0\n1\n2\n3\n");
  expect_refusal(command, 1, "places.txt");
  write("0\n1\nfar\n");
  expect_refusal(command, 1, "places.txt");
  write("0\n1\n1\n");
  expect_refusal(command, 1, "places.txt");
}

TEST_F(BadInput, ADisparityRangeThatCannotBeSampledIsNamed) {
  const auto expect = [&](const std::string& options, const std::string& word) {
    expect_refusal("depth made -o out " + options, 2, word);
    expect_refusal("probe made -o out --at 1 1 " + options, 2, word);
  };
  expect("--disparity 1 0", "disparity range 1 0");
  expect("--disparity 1 1", "disparity range 1 1");
  expect("--disparity 0 0.0001", "disparity range 0 0.0001");
  expect("--disparity -5000 5000", "disparity range -5000 5000");
  expect("--disparity 0 inf", "disparity");
  expect("--disparity nan 1", "disparity");
  expect("--disparity 0", "--disparity");
  expect("--disparity far near", "--disparity");
  expect("--hypotheses 1", "hypotheses is 1");
  expect("--hypotheses 5000", "hypotheses is 5000");
}

TEST_F(BadInput, AnOptionThatCannotBeMeantIsNamed) {
  expect_refusal("depth made", 2, "--output");
  expect_refusal("depth made -o out --preset best", 2, "--preset", "best");
  expect_refusal("depth made -o out --memory 0", 2, "--memory");
  expect_refusal("depth made -o out --format tiff", 2, "--format", "tiff");
  expect_refusal("depth made -o out --views 9", 2, "view 9", "0 … 4");
  expect_refusal("depth made -o out --views 3-1", 2, "3-1");
  expect_refusal("depth made -o out --views view_007", 2, "view_007");
  expect_refusal("depth made -o out --views ,", 2, "view");
  expect_refusal("probe made", 2, "--at");
  expect_refusal("probe made --at 5", 2, "--at");
  expect_refusal("probe made -o out --at 48 0", 2, "48 0", "48x37");
  expect_refusal("probe made -o out --at 3 -1", 2, "3 -1");
  expect_refusal("probe made -o out --at 3 3 --view 9", 2, "view 9");
}

/// In every place where a file is named: a pipe would never answer, a device never end.
TEST_F(BadInput, PipesAndDevicesAreNoFiles) {
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  fs::create_directory(folder / "pictures");
  for (const char* name : {"v1.png", "v2.png"}) save(std::string("pictures/") + name);
  for (const std::string place : {"pipe", "/dev/zero"}) {
    for (const std::string command : {"info ", "decode -o out ", "depth -o out "})
      expect_refusal(command + place, 1, place, "not a file");
    expect_refusal("info pictures --positions " + place, 1, place, "not a file");
    expect_refusal("evaluate made/truth.pfm " + place, 1, place);
    expect_refusal("evaluate " + place + " made/truth.pfm", 1, place);
    expect_refusal("compare made -o out --external " + place, 1, place);
  }
  fs::remove(folder / "made/gigaray.json");
  fs::create_symlink(folder / "pipe", folder / "made/gigaray.json");
  expect_refusal("cloud made -o out.ply", 1, "made");
}

TEST_F(BadInput, APictureThatUnfoldsBeyondTheLimitIsNamed) {
  fs::create_directory(folder / "bombs");
  for (const char* name : {"v1.png", "v2.png"})
    ASSERT_TRUE(cv::imwrite((folder / "bombs" / name).string(),
                            cv::Mat(8000, 9000, CV_8U, cv::Scalar(0)),
                            {cv::IMWRITE_PNG_BILEVEL, 1}));
  const std::string least = " --memory 0.25";  // GiB
  expect_refusal("info bombs" + least, 1, "v1.png", "9000×8000");
  expect_refusal("depth bombs -o out --disparity 0 1" + least, 1, "v1.png", "9000×8000");
}

TEST_F(BadInput, WithoutADeviceOneLineSaysSo) {
  fs::create_directory(folder / "none");
  const std::string none = "OCL_ICD_VENDORS=$PWD/none";
  expect_refusal("depth made -o out", 1, "no OpenCL device", "install", none);
  expect_refusal("probe made -o out --at 3 3", 1, "no OpenCL device", "install", none);
  expect_refusal("devices --json", 1, "no OpenCL device", "install", none);
  expect_refusal("depth made -o out --device abacus", 1, "abacus");
}

TEST_F(BadInput, APlaceThatCannotBeWrittenIsNamed) {
  std::ofstream(folder / "file") << "x";
  fs::create_directory(folder / "mine");
  std::ofstream(folder / "mine/diary.txt") << "dear";
  for (const std::string command : {"depth made", "probe made --at 3 3"}) {
    expect_refusal(command + " -o file/out", 1, "file/out");
    expect_refusal(command + " -o file", 2, "file");
    expect_refusal(command + " -o mine", 2, "mine", "not empty");
  }
  EXPECT_EQ(names_in("mine"), (Names{"diary.txt"}));
}

TEST_F(BadInput, AFullDiskLeavesNothing) {
  ASSERT_EQ(run("depth made -o warm").exit_code, 0);  // the kernels are on disk now
  make("--views 5 --width 1000 --height 700");
  // Files may not grow beyond 2 MB, blocks of 512 bytes: what a write meets on a full disk. Those
  // that PoCL compiles from are smaller.
  expect_refusal("depth made -o out --views centre --hypotheses 16", 1, "disparity.pfm",
                 "can't be written", "trap '' XFSZ; ulimit -f 4000;");
}

TEST_F(BadInput, InterruptEndsWith130AndLeavesNothing) {
  make("--views 21 --width 300 --height 200");
  fs::create_directory(folder / "work");
  const Names before = names_in(".");
  const pid_t child = start({"depth", "made", "-o", "out", "--work", "work"});
  EXPECT_TRUE(wait_until([&] { return text_of(".err").find("level 0") != std::string::npos; }));
  kill(child, SIGINT);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_NE(text_of(".err").find("gigaray depth: stopped"), std::string::npos) << text_of(".err");
  EXPECT_EQ(text_of(".out"), "");
  EXPECT_EQ(names_in("."), before);
  EXPECT_TRUE(names_in("work").empty());
}

TEST_F(BadInput, AKilledRunLeavesNothingThatLooksLikeAResult) {
  make("--views 21 --width 300 --height 200");
  fs::create_directory(folder / "work");
  // In the middle of the computation, and in the middle of writing.
  for (const std::string stage : {"level 0\n", "write\n"}) {
    const pid_t child =
        start({"depth", "made", "-o", "out", "--work", "work", "--format", "exr,npy,png16"});
    EXPECT_TRUE(wait_until([&] { return text_of(".err").find(stage) != std::string::npos; }));
    kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << stage;
    EXPECT_FALSE(fs::exists(folder / "out")) << stage;
    for (const std::string& name : names_in("."))
      EXPECT_TRUE(!name.starts_with("out") && !name.ends_with("out")) << name;
    EXPECT_TRUE(names_in("work").empty()) << stage;
  }
  EXPECT_EQ(run("depth made -o out --views centre").exit_code, 0);
  EXPECT_TRUE(fs::exists(folder / "out/disparity.pfm"));
  for (const std::string& name : names_in(".")) EXPECT_FALSE(name.starts_with(".")) << name;
}

TEST_F(BadInput, LargePicturesAreRefusedBeforeTheyAreLookedAt) {
  for (const char* name : {"big/v1.jpg", "big/v2.jpg"}) save(name, 6000, 5000);
  for (const std::string command : {"depth big -o out", "info big", "probe big --at 1 1"}) {
    const Result result = run(command + " --memory 0.5");
    const std::string text = result.out + result.err;
    EXPECT_TRUE(text.find("give it at least") != std::string::npos ||
                text.find("the limit is 512 MiB") != std::string::npos)
        << command << ": " << text;
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    EXPECT_LT(usage.ru_maxrss, 512 * 1024) << command;
  }
}

TEST_F(BadInput, ADamagedKernelCacheIsBuiltAgain) {
  const std::string cache = "GIGARAY_CACHE_DIR=$PWD/cache";
  ASSERT_EQ(run("depth made -o first --views centre", cache).exit_code, 0);
  int damaged = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "cache")) {
    // Compiled kernels, in PoCL's cache and in ours.
    const std::string kind = entry.path().extension();
    if (kind != ".so" && kind != ".bc" && kind != ".bin") continue;
    // Half of them cut short, half of them changed inside.
    if (damaged++ % 2 == 0) {
      fs::resize_file(entry.path(), entry.file_size() / 2);
    } else {
      std::fstream file(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
      file.seekp(std::streamoff(entry.file_size() / 2));
      file << "damaged";
    }
  }
  EXPECT_GT(damaged, 1);
  const Result again = run("depth made -o second --views centre", cache);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(text_of("first/disparity.pfm"), text_of("second/disparity.pfm"));
  EXPECT_EQ(text_of("first/confidence.pfm"), text_of("second/confidence.pfm"));
}

}  // namespace
}  // namespace gigaray
