// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// The pictures of 3D and 4D light fields, one file per view.
#include <memory>

#include "gigaray/adapters/input_file.h"
#include "picture_files.h"
#include "picture_values.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void bad(const fs::path& path, const std::string& what) {
  throw Error(ErrorCode::kBadInput, path.string() + ": " + what);
}

class PictureFiles : public PixelSource {
 public:
  PictureFiles(std::vector<fs::path> files, int width, int height, int bit_depth,
               const ValueScale& scale, double limit)
      : files_(std::move(files)),
        width_(width),
        height_(height),
        bit_depth_(bit_depth),
        scale_(scale),
        limit_(limit) {}

  Image<std::uint16_t> read(int view_idx) const override {
    const fs::path& path = files_.at(view_idx);
    PictureSpec spec;
    Image<std::uint16_t> picture =
        decode_picture(path, Orientation::kApplied, spec, limit_, scale_);
    if (picture.width() != width_ || picture.height() != height_)
      bad(path, "has another size than when it was opened");
    if (spec.bit_depth < bit_depth_) widen_to_16_bit(picture);
    return picture;
  }
  int bit_depth() const override { return bit_depth_; }

 private:
  std::vector<fs::path> files_;
  int width_, height_, bit_depth_;
  ValueScale scale_;
  double limit_;
};

}  // namespace

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
  const ValueScale scale = scale_of(files, specs, limit, light_field.notes);
  light_field.width = specs.front().width;
  light_field.height = specs.front().height;
  light_field.pixels = std::make_shared<PictureFiles>(std::move(files), light_field.width,
                                                      light_field.height, bit_depth, scale, limit);
}

}  // namespace gigaray
