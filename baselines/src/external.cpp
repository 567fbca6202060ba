// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/baselines/external.h"

#include <stdlib.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <chrono>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <system_error>

#include "gigaray/adapters/child_process.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/baselines/pair.h"
#include "gigaray/baselines/pictures.h"
#include "gigaray/core/scratch_file.h"

namespace gigaray::baselines {
namespace {

namespace fs = std::filesystem;

/// A folder for the files of one run, removed with all that is in it.
class WorkFolder {
 public:
  WorkFolder() {
    std::string pattern = temporary_folder() + "/gigaray-external-XXXXXX";
    if (!mkdtemp(pattern.data()))
      throw Error(ErrorCode::kIo,
                  pattern + ": can't be made: " + std::generic_category().message(errno));
    path_ = pattern;
  }
  ~WorkFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

struct Description {
  std::string name, title, reference, parameters;
  std::vector<std::string> command;
  std::string pictures = "png", disparity = "pfm";
  double scale = 1;
};

Description read_description(const fs::path& path) {
  const auto bad = [&](const std::string& what) {
    return Error(ErrorCode::kBadInput, path.string() + ": " + what);
  };
  const std::string json = read_text(path);
  check_json(json, path.string());
  const auto root = nlohmann::json::parse(json, nullptr, false);
  if (!root.is_object()) throw bad("is not a JSON object");
  for (const auto& [key, value] : root.items()) {
    static const std::vector<std::string> known{"name",    "title",    "reference", "parameters",
                                                "command", "pictures", "disparity", "scale"};
    if (std::ranges::find(known, key) == known.end()) throw bad("has no use for '" + key + "'");
  }
  Description result;
  const auto text = [&](const char* key, std::string& value, bool is_required) {
    if (!root.contains(key)) {
      if (is_required) throw bad(std::string("has no '") + key + "'");
      return;
    }
    if (!root[key].is_string() || root[key].get<std::string>().empty())
      throw bad(std::string("'") + key + "' must be a text");
    value = root[key];
  };
  text("name", result.name, true);
  result.title = result.name;
  text("title", result.title, false);
  text("reference", result.reference, false);
  text("parameters", result.parameters, false);
  text("pictures", result.pictures, false);
  text("disparity", result.disparity, false);
  if (result.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_-") != std::string::npos)
    throw bad("'name' names a folder: a to z, 0 to 9, _ and -");
  const auto one_of = [&](const char* key, const std::string& value,
                          const std::vector<std::string>& choices) {
    if (std::ranges::find(choices, value) == choices.end())
      throw bad(std::string("'") + key + "' is '" + value + "'; it can't be that");
  };
  one_of("pictures", result.pictures, {"png", "ppm", "pgm"});
  one_of("disparity", result.disparity, {"pfm", "npy", "exr"});
  if (root.contains("scale")) {
    if (!root["scale"].is_number() || root["scale"] == 0) throw bad("'scale' must be a number");
    result.scale = root["scale"];
  }
  if (!root.contains("command") || !root["command"].is_array() || root["command"].empty())
    throw bad("'command' must be a list of words");
  for (const auto& word : root["command"]) {
    if (!word.is_string()) throw bad("'command' must be a list of words");
    result.command.push_back(word);
  }
  for (const char* place : {"{left}", "{right}", "{disparity}"})
    if (std::ranges::none_of(result.command, [&](const std::string& word) {
          return word.find(place) != std::string::npos;
        }))
      throw bad(std::string("'command' has no ") + place);
  return result;
}

std::string replaced(std::string word, const std::string& place, const std::string& value) {
  for (std::size_t at = word.find(place); at != std::string::npos;
       at = word.find(place, at + value.size()))
    word.replace(at, place.size(), value);
  return word;
}

void write_picture(const fs::path& path, const cv::Mat& rgb) {
  cv::Mat picture;
  cv::cvtColor(rgb, picture, path.extension() == ".pgm" ? cv::COLOR_RGB2GRAY : cv::COLOR_RGB2BGR);
  if (!cv::imwrite(path.string(), picture))
    throw Error(ErrorCode::kIo, path.string() + ": can't be written");
}

/// Runs the program to its end. Throws with the last line that it printed when it fails.
void run(const std::vector<std::string>& command, const std::string& name,
         const RunControl& control) {
  using namespace std::chrono_literals;
  ChildProcess process(command, {});
  std::string printed;
  while (const auto part = process.read(100ms)) {
    control.throw_if_cancelled();
    printed += *part;
  }
  const std::string problem = process.result();
  if (problem.empty()) return;
  while (!printed.empty() && std::isspace(static_cast<unsigned char>(printed.back())))
    printed.pop_back();
  const std::string last = printed.substr(printed.find_last_of('\n') + 1);
  throw Error(ErrorCode::kIo,
              name + ": " + problem + (last.empty() ? "" : "; its last words: " + last));
}

cv::Mat match(const Description& description, const Pair& pair, const RunControl& control) {
  const WorkFolder folder;
  const fs::path left = folder.path() / ("left." + description.pictures),
                 right = folder.path() / ("right." + description.pictures),
                 found = folder.path() / ("disparity." + description.disparity);
  write_picture(left, pair.reference);
  write_picture(right, pair.other);
  std::vector<std::string> command;
  for (std::string word : description.command) {
    word = replaced(word, "{left}", left.string());
    word = replaced(word, "{right}", right.string());
    word = replaced(word, "{disparity}", found.string());
    word = replaced(word, "{min}", std::to_string(pair.least));
    word = replaced(word, "{max}", std::to_string(pair.most));
    command.push_back(word);
  }
  run(command, description.name, control);
  if (!fs::exists(found))
    throw Error(ErrorCode::kIo, description.name + ": wrote no " + found.filename().string());
  const cv::Mat disparity = mat_of(read_float_map(found)) * description.scale;
  if (disparity.size() != pair.reference.size())
    throw Error(ErrorCode::kBadInput, description.name + ": its map is " +
                                          std::to_string(disparity.cols) + " x " +
                                          std::to_string(disparity.rows) + ", the pictures are " +
                                          std::to_string(pair.reference.cols) + " x " +
                                          std::to_string(pair.reference.rows));
  return disparity;
}

}  // namespace

Baseline external_baseline(const fs::path& path) {
  const Description description = read_description(path);
  const std::string& program = description.command.front();
  if (program.find('/') == std::string::npos ? is_missing(program) : !fs::exists(program))
    throw Error(ErrorCode::kIo,
                description.name + ": the program " + program + " is not installed");
  const Match matcher = [description](const Pair& pair, const RunControl& control) {
    return match(description, pair, control);
  };
  std::string command;
  for (const std::string& word : description.command)
    command += (command.empty() ? "" : " ") + word;
  const std::string reference =
      description.reference.empty() ? "external program" : description.reference;
  const std::string parameters =
      description.parameters.empty() ? command : description.parameters + "; " + command;
  return {description.name, description.title, reference,
          parameters + "; holes from the farther neighbour",
          [matcher](const Problem& problem) { return pair_trials(problem, matcher, 4096); }};
}

}  // namespace gigaray::baselines
