// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "stated_views.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "gigaray/adapters/input_file.h"
#include "mask_folder.h"
#include "picture_files.h"
#include "picture_folder.h"
#include "posed_pictures.h"
#include "view_names.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

/// The name of a picture in a folder: its extension is added where the file leaves it out.
std::string name_in(const fs::path& folder, const std::string& stated) {
  std::error_code ignored;
  for (const char* extension : {"", ".png", ".jpg", ".jpeg", ".JPG", ".PNG"})
    if (fs::is_regular_file(folder / (stated + extension), ignored)) return stated + extension;
  return stated;
}

/// The pictures of a folder that was named with --images, whose names may begin with other folders.
std::vector<std::string> names_in_stated_folder(const std::vector<StatedView>& views,
                                                const fs::path& folder) {
  std::vector<std::string> names;
  for (const StatedView& view : views) {
    std::string name = name_in(folder, view.picture);
    std::error_code ignored;
    if (!fs::is_regular_file(folder / name, ignored))
      name = name_in(folder, fs::path(view.picture).filename().string());
    names.push_back(std::move(name));
  }
  return names;
}

std::vector<std::string> names_below(const std::vector<StatedView>& views,
                                     const std::vector<fs::path>& folders) {
  std::vector<std::string> names;
  for (const StatedView& view : views) {
    std::string name = view.picture;
    for (const fs::path& folder : folders)
      if (name == view.picture) name = name_in(folder, view.picture);
    names.push_back(std::move(name));
  }
  return names;
}

void complete_lens(StatedView& view, const fs::path& picture, double limit) {
  Lens& lens = view.lens;
  if (lens.width > 0) return;
  const PictureSpec spec = read_picture_spec(picture, Orientation::kIgnored, limit);
  lens.width = spec.width;
  lens.height = spec.height;
  if (view.field_of_view)
    lens = centred_pinhole(spec.width, spec.height,
                           spec.width / 2.0 / std::tan(*view.field_of_view / 2));
}

}  // namespace

void set_pose(StatedView& view, const Eigen::Matrix3d& axes, const Eigen::Vector3d& position,
              const std::string& where) {
  constexpr double kRounding = 1e-3;
  const auto bad = [&](const char* what) {
    throw Error(ErrorCode::kBadInput, where + ": " + what);
  };
  if (!axes.allFinite() || !position.allFinite()) bad("its pose holds a number that is not finite");
  const Eigen::Matrix3d square = axes * axes.transpose();
  if ((square - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() > kRounding ||
      axes.determinant() < 0)
    bad("its rotation is none (not orthonormal, or mirrored)");
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
  view.rotation = (svd.matrixU() * svd.matrixV().transpose()).transpose();
  view.translation = -view.rotation * position;
}

LightField open_stated_views(std::vector<StatedView> views, const fs::path& file,
                             const std::vector<fs::path>& folders, const OpenOptions& options,
                             const std::string& format) {
  if (views.size() < 2)
    throw Error(ErrorCode::kBadInput, file.string() + ": states " +
                                          (views.empty() ? "no camera" : "only one camera") +
                                          "; depth needs two views or more");
  const bool is_stated = !options.images.empty();
  const std::vector<fs::path> places = is_stated ? std::vector{options.images} : folders;
  std::sort(views.begin(), views.end(),
            [](const StatedView& a, const StatedView& b) { return a.picture < b.picture; });
  const std::vector<std::string> names =
      is_stated ? names_in_stated_folder(views, options.images) : names_below(views, folders);
  for (std::size_t i = 1; i < names.size(); ++i)
    if (names[i] == names[i - 1])
      throw Error(ErrorCode::kBadInput,
                  file.string() + ": states the camera of " + names[i] + " twice");
  const fs::path folder = folder_of_pictures(file, places, names);
  const std::vector<std::string> view_name = view_names(names);

  const double limit = opening_limit(options.memory_bytes);
  std::vector<PosedPicture> pictures;
  for (std::size_t i = 0; i < views.size(); ++i) {
    StatedView& view = views[i];
    PosedPicture picture;
    picture.file = folder / names[i];
    picture.name = view_name[i];
    complete_lens(view, picture.file, limit);
    picture.lens = view.lens;
    picture.rotation = view.rotation;
    picture.translation = view.translation;
    picture.inverse_depth = view.inverse_depth;
    if (!view.mask.empty() && options.masks.empty()) picture.mask = file.parent_path() / view.mask;
    pictures.push_back(std::move(picture));
  }
  std::vector<std::string> notes;
  if (!options.masks.empty()) attach_masks(pictures, names, options.masks, notes);
  LightField light_field = posed_light_field(std::move(pictures), format, options.memory_bytes);
  light_field.notes.insert(light_field.notes.begin(), notes.begin(), notes.end());
  return light_field;
}

}  // namespace gigaray
