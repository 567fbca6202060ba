// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// The .txt files of a COLMAP model: one line per entry, two per image; '#' begins a comment line.
#include <algorithm>
#include <charconv>
#include <utility>

#include "colmap/colmap_model_files.h"
#include "files/text.h"
#include "gigaray/core/error.h"

namespace gigaray {
namespace {

constexpr std::string_view kSpace = " \t\r";

/// Lines of a file, and the words of the current one. White space alone parts words: names may hold
/// commas.
class LineReader {
 public:
  LineReader(std::string_view bytes, const std::string& where) : bytes_(bytes), where_(where) {}

  /// Goes to the next line that is neither blank nor a comment; false at the end of the file.
  bool next_entry() {
    while (next_line())
      if (!line_.empty() && line_[0] != '#') return true;
    return false;
  }
  /// Goes to the next line, whatever is in it; false at the end of the file.
  bool next_line() {
    if (begin_ >= bytes_.size()) return false;
    const auto end = std::min(bytes_.find('\n', begin_), bytes_.size());
    line_ = trimmed(bytes_.substr(begin_, end - begin_));
    begin_ = end + 1;
    ++number_;
    return true;
  }
  bool at_end() const { return line_.empty(); }

  std::string_view word(const char* what) {
    if (line_.empty()) bad(std::string("ends before its ") + what);
    const auto end = std::min(line_.find_first_of(kSpace), line_.size());
    const std::string_view word = line_.substr(0, end);
    line_ = trimmed(line_.substr(end));
    return word;
  }
  std::string_view rest() { return std::exchange(line_, {}); }

  double number(const char* what) {
    const std::string_view text = word(what);
    const auto value = parse_number(text);
    if (!value) bad("has " + in_quotes(text) + " as its " + what);
    return *value;
  }
  template <class T>
  T integer(const char* what) {
    const std::string_view text = word(what);
    T value{};
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec != std::errc() || result.ptr != text.data() + text.size())
      bad("has " + in_quotes(text) + " as its " + what);
    return value;
  }
  Eigen::Vector3d vector(const char* what) {
    const double x = number(what), y = number(what);
    return {x, y, number(what)};
  }

  [[noreturn]] void bad(const std::string& what) const {
    throw Error(ErrorCode::kBadInput, where_ + ": line " + std::to_string(number_) + " " + what);
  }

 private:
  std::string_view bytes_, line_;
  const std::string& where_;
  std::size_t begin_ = 0;
  int number_ = 0;
};

void parse_cameras(std::string_view bytes, const std::string& where, ColmapModel& model) {
  LineReader file(bytes, where);
  while (file.next_entry()) {
    const auto id = file.integer<std::uint32_t>("camera number");
    Lens lens;
    lens.model = upper(std::string(file.word("camera model")));
    lens.width = file.integer<int>("width");
    lens.height = file.integer<int>("height");
    while (!file.at_end()) lens.params.push_back(file.number("parameter"));
    accept(id, std::move(lens), where, model);
  }
}

void parse_images(std::string_view bytes, const std::string& where, ColmapModel& model) {
  LineReader file(bytes, where);
  while (file.next_entry()) {
    ColmapModel::Image image;
    image.id = file.integer<std::uint32_t>("image number");
    image.rotation.w() = file.number("quaternion");
    image.rotation.vec() = file.vector("quaternion");
    image.translation = file.vector("translation");
    image.camera_id = file.integer<std::uint32_t>("camera number");
    image.name = file.rest();
    // Empty for an image without points; it may be missing at the end of the file alone.
    if (file.next_line())
      while (!file.at_end()) {
        ColmapModel::Feature feature;
        feature.x = file.number("point");
        feature.y = file.number("point");
        const auto id = file.integer<std::int64_t>("number of a 3D point");
        feature.point_id = id < 0 ? ColmapModel::kNoPoint : std::uint64_t(id);
        image.features.push_back(feature);
      }
    accept(std::move(image), where, model);
  }
}

void parse_points(std::string_view bytes, const std::string& where, ColmapModel& model) {
  LineReader file(bytes, where);
  while (file.next_entry()) {
    ColmapModel::Point point;
    point.id = file.integer<std::uint64_t>("point number");
    point.position = file.vector("position");
    for (std::uint8_t& value : point.rgb) value = file.integer<std::uint8_t>("colour");
    point.error = file.number("error");
    while (!file.at_end()) {
      const auto image_id = file.integer<std::uint32_t>("image number");
      point.track.push_back({image_id, file.integer<std::uint32_t>("feature number")});
    }
    accept(std::move(point), where, model);
  }
}

/// Appends the shortest text that is read back as the same number, whatever the locale.
template <class T>
void append(std::string& text, T value, char before = ' ') {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  if (before) text += before;
  text.append(digits, end);
}

void append(std::string& text, const Eigen::Vector3d& vector) {
  for (const double value : vector) append(text, value);
}

std::string print_cameras(const ColmapModel& model) {
  std::string text =
      "# Camera list with one line of data per camera:\n"
      "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n";
  for (const auto& [id, lens] : model.cameras) {
    append(text, id, '\0');
    text += " " + lens.model;
    append(text, lens.width);
    append(text, lens.height);
    for (const double value : lens.params) append(text, value);
    text += '\n';
  }
  return text;
}

std::string print_images(const ColmapModel& model) {
  std::string text =
      "# Image list with two lines of data per image:\n"
      "#   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
      "#   POINTS2D[] as (X, Y, POINT3D_ID)\n";
  for (const ColmapModel::Image& image : model.images) {
    append(text, image.id, '\0');
    append(text, image.rotation.w());
    append(text, Eigen::Vector3d(image.rotation.vec()));
    append(text, image.translation);
    append(text, image.camera_id);
    text += " " + image.name + "\n";
    for (const ColmapModel::Feature& feature : image.features) {
      append(text, feature.x, &feature == &image.features.front() ? '\0' : ' ');
      append(text, feature.y);
      append(text, std::int64_t(feature.point_id));  // kNoPoint is -1
    }
    text += '\n';
  }
  return text;
}

std::string print_points(const ColmapModel& model) {
  std::string text =
      "# 3D point list with one line of data per point:\n"
      "#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n";
  for (const ColmapModel::Point& point : model.points) {
    append(text, point.id, '\0');
    append(text, point.position);
    for (const std::uint8_t value : point.rgb) append(text, value);
    append(text, point.error);
    for (const ColmapModel::Sight& sight : point.track) {
      append(text, sight.image_id);
      append(text, sight.feature_idx);
    }
    text += '\n';
  }
  return text;
}

}  // namespace

const ColmapParser kTextColmapParser{parse_cameras, parse_images, parse_points};
const ColmapPrinter kTextColmapPrinter{print_cameras, print_images, print_points};

}  // namespace gigaray
