// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// One picture of a plenoptic camera, resampled to a square raster of lenses, as in the Stanford
// Lytro archive (…_eslf.png): below each lens lie columns × rows pixels, one of each view.
#include <system_error>

#include "files/text.h"
#include "formats/readers.h"
#include "formats/view_grid.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/adapters/pictures.h"
#include "pictures/picture_files.h"
#include "pictures/picture_values.h"

namespace gigaray {
namespace {

namespace fs = std::filesystem;

constexpr int kEslfViews = 14;  // per axis, in the Stanford Lytro archive

bool is_eslf(const fs::path& input) {
  return lower(input.stem().string()).find("eslf") != std::string::npos;
}

class LensletReader : public Reader {
 public:
  std::string name() const override { return "lenslet picture"; }

  ProbeResult probe(const fs::path& input) const override {
    std::error_code ignored;
    return {is_eslf(input) && fs::is_regular_file(input, ignored) && is_picture(input) ? 40 : 0,
            ""};
  }

  LightField open(const fs::path& input, const OpenOptions& options) const override {
    const int columns = options.lenslet.columns > 0 ? options.lenslet.columns : kEslfViews;
    const int rows = options.lenslet.rows > 0 ? options.lenslet.rows : columns;
    if (columns * rows < 2 || columns > 100 || rows > 100)
      throw Error(ErrorCode::kInvalidArgument,
                  "OpenOptions::lenslet: " + std::to_string(columns) + "×" + std::to_string(rows) +
                      " is no grid of views; up to 100 per axis, two or more in all");
    const Directions directions = Directions::of_grid(options, Travel::kRight, Travel::kDown);

    // The picture, and its views beside it.
    const double limit = opening_limit(options.memory_bytes);
    PictureSpec spec = read_picture_spec(input, Orientation::kApplied, limit);
    constexpr double kBytesPerPixel = 6 + 6;
    hold_against_limit(input.string(), "states " + size_text(spec.width, spec.height) + " px",
                       kBytesPerPixel * spec.width * spec.height, limit);
    LightField light_field;
    const ValueScale scale = scale_of({input}, {spec}, limit, light_field.notes);
    const Image<std::uint16_t> all =
        decode_picture(input, Orientation::kApplied, spec, limit, scale);
    if (all.width() % columns != 0 || all.height() % rows != 0)
      throw Error(ErrorCode::kBadInput, input.string() + ": " + std::to_string(all.width()) + "×" +
                                            std::to_string(all.height()) +
                                            " pixels can't be divided into " +
                                            std::to_string(columns) + "×" + std::to_string(rows) +
                                            " views; state the grid with OpenOptions::lenslet");
    light_field.views = grid_views(rows, columns, directions);
    light_field.kind = kind_from_positions(light_field.views);
    assume_directions(light_field, directions);
    std::vector<Image<std::uint16_t>> pictures;
    for (int row = 0; row < rows; ++row)
      for (int column = 0; column < columns; ++column) {
        Image<std::uint16_t> picture(all.width() / columns, all.height() / rows, 3);
        for (int v = 0; v < picture.height(); ++v)
          for (int u = 0; u < picture.width(); ++u)
            for (int c = 0; c < 3; ++c)
              picture(u, v, c) = all(u * columns + column, v * rows + row, c);
        pictures.push_back(std::move(picture));
      }
    try {
      attach_bright_views(light_field, std::move(pictures), spec.bit_depth);
    } catch (const Error& problem) {
      throw Error(problem.code(), input.string() + ": " + problem.what());
    }
    return light_field;
  }
};

}  // namespace

std::unique_ptr<const Reader> lenslet_reader() { return std::make_unique<LensletReader>(); }

}  // namespace gigaray
