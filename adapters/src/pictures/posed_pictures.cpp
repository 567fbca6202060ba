// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "pictures/posed_pictures.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <set>

#include "gigaray/adapters/input_file.h"
#include "pictures/mask_folder.h"
#include "pictures/picture_alpha.h"
#include "pictures/picture_faults.h"
#include "pictures/picture_files.h"
#include "pictures/picture_values.h"
#include "pictures/undistortion.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void bad(const fs::path& path, const std::string& what) {
  throw Error(ErrorCode::kBadInput, path.string() + ": " + what);
}

/// A view as it is read.
struct Source {
  fs::path file, mask;
  int width = 0, height = 0;
  std::shared_ptr<const Undistortion> undistortion;  // empty: a pinhole already
  bool has_alpha = false;
};

class PosedPictures : public PixelSource {
 public:
  PosedPictures(std::vector<Source> sources, int width, int height, int bit_depth,
                const ValueScale& scale, bool has_mask, double limit)
      : sources_(std::move(sources)),
        width_(width),
        height_(height),
        bit_depth_(bit_depth),
        scale_(scale),
        has_mask_(has_mask),
        limit_(limit) {}

  int bit_depth() const override { return bit_depth_; }
  bool has_mask() const override { return has_mask_; }

  Image<std::uint16_t> read(int view_idx) const override {
    const Source& source = sources_.at(std::size_t(view_idx));
    PictureSpec spec;
    Image<std::uint16_t> picture =
        decode_picture(source.file, Orientation::kIgnored, spec, limit_, scale_);
    if (picture.width() != source.width || picture.height() != source.height)
      bad(source.file, "has another size than when it was opened");
    if (spec.bit_depth < bit_depth_) widen_to_16_bit(picture);
    Mask seen = mask_of(source);
    if (source.undistortion) {
      const Undistortion::Map map = keep(source.undistortion->map());
      picture = resampled(picture, *map, most());
      if (has_mask_) seen = resampled(seen, *map);
    }
    return has_mask_ ? on_canvas(picture, seen) : picture;
  }

 private:
  int most() const { return (1 << bit_depth_) - 1; }

  /// 1 where the picture is opaque and the user's mask, if there is one, is not black. Empty
  /// without masks.
  Mask mask_of(const Source& source) const {
    if (!has_mask_) return {};
    Mask seen = source.has_alpha ? read_alpha(source.file, limit_, scale_)
                                 : Mask(source.width, source.height, 1, 1);
    if (seen.width() != source.width || seen.height() != source.height)
      bad(source.file, "has another size than when it was opened");
    if (source.mask.empty()) return seen;
    const Mask mask =
        read_mask(source.mask, source.width, source.height, Orientation::kIgnored, limit_);
    std::ranges::transform(seen, mask, seen.begin(), std::bit_and<>());
    return seen;
  }

  Image<std::uint16_t> on_canvas(const Image<std::uint16_t>& picture, const Mask& seen) const {
    Image<std::uint16_t> canvas(width_, height_, 4);
    for (int v = 0; v < picture.height(); ++v)
      for (int u = 0; u < picture.width(); ++u) {
        for (int c = 0; c < 3; ++c) canvas(u, v, c) = picture(u, v, c);
        canvas(u, v, 3) = std::uint16_t(seen(u, v) ? most() : 0);
      }
    return canvas;
  }

  /// Views of one lens come one after another as a rule. With a lens for every view, all maps would
  /// take more memory than the pictures.
  Undistortion::Map keep(Undistortion::Map map) const {
    constexpr std::size_t kMapsKept = 2;
    const std::lock_guard lock(mutex_);
    if (std::find(kept_.begin(), kept_.end(), map) == kept_.end()) kept_.push_back(map);
    if (kept_.size() > kMapsKept) kept_.pop_front();
    return map;
  }

  std::vector<Source> sources_;
  int width_, height_, bit_depth_;
  ValueScale scale_;
  bool has_mask_;
  double limit_;
  mutable std::mutex mutex_;
  mutable std::deque<Undistortion::Map> kept_;
};

/// Pictures of one lens and size share the work.
class Undistortions {
 public:
  std::shared_ptr<const Undistortion> of(const Lens& lens, const Source& source) {
    for (const Known& known : known_)
      if (known.lens == lens && known.width == source.width && known.height == source.height)
        return known.undistortion;
    constexpr int kMostOfRemap = 32766;  // px, OpenCV
    if (std::max(source.width, source.height) > kMostOfRemap)
      bad(source.file, "is too large to be undistorted; the limit is " +
                           std::to_string(kMostOfRemap) + " px, undistort it before");
    const auto undistortion = std::make_shared<Undistortion>(lens, source.width, source.height);
    if (!undistortion->shows_anything())
      bad(source.file, "nothing is left of it when its lens (" + lens.model +
                           ") is undistorted; its parameters can't be right");
    known_.push_back({lens, source.width, source.height, undistortion});
    return undistortion;
  }

  bool fill_the_pictures() const {
    return std::all_of(known_.begin(), known_.end(),
                       [](const Known& known) { return known.undistortion->fills_the_picture(); });
  }

  /// "OPENCV", "OPENCV, RADIAL"; empty when none was needed.
  std::string models() const {
    std::set<std::string> names;
    for (const Known& known : known_) names.insert(known.lens.model);
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
  }

 private:
  struct Known {
    Lens lens;
    int width, height;
    std::shared_ptr<const Undistortion> undistortion;
  };
  std::vector<Known> known_;
};

/// May the picture be the lens's own, reduced or enlarged and rounded to whole pixels?
bool is_scaled(const Lens& lens, const Source& source) {
  const double width = double(lens.width) * source.height / lens.height;
  const double height = double(lens.height) * source.width / lens.width;
  return std::abs(width - source.width) <= 1 || std::abs(height - source.height) <= 1;
}

Camera camera_of(const PosedPicture& picture, const Source& source) {
  const LensMap lens(picture.lens, source.width, source.height);
  Camera camera;
  camera.width = source.width;
  camera.height = source.height;
  camera.focal_u = lens.focal().x();
  camera.focal_v = lens.focal().y();
  camera.centre_u = lens.centre().x();
  camera.centre_v = lens.centre().y();
  camera.rotation = picture.rotation;
  camera.translation = picture.translation;
  camera.inverse_depth = picture.inverse_depth;
  return camera;
}

/// Takes those that can't be used out of `pictures`, with a note.
void leave_out_faulty(std::vector<PosedPicture>& pictures, bool strict, double limit,
                      std::vector<std::string>& notes) {
  for (PosedPicture& picture : pictures)
    if (picture.fault.empty())
      picture.fault = fault_of_picture(picture.file, Orientation::kIgnored, limit);
  const auto usable = std::stable_partition(
      pictures.begin(), pictures.end(), [](const auto& picture) { return picture.fault.empty(); });
  if (usable == pictures.end()) return;
  std::vector<PictureFault> faulty;
  for (auto picture = usable; picture != pictures.end(); ++picture)
    faulty.push_back({picture->name, picture->file, picture->fault});
  const std::size_t all = pictures.size();
  pictures.erase(usable, pictures.end());
  if (strict) throw Error(ErrorCode::kBadInput, faulty.front().why);
  if (pictures.size() < kLeastPictures)
    throw Error(ErrorCode::kBadInput, faulty.front().why + "; of " + std::to_string(all) +
                                          " pictures " + (pictures.empty() ? "none" : "only one") +
                                          " can be used, depth needs two");
  notes.push_back(left_out_text(faulty, all));
}

}  // namespace

LightField posed_light_field(std::vector<PosedPicture> pictures, const std::string& format,
                             double memory_bytes, bool strict) {
  if (pictures.size() < kLeastPictures)
    throw Error(ErrorCode::kBadInput,
                "a light field needs two pictures with cameras or more, there is " +
                    std::string(pictures.empty() ? "none" : "only one"));
  LightField light_field;
  light_field.kind = LightFieldKind::kUnstructured;
  light_field.format = format;

  const double limit = opening_limit(memory_bytes);
  leave_out_faulty(pictures, strict, limit, light_field.notes);
  std::vector<Source> sources;
  std::vector<PictureSpec> specs;
  Undistortions undistortions;
  int num_scaled = 0, num_undistorted = 0, num_transparent = 0, num_masks_scaled = 0;
  bool masked = false, turned = false;
  for (const PosedPicture& picture : pictures) {
    check(picture.lens, picture.file.string());
    specs.push_back(read_picture_spec(picture.file, Orientation::kIgnored, limit));
    PictureSpec& spec = specs.back();
    Source source{picture.file, picture.mask, spec.width, spec.height, nullptr, spec.has_alpha};
    num_transparent += spec.has_alpha;
    spec.has_alpha = false;  // it is not ignored here
    if (!is_scaled(picture.lens, source))
      bad(picture.file, "has " + size_text(spec.width, spec.height) +
                            " pixels, its camera was made for " +
                            size_text(picture.lens.width, picture.lens.height) +
                            ", which is no scaled size of it; give the pictures that the cameras "
                            "were found with");
    if (!source.mask.empty())
      num_masks_scaled += is_mask_scaled(source.mask, source.file, source.width, source.height,
                                         Orientation::kIgnored, limit);
    if (!is_pinhole(picture.lens)) source.undistortion = undistortions.of(picture.lens, source);
    num_undistorted += source.undistortion != nullptr;
    num_scaled += spec.width != picture.lens.width || spec.height != picture.lens.height;
    masked |= !source.mask.empty();
    turned |= spec.is_turned;
    light_field.width = std::max(light_field.width, spec.width);
    light_field.height = std::max(light_field.height, spec.height);
    light_field.views.push_back({picture.name, 0, 0});
    light_field.cameras.push_back(camera_of(picture, source));
    check(light_field.cameras.back(), picture.file.string());
    sources.push_back(std::move(source));
  }
  const bool one_size = std::all_of(specs.begin(), specs.end(), [&](const PictureSpec& spec) {
    return spec.width == light_field.width && spec.height == light_field.height;
  });

  // The picture, where its pixels come from, itself again, a mask and the canvas.
  constexpr double kBytesPerPixel = 6 + 8 + 6 + 2 + 8;
  hold_against_limit(pictures.front().file.string(),
                     "is brought to " + size_text(light_field.width, light_field.height) +
                         " px with the other pictures",
                     kBytesPerPixel * light_field.width * light_field.height, limit);

  auto& notes = light_field.notes;
  const int bit_depth = common_bit_depth(specs, notes);
  std::vector<fs::path> files;
  for (const Source& source : sources) files.push_back(source.file);
  const ValueScale scale = scale_of(files, specs, limit, notes);
  const std::string of_all = " of " + std::to_string(pictures.size()) + " pictures";
  if (num_undistorted > 0)
    notes.push_back(std::to_string(num_undistorted) + of_all + " are undistorted (" +
                    undistortions.models() + ")");
  if (num_transparent > 0)
    notes.push_back("the alpha channel of " + std::to_string(num_transparent) + of_all +
                    " masks what is transparent");
  if (num_masks_scaled > 0) notes.push_back(scaled_masks_text(num_masks_scaled));
  if (num_scaled > 0)
    notes.push_back(std::to_string(num_scaled) + of_all +
                    " have another size than their cameras state; the cameras are scaled");
  if (!one_size)
    notes.push_back("pictures of several sizes: brought to " +
                    size_text(light_field.width, light_field.height) +
                    " px, what is added counts as masked");
  if (turned)
    notes.push_back(
        "the orientation noted in the pictures is ignored, as cameras are found "
        "without it");
  const bool has_mask =
      masked || num_transparent > 0 || !one_size || !undistortions.fill_the_pictures();
  light_field.pixels = std::make_shared<PosedPictures>(
      std::move(sources), light_field.width, light_field.height, bit_depth, scale, has_mask, limit);
  place_by_cameras(light_field);
  return light_field;
}

}  // namespace gigaray
