// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Pictures of any format that OpenImageIO reads. It reports a file that was cut short as an error,
// which decoders built on libjpeg's defaults fill with grey.
#include "picture_files.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <limits>
#include <opencv2/core.hpp>
#include <system_error>

#include "gigaray/adapters/pictures.h"
#include "text.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

struct PictureSpec {
  int width = 0;  // as seen, after the orientation is applied
  int height = 0;
  int channels = 0;
  bool has_alpha = false;
  int bit_depth = 8;
  int orientation = 1;  // EXIF 1 … 8
};

[[noreturn]] void bad(const fs::path& path, const std::string& what) {
  throw Error(ErrorCode::kBadInput, path.string() + ": " + what);
}

// First line of what a decoder says, without the path that it may repeat.
std::string reason(std::string text) {
  text = text.substr(0, text.find('\n'));
  return text.empty() ? "unknown reason" : text;
}

std::unique_ptr<OIIO::ImageInput> open_picture(const fs::path& path, PictureSpec& spec) {
  OIIO::ImageSpec config;
  config["oiio:UnassociatedAlpha"] = 1;  // colours as stored, not multiplied by alpha
  auto input = OIIO::ImageInput::open(path.string(), &config);
  if (!input) bad(path, "is damaged or no picture (" + reason(OIIO::geterror()) + ")");

  const OIIO::ImageSpec& header = input->spec();
  if (header.format.is_floating_point())
    bad(path, "has floating-point pixels; light fields are read from 8 or 16 bit pictures");
  spec.orientation = std::clamp(header.get_int_attribute("Orientation", 1), 1, 8);
  spec.width = header.width;
  spec.height = header.height;
  if (spec.orientation >= 5) std::swap(spec.width, spec.height);
  spec.channels = header.nchannels;
  spec.has_alpha = header.alpha_channel >= 0 || spec.channels == 2 || spec.channels == 4;
  spec.bit_depth = header.format.size() == 1 ? 8 : 16;
  return input;
}

// EXIF: rows and columns of the stored picture in the picture as seen.
cv::Mat oriented(const cv::Mat& stored, int orientation) {
  struct Step {
    bool transpose, mirror_u, mirror_v;
  };
  static constexpr std::array<Step, 9> kSteps{{{},
                                               {false, false, false},
                                               {false, true, false},
                                               {false, true, true},
                                               {false, false, true},
                                               {true, false, false},
                                               {true, true, false},
                                               {true, true, true},
                                               {true, false, true}}};
  const Step step = kSteps[orientation];
  cv::Mat seen = stored;
  if (step.transpose) cv::transpose(seen, seen);
  if (step.mirror_u && step.mirror_v)
    cv::flip(seen, seen, -1);
  else if (step.mirror_u || step.mirror_v)
    cv::flip(seen, seen, step.mirror_u ? 1 : 0);
  return seen;
}

Image<std::uint16_t> decode(const fs::path& path, PictureSpec& spec) {
  const auto input = open_picture(path, spec);
  const int width = input->spec().width, height = input->spec().height;
  const bool grey = spec.channels < 3;
  const int stored_channels = grey ? 1 : 3;
  cv::Mat stored(height, width, CV_MAKETYPE(spec.bit_depth == 8 ? CV_8U : CV_16U, stored_channels));
  // 8-bit values stay 0 … 255: read in the file's own type, then widened by OpenCV.
  const auto type = spec.bit_depth == 8 ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::UINT16;
  if (!input->read_image(0, 0, 0, stored_channels, type, stored.data))
    bad(path, "is damaged or cut short (" + reason(input->geterror()) + ")");

  const cv::Mat seen = oriented(stored, spec.orientation);
  Image<std::uint16_t> picture(seen.cols, seen.rows, 3);
  cv::Mat target(seen.rows, seen.cols, CV_16UC3, picture.data());
  if (grey) {
    cv::Mat wide;
    seen.convertTo(wide, CV_16U);
    cv::merge(std::array{wide, wide, wide}, target);
  } else {
    seen.convertTo(target, CV_16U);
  }
  return picture;
}

class PictureFiles : public PixelSource {
 public:
  PictureFiles(std::vector<fs::path> files, int width, int height, int bit_depth)
      : files_(std::move(files)), width_(width), height_(height), bit_depth_(bit_depth) {}

  Image<std::uint16_t> read(int view_idx) const override {
    const fs::path& path = files_.at(view_idx);
    PictureSpec spec;
    Image<std::uint16_t> picture = decode(path, spec);
    if (picture.width() != width_ || picture.height() != height_)
      bad(path, "has another size than when it was opened");
    if (spec.bit_depth < bit_depth_)
      for (std::uint16_t& value : picture) value *= 257;
    return picture;
  }
  int bit_depth() const override { return bit_depth_; }

 private:
  std::vector<fs::path> files_;
  int width_, height_, bit_depth_;
};

std::string size_text(int width, int height) {
  return std::to_string(width) + "×" + std::to_string(height);
}

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

void attach_pictures(LightField& light_field, std::vector<fs::path> files) {
  GIGARAY_CHECK(files.size() == light_field.views.size() && !files.empty());
  PictureSpec first;
  int bit_depth = 8;
  bool alpha = false, grey = false, mixed_depth = false;
  for (const fs::path& path : files) {
    PictureSpec spec;
    open_picture(path, spec);
    if (&path == &files.front()) first = spec;
    if (spec.width != first.width || spec.height != first.height)
      bad(path, "has " + size_text(spec.width, spec.height) + " pixels, " +
                    files.front().filename().string() + " has " +
                    size_text(first.width, first.height) + "; all views need one size");
    bit_depth = std::max(bit_depth, spec.bit_depth);
    mixed_depth |= spec.bit_depth != first.bit_depth;
    alpha |= spec.has_alpha;
    grey |= spec.channels < 3;
  }
  if (alpha) light_field.notes.push_back("the alpha channel of the pictures is ignored");
  if (grey) light_field.notes.push_back("grey pictures are read as colour with equal channels");
  if (mixed_depth)
    light_field.notes.push_back("pictures of 8 and of 16 bit: the 8-bit ones are scaled up");
  light_field.width = first.width;
  light_field.height = first.height;
  light_field.pixels =
      std::make_shared<PictureFiles>(std::move(files), first.width, first.height, bit_depth);
}

Image<std::uint16_t> read_picture(const fs::path& path, int* bit_depth) {
  PictureSpec spec;
  Image<std::uint16_t> picture = decode(path, spec);
  if (bit_depth) *bit_depth = spec.bit_depth;
  return picture;
}

}  // namespace gigaray
