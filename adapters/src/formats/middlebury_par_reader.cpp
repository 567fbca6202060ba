// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// NAME_par.txt of the multi-view sets of Seitz et al. 2006, https://vision.middlebury.edu/mview:
// the number of pictures, then per line the picture, K and R by rows and t; a scene point X is seen
// at K (R X + t), pixel centres at integers.
#include <sstream>
#include <system_error>

#include "files/text.h"
#include "formats/camera_position.h"
#include "formats/readers.h"
#include "formats/stated_views.h"
#include "gigaray/adapters/input_file.h"
#include "pictures/picture_files.h"
#include "pictures/projection.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "Middlebury multi-view";
constexpr const char* kEnding = "_par.txt";

bool is_par_file(const fs::path& path) {
  std::error_code ignored;
  return lower(path.filename().string()).ends_with(kEnding) && fs::is_regular_file(path, ignored);
}

std::vector<fs::path> par_files_of(const fs::path& input) {
  if (is_par_file(input)) return {input};
  return files_ending_in(kEnding, input);
}

class MiddleburyParReader : public Reader {
 public:
  std::string name() const override { return kName; }

  ProbeResult probe(const fs::path& input) const override {
    return {par_files_of(input).empty() ? 0 : 75, ""};
  }

  LightField open(const fs::path& input, const OpenOptions& options) const override {
    refuse_direction(options, "the file of cameras states");
    const std::vector<fs::path> files = par_files_of(input);
    if (files.size() > 1)
      throw Error(ErrorCode::kBadInput, input.string() + ": holds " + std::to_string(files.size()) +
                                            " files of cameras; name one of them, such as " +
                                            files.front().string());
    const fs::path& file = files.front();
    return open_stated_views(parse_middlebury_par(read_text(file), file.string()), file,
                             {file.parent_path(), file.parent_path() / "images"}, options, kName);
  }
};

}  // namespace

std::vector<StatedView> parse_middlebury_par(std::string_view text, const std::string& where) {
  constexpr std::size_t kWords = 22;
  std::istringstream stream{std::string(text)};
  std::vector<StatedView> views;
  std::optional<double> stated;
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const std::string place = where + ":" + std::to_string(number);
    const std::vector<std::string> words = split_words(line);
    if (words.empty()) continue;
    if (!stated) {
      stated = words.size() == 1 ? parse_number(words.front()) : std::nullopt;
      if (!stated) throw Error(ErrorCode::kBadInput, place + ": is not the number of pictures");
      continue;
    }
    if (words.size() != kWords)
      throw Error(ErrorCode::kBadInput, place + ": has " + std::to_string(words.size()) +
                                            " words; a picture and 21 numbers are expected");
    const std::vector<double> numbers = finite_numbers(words, 1, place, {9, 21});
    StatedView view;
    view.picture = words.front();
    set_projection(view, numbers.data(), place);
    StatedPose matrix;
    matrix << Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(numbers.data() + 9),
        Eigen::Vector3d(numbers[18], numbers[19], numbers[20]);
    set_pose(view, matrix, {"RDF", true}, place);
    views.push_back(std::move(view));
  }
  if (!stated) throw Error(ErrorCode::kBadInput, where + ": is empty");
  if (*stated != double(views.size()))
    throw Error(ErrorCode::kBadInput, where + ": states " + std::to_string(views.size()) +
                                          " cameras, its first line another number; it is cut "
                                          "short or damaged");
  return views;
}

std::unique_ptr<const Reader> middlebury_par_reader() {
  return std::make_unique<MiddleburyParReader>();
}

}  // namespace gigaray
