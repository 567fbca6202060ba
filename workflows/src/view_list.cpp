// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/workflows/view_list.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>

#include "gigaray/workflows/did_you_mean.h"

namespace gigaray {
namespace {

std::optional<int> index_of(const std::string& text, const LightField& light_field) {
  int index = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if (index < 0 || index >= light_field.num_views())
    throw Error(ErrorCode::kInvalidArgument, "view " + text + ": there are views 0 … " +
                                                 std::to_string(light_field.num_views() - 1));
  return index;
}

}  // namespace

int parse_view(const std::string& text, const LightField& light_field) {
  if (text == "centre") return centre_view(light_field);
  for (int i = 0; i < light_field.num_views(); ++i)
    if (light_field.views[i].name == text) return i;
  if (const auto index = index_of(text, light_field)) return *index;
  std::vector<std::string> known{"centre"};
  for (const View& view : light_field.views) known.push_back(view.name);
  throw Error(ErrorCode::kInvalidArgument,
              "view " + text + ": no view has this name or index" + did_you_mean(text, known));
}

std::vector<int> parse_views(const std::string& text, const LightField& light_field) {
  if (text == "all") return {};
  std::vector<int> views;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    const auto dash = part.find('-');
    const bool is_name = std::any_of(light_field.views.begin(), light_field.views.end(),
                                     [&](const View& view) { return view.name == part; });
    if (is_name || dash == std::string::npos || dash == 0) {
      views.push_back(parse_view(part, light_field));
      continue;
    }
    const auto first = index_of(part.substr(0, dash), light_field);
    const auto last = index_of(part.substr(dash + 1), light_field);
    if (!first || !last || *first > *last)
      throw Error(ErrorCode::kInvalidArgument, "`views` " + part + ": neither a view nor a range");
    for (int i = *first; i <= *last; ++i) views.push_back(i);
  }
  if (views.empty()) throw Error(ErrorCode::kInvalidArgument, "`views`: no view is named");
  std::sort(views.begin(), views.end());
  views.erase(std::unique(views.begin(), views.end()), views.end());
  return views;
}

}  // namespace gigaray
