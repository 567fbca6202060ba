// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// A rectified pair im0, im1 with calib.txt: Middlebury's sets of 2014 and 2021 and its benchmark,
// https://vision.middlebury.edu/stereo/data/scenes2014, and ETH3D's two-view sets. im1 is taken
// from the right. The pair is one view step apart, so that disparities are those of the pair, as
// the truth states them: infinity is at -doffs.
#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "files/text.h"
#include "formats/camera_position.h"
#include "formats/readers.h"
#include "formats/stereo_calibration.h"
#include "gigaray/adapters/input_file.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

/// What a disparity is at most when calib.txt doesn't state it, of the width: the sets have up to
/// 0.3.
constexpr double kMostDisparity = 1.0 / 3;

struct Pair {
  fs::path left, right, calibration;
};

std::optional<Pair> pair_in(const fs::path& input) {
  std::error_code ignored;
  if (!fs::is_directory(input, ignored)) return {};
  Pair pair;
  for (const fs::path& path : files_of(input)) {
    const std::string name = lower(path.filename().string()), stem = lower(path.stem().string());
    if (name == "calib.txt") pair.calibration = path;
    if ((stem != "im0" && stem != "im1") || !is_picture(path)) continue;
    (stem == "im0" ? pair.left : pair.right) = path;
  }
  if (pair.left.empty() || pair.right.empty() || pair.calibration.empty()) return {};
  constexpr std::uintmax_t kMostBytes = 1 << 16;
  if (fs::file_size(pair.calibration, ignored) > kMostBytes) return {};
  return pair;
}

bool is_calibrated(const Pair& pair) {
  try {
    return is_stereo_calibration(read_text(pair.calibration));
  } catch (const Error&) {
    return false;  // open() of whatever reads the pictures has nothing to say of it
  }
}

/// The calibration for pictures of another size of the same shape.
void scale(StereoCalibration& calibration, const LightField& pictures, const std::string& where,
           std::vector<std::string>& notes) {
  if (calibration.width == 0 || calibration.height == 0) return;
  const double by = double(pictures.width) / calibration.width;
  if (pictures.width == calibration.width && pictures.height == calibration.height) return;
  const std::string sizes = "is for pictures of " +
                            size_text(calibration.width, calibration.height) + " px, these have " +
                            size_text(pictures.width, pictures.height);
  if (std::abs(calibration.height * by - pictures.height) > 1)
    throw Error(
        ErrorCode::kBadInput,
        where + ": " + sizes + ", which is no scaled size of it; take the file of this size");
  notes.push_back(where + " " + sizes + ": it is scaled");
  calibration.focal_px *= by;
  calibration.doffs *= by;
  calibration.centre_u = (calibration.centre_u + 0.5) * by - 0.5;
  calibration.centre_v = (calibration.centre_v + 0.5) * by - 0.5;
  if (calibration.disparities) *calibration.disparities *= by;
}

class CalibratedPairReader : public Reader {
 public:
  std::string name() const override { return "Middlebury stereo pair with calib.txt"; }

  ProbeResult probe(const fs::path& input) const override {
    const auto pair = pair_in(input);
    return {pair && is_calibrated(*pair) ? 60 : 0, ""};
  }

  LightField open(const fs::path& input, const OpenOptions& options) const override {
    refuse_direction(options, "a Middlebury stereo pair states");
    const Pair pair = pair_in(input).value();
    StereoCalibration calibration =
        parse_stereo_calibration(read_text(pair.calibration), pair.calibration.string());
    LightField light_field;
    light_field.kind = LightFieldKind::k3D;
    light_field.views = {{pair.left.stem().string(), -0.5, 0},
                         {pair.right.stem().string(), 0.5, 0}};
    attach_pictures(light_field, {pair.left, pair.right}, options);
    auto& notes = light_field.notes;
    scale(calibration, light_field, pair.calibration.filename().string(), notes);

    RigGeometry& rig = light_field.rig;
    rig.focal_px = calibration.focal_px;
    rig.baseline = calibration.baseline;
    rig.unit = "mm";
    if (calibration.doffs != 0)
      rig.focus_distance = calibration.focal_px * calibration.baseline / calibration.doffs;
    rig.principal_point =
        Eigen::Vector2d(calibration.centre_u + calibration.doffs / 2, calibration.centre_v);
    const double most = calibration.disparities ? std::ceil(*calibration.disparities)
                                                : std::round(kMostDisparity * light_field.width);
    light_field.declared_range = DisparityRange{0, std::max(1.0, most)};
    if (!calibration.disparities)
      notes.push_back(
          "disparities up to " + std::to_string(int(most)) +
          " px are assumed, a third of the width (ndisp in calib.txt or DepthOptions::disparity "
          "states them)");
    return light_field;
  }
};

}  // namespace

std::unique_ptr<const Reader> calibrated_pair_reader() {
  return std::make_unique<CalibratedPairReader>();
}

}  // namespace gigaray
