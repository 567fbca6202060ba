// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Pictures of any format that libvips reads. It reports a file that was cut short or damaged as an
// error, which decoders built on the defaults of libjpeg fill with grey, and gives sizes without
// decoding.
#include "pictures/picture_files.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>
#include <system_error>

#include "files/text.h"
#include "formats/file_type.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/pictures.h"
#include "pictures/exr_picture.h"
#include "pictures/picture_loading.h"
#include "pictures/picture_values.h"

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

Samples samples_of(const vips::VImage& image, const fs::path& path) {
  if (image.coding() == VIPS_CODING_RAD) return Samples::kLight;
  switch (image.format()) {
    case VIPS_FORMAT_UCHAR:
      return Samples::k8;
    case VIPS_FORMAT_USHORT:
    case VIPS_FORMAT_CHAR:
    case VIPS_FORMAT_SHORT:
      return Samples::k16;
    case VIPS_FORMAT_UINT:
    case VIPS_FORMAT_INT:
      return Samples::k32;
    case VIPS_FORMAT_FLOAT:
    case VIPS_FORMAT_DOUBLE:
      return Samples::kLight;
    default:
      bad(path, "has pixels of complex numbers, a view has real ones");
  }
}

PictureSpec spec_of(const vips::VImage& image, Orientation orientation, const fs::path& path) {
  PictureSpec spec;
  spec.samples = samples_of(image, path);
  spec.width = image.width();
  spec.height = image.height();
  spec.is_turned = vips_image_get_orientation(image.get_image()) != 1;
  if (orientation == Orientation::kApplied && vips_image_get_orientation_swap(image.get_image()))
    std::swap(spec.width, spec.height);
  spec.taken_with = taken_with(image);
  spec.has_alpha = image.has_alpha() && image.coding() != VIPS_CODING_RAD;
  spec.is_grey = image.bands() < 3;
  spec.bit_depth = spec.samples == Samples::k8 ? 8 : 16;
  return spec;
}

/// What libvips says, or that it can't read what is no damage.
std::string fault_text(const vips::VError& error, const std::string& otherwise) {
  const std::string reason = vips_reason(error);
  if (reason.find("not a whole number of bytes") != std::string::npos)
    return "has samples of 9 to 15 bits, one after the other, which can't be read; save it with 16 "
           "bits, as `convert FILE -depth 16 NEW.tif` does";
  return otherwise + " (" + reason + ")";
}

}  // namespace

bool is_picture_name(const fs::path& path) {
  static constexpr std::array<std::string_view, 27> kExtensions{
      ".jpg", ".jpeg", ".jpe",  ".jfif", ".jpg_large", ".png",  ".tif", ".tiff", ".bmp",
      ".dib", ".ppm",  ".pgm",  ".pbm",  ".pnm",       ".webp", ".jp2", ".j2k",  ".jpf",
      ".jpx", ".tga",  ".heic", ".heif", ".hif",       ".avif", ".jxl", ".gif",  ".jpeg_large"};
  const std::string extension = lower(path.extension().string());
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

bool is_picture(const fs::path& path) {
  if (is_picture_name(path)) return true;
  const FileKind kind = file_type(path).kind;
  return kind == FileKind::kPicture || kind == FileKind::kLight;
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

std::vector<fs::path> files_ending_in(const std::string& ending, const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return {};
  std::vector<fs::path> files = files_of(folder);
  std::erase_if(files, [&](const fs::path& path) {
    return !lower(path.filename().string()).ends_with(ending);
  });
  return files;
}

std::vector<fs::path> pictures_of(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return {};
  const std::vector<fs::path> files = files_of(folder);
  std::vector<fs::path> pictures, light;
  std::ranges::copy_if(files, std::back_inserter(pictures), [](const fs::path& path) {
    return likely_kind(path) == FileKind::kPicture;
  });
  // Beside pictures of the usual kinds they are maps of depth as a rule.
  if (pictures.size() >= 2) return pictures;
  std::ranges::copy_if(files, std::back_inserter(light), [](const fs::path& path) {
    return file_type(path).kind == FileKind::kLight;
  });
  return light.size() > pictures.size() ? light : pictures;
}

std::string size_text(int width, int height) {
  return std::to_string(width) + "×" + std::to_string(height);
}

PictureSpec read_picture_spec(const fs::path& path, Orientation orientation, double limit) {
  if (is_exr(path)) return exr_spec(path, limit);
  try {
    return spec_of(open_picture(path, limit), orientation, path);
  } catch (const vips::VError& error) {
    bad(path, fault_text(error, "is damaged or no picture"));
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

StoredPicture read_stored(const fs::path& path, Orientation orientation, PictureSpec& spec,
                          double limit) {
  StoredPicture stored;
  if (is_exr(path)) {
    spec = exr_spec(path, limit);
    stored.light = read_exr_colours(path, limit);
    return stored;
  }
  try {
    vips::VImage image = open_picture(path, limit);
    spec = spec_of(image, orientation, path);
    if (image.coding() == VIPS_CODING_RAD) image = image.rad2float();
    // PFM has its rows from bottom to top, which libvips leaves as it is.
    if (spec.samples == Samples::kLight &&
        std::string_view(image.get_string("vips-loader")).starts_with("ppm"))
      image = image.copy_memory().flip(VIPS_DIRECTION_VERTICAL);
    if (image.interpretation() == VIPS_INTERPRETATION_CMYK)
      image = image.colourspace(VIPS_INTERPRETATION_sRGB);
    const int bands = spec.is_grey ? 1 : 3;
    image = image.extract_band(0, vips::VImage::option()->set("n", bands))
                .cast(spec.samples == Samples::kLight ? VIPS_FORMAT_FLOAT
                      : spec.samples == Samples::k32  ? VIPS_FORMAT_UINT
                                                      : VIPS_FORMAT_USHORT);
    // Turning reads rows in another order than the file has them: decode first.
    if (orientation == Orientation::kApplied && spec.is_turned)
      image = image.copy_memory().autorot();
    const int width = image.width(), height = image.height();
    if (spec.samples == Samples::kLight)
      stored.light = {width, height, bands, values_of<float>(image)};
    else if (spec.samples == Samples::k32)
      stored.deep = {width, height, bands, values_of<std::uint32_t>(image)};
    else
      stored.whole = {width, height, bands, values_of<std::uint16_t>(image)};
    return stored;
  } catch (const vips::VError& error) {
    bad(path, fault_text(error, "is damaged or cut short"));
  }
}

Image<std::uint16_t> decode_picture(const fs::path& path, Orientation orientation,
                                    PictureSpec& spec, double limit, const ValueScale& scale) {
  StoredPicture stored = read_stored(path, orientation, spec, limit);
  return colours_of_16_bit(std::move(stored), spec.samples, scale);
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

Image<std::uint16_t> read_picture(const fs::path& path, int* bit_depth, double memory_bytes) {
  PictureSpec spec;
  Image<std::uint16_t> picture =
      decode_picture(path, Orientation::kApplied, spec, opening_limit(memory_bytes));
  if (bit_depth) *bit_depth = spec.bit_depth;
  return picture;
}

}  // namespace gigaray
