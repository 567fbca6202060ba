// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// With the real program, on rendered photographs.
#include "gigaray/adapters/colmap_program.h"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>

#include "adapters/adapters_test.h"
#include "adapters/colmap_scene.h"
#include "adapters/textured_planes.h"
#include "gigaray/adapters/child_process.h"
#include "gigaray/adapters/colmap_model.h"

namespace gigaray {
namespace {

using std::chrono::milliseconds;

class ColmapProgram : public AdaptersTest {
 protected:
  /// Renders photographs p0.png, p1.png … and returns their cameras.
  std::vector<Camera> photograph(int count) const {
    const std::vector<Camera> cameras = cameras_before_planes(count);
    for (int i = 0; i < count; ++i)
      save("photos/p" + std::to_string(i) + ".png", textured_planes(cameras[i]));
    return cameras;
  }
  /// A photograph of something else.
  void save_stranger(const std::string& name) const {
    cv::Mat other(300, 400, CV_8UC3);
    for (int v = 0; v < other.rows; ++v)
      for (int u = 0; u < other.cols; ++u)
        other.at<cv::Vec3b>(v, u) =
            cv::Vec3b::all(std::uint8_t(255 * noise_texture(u / 17.0, v / 17.0, 991)));
    save(name, other);
  }
  const Lens lens{"PINHOLE", 400, 300, {380, 380, 200, 150}};
  RunControl control;
};

TEST_F(ColmapProgram, FindsTheCamerasOfPhotographsUpToScale) {
  const std::vector<Camera> truth = photograph(6);
  save_stranger("photos/stranger.png");
  write("photos/notes.txt", "not a photograph");
  cv::Mat mask(300, 400, CV_8UC1, cv::Scalar(255));
  mask(cv::Rect(0, 0, 60, 300)) = 0;
  save("masks/p1.png", mask);
  std::vector<std::string> messages;
  std::set<std::string> stages;
  control.on_message = [&](const std::string& text) { messages.push_back(text); };
  control.on_progress = [&](const std::string& stage, double done, double total) {
    stages.insert(stage);
    EXPECT_LE(done, total);
  };
  ColmapRunOptions options;
  options.lens = lens;
  options.masks = folder / "masks";
  const ColmapRun run = run_colmap(folder / "photos", folder / "work", options, control);

  EXPECT_EQ(run.num_pictures, 7);
  EXPECT_EQ(run.num_registered, 6);
  EXPECT_EQ(run.lost, std::vector<std::string>{"stranger.png"});
  EXPECT_EQ(stages,
            (std::set<std::string>{"COLMAP: features", "COLMAP: matches", "COLMAP: cameras"}));
  ASSERT_EQ(messages.size(), 2);
  EXPECT_NE(messages[0].find("s for features"), std::string::npos) << messages[0];
  EXPECT_NE(messages[1].find("stranger.png"), std::string::npos);
  EXPECT_NE(read("work/colmap.log").find("Feature extraction"), std::string::npos);

  const ColmapModel model = read_colmap_model(run.model);
  EXPECT_EQ(model.cameras.begin()->second.params, lens.params);
  Eigen::Matrix3Xd found(3, 6), wanted(3, 6);
  for (const ColmapModel::Image& image : model.images) {
    const int i = image.name[1] - '0';
    found.col(i) = -(image.rotation.inverse() * image.translation);
    wanted.col(i) = truth[i].position();
    if (i != 1) continue;
    // Nothing was found under the mask.
    for (const ColmapModel::Feature& feature : image.features) EXPECT_GE(feature.x, 59);
  }
  const Eigen::Matrix4d truth_from_found = Eigen::umeyama(found, wanted);
  const double off = (truth_from_found.topLeftCorner<3, 3>() * found -
                      (wanted.colwise() - truth_from_found.topRightCorner<3, 1>()))
                         .colwise()
                         .norm()
                         .maxCoeff();
  EXPECT_LT(off, 0.01);  // of a rig 1.75 wide

  OpenOptions open;
  open.images = folder / "photos";
  const LightField light_field = open_light_field(run.model, open);
  EXPECT_EQ(light_field.num_views(), 6);
  for (const Camera& camera : light_field.cameras) EXPECT_TRUE(camera.inverse_depth.has_value());
}

TEST_F(ColmapProgram, PhotographsOfDifferentThingsAreRefusedWithAdvice) {
  photograph(1);
  save_stranger("photos/stranger.png");
  testing_support::expect_error(
      ErrorCode::kBadInput, {"no cameras", "two thirds", "colmap.log"},
      [&] { run_colmap(folder / "photos", folder / "work", {}, control); });
  EXPECT_TRUE(std::filesystem::exists(folder / "work" / "colmap.log"));
  expect_error(ErrorCode::kInvalidArgument, "earlier run",
               [&] { run_colmap(folder / "photos", folder / "work", {}, control); });
}

TEST_F(ColmapProgram, WhatItCannotReadIsCopiedAndWhatNobodyCanIsLeftOut) {
  photograph(5);
  for (int i = 0; i < 4; ++i) {
    const std::string name = (folder / "photos/p").string() + std::to_string(i) + ".png";
    cv::Mat picture = cv::imread(name);
    picture.convertTo(picture, CV_16U, 257);
    cv::imwrite(name, picture);
  }
  std::filesystem::copy_file(folder / "photos/p4.png", folder / "photos/p5.png");
  std::filesystem::resize_file(folder / "photos/p5.png", 2000);
  std::string messages;
  control.on_message = [&](const std::string& text) { messages += text + "\n"; };
  ColmapRunOptions options;
  options.lens = lens;
  options.max_size = 350;
  const ColmapRun run = run_colmap(folder / "photos", folder / "work", options, control);
  EXPECT_EQ(run.num_registered, 5);
  EXPECT_NE(messages.find("4 of 5 photographs are copied"), std::string::npos) << messages;
  EXPECT_NE(messages.find("1 of 6 pictures is left out: p5.png"), std::string::npos) << messages;
  EXPECT_NE(read("work/colmap.log").find("max_image_size 350"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "work/copies"));
  OpenOptions open;
  open.images = folder / "photos";
  EXPECT_EQ(open_light_field(run.model, open).num_views(), 5);
}

TEST_F(ColmapProgram, PhotographsWithoutFeaturesAreNamedBeforeTheyAreCompared) {
  photograph(1);
  for (const char* name : {"photos/blank.png", "photos/white.png"})
    save(name, cv::Mat(300, 400, CV_8UC3, cv::Scalar::all(200)));
  testing_support::expect_error(
      ErrorCode::kBadInput, {"nothing to compare in 2 of 3", "blank.png, white.png"},
      [&] { run_colmap(folder / "photos", folder / "work", {}, control); });
}

TEST_F(ColmapProgram, PhotographsOfTwoPlacesAreTwoModelsAndTheLargerIsTaken) {
  photograph(9);
  // Mirrored ones are of another place.
  for (int i = 5; i < 9; ++i) {
    const std::string name = (folder / "photos/p").string() + std::to_string(i) + ".png";
    const cv::Mat picture = cv::imread(name);
    cv::Mat other;
    cv::flip(picture, other, 0);
    cv::imwrite(name, other);
  }
  std::string messages;
  control.on_message = [&](const std::string& text) { messages += text + "\n"; };
  ColmapRunOptions options;
  options.lens = lens;
  options.quality = ColmapQuality::kLow;
  const ColmapRun run = run_colmap(folder / "photos", folder / "work", options, control);
  EXPECT_EQ(run.num_registered, 5);
  EXPECT_EQ(run.lost, (std::vector<std::string>{"p5.png", "p6.png", "p7.png", "p8.png"}));
  EXPECT_NE(messages.find("2 models"), std::string::npos) << messages;
  EXPECT_NE(messages.find("has 5"), std::string::npos) << messages;
  EXPECT_NE(messages.find("has 4"), std::string::npos) << messages;
  EXPECT_NE(messages.find("s for features"), std::string::npos) << messages;
  const std::string log = read("work/colmap.log");
  EXPECT_NE(log.find("max_image_size 1000"), std::string::npos);
  EXPECT_NE(log.find("max_num_features 2048"), std::string::npos);
}

TEST_F(ColmapProgram, ManyFramesInOrderAreComparedWithTheirNeighbours) {
  const auto command_for = [&](const std::string& last) {
    std::filesystem::remove_all(folder / "photos");
    std::filesystem::remove_all(folder / "work");
    const cv::Mat frame = textured_planes(cameras_before_planes(1)[0]);
    for (int i = 0; i < 31; ++i) {
      const cv::Mat moved = frame(cv::Rect(i, 0, 200, 150)).clone();
      std::string name = "photos/frame" + std::to_string(100 + i) + ".png";
      if (i == 30) name = "photos/" + last;
      save(name, moved);
    }
    RunControl till_matches;
    till_matches.on_progress = [&](const std::string& stage, double, double) {
      if (stage == "COLMAP: matches") till_matches.cancel();
    };
    ColmapRunOptions options;
    options.quality = ColmapQuality::kLow;
    expect_error(ErrorCode::kCancelled, "stopped",
                 [&] { run_colmap(folder / "photos", folder / "work", options, till_matches); });
    return read("work/colmap.log");
  };
  EXPECT_NE(command_for("frame130.png").find("--SequentialMatching.overlap 5"), std::string::npos);
  // Not in order: a name of another kind, a number far away.
  for (const char* last : {"church.png", "frame900.png"})
    EXPECT_NE(command_for(last).find("exhaustive_matcher"), std::string::npos) << last;
}

TEST_F(ColmapProgram, CancellingEndsTheProgramSoon) {
  photograph(3);
  control.on_progress = [&](const std::string& stage, double, double) {
    if (stage == "COLMAP: features") control.cancel();
  };
  const auto start = std::chrono::steady_clock::now();
  expect_error(ErrorCode::kCancelled, "stopped",
               [&] { run_colmap(folder / "photos", folder / "work", {}, control); });
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST_F(ColmapProgram, WhatIsMissingIsNamedBeforeAnythingRuns) {
  const auto refused = [&](ErrorCode code, const std::string& word,
                           const ColmapRunOptions& options = {}) {
    expect_error(code, word,
                 [&] { run_colmap(folder / "photos", folder / "work", options, control); });
    std::filesystem::remove_all(folder / "work");
  };
  std::filesystem::create_directory(folder / "photos");
  refused(ErrorCode::kBadInput, "no photograph");
  save("photos/a.png");
  refused(ErrorCode::kBadInput, "one photograph");
  save("photos/b.png");
  ColmapRunOptions options;
  options.lens = lens;
  refused(ErrorCode::kInvalidArgument, "400×300", options);
  options.lens->params[0] = -1;
  refused(ErrorCode::kBadInput, "focal length", options);
  options = {};
  options.masks = folder / "nowhere";
  refused(ErrorCode::kBadInput, "nowhere", options);
  options = {};
  write("photos/c.png", "no picture");
  options.strict = true;
  refused(ErrorCode::kBadInput, "c.png", options);
  std::filesystem::remove(folder / "photos/b.png");
  refused(ErrorCode::kBadInput, "c.png");  // one is too few
  save("photos/b.png");
  std::filesystem::remove(folder / "photos/c.png");

  const std::string path = getenv("PATH");
  setenv("PATH", folder.c_str(), 1);
  refused(ErrorCode::kIo, "package `colmap`");
  setenv("PATH", path.c_str(), 1);
}

TEST_F(ColmapProgram, OurTextIsReadByColmapAndItsBinaryByUs) {
  const ColmapModel model = colmap_scene();
  write_colmap_model(folder / "text", model, ColmapFormat::kText);
  std::filesystem::create_directory(folder / "binary");
  ChildProcess colmap({"colmap", "model_converter", "--input_path", folder / "text",
                       "--output_path", folder / "binary", "--output_type", "BIN"},
                      {"QT_QPA_PLATFORM=offscreen"});
  std::string printed;
  while (const auto text = colmap.read(milliseconds(100))) printed += *text;
  ASSERT_EQ(colmap.result(), "") << printed;
  const ColmapModel again = read_colmap_model(folder / "binary");
  EXPECT_EQ(again.cameras, model.cameras);
  ASSERT_EQ(again.images.size(), model.images.size());
  ASSERT_EQ(again.points.size(), model.points.size());
  for (const ColmapModel::Image& image : model.images) {
    const auto same = std::find_if(again.images.begin(), again.images.end(),
                                   [&](const auto& other) { return other.name == image.name; });
    ASSERT_NE(same, again.images.end());
    EXPECT_EQ(same->features, image.features);
    EXPECT_LT((same->translation - image.translation).norm(), 1e-12);
    EXPECT_LT((same->rotation.coeffs() - image.rotation.coeffs()).norm(), 1e-12);
  }
}

TEST(ChildProcesses, OutputAndStatusComeBack) {
  ChildProcess child({"sh", "-c", "echo out; echo err >&2; echo $GIGARAY_TEST; exit 3"},
                     {"GIGARAY_TEST=set", "PATH=ignored"});
  std::string printed;
  while (const auto text = child.read(milliseconds(100))) printed += *text;
  EXPECT_EQ(printed, "out\nerr\nset\n");
  EXPECT_EQ(child.result(), "ended with status 3");
}

/// Ends a process within five seconds? A zombie that nobody has reaped yet is dead as well.
bool ends(pid_t process) {
  for (int i = 0; i < 100; ++i) {
    std::ifstream stat("/proc/" + std::to_string(process) + "/stat");
    std::string id, name, state;
    if (!(stat >> id >> name >> state) || state == "Z") return true;
    usleep(50000);
  }
  return false;
}

TEST(ChildProcesses, WholeGroupIsKilledWithIt) {
  std::string printed;
  {
    ChildProcess child({"sh", "-c", "trap '' TERM; sleep 1000 & echo $!; wait; sleep 1000"}, {});
    while (printed.find('\n') == std::string::npos)
      if (const auto text = child.read(milliseconds(100))) printed += *text;
  }
  EXPECT_TRUE(ends(std::stoi(printed)));
}

TEST(ChildProcesses, WholeGroupEndsWithAProcessThatIsKilled) {
  int ends_of_pipe[2];
  ASSERT_EQ(pipe2(ends_of_pipe, O_CLOEXEC), 0);
  const pid_t parent = fork();
  if (parent == 0) {
    ChildProcess first({"sh", "-c", "sleep 1000 & echo $! $$; wait"}, {});
    ChildProcess second({"sh", "-c", "sleep 1000 & echo $! $$; wait"}, {});
    for (ChildProcess* child : {&first, &second}) {
      std::string printed;
      while (printed.find('\n') == std::string::npos)
        if (const auto text = child->read(milliseconds(100))) printed += *text;
      if (write(ends_of_pipe[1], printed.data(), printed.size()) < 0) _exit(1);
    }
    close(ends_of_pipe[1]);
    pause();
  }
  close(ends_of_pipe[1]);
  std::string printed;
  char bytes[100];
  for (ssize_t count; (count = read(ends_of_pipe[0], bytes, sizeof bytes)) > 0;)
    printed.append(bytes, std::size_t(count));
  close(ends_of_pipe[0]);
  std::istringstream numbers(printed);
  std::vector<pid_t> children(std::istream_iterator<pid_t>(numbers), {});
  ASSERT_EQ(children.size(), 4u) << printed;
  for (const pid_t child : children) EXPECT_EQ(kill(child, 0), 0);
  kill(parent, SIGKILL);
  ASSERT_EQ(waitpid(parent, nullptr, 0), parent);
  for (const pid_t child : children) EXPECT_TRUE(ends(child));
}

TEST(ChildProcesses, ASignalThatEndsTheProgramIsTold) {
  ChildProcess child({"sh", "-c", "kill -SEGV $$"}, {});
  while (child.read(milliseconds(100))) continue;
  EXPECT_EQ(child.result(), "was killed by signal 11");
}

TEST(ChildProcesses, ProgramThatIsNotThereIsNamed) {
  EXPECT_TRUE(is_missing("no-such-program-anywhere"));
  EXPECT_FALSE(is_missing("sh"));
  testing_support::expect_error(ErrorCode::kIo, {"no-such-program-anywhere"},
                                [] { ChildProcess({"no-such-program-anywhere"}, {}); });
}

}  // namespace
}  // namespace gigaray
