// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <algorithm>
#include <memory>
#include <utility>

#include "formats/sparse_file_parts.h"
#include "gigaray/adapters/sparse_file.h"
#include "gigaray/core/parallel.h"
#include "gigaray/sparse/sparse_coding.h"

namespace gigaray {
namespace {

/// Rows that the streams of a block have enough of to be worth their tables.
int usual_band_rows(const LightField& light_field) {
  return std::clamp((1 << 17) / light_field.width, 16, std::max(16, light_field.height));
}

Image<std::uint16_t> rows_of(const Image<std::uint16_t>& picture, RowRange rows) {
  Image<std::uint16_t> part(picture.width(), rows.size(), picture.channels());
  std::copy(picture.row(rows.begin), picture.row(rows.begin) + part.size(), part.begin());
  return part;
}

class WithoutMasks : public PixelSource {
 public:
  explicit WithoutMasks(std::shared_ptr<const PixelSource> pixels) : pixels_(std::move(pixels)) {}
  int bit_depth() const override { return pixels_->bit_depth(); }
  Image<std::uint16_t> read(int view_idx) const override {
    Image<std::uint16_t> picture = pixels_->read(view_idx);
    take_mask(picture);
    return picture;
  }

 private:
  std::shared_ptr<const PixelSource> pixels_;
};

struct CodedBand {
  std::string bytes;
  std::uint64_t unexplained = 0;
};

}  // namespace

SparseFileReport write_sparse_file(AtomicFile output, const LightField& given,
                                   const DisparityOfView& disparity,
                                   const SparseFileOptions& options, const RunControl& control) {
  check(given);
  LightField light_field = given;
  if (given.pixels->has_mask()) {
    light_field.pixels = std::make_shared<WithoutMasks>(given.pixels);
    control.message("a sparse light field keeps the colours under masks, not the masks");
  }
  const int most = (1 << light_field.pixels->bit_depth()) - 1;
  if (options.max_error < 0 || options.max_error > most / 2)
    throw Error(ErrorCode::kInvalidArgument,
                "the largest error is " + std::to_string(options.max_error) +
                    "; it must be from 0 to " + std::to_string(most / 2));
  SparseDirectory directory;
  directory.light_field = light_field;
  directory.max_error = options.max_error;
  directory.shape =
      sparse_shape(light_field, light_field.pixels->bit_depth(),
                   options.band_rows > 0 ? options.band_rows : usual_band_rows(light_field));
  const SparseShape& shape = directory.shape;
  SectionWriter file(std::move(output));

  const SparseTuples tuples = choose_tuples(light_field, shape, disparity, options.sparse, control);
  SparseFileReport report;
  report.rays = std::uint64_t(light_field.num_views()) * light_field.width * light_field.height;
  report.rgb_bytes = report.rays * 3 * shape.bit_depth / 8;
  report.tuples = num_tuples(tuples);
  for (int band = 0; band < shape.num_bands(); ++band) {
    const std::string bytes = encode_tuples(shape, band, tuples[band]);
    directory.tuples.push_back(
        {file.add(bytes), tuples[band].least_slope, tuples[band].largest_slope});
    report.tuple_bytes += bytes.size();
  }
  for (int view = 0; view < light_field.num_views(); ++view) {
    control.progress("encode", double(view), double(light_field.num_views()));
    const Image<std::uint16_t> picture = read_view(light_field, view);
    std::vector<CodedBand> bands(shape.num_bands());
    parallel_for(
        shape.num_bands(),
        [&](int band) {
          const RowRange rows = shape.band(band);
          DrawnRows drawn = draw_tuples(shape, tuples, view, rows);
          bands[band].unexplained =
              std::uint64_t(std::count(drawn.slope.begin(), drawn.slope.end(), DrawnRows::kNone));
          fill_undrawn(drawn);
          bands[band].bytes = encode_difference(rows_of(picture, rows), drawn.colour,
                                                shape.bit_depth, options.max_error);
        },
        [&](int) { control.throw_if_cancelled(); });
    std::vector<Section>& sections = directory.differences.emplace_back();
    for (const CodedBand& band : bands) {
      sections.push_back(file.add(band.bytes));
      report.difference_bytes += band.bytes.size();
      report.unexplained += band.unexplained;
    }
  }
  report.file_bytes = file.finish(encode_directory(directory), control);
  control.progress("encode", 1, 1);
  return report;
}

}  // namespace gigaray
