// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "pictures/picture_loading.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <type_traits>

#include "formats/file_type.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/core/error.h"
#include "pictures/picture_files.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

/// A decoder that may be used. libvips looks at the content and would also take drawings, documents
/// and slides, which can have any size whatever their files have.
struct Decoder {
  std::string_view name;    ///< the class of libvips begins with it
  double sample_bytes;      ///< held beside the result, per sample of the whole picture
  double most_px_per_byte;  ///< what the format can compress at best; 0: no bound
};
constexpr Decoder kDecoders[] = {
    // Deflate gives 1032 bytes for one, of 8 px each in black and white.
    {"VipsForeignLoadPng", 0, 8 * 1100},
    // A bit at least for the first coefficient of every block; 16 blocks and two of colour in
    // 4:1:0.
    {"VipsForeignLoadJpeg", 0, 1100},
    {"VipsForeignLoadPpm", 0, 8},
    {"VipsForeignLoadTiff", 4, 0},
    {"VipsForeignLoadWebp", 4, 0},
    {"VipsForeignLoadNsgif", 4, 4096},
    {"VipsForeignLoadJp2k", 8, 0},
    {"VipsForeignLoadHeif", 6, 0},
    {"VipsForeignLoadJxl", 12, 0},
    {"VipsForeignLoadRad", 0, 64},      // runs of up to 127 equal values
    {"VipsForeignLoadMagick", 8, 256},  // BMP and TGA
};

[[noreturn]] void bad(const fs::path& path, const std::string& what) {
  throw Error(ErrorCode::kBadInput, path.string() + ": " + what);
}

/// ImageMagick knows some hundred formats; what light fields come in is left to it alone.
bool is_for_magick(const InputFile& file) {
  const std::string extension = file.path().extension().string();
  return file.read(0, 2) == "BM" || extension == ".tga" || extension == ".TGA";
}

const Decoder& decoder_of(const InputFile& file) {
  // Of a raw photograph libvips would read the preview.
  if (const std::string why = why_unread(file.path()); !why.empty()) bad(file.path(), why);
  const char* found = vips_foreign_find_load(file.path().c_str());
  if (!found) throw vips::VError();
  for (const Decoder& decoder : kDecoders)
    if (std::string_view(found).starts_with(decoder.name) &&
        (decoder.name != "VipsForeignLoadMagick" || is_for_magick(file)))
      return decoder;
  bad(file.path(), "is damaged or no picture of a format that light fields come in");
}

bool is_interlaced(const vips::VImage& image) {
  for (const char* field : {"interlaced", "jpeg-multiscan"})
    if (image.get_typeof(field) != 0 && image.get_int(field) != 0) return true;
  return false;
}

/// Every scan of a progressive JPEG goes over the whole picture again; cameras write ten or so.
void refuse_endless_scans(const InputFile& file, double pixels) {
  constexpr int kMostScans = 100;
  constexpr double kMostWork = 4e9;  // px
  constexpr std::uint64_t kPiece = 1 << 20;
  int scans = 0;
  char last = 0;
  for (std::uint64_t at = 0; at < file.size(); at += kPiece) {
    for (const char c : file.read(at, kPiece)) {
      scans += last == '\xff' && c == '\xda';
      last = c;
    }
  }
  if (scans > kMostScans || (scans > 16 && scans * pixels > kMostWork))
    bad(file.path(), "is a JPEG of " + std::to_string(scans) +
                         " scans, which would take very long to decode; save it anew");
}

double bytes_to_decode(const vips::VImage& image, const Decoder& decoder) {
  const double pixels = double(image.width()) * image.height();
  const double bands = std::max(3, image.bands());
  const double interlaced = is_interlaced(image) ? 4 : 0;
  const double stored = image.coding() == VIPS_CODING_RAD
                            ? sizeof(float)
                            : double(VIPS_IMAGE_SIZEOF_ELEMENT(image.get_image()));
  const double result = 6 + (stored > 2 ? 3 * stored : 0);  // RGB of 16 bit, and what becomes it
  const bool turned = vips_image_get_orientation(image.get_image()) != 1;
  return pixels * (bands * (decoder.sample_bytes + interlaced) + (turned ? 3 : 1) * result);
}

}  // namespace

vips::VImage open_picture(const fs::path& path, double limit) {
  use_vips();
  vips_error_clear();  // of what an earlier picture had
  const InputFile file = [&] {
    try {
      return InputFile(path);
    } catch (const Error& problem) {
      // A picture that is missing is a fault of what names it.
      throw Error(ErrorCode::kBadInput, problem.what());
    }
  }();
  const Decoder& decoder = decoder_of(file);
  vips::VImage image =
      vips::VImage::new_from_file(path.c_str(), vips::VImage::option()
                                                    ->set("access", VIPS_ACCESS_SEQUENTIAL)
                                                    ->set("fail_on", VIPS_FAIL_ON_WARNING));
  const double pixels = double(image.width()) * image.height();
  const std::string claim = "states " + size_text(image.width(), image.height()) + " px";
  if (decoder.most_px_per_byte > 0 && pixels > decoder.most_px_per_byte * double(file.size()))
    bad(path, "is damaged or cut short: it " + claim + " and has " + std::to_string(file.size()) +
                  " bytes");
  hold_against_limit(path.string(), claim, bytes_to_decode(image, decoder), limit);
  if (decoder.name == "VipsForeignLoadJpeg" && is_interlaced(image))
    refuse_endless_scans(file, pixels);
  return image;
}

template <class T>
std::vector<T> values_of(const vips::VImage& image) {
  constexpr VipsBandFormat kFormat = std::is_same_v<T, float>           ? VIPS_FORMAT_FLOAT
                                     : std::is_same_v<T, std::uint32_t> ? VIPS_FORMAT_UINT
                                                                        : VIPS_FORMAT_USHORT;
  GIGARAY_CHECK(image.format() == kFormat);
  const vips::VRegion region = vips::VRegion::new_from_image(image);
  const std::size_t row = std::size_t(image.width()) * image.bands();
  std::vector<T> values;
  values.reserve(row * image.height());
  constexpr int kRowsAtOnce = 16;
  for (int top = 0; top < image.height(); top += kRowsAtOnce) {
    const VipsRect rows{0, top, image.width(), std::min(kRowsAtOnce, image.height() - top)};
    region.prepare(&rows);
    for (int v = top; v < top + rows.height; ++v) {
      const auto* first = reinterpret_cast<const T*>(region.addr(0, v));
      values.insert(values.end(), first, first + row);
    }
  }
  return values;
}

template std::vector<std::uint16_t> values_of(const vips::VImage&);
template std::vector<std::uint32_t> values_of(const vips::VImage&);
template std::vector<float> values_of(const vips::VImage&);

}  // namespace gigaray
