// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "pictures/projection.h"

#include <cmath>

#include "files/text.h"
#include "gigaray/core/error.h"

namespace gigaray {

std::vector<double> finite_numbers(const std::vector<std::string>& words, std::size_t first,
                                   const std::string& where, PoseAt pose) {
  std::vector<double> numbers;
  for (std::size_t i = first; i < words.size(); ++i) {
    const auto value = parse_number(words[i]);
    const bool is_pose = numbers.size() >= pose.begin && numbers.size() < pose.end;
    if (!value || !(is_pose || std::isfinite(*value)))
      throw Error(ErrorCode::kBadInput,
                  where + ": " + in_quotes(words[i]) + " is no finite number");
    numbers.push_back(*value);
  }
  return numbers;
}

void set_projection(StatedView& view, const double* k, const std::string& where) {
  constexpr double kMostSkew = 1e-3;  // px
  const bool is_plain =
      std::abs(k[1]) <= kMostSkew && k[3] == 0 && k[6] == 0 && k[7] == 0 && k[8] == 1;
  if (!is_plain)
    throw Error(ErrorCode::kBadInput, where + ": its K is not of the form fx 0 cx, 0 fy cy, 0 0 1");
  constexpr double kCorner = 0.5;  // Lens has pixel corners at integers
  view.lens.model = "PINHOLE";
  view.lens.params = {k[0], k[4], k[2] + kCorner, k[5] + kCorner};
}

}  // namespace gigaray
