// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/sparse_file.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>

#include "formats/sparse_file_parts.h"
#include "gigaray/adapters/input_file.h"
#include "gigaray/core/arguments.h"
#include "gigaray/core/parallel.h"
#include "gigaray/sparse/sparse_coding.h"
#include "pictures/picture_files.h"

namespace gigaray {

struct SparseFile::Impl {
  Impl(const std::filesystem::path& path, double most)
      : limit(most),
        file(path, most),
        directory(decode_directory(file.directory(), path.string(), most)),
        tuples(directory.tuples.size()),
        read_once(std::make_unique<std::once_flag[]>(directory.tuples.size())) {
    for (std::size_t i = 0; i < tuples.size(); ++i) {
      tuples[i].least_slope = directory.tuples[i].least_slope;
      tuples[i].largest_slope = directory.tuples[i].largest_slope;
    }
    hold_sizes();
  }

  /// Holds what the directory states against the bytes that are there, and a picture against the
  /// limit.
  void hold_sizes() const {
    const SparseShape& shape = directory.shape;
    const std::string place = file.path().string();
    const std::string claim = "states " + size_text(shape.width, shape.height) + " px";
    for (const std::vector<Section>& view : directory.differences)
      for (int band = 0; band < shape.num_bands(); ++band)
        if (!may_hold_difference(view[band].size, double(shape.width) * shape.band(band).size()))
          throw Error(ErrorCode::kBadInput, place + ": is damaged: it " + claim + " and has " +
                                                std::to_string(view[band].size) +
                                                " bytes for a band of them");
    // The picture, and of every band that is decoded meanwhile what is drawn and the planes.
    constexpr double kPixel = 6, kBandPixel = 56;
    const double rows = std::min(double(shape.height), double(threads()) * shape.band_rows);
    hold_against_limit(place, claim, shape.width * (kPixel * shape.height + kBandPixel * rows),
                       limit);
  }

  static int threads() { return num_threads(); }

  /// Runs a decoder of a section; what it says of damage gets the name of the file.
  template <class Decode>
  auto decoded(const Section& section, Decode decode) const {
    const std::string bytes = file.read(section);
    try {
      return decode(bytes);
    } catch (const Error& problem) {
      throw Error(problem.code(), file.path().string() + ": " + problem.what());
    }
  }

  void read_tuples(int band) const {
    std::call_once(read_once[band], [&] {
      TupleBand found = decoded(directory.tuples[band].section, [&](const std::string& bytes) {
        return decode_tuples(directory.shape, band, bytes, (limit - taken) / threads());
      });
      // Other threads look at the slopes meanwhile, which the directory told.
      if (found.least_slope != tuples[band].least_slope ||
          found.largest_slope != tuples[band].largest_slope)
        throw Error(ErrorCode::kBadInput,
                    file.path().string() + ": is damaged: its tuples are not what it says");
      taken += double(found.tuples.size() * sizeof(SparseTuple));
      tuples[band].tuples = std::move(found.tuples);
    });
  }

  DrawnRows draw(int view, RowRange rows) const {
    for (const int band : bands_reaching(directory.shape, tuples, view, rows)) read_tuples(band);
    return draw_tuples(directory.shape, tuples, view, rows);
  }

  /// A band of a view.
  Image<std::uint16_t> picture(int view, int band) const {
    DrawnRows drawn = draw(view, directory.shape.band(band));
    fill_undrawn(drawn);
    return decoded(directory.differences[view][band], [&](const std::string& bytes) {
      return decode_difference(bytes, drawn.colour, directory.shape.bit_depth);
    });
  }

  double limit;
  SectionReader file;
  SparseDirectory directory;
  mutable std::atomic<double> taken = 0;  ///< bytes of the tuples that were read
  mutable SparseTuples tuples;            ///< filled as they are asked for
  std::unique_ptr<std::once_flag[]> read_once;
};

namespace {

class PicturesOfSparseFile : public PixelSource {
 public:
  explicit PicturesOfSparseFile(SparseFile file) : file_(std::move(file)) {}
  Image<std::uint16_t> read(int view) const override {
    return file_.picture(view, {0, file_.shape().height});
  }
  int bit_depth() const override { return file_.shape().bit_depth; }

 private:
  SparseFile file_;
};

}  // namespace

SparseFile::SparseFile(const std::filesystem::path& path, double memory_bytes)
    : impl_(std::make_shared<Impl>(path, opening_limit(memory_bytes))) {}

LightField SparseFile::light_field() const {
  LightField light_field = impl_->directory.light_field;
  light_field.pixels = std::make_shared<PicturesOfSparseFile>(*this);
  if (max_error() > 0)
    light_field.notes.push_back(impl_->file.path().string() +
                                ": is lossy, values are off by up to " +
                                std::to_string(max_error()));
  return light_field;
}

const SparseShape& SparseFile::shape() const { return impl_->directory.shape; }

DisparityRange SparseFile::disparity_range() const {
  DisparityRange range{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  for (const TupleBand& band : impl_->tuples) {
    if (band.least_slope > band.largest_slope) continue;
    range.min = std::min(range.min, shape().disparity(band.least_slope));
    range.max = std::max(range.max, shape().disparity(band.largest_slope));
  }
  if (range.min > range.max) return {0, 1};
  return range;
}

namespace {

void check_part(const SparseShape& shape, int view, RowRange rows) {
  require_argument(view >= 0 && view < int(shape.positions.size()),
                   "view: the file has no such view");
  require_argument(rows.begin >= 0 && rows.begin < rows.end && rows.end <= shape.height,
                   "rows: must be rows of the picture");
}

}  // namespace

int SparseFile::max_error() const { return impl_->directory.max_error; }

Image<std::uint16_t> SparseFile::picture(int view, RowRange rows) const {
  const SparseShape& shape = this->shape();
  check_part(shape, view, rows);
  Image<std::uint16_t> result(shape.width, rows.size(), 3);
  const int first = rows.begin / shape.band_rows;
  const int last = (rows.end - 1) / shape.band_rows;
  parallel_for(
      last - first + 1,
      [&](int i) {
        const Image<std::uint16_t> part = impl_->picture(view, first + i);
        const RowRange band = shape.band(first + i);
        const int begin = std::max(band.begin, rows.begin), end = std::min(band.end, rows.end);
        std::copy_n(part.row(begin - band.begin), std::size_t(end - begin) * shape.width * 3,
                    result.row(begin - rows.begin));
      },
      [](int) {});
  return result;
}

FloatMap SparseFile::disparity(int view, RowRange rows) const {
  check_part(shape(), view, rows);
  const DrawnRows drawn = impl_->draw(view, rows);
  FloatMap map(shape().width, rows.size());
  std::transform(drawn.slope.begin(), drawn.slope.end(), map.begin(), [&](std::int32_t slope) {
    return slope == DrawnRows::kNone ? kNoEstimate : float(shape().disparity(slope));
  });
  return map;
}

const SparseTuples& SparseFile::tuples() const {
  for (int band = 0; band < shape().num_bands(); ++band) impl_->read_tuples(band);
  return impl_->tuples;
}

}  // namespace gigaray
