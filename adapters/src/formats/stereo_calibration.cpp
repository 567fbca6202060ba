// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// https://vision.middlebury.edu/stereo/data/scenes2014: lines "key=value"; cam0 and cam1 are K by
// rows, "[f 0 cx; 0 f cy; 0 0 1]". ETH3D's two-view sets have the same file with fewer keys.
#include "formats/stereo_calibration.h"

#include <cmath>
#include <map>

#include "files/text.h"
#include "gigaray/core/error.h"
#include "pictures/projection.h"

namespace gigaray {
namespace {

using Values = std::map<std::string, std::string>;

Values values_of(std::string_view text) {
  Values values;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const auto sign = line.find_first_of("=:");
    if (sign == std::string_view::npos) continue;
    values[lower(std::string(trimmed(line.substr(0, sign))))] = trimmed(line.substr(sign + 1));
  }
  return values;
}

}  // namespace

bool is_stereo_calibration(std::string_view text) {
  const Values values = values_of(text);
  return values.contains("cam0") && values.contains("baseline");
}

StereoCalibration parse_stereo_calibration(std::string_view text, const std::string& where) {
  const Values values = values_of(text);
  const auto number = [&](const char* key) -> std::optional<double> {
    const auto found = values.find(key);
    if (found == values.end()) return std::nullopt;
    return finite_numbers({found->second}, 0, where + ", " + key).front();
  };
  const auto needed = [&](const char* key) {
    const auto value = number(key);
    if (!value) throw Error(ErrorCode::kBadInput, where + ": has no " + key);
    return *value;
  };
  const auto bad = [&](const std::string& what) {
    throw Error(ErrorCode::kBadInput, where + ": " + what);
  };
  const auto matrix = [&](const char* key) {
    std::string rows = values.at(key);
    std::erase_if(rows, [](char c) { return c == '[' || c == ']'; });
    const std::vector<double> k = finite_numbers(split_words(rows), 0, where + ", " + key);
    if (k.size() != 9 || !(k[0] > 0))
      bad(std::string(key) + " is no matrix [f 0 cx; 0 f cy; 0 0 1]");
    return k;
  };
  if (!values.contains("cam0")) bad("has no cam0");
  StereoCalibration calibration;
  const std::vector<double> left = matrix("cam0");
  calibration.focal_px = left[0];
  calibration.centre_u = left[2];
  calibration.centre_v = left[5];
  calibration.baseline = needed("baseline");
  if (!(calibration.baseline > 0)) bad("its baseline is not above 0");
  const double apart = values.contains("cam1") ? matrix("cam1")[2] - left[2] : 0;
  calibration.doffs = number("doffs").value_or(apart);
  calibration.disparities = number("ndisp");
  if (calibration.disparities && !(*calibration.disparities >= 1)) bad("its ndisp is below 1");
  constexpr double kMostSize = 1 << 20;
  for (const auto& [key, size] :
       {std::pair("width", &calibration.width), std::pair("height", &calibration.height)}) {
    const double value = number(key).value_or(0);
    if (!(value >= 0 && value <= kMostSize)) bad(std::string(key) + " is no size of a picture");
    *size = int(value);
  }
  return calibration;
}

}  // namespace gigaray
