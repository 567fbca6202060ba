// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/colmap_model.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <system_error>

#include "colmap/colmap_model_files.h"
#include "files/text.h"
#include "gigaray/adapters/atomic_output.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/core/error.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void bad(const std::string& where, const std::string& what) {
  throw Error(ErrorCode::kBadInput, where + ": " + what);
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

bool has_parts(const fs::path& folder, const std::string& extension) {
  return is_file(folder / ("cameras" + extension)) && is_file(folder / ("images" + extension));
}

}  // namespace

void accept(std::uint32_t camera_id, Lens lens, const std::string& where, ColmapModel& model) {
  const std::string camera = where + ": camera " + std::to_string(camera_id);
  try {
    check(lens, camera);
  } catch (const Error& problem) {
    model.faulty_cameras.emplace(camera_id, problem.what());
    return;
  }
  if (!model.cameras.emplace(camera_id, std::move(lens)).second) bad(camera, "is there twice");
}

void accept(ColmapModel::Image image, const std::string& where, ColmapModel& model) {
  const auto bad_image = [&](const std::string& what) {
    bad(where, "image " + in_quotes(image.name) + " " + what);
  };
  if (trimmed(image.name).empty()) bad(where, "image " + std::to_string(image.id) + " has no name");
  // No picture has one, and the files could not hold it.
  if (std::any_of(image.name.begin(), image.name.end(), [](unsigned char c) { return c < ' '; }))
    bad_image("has control characters in its name");
  const double length = image.rotation.norm();
  constexpr double kTolerance = 0.01;
  if (!image.translation.allFinite() || !std::isfinite(length)) {
    const std::string what =
        "image " + in_quotes(image.name) + " has a pose with a number that is not finite";
    model.left_out.push_back({std::move(image.name), where + ": " + what});
    return;
  }
  if (std::abs(length - 1) > kTolerance)
    bad_image("has a quaternion of length " + std::to_string(length) + ", a rotation has 1");
  image.rotation.normalize();
  for (ColmapModel::Feature& feature : image.features) {
    if (!std::isfinite(feature.x) || !std::isfinite(feature.y))
      bad_image("has a point that is not at a finite position");
    // Text files have negative numbers for none.
    if (feature.point_id > std::uint64_t(INT64_MAX)) feature.point_id = ColmapModel::kNoPoint;
  }
  model.images.push_back(std::move(image));
}

void accept(ColmapModel::Point point, const std::string& where, ColmapModel& model) {
  if (!point.position.allFinite() || !std::isfinite(point.error)) {
    model.faulty_points.push_back(point.id);
    return;
  }
  model.points.push_back(std::move(point));
}

void settle(ColmapModel& model, const std::string& where, bool strict) {
  std::erase_if(model.images, [&](const ColmapModel::Image& image) {
    if (model.cameras.count(image.camera_id)) return false;
    const auto faulty = model.faulty_cameras.find(image.camera_id);
    model.left_out.push_back(
        {image.name, faulty != model.faulty_cameras.end()
                         ? faulty->second
                         : where + ": image " + in_quotes(image.name) + " has camera " +
                               std::to_string(image.camera_id) + ", which is not in the model"});
    return true;
  });
  if (!model.left_out.empty() && (strict || model.images.empty()))
    throw Error(ErrorCode::kBadInput, model.left_out.front().fault);
  if (strict && !model.faulty_cameras.empty())
    throw Error(ErrorCode::kBadInput, model.faulty_cameras.begin()->second);
  if (strict && !model.faulty_points.empty())
    bad(where, "point " + std::to_string(model.faulty_points.front()) +
                   " has a number that is not finite");
  if (model.images.empty())
    bad(where, "no image is registered: COLMAP found no cameras; take pictures that overlap more");
  std::set<std::uint32_t> ids;
  std::set<std::string_view> names;
  for (const ColmapModel::Image& image : model.images) {
    if (!ids.insert(image.id).second)
      bad(where, "two images have the number " + std::to_string(image.id));
    if (!names.insert(image.name).second)
      bad(where, "two images are named " + in_quotes(image.name));
  }
  std::set<std::uint64_t> points;
  for (const ColmapModel::Point& point : model.points)
    if (!points.insert(point.id).second)
      bad(where, "two points have the number " + std::to_string(point.id));
}

bool is_colmap_model(const fs::path& folder) {
  return has_parts(folder, ".bin") || has_parts(folder, ".txt");
}

ColmapModel read_colmap_model(const fs::path& folder, bool strict) {
  if (!is_colmap_model(folder))
    bad(folder.string(),
        "holds no COLMAP model: cameras.bin and images.bin, or the same as .txt, are needed");
  const bool binary = has_parts(folder, ".bin");
  const ColmapParser& parser = binary ? kBinaryColmapParser : kTextColmapParser;
  const std::string extension = binary ? ".bin" : ".txt";
  const double limit = opening_limit();
  ColmapModel model;
  const auto parse = [&](const std::string& part, auto parse_bytes) {
    const fs::path path = folder / (part + extension);
    // Entries in memory have some times the bytes that they have in the file.
    constexpr double kBytesPerByte = 5;
    const InputFile file(path);
    hold_against_limit(path.string(), "has " + std::to_string(file.size()) + " bytes",
                       kBytesPerByte * double(file.size()), limit);
    std::string bytes = file.read(0, file.size());
    parse_bytes(binary ? std::move(bytes) : as_utf8(std::move(bytes)), path.string(), model);
  };
  parse("cameras", parser.cameras);
  parse("images", parser.images);
  // Poses that were found by other means often come without.
  if (is_file(folder / ("points3D" + extension))) parse("points3D", parser.points);
  settle(model, folder.string(), strict);
  return model;
}

void write_colmap_model(const fs::path& folder, const ColmapModel& model, ColmapFormat format) {
  const bool binary = format == ColmapFormat::kBinary;
  if (!binary && has_parts(folder, ".bin"))
    throw Error(ErrorCode::kInvalidArgument,
                folder.string() +
                    ": holds a binary model, which readers prefer to text; name another folder");
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw Error(ErrorCode::kIo, folder.string() + ": can't be written (" + error.message() + ")");
  const ColmapPrinter& printer = binary ? kBinaryColmapPrinter : kTextColmapPrinter;
  const std::string extension = binary ? ".bin" : ".txt";
  write_file_atomically(folder / ("cameras" + extension), printer.cameras(model));
  write_file_atomically(folder / ("points3D" + extension), printer.points(model));
  write_file_atomically(folder / ("images" + extension), printer.images(model));
}

}  // namespace gigaray
