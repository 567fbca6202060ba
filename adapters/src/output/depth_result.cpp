// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/depth_result.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <system_error>

#include "files/text.h"
#include "formats/described_light_field.h"
#include "gigaray/adapters/depth_folder.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/maps.h"
#include "gigaray/adapters/reader.h"
#include "gigaray/adapters/shrunk.h"
#include "gigaray/core/arguments.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Undistorted pictures that lie beside the maps; smaller ones are masked at the right and bottom.
class PicturesBesideMaps : public PixelSource {
 public:
  PicturesBesideMaps(std::vector<fs::path> files, const LightField& light_field)
      : files_(std::move(files)),
        width_(light_field.width),
        height_(light_field.height),
        limit_(opening_limit()) {
    for (const fs::path& file : files_) {
      const PictureSpec spec = read_picture_spec(file, Orientation::kIgnored, limit_);
      bit_depth_ = std::max(bit_depth_, spec.bit_depth);
      has_mask_ = has_mask_ || spec.width != width_ || spec.height != height_;
      if (spec.width > width_ || spec.height > height_)
        throw Error(ErrorCode::kBadInput, file.string() + ": is larger than gigaray.json states");
      constexpr double kCanvas = 8;  // bytes per px
      hold_against_limit(
          file.string(),
          "is brought to the " + size_text(width_, height_) + " px that gigaray.json states",
          kCanvas * width_ * height_, limit_);
    }
  }
  bool has_mask() const override { return has_mask_; }
  int bit_depth() const override { return bit_depth_; }

  Image<std::uint16_t> read(int view) const override {
    PictureSpec spec;
    Image<std::uint16_t> picture =
        decode_picture(files_.at(std::size_t(view)), Orientation::kIgnored, spec, limit_);
    if (!has_mask_) return picture;
    Image<std::uint16_t> canvas(width_, height_, 4);
    for (int v = 0; v < picture.height(); ++v)
      for (int u = 0; u < picture.width(); ++u) {
        std::copy_n(&picture(u, v), 3, &canvas(u, v));
        canvas(u, v, 3) = std::uint16_t((1 << bit_depth_) - 1);
      }
    return canvas;
  }

 private:
  std::vector<fs::path> files_;
  int width_, height_, bit_depth_ = 8;
  double limit_;
  bool has_mask_ = false;
};

json read_json(const fs::path& path) { return json::parse(read_json_text(path), nullptr, false); }

}  // namespace

Camera read_camera(const fs::path& path) {
  const json root = read_json(path);
  if (!root.is_object())
    throw Error(ErrorCode::kBadInput, path.string() + ": is damaged or no JSON object");
  try {
    return camera_of(root.contains("camera") ? root["camera"] : root, "camera");
  } catch (const json::exception& problem) {
    throw Error(ErrorCode::kBadInput, path.string() + ": holds no camera (" + problem.what() + ")");
  } catch (const Error& problem) {
    throw Error(problem.code(), path.string() + ": " + problem.what());
  }
}

DepthResult::DepthResult(const fs::path& folder) : folder_(folder) {
  std::error_code ignored;
  if (!fs::is_regular_file(folder / "gigaray.json", ignored))
    throw Error(ErrorCode::kBadInput,
                folder.string() + ": is no result of `gigaray depth` (it has no gigaray.json)");
  const fs::path path = folder / "gigaray.json";
  DescribedDepth described = parse_depth_json(read_json_text(path), path.string());
  light_field_ = std::move(described.light_field);
  input_ = std::move(described.input);
  opened_with_ = std::move(described.opened_with);
  searched_ = described.searched;
  hypotheses_ = described.hypotheses;
  top_view_ = described.top_view;
}

FloatMap DepthResult::map(int view, const char* name) const {
  require_argument(view >= 0 && view < light_field_.num_views(),
                   "view: the result has no such view");
  const fs::path path = folder_ / light_field_.views[view].name / name;
  FloatMap map = read_pfm(path);
  const bool unstructured = light_field_.kind == LightFieldKind::kUnstructured;
  const int width = unstructured ? light_field_.cameras[view].width : light_field_.width;
  const int height = unstructured ? light_field_.cameras[view].height : light_field_.height;
  if (map.width() != width || map.height() != height)
    throw Error(ErrorCode::kBadInput, path.string() + ": is " +
                                          size_text(map.width(), map.height()) + ", the view is " +
                                          size_text(width, height));
  return map;
}

LightField DepthResult::open_input(const fs::path& input) const {
  const fs::path place = input.empty() ? input_ : input;
  const auto bad = [&](const std::string& what) {
    return Error(ErrorCode::kBadInput, place.string() + ": " + what +
                                           "; name the light field that " + folder_.string() +
                                           " was computed of as `input`");
  };
  if (place.empty())
    throw Error(ErrorCode::kBadInput, folder_.string() +
                                          ": was computed of pictures in memory; name the light "
                                          "field as `input`");
  std::error_code error;
  if (!fs::exists(place, error)) throw bad("no such file or folder");
  LightField all = open_light_field(place, opened_with_);
  if (all.width > light_field_.width)
    all = shrunk(std::move(all), std::max(light_field_.width, light_field_.height));
  if (all.width != light_field_.width || all.height != light_field_.height)
    throw bad("its pictures are " + size_text(all.width, all.height) + ", the maps " +
              size_text(light_field_.width, light_field_.height));
  return all;
}

LightField DepthResult::with_pictures(const fs::path& input) const {
  LightField light_field = light_field_;
  if (light_field.kind == LightFieldKind::kUnstructured) {
    std::vector<fs::path> files;
    for (const View& view : light_field.views) files.push_back(folder_ / view.name / "picture.png");
    light_field.pixels = std::make_shared<PicturesBesideMaps>(std::move(files), light_field);
    return light_field;
  }
  LightField all = open_input(input);
  std::map<std::string, int> index;
  for (int i = 0; i < all.num_views(); ++i) index[all.views[i].name] = i;
  std::vector<int> which;
  for (const View& view : light_field.views) {
    const auto found = index.find(view.name);
    if (found == index.end())
      throw Error(ErrorCode::kBadInput, (input.empty() ? input_ : input).string() +
                                            ": it has no view " + view.name + ", of which " +
                                            folder_.string() + " has depth");
    which.push_back(found->second);
  }
  light_field.pixels = pictures_of(std::move(all), std::move(which));
  return light_field;
}

}  // namespace gigaray
