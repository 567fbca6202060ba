// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// A stereo pair of the Middlebury sets of 2003 (im2, im6) and 2005 / 2006 (view1, view5),
// https://vision.middlebury.edu/stereo/data: the second picture is taken from the right. The pair
// is one view step apart, so that disparities are those of the pair.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "formats/camera_position.h"
#include "formats/readers.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

/// Of the width: the sets have up to 0.15.
constexpr double kMostDisparity = 1.0 / 6;

using PicturePair = std::pair<fs::path, fs::path>;

/// The pair, if the folder holds no other view of its series and the disparity of one side: the
/// names alone are too common.
std::optional<PicturePair> pair_in(const fs::path& input) {
  struct Names {
    const char *series, *left, *right, *disparity;
  };
  static constexpr std::array<Names, 2> kNames{
      {{"im", "im2", "im6", "disp2"}, {"view", "view1", "view5", "disp1"}}};
  const std::vector<fs::path> pictures = pictures_of(input);
  for (const Names& names : kNames) {
    const auto find = [&](const char* stem) {
      const auto found =
          std::ranges::find_if(pictures, [&](const fs::path& path) { return path.stem() == stem; });
      return found == pictures.end() ? fs::path() : *found;
    };
    const auto in_series = std::ranges::count_if(pictures, [&](const fs::path& path) {
      return path.stem().string().starts_with(names.series);
    });
    const PicturePair pair{find(names.left), find(names.right)};
    if (in_series == 2 && !pair.first.empty() && !pair.second.empty() &&
        !find(names.disparity).empty())
      return pair;
  }
  return {};
}

class MiddleburyStereoReader : public Reader {
 public:
  std::string name() const override { return "Middlebury stereo pair"; }

  ProbeResult probe(const fs::path& input) const override { return {pair_in(input) ? 50 : 0, ""}; }

  LightField open(const fs::path& input, const OpenOptions& options) const override {
    refuse_direction(options, "a Middlebury stereo pair states");
    const auto [left, right] = pair_in(input).value();
    LightField light_field;
    light_field.kind = LightFieldKind::k3D;
    light_field.views = {{left.stem().string(), -0.5, 0}, {right.stem().string(), 0.5, 0}};
    attach_pictures(light_field, {left, right}, options);
    light_field.declared_range = DisparityRange{0, std::round(kMostDisparity * light_field.width)};
    light_field.notes.push_back(
        "disparities up to " + std::to_string(int(light_field.declared_range->max)) +
        " px are assumed, a sixth of the width (DepthOptions::disparity states them)");
    return light_field;
  }
};

}  // namespace

std::unique_ptr<const Reader> middlebury_stereo_reader() {
  return std::make_unique<MiddleburyStereoReader>();
}

}  // namespace gigaray
