// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// The pictures of 3D and 4D light fields, one file per view.
#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <utility>

#include "gigaray/adapters/input_file.h"
#include "pictures/mask_folder.h"
#include "pictures/picture_alpha.h"
#include "pictures/picture_faults.h"
#include "pictures/picture_files.h"
#include "pictures/picture_values.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void bad(const fs::path& path, const std::string& what) {
  throw Error(ErrorCode::kBadInput, path.string() + ": " + what);
}

/// A view as it is read.
struct Source {
  fs::path file;
  fs::path mask;  ///< empty: none
  bool is_alpha_used = false;
};

struct Format {
  int width = 0, height = 0, bit_depth = 8;
  bool has_mask = false;
  ValueScale scale;
};

class PictureFiles : public PixelSource {
 public:
  PictureFiles(std::vector<Source> sources, const Format& format, double limit)
      : sources_(std::move(sources)), format_(format), limit_(limit) {}

  Image<std::uint16_t> read(int view_idx) const override {
    const Source& source = sources_.at(std::size_t(view_idx));
    PictureSpec spec;
    Image<std::uint16_t> picture =
        decode_picture(source.file, Orientation::kApplied, spec, limit_, format_.scale);
    check_size(source, picture.width(), picture.height());
    if (spec.bit_depth < format_.bit_depth) widen_to_16_bit(picture);
    return format_.has_mask ? with_mask(picture, mask_of(source)) : picture;
  }
  int bit_depth() const override { return format_.bit_depth; }
  bool has_mask() const override { return format_.has_mask; }

 private:
  void check_size(const Source& source, int width, int height) const {
    if (width != format_.width || height != format_.height)
      bad(source.file, "has another size than when it was opened");
  }

  Mask mask_of(const Source& source) const {
    Mask seen(format_.width, format_.height, 1, 1);
    if (source.is_alpha_used) seen = read_alpha(source.file, limit_, format_.scale);
    check_size(source, seen.width(), seen.height());
    if (source.mask.empty()) return seen;
    const Mask mask =
        read_mask(source.mask, format_.width, format_.height, Orientation::kApplied, limit_);
    std::ranges::transform(seen, mask, seen.begin(), std::bit_and<>());
    return seen;
  }

  Image<std::uint16_t> with_mask(const Image<std::uint16_t>& picture, const Mask& seen) const {
    const auto shown = std::uint16_t((1 << format_.bit_depth) - 1);
    Image<std::uint16_t> masked(picture.width(), picture.height(), 4);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      std::copy_n(picture.data() + 3 * i, 3, masked.data() + 4 * i);
      masked.data()[4 * i + 3] = seen.data()[i] ? shown : std::uint16_t(0);
    }
    return masked;
  }

  std::vector<Source> sources_;
  Format format_;
  double limit_;
};

/// All that decides what a view is read as.
std::string key_of(const Source& source, const Format& format) {
  std::string key = source.file.string() + '\n' + source.mask.string();
  for (const double number :
       {double(source.is_alpha_used), double(format.width), double(format.height),
        double(format.bit_depth), double(format.has_mask), double(format.scale.bits_of_16),
        double(format.scale.bits_of_32), double(format.scale.full_light)})
    key += '\n' + std::to_string(number);
  return key;
}

using Size = std::pair<int, int>;

/// A few pictures of another size are an accident; more of them are another capture.
std::string fault_of_size(const fs::path& path, const Size& size, const Size& usual) {
  return path.string() + ": has " + size_text(size.first, size.second) +
         " pixels, the others have " + size_text(usual.first, usual.second);
}

/// Takes views whose pictures can't be used out of `light_field`, their files out of `files`.
void leave_out_faulty(LightField& light_field, std::vector<fs::path>& files,
                      std::vector<PictureSpec>& specs, const OpenOptions& options, double limit) {
  std::vector<PictureFault> faulty;
  std::vector<std::string> why(files.size());
  std::map<Size, std::size_t> sizes;
  specs.assign(files.size(), {});
  for (std::size_t i = 0; i < files.size(); ++i) {
    why[i] = fault_of_picture(files[i], Orientation::kApplied, limit, &specs[i]);
    if (why[i].empty()) ++sizes[{specs[i].width, specs[i].height}];
  }
  if (sizes.size() > 1) {
    const auto usual =
        std::max_element(sizes.begin(), sizes.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    std::size_t others = 0, first = 0, other = 0;
    for (std::size_t i = files.size(); i-- > 0;) {
      if (!why[i].empty()) continue;
      const Size size{specs[i].width, specs[i].height};
      if (size == usual->first) {
        first = i;
        continue;
      }
      ++others;
      other = i;
      why[i] = fault_of_size(files[i], size, usual->first);
    }
    constexpr std::size_t kFew = 4;  // one of so many
    if (kFew * others > files.size() || options.strict)
      bad(files[other], "has " + size_text(specs[other].width, specs[other].height) + " pixels, " +
                            files[first].filename().string() + " has " +
                            size_text(usual->first.first, usual->first.second) +
                            "; all views need one size");
  }

  std::vector<View> views;
  std::size_t kept = 0;
  const std::size_t all = files.size();
  for (std::size_t i = 0; i < all; ++i) {
    if (!why[i].empty()) {
      faulty.push_back({files[i].filename().string(), files[i], why[i]});
      light_field.left_out.push_back(light_field.views[i]);
      continue;
    }
    views.push_back(light_field.views[i]);
    files[kept] = files[i];
    specs[kept++] = specs[i];
  }
  if (faulty.empty()) return;
  if (options.strict || kept < kLeastPictures)
    throw Error(
        ErrorCode::kBadInput,
        faulty.front().why + (options.strict ? ""
                                             : "; of " + std::to_string(all) + " pictures " +
                                                   (kept == 0 ? "none" : "only one") +
                                                   " can be used, depth needs two"));
  files.resize(kept);
  specs.resize(kept);
  light_field.views = std::move(views);
  light_field.kind = kind_from_positions(light_field.views);
  light_field.notes.push_back(left_out_text(faulty, all));
}

/// Is anything of a few of the pictures transparent? Opaque ones gain nothing by a mask.
bool is_any_transparent(const std::vector<fs::path>& files, const std::vector<PictureSpec>& specs,
                        const ValueScale& scale, double limit) {
  constexpr std::size_t kPictures = 3;
  std::vector<std::size_t> with_alpha;
  for (std::size_t i = 0; i < specs.size(); ++i)
    if (specs[i].has_alpha && !specs[i].is_turned) with_alpha.push_back(i);
  const std::size_t count = std::min(kPictures, with_alpha.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t at = count == 1 ? 0 : i * (with_alpha.size() - 1) / (count - 1);
    try {
      const Mask opaque = read_alpha(files[with_alpha[at]], limit, scale);
      if (std::ranges::find(opaque, 0) != opaque.end()) return true;
    } catch (const Error&) {
      continue;  // whoever reads it says why
    }
  }
  return false;
}

}  // namespace

void attach_pictures(LightField& light_field, std::vector<fs::path> files,
                     const OpenOptions& options) {
  GIGARAY_CHECK(files.size() == light_field.views.size() && !files.empty());
  const double limit = opening_limit(options.memory_bytes);
  std::vector<PictureSpec> specs;
  leave_out_faulty(light_field, files, specs, options, limit);

  Format format;
  format.width = light_field.width = specs.front().width;
  format.height = light_field.height = specs.front().height;
  auto& notes = light_field.notes;
  format.scale = scale_of(files, specs, limit, notes);
  std::vector<Source> sources;
  for (const fs::path& file : files) sources.push_back({file, {}, false});
  if (is_any_transparent(files, specs, format.scale, limit)) {
    int count = 0;
    for (std::size_t i = 0; i < specs.size(); ++i) {
      sources[i].is_alpha_used = specs[i].has_alpha && !specs[i].is_turned;
      count += sources[i].is_alpha_used;
      specs[i].has_alpha = specs[i].has_alpha && specs[i].is_turned;
    }
    format.has_mask = true;
    notes.push_back("the alpha channel of " + std::to_string(count) + " of " +
                    std::to_string(files.size()) + " pictures masks what is transparent");
  }
  format.bit_depth = common_bit_depth(specs, notes);
  if (!options.masks.empty()) {
    std::vector<std::string> names;
    for (const fs::path& file : files) names.push_back(file.filename().string());
    const std::vector<fs::path> masks = MaskFolder(options.masks).find_all(names, notes);
    int num_scaled = 0;
    for (std::size_t i = 0; i < masks.size(); ++i) {
      sources[i].mask = masks[i];
      num_scaled +=
          !masks[i].empty() && is_mask_scaled(masks[i], files[i], format.width, format.height,
                                              Orientation::kApplied, limit);
    }
    if (num_scaled > 0) notes.push_back(scaled_masks_text(num_scaled));
    format.has_mask = true;
  }
  std::vector<std::string> keys;
  for (const Source& source : sources) keys.push_back(key_of(source, format));
  light_field.pixels = KeptPictures::over(
      options.kept, std::make_shared<PictureFiles>(std::move(sources), format, limit), keys);
}

}  // namespace gigaray
