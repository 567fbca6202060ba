// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// The .bin files of a COLMAP model: a count of 64 bit, then the entries without padding, little
// endian.
#include <bit>
#include <cstring>
#include <type_traits>

#include "colmap/colmap_model_files.h"
#include "gigaray/core/error.h"

namespace gigaray {
namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::int32_t kEquirectangular = 17;  // as COLMAP 4 counts its camera models

class ByteReader {
 public:
  ByteReader(std::string_view bytes, const std::string& where) : rest_(bytes), where_(where) {}

  template <class T>
  T get() {
    static_assert(std::is_trivially_copyable_v<T>);
    if (rest_.size() < sizeof(T)) bad("is cut short");
    T value;
    std::memcpy(&value, rest_.data(), sizeof(T));
    rest_.remove_prefix(sizeof(T));
    return value;
  }
  Eigen::Vector3d get_vector() {
    const double x = get<double>(), y = get<double>();
    return {x, y, get<double>()};
  }
  std::string get_name() {
    const auto end = rest_.find('\0');
    if (end == std::string_view::npos) bad("is cut short");
    std::string name(rest_.substr(0, end));
    rest_.remove_prefix(end + 1);
    return name;
  }
  /// A number of entries of so many bytes or more each, which the file must be able to hold.
  std::size_t get_count(std::size_t least_bytes, const char* what) {
    const auto count = get<std::uint64_t>();
    if (count > rest_.size() / least_bytes)
      bad("states " + std::to_string(count) + " " + what +
          ", more than fit into the file; it is cut short or damaged");
    return std::size_t(count);
  }
  void expect_end() const {
    if (!rest_.empty())
      bad("has " + std::to_string(rest_.size()) + " bytes after its last entry; it is damaged");
  }

 private:
  [[noreturn]] void bad(const std::string& what) const {
    throw Error(ErrorCode::kBadInput, where_ + ": " + what);
  }
  std::string_view rest_;
  const std::string& where_;
};

void parse_cameras(std::string_view bytes, const std::string& where, ColmapModel& model) {
  ByteReader file(bytes, where);
  const std::size_t count = file.get_count(4 + 4 + 8 + 8 + 2 * 8, "cameras");
  for (std::size_t i = 0; i < count; ++i) {
    const auto id = file.get<std::uint32_t>();
    const auto model_id = file.get<std::int32_t>();
    if (model_id == kEquirectangular) {
      check(Lens{"EQUIRECTANGULAR", 0, 0, {}},  // which refuses it by name
            where + ": camera " + std::to_string(id));
    }
    if (model_id < 0 || std::size_t(model_id) >= lens_models().size())
      throw Error(ErrorCode::kBadInput,
                  where + ": camera " + std::to_string(id) + " has the unknown model number " +
                      std::to_string(model_id) +
                      "; those of COLMAP 3.8 to 4 are known. `colmap "
                      "image_undistorter` makes a model with pinhole cameras");
    Lens lens;
    lens.model = lens_models()[std::size_t(model_id)];
    const auto width = file.get<std::uint64_t>(), height = file.get<std::uint64_t>();
    // What does not fit becomes a size that check() refuses.
    lens.width = width <= INT32_MAX ? int(width) : 0;
    lens.height = height <= INT32_MAX ? int(height) : 0;
    for (int k = 0; k < num_lens_params(lens.model); ++k) lens.params.push_back(file.get<double>());
    accept(id, std::move(lens), where, model);
  }
  file.expect_end();
}

void parse_images(std::string_view bytes, const std::string& where, ColmapModel& model) {
  ByteReader file(bytes, where);
  const std::size_t count = file.get_count(4 + 7 * 8 + 4 + 1 + 8, "images");
  for (std::size_t i = 0; i < count; ++i) {
    ColmapModel::Image image;
    image.id = file.get<std::uint32_t>();
    image.rotation.w() = file.get<double>();
    image.rotation.vec() = file.get_vector();
    image.translation = file.get_vector();
    image.camera_id = file.get<std::uint32_t>();
    image.name = file.get_name();
    image.features.resize(file.get_count(8 + 8 + 8, "points of an image"));
    for (ColmapModel::Feature& feature : image.features) {
      feature.x = file.get<double>();
      feature.y = file.get<double>();
      feature.point_id = file.get<std::uint64_t>();
    }
    accept(std::move(image), where, model);
  }
  file.expect_end();
}

void parse_points(std::string_view bytes, const std::string& where, ColmapModel& model) {
  ByteReader file(bytes, where);
  const std::size_t count = file.get_count(8 + 3 * 8 + 3 + 8 + 8, "points");
  for (std::size_t i = 0; i < count; ++i) {
    ColmapModel::Point point;
    point.id = file.get<std::uint64_t>();
    point.position = file.get_vector();
    for (std::uint8_t& value : point.rgb) value = file.get<std::uint8_t>();
    point.error = file.get<double>();
    point.track.resize(file.get_count(4 + 4, "images of a point"));
    for (ColmapModel::Sight& sight : point.track) {
      sight.image_id = file.get<std::uint32_t>();
      sight.feature_idx = file.get<std::uint32_t>();
    }
    accept(std::move(point), where, model);
  }
  file.expect_end();
}

template <class T>
void append(std::string& bytes, const T& value) {
  static_assert(std::is_arithmetic_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void append(std::string& bytes, const Eigen::Vector3d& vector) {
  for (const double value : vector) append(bytes, value);
}

std::string print_cameras(const ColmapModel& model) {
  std::string bytes;
  append(bytes, std::uint64_t(model.cameras.size()));
  for (const auto& [id, lens] : model.cameras) {
    std::int32_t model_id = 0;
    while (lens_models().at(std::size_t(model_id)) != lens.model) ++model_id;
    append(bytes, id);
    append(bytes, model_id);
    append(bytes, std::uint64_t(lens.width));
    append(bytes, std::uint64_t(lens.height));
    for (const double value : lens.params) append(bytes, value);
  }
  return bytes;
}

std::string print_images(const ColmapModel& model) {
  std::string bytes;
  append(bytes, std::uint64_t(model.images.size()));
  for (const ColmapModel::Image& image : model.images) {
    append(bytes, image.id);
    append(bytes, image.rotation.w());
    append(bytes, Eigen::Vector3d(image.rotation.vec()));
    append(bytes, image.translation);
    append(bytes, image.camera_id);
    bytes.append(image.name.c_str(), image.name.size() + 1);
    append(bytes, std::uint64_t(image.features.size()));
    for (const ColmapModel::Feature& feature : image.features) {
      append(bytes, feature.x);
      append(bytes, feature.y);
      append(bytes, feature.point_id);
    }
  }
  return bytes;
}

std::string print_points(const ColmapModel& model) {
  std::string bytes;
  append(bytes, std::uint64_t(model.points.size()));
  for (const ColmapModel::Point& point : model.points) {
    append(bytes, point.id);
    append(bytes, point.position);
    for (const std::uint8_t value : point.rgb) append(bytes, value);
    append(bytes, point.error);
    append(bytes, std::uint64_t(point.track.size()));
    for (const ColmapModel::Sight& sight : point.track) {
      append(bytes, sight.image_id);
      append(bytes, sight.feature_idx);
    }
  }
  return bytes;
}

}  // namespace

const ColmapParser kBinaryColmapParser{parse_cameras, parse_images, parse_points};
const ColmapPrinter kBinaryColmapPrinter{print_cameras, print_images, print_points};

}  // namespace gigaray
