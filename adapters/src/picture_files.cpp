// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Pictures of any format that libvips reads. It reports a file that was cut short or damaged as an
// error, which decoders built on the defaults of libjpeg fill with grey, and gives sizes without
// decoding.
#include "picture_files.h"

#include <algorithm>
#include <array>
#include <system_error>

#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/pictures.h"
#include "picture_loading.h"
#include "text.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void bad(const fs::path& path, const std::string& what) {
  throw Error(ErrorCode::kBadInput, path.string() + ": " + what);
}

std::string taken_with(const vips::VImage& image) {
  std::string text;
  for (const char* field : {"exif-ifd0-Make", "exif-ifd0-Model", "exif-ifd2-FocalLength"})
    if (image.get_typeof(field) != 0) text += std::string(image.get_string(field)) + "; ";
  return text;
}

PictureSpec spec_of(const vips::VImage& image, Orientation orientation, const fs::path& path) {
  if (image.format() != VIPS_FORMAT_UCHAR && image.format() != VIPS_FORMAT_USHORT)
    bad(path, "has pixels of another type than 8 or 16 bit");
  PictureSpec spec;
  spec.width = image.width();
  spec.height = image.height();
  spec.is_turned = vips_image_get_orientation(image.get_image()) != 1;
  if (orientation == Orientation::kApplied && vips_image_get_orientation_swap(image.get_image()))
    std::swap(spec.width, spec.height);
  spec.taken_with = taken_with(image);
  spec.has_alpha = image.has_alpha();
  spec.is_grey = image.bands() < 3;
  spec.bit_depth = image.format() == VIPS_FORMAT_UCHAR ? 8 : 16;
  return spec;
}

Image<std::uint16_t> repeated(const Image<std::uint16_t>& grey) {
  Image<std::uint16_t> picture(grey.width(), grey.height(), 3);
  for (std::size_t i = 0; i < picture.size(); ++i) picture.data()[i] = grey.data()[i / 3];
  return picture;
}

class PictureFiles : public PixelSource {
 public:
  PictureFiles(std::vector<fs::path> files, int width, int height, int bit_depth, double limit)
      : files_(std::move(files)),
        width_(width),
        height_(height),
        bit_depth_(bit_depth),
        limit_(limit) {}

  Image<std::uint16_t> read(int view_idx) const override {
    const fs::path& path = files_.at(view_idx);
    PictureSpec spec;
    Image<std::uint16_t> picture = decode_picture(path, Orientation::kApplied, spec, limit_);
    if (picture.width() != width_ || picture.height() != height_)
      bad(path, "has another size than when it was opened");
    if (spec.bit_depth < bit_depth_) widen_to_16_bit(picture);
    return picture;
  }
  int bit_depth() const override { return bit_depth_; }

 private:
  std::vector<fs::path> files_;
  int width_, height_, bit_depth_;
  double limit_;
};

}  // namespace

bool is_picture_name(const fs::path& path) {
  static constexpr std::array<std::string_view, 17> kExtensions{
      ".jpg", ".jpeg", ".jpe", ".png",  ".tif", ".tiff", ".bmp",  ".dib", ".ppm",
      ".pgm", ".pbm",  ".pnm", ".webp", ".jp2", ".tga",  ".heic", ".gif"};
  const std::string extension = lower(path.extension().string());
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

std::vector<fs::path> files_of(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (auto entry = fs::directory_iterator(folder, error);
       !error && entry != fs::directory_iterator(); entry.increment(error)) {
    std::error_code ignored;
    if (entry->is_regular_file(ignored) && !entry->path().filename().string().starts_with('.'))
      files.push_back(entry->path());
  }
  if (error)
    throw Error(ErrorCode::kIo, folder.string() + ": can't be read (" + error.message() + ")");
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<fs::path> pictures_of(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return {};
  std::vector<fs::path> files = files_of(folder);
  std::erase_if(files, [](const fs::path& path) { return !is_picture_name(path); });
  return files;
}

std::string size_text(int width, int height) {
  return std::to_string(width) + "×" + std::to_string(height);
}

PictureSpec read_picture_spec(const fs::path& path, Orientation orientation, double limit) {
  try {
    return spec_of(open_picture(path, limit), orientation, path);
  } catch (const vips::VError& error) {
    bad(path, "is damaged or no picture (" + vips_reason(error) + ")");
  }
}

bool may_be_cut_short(const fs::path& path) {
  constexpr std::uint64_t kTail = 4096;  // some writers append notes of their own
  const InputFile file(path);
  const std::string head = file.read(0, 4);
  const std::string tail = file.read(file.size() - std::min(file.size(), kTail), kTail);
  if (head.starts_with("\xff\xd8")) return tail.find("\xff\xd9") == std::string::npos;
  if (head == "\x89PNG") return tail.find("IEND") == std::string::npos;
  return false;
}

Image<std::uint16_t> decode_picture(const fs::path& path, Orientation orientation,
                                    PictureSpec& spec, double limit) {
  try {
    vips::VImage image = open_picture(path, limit);
    spec = spec_of(image, orientation, path);
    if (image.interpretation() == VIPS_INTERPRETATION_CMYK)
      image = image.colourspace(VIPS_INTERPRETATION_sRGB);
    const int bands = spec.is_grey ? 1 : 3;
    image = image.extract_band(0, vips::VImage::option()->set("n", bands)).cast(VIPS_FORMAT_USHORT);
    // Turning reads rows in another order than the file has them: decode first.
    if (orientation == Orientation::kApplied && spec.is_turned)
      image = image.copy_memory().autorot();
    Image<std::uint16_t> picture(image.width(), image.height(), bands, values_of(image));
    return spec.is_grey ? repeated(picture) : picture;
  } catch (const vips::VError& error) {
    bad(path, "is damaged or cut short (" + vips_reason(error) + ")");
  }
}

void widen_to_16_bit(Image<std::uint16_t>& picture) {
  for (std::uint16_t& value : picture) value *= 257;
}

int common_bit_depth(const std::vector<PictureSpec>& specs, std::vector<std::string>& notes) {
  const auto any = [&](auto property) { return std::any_of(specs.begin(), specs.end(), property); };
  const bool deep = any([](const PictureSpec& spec) { return spec.bit_depth == 16; });
  if (any([](const PictureSpec& spec) { return spec.has_alpha; }))
    notes.push_back("the alpha channel of the pictures is ignored");
  if (any([](const PictureSpec& spec) { return spec.is_grey; }))
    notes.push_back("grey pictures are read as colour with equal channels");
  if (deep && any([](const PictureSpec& spec) { return spec.bit_depth == 8; }))
    notes.push_back("pictures of 8 and of 16 bit: the 8-bit ones are scaled up");
  return deep ? 16 : 8;
}

void attach_pictures(LightField& light_field, std::vector<fs::path> files, double memory_bytes) {
  GIGARAY_CHECK(files.size() == light_field.views.size() && !files.empty());
  const double limit = opening_limit(memory_bytes);
  std::vector<PictureSpec> specs;
  for (const fs::path& path : files) {
    specs.push_back(read_picture_spec(path, Orientation::kApplied, limit));
    const PictureSpec &spec = specs.back(), &first = specs.front();
    if (spec.width != first.width || spec.height != first.height)
      bad(path, "has " + size_text(spec.width, spec.height) + " pixels, " +
                    files.front().filename().string() + " has " +
                    size_text(first.width, first.height) + "; all views need one size");
  }
  const int bit_depth = common_bit_depth(specs, light_field.notes);
  light_field.width = specs.front().width;
  light_field.height = specs.front().height;
  light_field.pixels = std::make_shared<PictureFiles>(std::move(files), light_field.width,
                                                      light_field.height, bit_depth, limit);
}

Image<std::uint16_t> read_picture(const fs::path& path, int* bit_depth, double memory_bytes) {
  PictureSpec spec;
  Image<std::uint16_t> picture =
      decode_picture(path, Orientation::kApplied, spec, opening_limit(memory_bytes));
  if (bit_depth) *bit_depth = spec.bit_depth;
  return picture;
}

}  // namespace gigaray
