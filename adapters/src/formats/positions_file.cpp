// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "formats/positions_file.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "files/text.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/core/error.h"

namespace gigaray {
namespace {

struct Line {
  int number = 0;  // in the file, from 1
  std::string name;
  CameraPosition position;
};

class Parser {
 public:
  explicit Parser(const std::string& where) : where_(where) {}

  /// One for each picture.
  std::vector<Line> lines(std::string_view text, std::size_t pictures) const {
    std::vector<Line> lines;
    std::size_t found = 0;
    for (int number = 1; !text.empty(); ++number) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      const std::string_view line = text.substr(0, end);
      text.remove_prefix(std::min(end + 1, text.size()));
      const auto words = split_words(line.substr(0, line.find('#')));
      if (!words.empty() && ++found <= pictures) lines.push_back(parse(number, words));
    }
    if (found != pictures)
      bad(std::to_string(found) + " positions for " + std::to_string(pictures) + " pictures");
    return lines;
  }

  [[noreturn]] void bad(int line, const std::string& what) const {
    throw Error(ErrorCode::kBadInput, where_ + ":" + std::to_string(line) + ": " + what);
  }
  [[noreturn]] void bad(const std::string& what) const {
    throw Error(ErrorCode::kBadInput, where_ + ": " + what);
  }

 private:
  Line parse(int number, const std::vector<std::string>& words) const {
    Line line;
    line.number = number;
    const bool named = words.size() == 3 || (words.size() == 2 && !parse_number(words[0]));
    if (named) line.name = words[0];
    const std::size_t first = named ? 1 : 0;
    if (words.size() > 3) bad(number, "more than a name and two numbers");
    line.position.right = coordinate(number, words[first]);
    if (words.size() > first + 1) line.position.down = coordinate(number, words[first + 1]);
    return line;
  }

  double coordinate(int number, const std::string& word) const {
    const auto value = parse_number(word);
    if (!value || !std::isfinite(*value)) bad(number, in_quotes(word) + " is not a finite number");
    return *value;
  }

  const std::string& where_;
};

}  // namespace

std::vector<CameraPosition> read_positions(const std::filesystem::path& path,
                                           const std::vector<std::filesystem::path>& pictures) {
  return parse_positions(read_text(path), path.string(), pictures);
}

std::vector<CameraPosition> parse_positions(std::string_view text, const std::string& where,
                                            const std::vector<std::filesystem::path>& pictures) {
  const Parser parser(where);
  const std::vector<Line> lines = parser.lines(text, pictures.size());

  std::map<std::string, std::size_t> index_of;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    index_of[pictures[i].stem().string()] = i;
    index_of[pictures[i].filename().string()] = i;
  }
  std::vector<std::optional<CameraPosition>> found(pictures.size());
  std::map<std::pair<double, double>, int> line_at;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Line& line = lines[i];
    if (line.name.empty() != lines.front().name.empty())
      parser.bad(line.number, "either every line has a name or none");
    std::size_t picture = i;
    if (!line.name.empty()) {
      const auto match = index_of.find(line.name);
      if (match == index_of.end())
        parser.bad(line.number, "no picture is named " + in_quotes(line.name));
      picture = match->second;
    }
    if (found[picture]) parser.bad(line.number, in_quotes(line.name) + " has two positions");
    const auto [other, is_new] =
        line_at.emplace(std::pair(line.position.right, line.position.down), line.number);
    if (!is_new)
      parser.bad(line.number, "the same position as line " + std::to_string(other->second));
    found[picture] = line.position;
  }
  std::vector<CameraPosition> positions;
  for (const auto& position : found) positions.push_back(position.value());
  return positions;
}

}  // namespace gigaray
