// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// A COLMAP workspace, https://colmap.github.io/format.html: photographs and the sparse model of
// their cameras. Its axes are those of gigaray::Camera, its pixels are half a pixel off (lens.h).
#include <algorithm>
#include <system_error>
#include <unordered_map>

#include "colmap/colmap_folders.h"
#include "features/points_beside.h"
#include "files/text.h"
#include "formats/camera_position.h"
#include "formats/readers.h"
#include "formats/view_names.h"
#include "pictures/mask_folder.h"
#include "pictures/picture_folder.h"
#include "pictures/picture_lookup.h"
#include "pictures/posed_pictures.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "COLMAP workspace";
const PoseConvention kConvention{"RDF", true};

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

/// Where the pictures of a model may lie.
std::vector<fs::path> folders_around(const fs::path& model) {
  // WORKSPACE/sparse/0 is three deep at most.
  fs::path above = fs::absolute(model).lexically_normal();
  if (!above.has_filename()) above = above.parent_path();
  std::vector<fs::path> folders;
  for (int i = 0; i < 3; ++i, above = above.parent_path()) {
    folders.push_back(above / "images");
    folders.push_back(above);
  }
  return folders;
}

/// Depths of the sparse points, per image.
class SparseDepths {
 public:
  explicit SparseDepths(const ColmapModel& model) : model_(model) {
    std::vector<double> errors;
    for (const ColmapModel::Point& point : model.points)
      if (point.error >= 0) errors.push_back(point.error);
    if (!errors.empty()) {
      std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
      constexpr double kLarge = 3;  // times the median
      large_error_ = kLarge * errors[errors.size() / 2];
    }
    for (const ColmapModel::Point& point : model.points)
      for (const ColmapModel::Sight& sight : point.track)
        seen_by_[sight.image_id].push_back(&point);
  }

  /// Of what the image sees. Without enough points of its own: of all that lie before its camera
  /// and inside its picture.
  std::optional<InverseDepthRange> range(const ColmapModel::Image& image, const Lens& lens) const {
    constexpr std::size_t kEnough = 20;
    std::vector<double> good, all;
    if (const auto seen = seen_by_.find(image.id); seen != seen_by_.end())
      for (const ColmapModel::Point* point : seen->second) {
        const double z = in_camera(image, *point).z();
        if (!(z > 0)) continue;
        all.push_back(z);
        if (is_good(*point)) good.push_back(z);
      }
    if (good.size() >= kEnough) return range_of_depths(std::move(good));
    if (const auto range = range_of_depths(std::move(all))) return range;

    std::vector<double> inside;
    const LensMap map(lens);
    for (const ColmapModel::Point& point : model_.points) {
      const Eigen::Vector3d at = in_camera(image, point);
      if (!(at.z() > 0)) continue;
      const auto pixel = map.distort(at.head<2>() / at.z());
      if (pixel && (pixel->array() >= 0).all() && pixel->x() < lens.width &&
          pixel->y() < lens.height)
        inside.push_back(at.z());
    }
    return range_of_depths(std::move(inside));
  }

 private:
  static Eigen::Vector3d in_camera(const ColmapModel::Image& image,
                                   const ColmapModel::Point& point) {
    return image.rotation * point.position + image.translation;
  }
  bool is_good(const ColmapModel::Point& point) const {
    constexpr std::size_t kLeastSights = 3;  // two rays may meet anywhere
    return point.track.size() >= kLeastSights && point.error <= large_error_;
  }

  const ColmapModel& model_;
  double large_error_ = 0;
  std::unordered_map<std::uint32_t, std::vector<const ColmapModel::Point*>> seen_by_;
};

/// Do the points of the model lie where its images have found them? Then its poses need no other
/// check.
bool shows_its_points(const ColmapModel& model) {
  constexpr std::size_t kLeastSights = 50;
  constexpr double kNear = 0.02;  // of the width: of guessed lenses too
  std::unordered_map<std::uint64_t, const ColmapModel::Point*> points;
  for (const ColmapModel::Point& point : model.points) points[point.id] = &point;
  std::size_t num_sights = 0, num_near = 0;
  for (const ColmapModel::Image& image : model.images) {
    const Lens& lens = model.cameras.at(image.camera_id);
    const LensMap map(lens);
    for (const ColmapModel::Feature& feature : image.features) {
      const auto found = points.find(feature.point_id);
      if (found == points.end()) continue;
      ++num_sights;
      const Eigen::Vector3d at = image.rotation * found->second->position + image.translation;
      if (!(at.z() > 0)) continue;
      const auto pixel = map.distort(at.head<2>() / at.z());
      num_near +=
          pixel && (*pixel - Eigen::Vector2d(feature.x, feature.y)).norm() < kNear * lens.width;
    }
  }
  return num_sights >= kLeastSights && 2 * num_near > num_sights;
}

/// Reads the poses of all images in another convention than COLMAP's. Is the scene mirrored?
bool read_poses(ColmapModel& model, const PoseConvention& convention) {
  bool is_mirrored = false;
  for (ColmapModel::Image& image : model.images) {
    const CameraPose stated{image.rotation.toRotationMatrix(), image.translation, false};
    const CameraPose pose = read_pose(state_pose(stated, kConvention), convention).value();
    image.rotation = Eigen::Quaterniond(pose.rotation);
    image.translation = pose.translation;
    is_mirrored = pose.is_mirrored;
  }
  return is_mirrored;
}

LightField open_model(FoundColmapModel found, const OpenOptions& options,
                      std::vector<std::string> notes) {
  std::vector<ColmapModel::Image>& images = found.model.images;
  if (images.size() + found.model.left_out.size() < kLeastPictures)
    throw Error(ErrorCode::kBadInput,
                found.folder.string() +
                    ": only one image is registered, depth needs two or more; take pictures that "
                    "overlap more");
  const PoseConvention convention = options.convention.value_or(kConvention);
  const bool is_mirrored = options.convention && read_poses(found.model, convention);
  std::sort(images.begin(), images.end(),
            [](const auto& a, const auto& b) { return a.name < b.name; });
  std::vector<std::string> stated;
  for (const ColmapModel::Image& image : images) stated.push_back(image.name);
  const auto [place, names] = find_names(
      options.images.empty() ? folders_around(found.folder) : std::vector{options.images}, stated);
  const fs::path folder = folder_of_pictures(found.folder, {place}, names,
                                             options.strict ? names.size() : kLeastPictures);
  const std::vector<std::string> views = view_names(names);

  const SparseDepths depths(found.model);
  std::vector<PosedPicture> pictures;
  for (std::size_t i = 0; i < images.size(); ++i) {
    PosedPicture picture;
    picture.file = folder / names[i];
    picture.name = views[i];
    picture.lens = found.model.cameras.at(images[i].camera_id);
    picture.rotation = images[i].rotation.toRotationMatrix();
    picture.translation = images[i].translation;
    picture.inverse_depth = depths.range(images[i], picture.lens);
    pictures.push_back(std::move(picture));
  }
  if (!options.masks.empty()) attach_masks(pictures, names, options.masks, notes);
  for (const ColmapModel::Faulty& faulty : found.model.left_out) {
    PosedPicture picture;
    picture.file = folder / faulty.name;
    picture.name = faulty.name;
    picture.fault = faulty.fault;
    pictures.push_back(std::move(picture));
  }
  if (!found.model.faulty_points.empty())
    notes.push_back(std::to_string(found.model.faulty_points.size()) +
                    " points of the model are not finite and left out");
  for (const char* part : {"rigs.bin", "rigs.txt", "frames.bin", "frames.txt"})
    if (is_there(found.folder / part)) {
      notes.push_back("rigs and frames of the model are ignored; its images state every pose");
      break;
    }
  LightField light_field =
      posed_light_field(std::move(pictures), kName, options.memory_bytes, options.strict);
  light_field.notes.insert(light_field.notes.begin(), notes.begin(), notes.end());
  if (!shows_its_points(found.model))
    light_field.pose_reading = PoseReading{name_of(convention), is_mirrored};
  if (found.model.points.empty())
    if (const fs::path cloud = points_beside(found.folder); !cloud.empty())
      take_range_of_points(light_field, cloud, options.memory_bytes);
  return light_field;
}

class ColmapReader : public Reader {
 public:
  std::string name() const override { return kName; }

  ProbeResult probe(const fs::path& input) const override {
    constexpr int kWhole = 80, kPart = 5;  // numbered pictures are more than a part
    const std::vector<fs::path> models = colmap_models_of(input);
    if (models.empty()) return {};
    return {is_colmap_model(models.front()) ? kWhole : kPart, ""};
  }

  LightField open(const fs::path& input, const OpenOptions& options) const override {
    refuse_direction(options, "the COLMAP model states");
    std::vector<std::string> notes;
    FoundColmapModel found = largest_colmap_model(colmap_models_of(input), notes, options.strict);
    return open_model(std::move(found), options, std::move(notes));
  }
};

}  // namespace

std::unique_ptr<const Reader> colmap_reader() { return std::make_unique<ColmapReader>(); }

}  // namespace gigaray
