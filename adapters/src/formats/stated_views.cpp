// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "formats/stated_views.h"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "features/points_beside.h"
#include "formats/view_names.h"
#include "gigaray/adapters/input_file.h"
#include "pictures/mask_folder.h"
#include "pictures/picture_files.h"
#include "pictures/picture_folder.h"
#include "pictures/picture_lookup.h"
#include "pictures/posed_pictures.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

void complete_lens(StatedView& view, const fs::path& picture, double limit) {
  Lens& lens = view.lens;
  if (lens.width > 0) return;
  const PictureSpec spec = read_picture_spec(picture, Orientation::kIgnored, limit);
  lens.width = spec.width;
  lens.height = spec.height;
  if (view.may_be_of_a_copy && lens.params.size() >= 4) {
    const double octaves_u = std::round(std::log2(spec.width / (2 * lens.params[2]))),
                 octaves_v = std::round(std::log2(spec.height / (2 * lens.params[3])));
    if (octaves_u == octaves_v && octaves_u != 0) {
      lens.width = int(std::lround(spec.width / std::exp2(octaves_u)));
      lens.height = int(std::lround(spec.height / std::exp2(octaves_u)));
    }
  }
  if (view.is_centred && lens.params.size() >= 4) {
    lens.params[2] = spec.width / 2.0;
    lens.params[3] = spec.height / 2.0;
  }
  if (view.field_of_view)
    lens = centred_pinhole(spec.width, spec.height,
                           spec.width / 2.0 / std::tan(*view.field_of_view / 2));
}

}  // namespace

StatedView view_of_file(StatedView (*parse)(std::string_view text, const std::string& where),
                        const fs::path& file) {
  try {
    return parse(read_text(file), file.string());
  } catch (const Error& problem) {
    if (problem.code() != ErrorCode::kBadInput) throw;
    StatedView view;
    view.fault = problem.what();
    return view;
  }
}

void set_pose(StatedView& view, const StatedPose& matrix, const PoseConvention& convention,
              const std::string& where) {
  view.matrix = matrix;
  view.convention = convention;
  if (!matrix.allFinite()) {
    view.fault = where + ": its pose holds a number that is not finite";
    return;
  }
  const auto pose = read_pose(matrix, convention);
  if (pose)
    view.pose = *pose;
  else
    view.fault = where + ": its rotation is none (its axes are not orthogonal or of one length)";
}

namespace {

/// A camera that can't be used is left out, unless none can or nothing may be.
void refuse_faulty(const std::vector<StatedView>& views, bool strict) {
  const auto is_faulty = [](const StatedView& view) { return !view.fault.empty(); };
  const auto first = std::ranges::find_if(views, is_faulty);
  if (first != views.end() && (strict || std::ranges::all_of(views, is_faulty)))
    throw Error(ErrorCode::kBadInput, first->fault);
}

/// Left-handed frames are that in all views or in none. Are they?
bool find_mirrored(std::vector<StatedView>& views, const std::string& where,
                   std::vector<std::string>& notes) {
  const auto is_mirrored = [](const StatedView& view) {
    return view.fault.empty() && view.pose.is_mirrored;
  };
  const auto count = std::ranges::count_if(views, is_mirrored);
  if (count == 0) return false;
  const bool all = 2 * std::size_t(count) > views.size();
  for (StatedView& view : views)
    if (view.fault.empty() && is_mirrored(view) != all)
      view.fault = where + ": the frame of " + view.picture + " is " + (all ? "right" : "left") +
                   "-handed, unlike the others";
  if (all)
    notes.push_back("the frames are left-handed: z of the scene is turned around to read them");
  return all;
}

}  // namespace

LightField open_stated_views(std::vector<StatedView> views, const fs::path& file,
                             const std::vector<fs::path>& folders, const OpenOptions& options,
                             const std::string& format, const std::string& points) {
  if (views.size() < 2)
    throw Error(ErrorCode::kBadInput, file.string() + ": states " +
                                          (views.empty() ? "no camera" : "only one camera") +
                                          "; depth needs two views or more");
  const std::vector<fs::path> places =
      options.images.empty() ? folders : std::vector{options.images};
  std::sort(views.begin(), views.end(),
            [](const StatedView& a, const StatedView& b) { return a.picture < b.picture; });
  refuse_faulty(views, options.strict);
  if (options.convention)
    for (StatedView& view : views)
      if (view.fault.empty())
        set_pose(view, view.matrix, *options.convention, file.string() + ", " + view.picture);
  std::vector<std::string> notes;
  const bool is_mirrored = find_mirrored(views, file.string(), notes);
  std::vector<std::string> stated;
  for (const StatedView& view : views) stated.push_back(view.picture);
  const auto [place, names] = find_names(places, stated);
  for (std::size_t i = 1; i < names.size(); ++i)
    if (names[i] == names[i - 1])
      throw Error(ErrorCode::kBadInput,
                  file.string() + ": states the camera of " + names[i] + " twice");
  const fs::path folder =
      folder_of_pictures(file, {place}, names, options.strict ? names.size() : kLeastPictures);
  const std::vector<std::string> view_name = view_names(names);

  const PictureLookup beside_file(file.parent_path());
  const double limit = opening_limit(options.memory_bytes);
  std::vector<PosedPicture> pictures;
  for (std::size_t i = 0; i < views.size(); ++i) {
    StatedView& view = views[i];
    PosedPicture picture;
    picture.file = folder / names[i];
    picture.name = view_name[i];
    picture.fault = view.fault;
    if (picture.fault.empty() && view.lens.width == 0)
      picture.fault = fault_of_picture(picture.file, Orientation::kIgnored, limit);
    if (picture.fault.empty()) complete_lens(view, picture.file, limit);
    picture.lens = view.lens;
    picture.rotation = view.pose.rotation;
    picture.translation = view.pose.translation;
    picture.inverse_depth = view.inverse_depth;
    if (!view.mask.empty() && options.masks.empty()) {
      const std::string mask = beside_file.find(view.mask);
      picture.mask = file.parent_path() / (mask.empty() ? view.mask : mask);
    }
    pictures.push_back(std::move(picture));
  }
  if (!options.masks.empty()) attach_masks(pictures, names, options.masks, notes);
  LightField light_field =
      posed_light_field(std::move(pictures), format, options.memory_bytes, options.strict);
  const auto usable =
      std::ranges::find_if(views, [](const StatedView& view) { return view.fault.empty(); });
  light_field.pose_reading = PoseReading{name_of(usable->convention), is_mirrored};
  light_field.notes.insert(light_field.notes.begin(), notes.begin(), notes.end());
  std::error_code ignored;
  const fs::path beside = fs::is_directory(file, ignored) ? file : file.parent_path();
  if (const fs::path cloud = points_beside(beside.empty() ? "." : beside, points); !cloud.empty())
    take_range_of_points(light_field, cloud, options.memory_bytes);
  return light_field;
}

}  // namespace gigaray
