// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "coarse_guide.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "gigaray/core/parallel.h"
#include "reference/search_bounds.h"

namespace gigaray {
namespace {

/// An estimate of at least this probability is sure.
constexpr float kSure = 0.7f;
/// Sure estimates so near to a pixel tell what it may be, px of the half size: it, and where its
/// support reaches.
constexpr int kNear = 2;
/// Blocks of so many px, of which those next to a pixel's tell what it may be where it isn't sure;
/// this share of their pixels at least.
constexpr int kBlock = 8;
constexpr double kLeastSure = 0.15;
/// Where nothing is sure nearby an estimate is searched around, by this share of the range: what
/// shows no structure at half the size, sky or a bare wall, shows no more in the full one.
constexpr float kAroundDoubt = 0.05f;
/// A peak of the score, and what a half-size estimate is off, hypotheses.
constexpr int kMargin = 6;

struct Interval {
  float low = std::numeric_limits<float>::infinity();
  float high = -std::numeric_limits<float>::infinity();
  int count = 0;

  void join(float value) { join({value, value, 1}); }
  void join(const Interval& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
    count += other.count;
  }
};

/// Some rows of the half-size maps, with what is sure around every pixel.
class Surroundings {
 public:
  Surroundings(const FinishedMaps& maps, int active_idx, RowRange rows) : width_(maps.width()) {
    const int height = maps.height();
    rows_ = grown({rows.begin / kBlock * kBlock, (rows.end + kBlock - 1) / kBlock * kBlock}, kBlock,
                  (height + kBlock - 1) / kBlock * kBlock);
    rows_.end = std::min(rows_.end, height);
    own_.resize(std::size_t(width_) * rows_.size(), kNoEstimate);
    beside_.resize(own_.size());
    sure_.resize(own_.size());
    blocks_across_ = (width_ + kBlock - 1) / kBlock;
    blocks_.resize(std::size_t(blocks_across_) * ((rows_.size() + kBlock - 1) / kBlock));
    std::vector<float> confidences(width_);
    for (int v = rows_.begin; v < rows_.end; ++v) {
      float* row = &own_[at(0, v)];
      maps.read(active_idx, v, row, confidences.data(), nullptr);
      for (int u = 0; u < width_; ++u) {
        sure_[at(u, v)] = confidences[u] >= kSure;
        if (!sure_[at(u, v)]) continue;
        blocks_[block_at(u, v)].join(row[u]);
        for (int x = std::max(u - kNear, 0); x <= std::min(u + kNear, width_ - 1); ++x)
          beside_[at(x, v)].join(row[u]);
      }
    }
  }

  /// What a pixel may be; empty: anything.
  Interval around(int u, int v) const {
    Interval found;
    if (sure_[at(u, v)]) {
      for (int y = std::max(v - kNear, rows_.begin); y < std::min(v + kNear + 1, rows_.end); ++y)
        found.join(beside_[at(u, y)]);
      return found;
    }
    int pixels = 0;
    for (int y = v - kBlock; y <= v + kBlock; y += kBlock)
      for (int x = u - kBlock; x <= u + kBlock; x += kBlock) {
        if (x < 0 || x / kBlock >= blocks_across_ || y < rows_.begin || y >= rows_.end) continue;
        found.join(blocks_[block_at(x, y)]);
        pixels += kBlock * kBlock;
      }
    const float own = own_[at(u, v)];
    if (found.count < kLeastSure * pixels) {
      if (std::isnan(own)) return {};
      return {own - kAroundDoubt, own + kAroundDoubt, 1};
    }
    if (!std::isnan(own)) found.join(own);
    return found;
  }

 private:
  std::size_t at(int u, int v) const { return std::size_t(v - rows_.begin) * width_ + u; }
  std::size_t block_at(int u, int v) const {
    return std::size_t((v - rows_.begin) / kBlock) * blocks_across_ + u / kBlock;
  }

  int width_;
  RowRange rows_;
  int blocks_across_ = 0;
  std::vector<float> own_;
  std::vector<std::uint8_t> sure_;
  std::vector<Interval> beside_, blocks_;
};

HypothesisBounds bounds_around(const Interval& interval, const HypothesisRange& range) {
  if (interval.count == 0) return {0, std::uint16_t(range.count - 1)};
  return hypotheses_between(interval.low, interval.high, kMargin, range);
}

}  // namespace

bool is_guided(const LightField& light_field, const DepthOptions& options) {
  const std::size_t active =
      options.views.empty() ? light_field.views.size() : options.views.size();
  return light_field.kind == LightFieldKind::kUnstructured && options.coarse_first > 0 &&
         options.propagation.consensus && options.support.slanted && active > 1 &&
         std::min(light_field.width, light_field.height) >= options.coarse_first;
}

StripMap<float> CoarseGuide::hypotheses(int active_idx, int width, RowRange rows) const {
  StripMap<float> full(width, rows);
  const int half_width = maps_.width(), half_height = maps_.height();
  std::vector<float> above(half_width), below(half_width);
  for (int v = rows.begin; v < rows.end; ++v) {
    maps_.read(active_idx, v / 2, above.data(), nullptr, nullptr);
    maps_.read(active_idx, std::min((v + 1) / 2, half_height - 1), below.data(), nullptr, nullptr);
    for (int u = 0; u < width; ++u) {
      const int left = u / 2, right = std::min((u + 1) / 2, half_width - 1);
      full.row(v)[u] = (above[left] + above[right] + below[left] + below[right]) / 4;
    }
  }
  return full;
}

StripMap<HypothesisBounds> CoarseGuide::bounds(int active_idx, int width, RowRange rows,
                                               const HypothesisRange& range) const {
  constexpr int kRowsAtOnce = 64;
  StripMap<HypothesisBounds> bounds(width, rows);
  const auto fill = [&](int strip) {
    const RowRange some{rows.begin + strip * kRowsAtOnce,
                        std::min(rows.begin + (strip + 1) * kRowsAtOnce, rows.end)};
    const RowRange half{some.begin / 2, (some.end + 1) / 2};
    const Surroundings surroundings(maps_, active_idx, half);
    for (int v = half.begin; v < half.end; ++v)
      for (int u = 0; u < maps_.width(); ++u) {
        const HypothesisBounds here = bounds_around(surroundings.around(u, v), range);
        for (int y = std::max(2 * v, some.begin); y < std::min(2 * v + 2, some.end); ++y)
          for (int x = 2 * u; x < std::min(2 * u + 2, width); ++x) bounds.row(y)[x] = here;
      }
  };
  parallel_for((rows.size() + kRowsAtOnce - 1) / kRowsAtOnce, fill, [](int) {});
  return bounds;
}

}  // namespace gigaray
