// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// The command line of COLMAP, https://colmap.github.io/cli.html.
#include "gigaray/adapters/colmap_program.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <regex>
#include <set>
#include <sstream>
#include <system_error>

#include "colmap/colmap_folders.h"
#include "colmap/colmap_pictures.h"
#include "files/text.h"
#include "formats/numbered_names.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/child_process.h"
#include "gigaray/adapters/input_file.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "colmap";
constexpr const char* kAdvice =
    "neighbouring photographs should share two thirds of what they show, from places that differ, "
    "of a scene that stands still and has texture";

using Words = std::vector<std::string>;

/// Turns a printed line into progress: done and total, or nothing.
using LineToProgress = std::function<std::optional<std::pair<double, double>>(const std::string&)>;

/// "[3/11]", or "[2/4, 1/4]" of blocks against blocks.
std::optional<std::pair<double, double>> progress_in_brackets(const std::string& line) {
  static const std::regex kPattern(R"(\[(\d{1,9})/(\d{1,9})(?:, (\d{1,9})/(\d{1,9}))?\])");
  std::smatch match;
  if (!std::regex_search(line, match, kPattern)) return std::nullopt;
  const auto number = [&](int i) { return double(std::stol(match[i])); };
  if (!match[3].matched) return std::pair(number(1), number(2));
  return std::pair((number(1) - 1) * number(4) + number(3), number(2) * number(4));
}

/// A run of the program, step by step, with one log.
class Program {
 public:
  Program(const fs::path& log, const RunControl& control)
      : log_path_(log), log_(log, std::ios::binary), control_(control) {
    if (!log_) throw Error(ErrorCode::kIo, log.string() + ": can't be written");
  }

  /// Runs a command to its end. Returns what went wrong, or nothing.
  std::string run(const std::string& stage, const Words& arguments,
                  const LineToProgress& progress) {
    log_ << "$ " << kProgram;
    for (const std::string& word : arguments) log_ << ' ' << word;
    log_ << '\n';
    control_.progress(stage, 0, 1);
    std::string line;
    return run_process(arguments, [&](const std::string& printed) {
      log_ << printed << std::flush;
      for (const char c : printed) {
        if (c != '\n') {
          line += c;
          continue;
        }
        if (const auto at = progress(line); at && at->second > 0)
          control_.progress(stage, at->first, at->second);
        if (!trimmed(line).empty()) last_line_ = trimmed(line);
        line.clear();
      }
    });
  }

  void run_or_throw(const std::string& stage, const Words& arguments,
                    const LineToProgress& progress) {
    const std::string problem = run(stage, arguments, progress);
    if (!problem.empty()) fail(arguments.front(), problem);
  }

  [[noreturn]] void fail(const std::string& command, const std::string& problem) const {
    const bool crashed = problem.find("signal") != std::string::npos;
    throw Error(ErrorCode::kIo, "COLMAP " + std::string(crashed ? "crashed" : "failed") +
                                    " in its " + command + " (" + problem +
                                    (crashed ? "; too little memory?" : "") + "); its log is " +
                                    log_path_.string());
  }

  /// The first of some names of an option that the command knows; they change between versions.
  std::string known_option(const std::string& command, const Words& names) {
    std::string help;
    run_process({command, "-h"}, [&](const std::string& printed) { help += printed; });
    for (const std::string& name : names)
      if (help.find(name) != std::string::npos) return name;
    return names.front();
  }

 private:
  std::string run_process(const Words& arguments,
                          const std::function<void(const std::string&)>& sink) {
    constexpr std::chrono::milliseconds kPatience{100};
    Words words{kProgram};
    words.insert(words.end(), arguments.begin(), arguments.end());
    ChildProcess process(words, {"QT_QPA_PLATFORM=offscreen"});
    while (const auto printed = process.read(kPatience)) {
      control_.throw_if_cancelled();
      sink(*printed);
    }
    return process.result();
  }

  fs::path log_path_;
  std::ofstream log_;
  const RunControl& control_;
  std::string last_line_;
};

/// Times of what follows each other.
class Stopwatch {
 public:
  /// "12 s", since the last call.
  std::string lap() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return std::to_string(std::lround(seconds)) + " s";
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

std::string list_text(const Words& names) {
  constexpr std::size_t kMost = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i)
    text += (i ? ", " : "") + names[i];
  return names.size() > kMost ? text + " …" : text;
}

/// Counts features per photograph, of what COLMAP prints about each.
class FeatureCounts {
 public:
  void look_at(const std::string& line) {
    static const std::regex kName(R"(\bName:\s+(.+\S))"), kCount(R"(\bFeatures:\s+(\d{1,9}))");
    std::smatch match;
    if (std::regex_search(line, match, kName)) name_ = match[1];
    if (std::regex_search(line, match, kCount) && std::stol(match[1]) > 0) found_.insert(name_);
  }
  /// Photographs without any. None when COLMAP prints it in another way.
  Words without(const Words& names) const {
    Words lacking;
    if (name_.empty()) return lacking;
    std::copy_if(names.begin(), names.end(), std::back_inserter(lacking),
                 [&](const std::string& name) { return !found_.contains(name); });
    return lacking;
  }

 private:
  std::string name_;
  std::set<std::string> found_;
};

bool share_one_camera(const std::vector<PictureSpec>& specs) {
  return std::all_of(specs.begin(), specs.end(), [&](const PictureSpec& spec) {
    const PictureSpec& first = specs.front();
    return spec.width == first.width && spec.height == first.height &&
           spec.taken_with == first.taken_with;
  });
}

Words camera_arguments(const fs::path& folder, const Words& names,
                       const std::vector<PictureSpec>& specs, const std::optional<Lens>& lens) {
  if (!lens) {
    // A shared camera is seen by enough photographs to find more of its distortion.
    constexpr std::size_t kEnough = 8;
    const bool shared = share_one_camera(specs);
    return {"--ImageReader.single_camera", shared ? "1" : "0", "--ImageReader.camera_model",
            shared && names.size() >= kEnough ? "OPENCV" : "SIMPLE_RADIAL"};
  }
  check(*lens, "the lens of the photographs");
  for (std::size_t i = 0; i < names.size(); ++i)
    if (specs[i].width != lens->width || specs[i].height != lens->height)
      throw Error(ErrorCode::kInvalidArgument, (folder / names[i]).string() + ": has " +
                                                   size_text(specs[i].width, specs[i].height) +
                                                   " pixels, the lens is for " +
                                                   size_text(lens->width, lens->height));
  std::ostringstream params;
  params.imbue(std::locale::classic());
  params.precision(17);
  for (std::size_t i = 0; i < lens->params.size(); ++i) params << (i ? "," : "") << lens->params[i];
  return {"--ImageReader.single_camera", "1",         "--ImageReader.camera_model", lens->model,
          "--ImageReader.camera_params", params.str()};
}

/// Photographs of today have more features than are kept, and those found in an enlarged copy are
/// the first to go: without it the search takes a quarter of the time.
Words octave_arguments(const std::vector<PictureSpec>& specs) {
  constexpr int kLarge = 1200;  // px
  const bool large = std::all_of(specs.begin(), specs.end(), [](const PictureSpec& spec) {
    return std::max(spec.width, spec.height) >= kLarge;
  });
  return {"--SiftExtraction.first_octave", large ? "0" : "-1"};
}

/// What a quality is made of.
struct Effort {
  int max_size;      ///< px
  int max_features;  ///< of a photograph
  int neighbours;    ///< that each is compared with, where not with all
};

Effort effort_of(ColmapQuality quality) {
  switch (quality) {
    case ColmapQuality::kLow:
      return {1000, 2048, 5};
    case ColmapQuality::kMedium:
      return {1600, 4096, 10};
    case ColmapQuality::kHigh:
      return {3200, 8192, 20};
  }
  GIGARAY_CHECK(false);
}

/// COLMAP looks at pictures reduced like those that get depth, though never at tiny ones; its
/// cameras are for the whole size.
Words size_arguments(Program& program, const ColmapRunOptions& options) {
  constexpr int kLeast = 320;
  int size = effort_of(options.quality).max_size;
  if (options.max_size > 0) size = std::min(size, std::max(options.max_size, kLeast));
  return {program.known_option("feature_extractor", {"--SiftExtraction.max_image_size",
                                                     "--FeatureExtraction.max_image_size"}),
          std::to_string(size)};
}

Words joined(std::initializer_list<Words> parts) {
  Words all;
  for (const Words& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

void prepare(const fs::path& work) {
  std::error_code error;
  fs::create_directories(work / "sparse", error);
  if (error)
    throw Error(ErrorCode::kIo, work.string() + ": can't be written (" + error.message() + ")");
  if (fs::exists(work / "database.db", error))
    throw Error(ErrorCode::kInvalidArgument,
                work.string() + ": holds an earlier run of COLMAP; name another folder");
}

/// Does COLMAP find what it can compare? Says where it does not.
void check_features(const FeatureCounts& features, const Words& names, const fs::path& folder,
                    const RunControl& control) {
  const Words without = features.without(names);
  if (without.empty()) return;
  const std::string which = std::to_string(without.size()) + " of " + std::to_string(names.size()) +
                            " photographs (" + list_text(without) + ")";
  if (names.size() < without.size() + 2)
    throw Error(ErrorCode::kBadInput,
                folder.string() + ": COLMAP finds nothing to compare in " + which +
                    "; they are blank, blurred, dark or masked, or too small");
  control.message("COLMAP finds nothing to compare in " + which);
}

void find_features(Program& program, const fs::path& folder, const ColmapPictures& pictures,
                   const fs::path& work, const ColmapRunOptions& options,
                   const RunControl& control) {
  const Words& names = pictures.names();
  const std::vector<PictureSpec>& specs = pictures.specs();
  const Words cameras = camera_arguments(folder, names, specs, options.lens);
  const Words masks = pictures.masks().empty()
                          ? Words()
                          : Words{"--ImageReader.mask_path", pictures.masks().string()};
  std::string list;
  for (const std::string& name : names) list += name + "\n";
  write_file_atomically(work / "photographs.txt", list);
  const std::string on_gpu = program.known_option(
      "feature_extractor", {"--SiftExtraction.use_gpu", "--FeatureExtraction.use_gpu"});
  FeatureCounts features;
  program.run_or_throw(
      "COLMAP: features",
      joined({{"feature_extractor", "--database_path", work / "database.db", "--image_path",
               pictures.folder(), "--image_list_path", work / "photographs.txt", on_gpu, "0",
               "--SiftExtraction.max_num_features",
               std::to_string(effort_of(options.quality).max_features)},
              octave_arguments(specs),
              size_arguments(program, options),
              cameras,
              masks}),
      [&](const std::string& line) {
        features.look_at(line);
        return progress_in_brackets(line);
      });
  check_features(features, names, folder, control);
}

/// Frames of a walk: names that differ by one number, in its order, and few are left out.
bool are_in_order(const Words& names) {
  constexpr double kMostPerPicture = 2;
  const NameGroup group = largest_group({names.begin(), names.end()});
  if (group.pictures.size() < names.size() || group.changing.size() != 1) return false;
  const auto name = [](const NumberedPicture& picture) { return picture.path.string(); };
  if (!std::ranges::is_sorted(group.pictures, {}, name)) return false;  // "9", "10": not COLMAP's
  const std::size_t which = *group.changing.begin();
  const auto span =
      double(group.pictures.back().numbers[which] - group.pictures.front().numbers[which]);
  return span < kMostPerPicture * double(names.size());
}

void match_features(Program& program, const fs::path& work, const Words& names,
                    ColmapQuality quality, const RunControl& control) {
  constexpr std::size_t kMostForAllPairs = 100, kMostInOrder = 30;
  const bool in_order = names.size() > kMostInOrder && are_in_order(names);
  const bool all_pairs = !in_order && names.size() <= kMostForAllPairs;
  const int neighbours = effort_of(quality).neighbours;
  if (!all_pairs)
    control.message(
        (in_order ? std::to_string(names.size()) + " photographs numbered one after the other"
                  : "more than " + std::to_string(kMostForAllPairs) + " photographs") +
        ": each is compared with its next " + std::to_string(neighbours) +
        " in the order of their names, and with some farther ones");
  const std::string command = all_pairs ? "exhaustive_matcher" : "sequential_matcher";
  const std::string on_gpu =
      program.known_option(command, {"--SiftMatching.use_gpu", "--FeatureMatching.use_gpu"});
  Words arguments{command, "--database_path", work / "database.db", on_gpu, "0"};
  if (all_pairs)  // small blocks, so that there is progress to show
    arguments.insert(arguments.end(), {"--ExhaustiveMatching.block_size", "5"});
  else
    arguments.insert(arguments.end(), {"--SequentialMatching.overlap", std::to_string(neighbours)});
  program.run_or_throw("COLMAP: matches", arguments, progress_in_brackets);
}

void find_cameras(Program& program, const fs::path& folder, const fs::path& work,
                  std::size_t num_pictures, const ColmapRunOptions& options) {
  // Photographs that fall apart into parts still have cameras: the largest part is taken.
  Words arguments{"mapper", "--database_path", work / "database.db", "--image_path",
                  folder,   "--output_path",   work / "sparse",      "--Mapper.min_model_size",
                  "3"};
  if (options.lens && !options.refine_lens)
    arguments.insert(arguments.end(), {"--Mapper.ba_refine_focal_length", "0",
                                       "--Mapper.ba_refine_extra_params", "0"});
  double placed = 1;  // the first line is about the third photograph
  const auto progress = [&](const std::string& line) -> std::optional<std::pair<double, double>> {
    if (line.find("Registering image #") == std::string::npos) return std::nullopt;
    placed = std::min(placed + 1, double(num_pictures));
    return std::pair(placed, double(num_pictures));
  };
  const std::string problem = program.run("COLMAP: cameras", arguments, progress);
  // A mapper that finds nothing fails too; that is about the photographs.
  if (!problem.empty() && problem != "ended with status 1") program.fail("mapper", problem);
}

}  // namespace

ColmapRun run_colmap(const fs::path& photographs, const fs::path& work,
                     const ColmapRunOptions& options, const RunControl& control) {
  ColmapPictures pictures(photographs, work, options.strict, control);
  const Words& names = pictures.names();
  if (is_missing(kProgram))
    throw Error(ErrorCode::kIo,
                "colmap: is not installed; install the package `colmap`, which finds the cameras "
                "of photographs");
  prepare(work);
  ColmapRun result;
  result.log = work / kColmapLog;
  result.num_pictures = int(names.size());
  Program program(result.log, control);
  pictures.write_copies(options.masks, control);
  Stopwatch watch;
  find_features(program, photographs, pictures, work, options, control);
  const std::string for_features = watch.lap();
  match_features(program, work, names, options.quality, control);
  const std::string for_matches = watch.lap();
  find_cameras(program, pictures.folder(), work, names.size(), options);
  control.message("COLMAP took " + for_features + " for features, " + for_matches +
                  " for matches, " + watch.lap() + " for cameras");

  const std::vector<fs::path> models = colmap_models_below(work / "sparse");
  std::set<std::string> registered;
  if (!models.empty()) {
    std::vector<std::string> notes;
    const FoundColmapModel found = largest_colmap_model(models, notes);
    for (const std::string& note : notes) control.message(note);
    for (const ColmapModel::Image& image : found.model.images) registered.insert(image.name);
    result.model = found.folder;
  }
  result.num_registered = int(registered.size());
  std::copy_if(names.begin(), names.end(), std::back_inserter(result.lost),
               [&](const std::string& name) { return !registered.count(name); });
  if (result.num_registered < 2)
    throw Error(ErrorCode::kBadInput, photographs.string() + ": COLMAP found no cameras for its " +
                                          std::to_string(names.size()) + " photographs; " +
                                          kAdvice + " (log: " + result.log.string() + ")");
  if (!result.lost.empty())
    control.message("COLMAP found no camera for " + std::to_string(result.lost.size()) + " of " +
                    std::to_string(names.size()) + " photographs (" + list_text(result.lost) +
                    "), they are left out; " + kAdvice);
  return result;
}

}  // namespace gigaray
