// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/jpeg_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace gigaray {
namespace {

constexpr int kBlock = 8;
using Block = Eigen::Matrix<float, kBlock, kBlock, Eigen::RowMajor>;

/// Rows are the functions of the orthonormal DCT.
Block dct_matrix() {
  Block matrix;
  for (int k = 0; k < kBlock; ++k)
    for (int n = 0; n < kBlock; ++n)
      matrix(k, n) = float((k == 0 ? std::sqrt(1.0 / kBlock) : std::sqrt(2.0 / kBlock)) *
                           std::cos((2 * n + 1) * k * std::numbers::pi / (2 * kBlock)));
  return matrix;
}
const Block kDct = dct_matrix();

/// The tables of ITU-T T.81, annex K: most programs scale them by the quality, and where a picture
/// shows a step no longer they tell its size beside those that it does show.
const JpegTable kLuma{{16, 11, 10, 16, 24, 40, 51, 61},     {12, 12, 14, 19, 26, 58, 60, 55},
                      {14, 13, 16, 24, 40, 57, 69, 56},     {14, 17, 22, 29, 51, 87, 80, 62},
                      {18, 22, 37, 56, 68, 109, 103, 77},   {24, 35, 55, 64, 81, 104, 113, 92},
                      {49, 64, 78, 87, 103, 121, 120, 101}, {72, 92, 95, 98, 112, 100, 103, 99}};
const JpegTable kChroma{{17, 18, 24, 47, 99, 99, 99, 99}, {18, 21, 26, 66, 99, 99, 99, 99},
                        {24, 26, 56, 99, 99, 99, 99, 99}, {47, 66, 99, 99, 99, 99, 99, 99},
                        {99, 99, 99, 99, 99, 99, 99, 99}, {99, 99, 99, 99, 99, 99, 99, 99},
                        {99, 99, 99, 99, 99, 99, 99, 99}, {99, 99, 99, 99, 99, 99, 99, 99}};

/// Luma and both chroma differences around 0 (ITU-T T.871), levels of 8 bit.
std::array<FloatMap, 3> to_planes(const Image<std::uint16_t>& picture) {
  std::array<FloatMap, 3> planes;
  planes.fill(FloatMap(picture.width(), picture.height()));
  for (int v = 0; v < picture.height(); ++v)
    for (int u = 0; u < picture.width(); ++u) {
      const float r = picture(u, v, 0), g = picture(u, v, 1), b = picture(u, v, 2);
      const float luma = 0.299f * r + 0.587f * g + 0.114f * b;
      planes[0](u, v) = luma - 128;
      planes[1](u, v) = (b - luma) / 1.772f;
      planes[2](u, v) = (r - luma) / 1.402f;
    }
  return planes;
}

/// Means of cells of columns × rows pixels; those at the right and the lower edge may be smaller.
FloatMap means_of_cells(const FloatMap& plane, int columns, int rows) {
  FloatMap means((plane.width() + columns - 1) / columns, (plane.height() + rows - 1) / rows);
  for (int y = 0; y < means.height(); ++y)
    for (int x = 0; x < means.width(); ++x) {
      float sum = 0;
      int count = 0;
      for (int v = y * rows; v < std::min((y + 1) * rows, plane.height()); ++v)
        for (int u = x * columns; u < std::min((x + 1) * columns, plane.width()); ++u, ++count)
          sum += plane(u, v);
      means(x, y) = sum / float(count);
    }
  return means;
}

/// Linear between the middles of cells, the outermost repeated.
float between_cells(const FloatMap& means, int u, int v, int columns, int rows) {
  const float x =
      std::clamp((float(u) + 0.5f) / float(columns) - 0.5f, 0.f, float(means.width() - 1));
  const float y =
      std::clamp((float(v) + 0.5f) / float(rows) - 0.5f, 0.f, float(means.height() - 1));
  const int x0 = int(x), y0 = int(y);
  const int x1 = std::min(x0 + 1, means.width() - 1), y1 = std::min(y0 + 1, means.height() - 1);
  const float fx = x - float(x0), fy = y - float(y0);
  return (1 - fy) * ((1 - fx) * means(x0, y0) + fx * means(x1, y0)) +
         fy * ((1 - fx) * means(x0, y1) + fx * means(x1, y1));
}

/// The block whose first pixel is (u, v), which may lie outside: edges are repeated.
Block block_at(const FloatMap& plane, int u, int v) {
  if (u >= 0 && v >= 0 && u + kBlock <= plane.width() && v + kBlock <= plane.height())
    return Eigen::Map<const Block, 0, Eigen::OuterStride<>>(plane.row(v) + u,
                                                            Eigen::OuterStride<>(plane.width()));
  Block block;
  for (int i = 0; i < kBlock; ++i)
    for (int k = 0; k < kBlock; ++k)
      block(i, k) =
          plane(std::clamp(u + k, 0, plane.width() - 1), std::clamp(v + i, 0, plane.height() - 1));
  return block;
}

/// Sizes of the coefficients of one frequency each that are not 0, ascending.
using Sizes = std::array<std::vector<float>, std::size_t(kBlock) * kBlock>;

// The pixels are rounded too, which moves a coefficient by 0.2 to 0.3.
constexpr float kZero = 1.2f;

void add_sizes(const FloatMap& plane, Sizes& sizes) {
  constexpr int kMostBlocks = 4096;
  const int across = plane.width() / kBlock, count = across * (plane.height() / kBlock);
  for (int i = 0; i < count; i += std::max(1, count / kMostBlocks)) {
    const Block block = block_at(plane, i % across * kBlock, i / across * kBlock);
    const Block coefficients = (kDct * block * kDct.transpose()).cwiseAbs();
    for (int k = 0; k < coefficients.size(); ++k)
      if (coefficients.data()[k] > kZero) sizes[std::size_t(k)].push_back(coefficients.data()[k]);
  }
}

/// How well the sizes are multiples of a step, −1 … 1.
double sharpness(std::span<const float> sizes, float step) {
  double sum = 0;
  for (const float size : sizes) sum += std::cos(2 * std::numbers::pi * size / step);
  return sum / double(sizes.size());
}

/// The largest step that sizes, ascending, are multiples of; 0: they are of none, or too few.
float step_of(std::span<const float> sizes) {
  constexpr std::size_t kFewest = 24;
  constexpr double kMultiples = 0.9, kSharpness = 0.6;
  // None but 0 is smaller than half a step; a multiple of the step would leave many there.
  const auto multiples = [&](float step) {
    const auto first = std::ranges::upper_bound(sizes, 0.5f * step);
    const auto count = std::size_t(sizes.end() - first);
    return count < kFewest || double(count) < kMultiples * double(sizes.size())
               ? std::span<const float>()
               : sizes.last(count);
  };
  for (float step = 255; step > 1; --step) {
    const auto of_step = multiples(step);
    if (of_step.empty() || sharpness(of_step, step) < kSharpness) continue;
    // Its neighbour may fit better.
    while (step > 2 && sharpness(of_step, step - 1) > sharpness(of_step, step)) --step;
    return step;
  }
  return 0;
}

struct FoundTable {
  JpegTable table = JpegTable::Ones();
  int found = 0;         ///< steps that the picture shows
  int beyond_doubt = 0;  ///< those that no pattern of the scene looks like
  float sum_of_found = 0;
};

FoundTable find_table(Sizes sizes, const JpegTable& usual) {
  FoundTable result;
  JpegTable steps;
  std::vector<float> scales;
  for (int k = 0; k < kBlock; ++k)
    for (int l = 0; l < kBlock; ++l) {
      std::vector<float>& of_frequency = sizes[std::size_t(k * kBlock + l)];
      std::ranges::sort(of_frequency);
      steps(k, l) = step_of(of_frequency);
      if (steps(k, l) == 0) continue;
      scales.push_back(steps(k, l) / usual(k, l));
      ++result.found;
      result.sum_of_found += steps(k, l);
      // Coefficients that are all alike are a pattern of the scene perhaps.
      result.beyond_doubt += of_frequency.back() > 1.5f * steps(k, l);
    }
  if (scales.empty()) return result;
  const auto middle = scales.begin() + long(scales.size() / 2);
  std::ranges::nth_element(scales, middle);
  const JpegTable expected = (*middle * usual).array().round().max(1.0f);
  // Where few coefficients are left a divisor of the step may fit them as well.
  result.table = (steps.array() >= 0.5f * expected.array()).select(steps, expected);
  return result;
}

/// The plane with its blocks rounded, the mean over eight places where blocks begin.
FloatMap rounded_elsewhere(const FloatMap& plane, const JpegTable& table) {
  constexpr std::pair<int, int> kShifts[] = {{0, 0}, {4, 0}, {2, 2}, {6, 2},
                                             {0, 4}, {4, 4}, {2, 6}, {6, 6}};
  const Block steps = table, inverse = steps.cwiseInverse();
  const Block back = kDct.transpose();
  const int width = plane.width(), height = plane.height();
  FloatMap sum(width, height);
  for (const auto& [right, down] : kShifts)
    for (int v = down - kBlock; v < height; v += kBlock)
      for (int u = right - kBlock; u < width; u += kBlock) {
        Block block = kDct * block_at(plane, u, v) * back;
        block = (block.array() * inverse.array()).rint() * steps.array();
        block = back * block * kDct;
        for (int i = std::max(0, -v); i < std::min(kBlock, height - v); ++i)
          for (int k = std::max(0, -u); k < std::min(kBlock, width - u); ++k)
            sum(u + k, v + i) += block(i, k);
      }
  for (float& value : sum) value /= float(std::size(kShifts));
  return sum;
}

class PixelsWithoutBlocks : public PixelSource {
 public:
  /// usual: what the centre view shows.
  PixelsWithoutBlocks(std::shared_ptr<const PixelSource> pixels, JpegSteps usual)
      : pixels_(std::move(pixels)), usual_(std::move(usual)) {}
  Image<std::uint16_t> read(int view_idx) const override {
    Image<std::uint16_t> picture = pixels_->read(view_idx);
    pixels_->let_go(view_idx);
    if (auto steps = find_jpeg_steps(picture)) {
      // Weak colours show too little in some views.
      if (!steps->chroma) {
        steps->chroma = usual_.chroma;
        steps->chroma_width = usual_.chroma_width;
        steps->chroma_height = usual_.chroma_height;
      }
      return without_jpeg_blocks(picture, *steps);
    }
    for (std::uint16_t& value : picture) value = std::uint16_t(value * 257);
    return picture;
  }
  bool has_mask() const override { return pixels_->has_mask(); }
  int bit_depth() const override { return 16; }

 private:
  std::shared_ptr<const PixelSource> pixels_;
  JpegSteps usual_;
};

}  // namespace

std::optional<JpegSteps> find_jpeg_steps(const Image<std::uint16_t>& picture) {
  constexpr int kFewestSteps = 4, kFewestChroma = 2;
  const auto planes = to_planes(picture);
  Sizes sizes;
  add_sizes(planes[0], sizes);
  const FoundTable luma = find_table(std::move(sizes), kLuma);
  if (luma.beyond_doubt < kFewestSteps) return std::nullopt;
  JpegSteps steps{luma.table, {}, 1, 1};
  // Means over more than a sample are multiples too, of a part of the steps.
  float most = 0;
  for (const auto& [columns, rows] : {std::pair{1, 1}, {2, 1}, {2, 2}}) {
    Sizes of_both;
    for (const int plane : {1, 2}) add_sizes(means_of_cells(planes[plane], columns, rows), of_both);
    const FoundTable chroma = find_table(std::move(of_both), kChroma);
    if (chroma.found < kFewestChroma || chroma.sum_of_found <= most) continue;
    most = chroma.sum_of_found;
    steps.chroma = chroma.table;
    steps.chroma_width = columns;
    steps.chroma_height = rows;
  }
  return steps;
}

Image<std::uint16_t> without_jpeg_blocks(const Image<std::uint16_t>& picture,
                                         const JpegSteps& steps) {
  auto planes = to_planes(picture);
  planes[0] = rounded_elsewhere(planes[0], steps.luma);
  if (steps.chroma)
    for (const int plane : {1, 2}) {
      const int columns = steps.chroma_width, rows = steps.chroma_height;
      const FloatMap means =
          rounded_elsewhere(means_of_cells(planes[plane], columns, rows), *steps.chroma);
      for (int v = 0; v < picture.height(); ++v)
        for (int u = 0; u < picture.width(); ++u)
          planes[plane](u, v) = between_cells(means, u, v, columns, rows);
    }
  Image<std::uint16_t> result(picture.width(), picture.height(), picture.channels());
  const auto encoded = [](float level) {
    return std::uint16_t(std::lround(std::clamp(level, 0.f, 255.f) * 257));
  };
  for (int v = 0; v < picture.height(); ++v)
    for (int u = 0; u < picture.width(); ++u) {
      const float luma = planes[0](u, v) + 128;
      const float r = luma + 1.402f * planes[2](u, v), b = luma + 1.772f * planes[1](u, v);
      result(u, v, 0) = encoded(r);
      result(u, v, 1) = encoded((luma - 0.299f * r - 0.114f * b) / 0.587f);
      result(u, v, 2) = encoded(b);
      for (int c = 3; c < picture.channels(); ++c) result(u, v, c) = picture(u, v, c);
    }
  return result;
}

LightField without_jpeg_blocks(LightField light_field) {
  if (light_field.pixels->bit_depth() != 8) return light_field;
  if (const auto steps = find_jpeg_steps(read_view(light_field, centre_view(light_field))))
    light_field.pixels = std::make_shared<PixelsWithoutBlocks>(light_field.pixels, *steps);
  return light_field;
}

}  // namespace gigaray
