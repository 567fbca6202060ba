// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gigaray/depth_options.h"
#include "gigaray/image.h"
#include "gigaray/ray_sampler.h"

namespace gigaray {

/// Values of some rows of one view in the layout of the kernels: `pitch` values per row, pixel u at
/// kPad + u, zero elsewhere (kernels read beyond the edges but don't use what is there).
template <class T>
class StripMap {
 public:
  static constexpr int kPad = 32;
  static int pitch_for(int width) { return (width + 2 * kPad + 15) / 16 * 16; }

  StripMap() = default;
  StripMap(int width, RowRange rows)
      : width_(width),
        pitch_(pitch_for(width)),
        rows_(rows),
        data_(std::size_t(pitch_) * rows.size()) {}

  int width() const { return width_; }
  int pitch() const { return pitch_; }
  RowRange rows() const { return rows_; }
  T* row(int v) { return data_.data() + std::size_t(v - rows_.begin) * pitch_ + kPad; }
  const T* row(int v) const { return data_.data() + std::size_t(v - rows_.begin) * pitch_ + kPad; }
  /// First stored value of a row, padding included: what kernels get.
  T* padded_row(int v) { return row(v) - kPad; }
  const T* padded_row(int v) const { return row(v) - kPad; }

 private:
  int width_ = 0;
  int pitch_ = 0;
  RowRange rows_;
  std::vector<T> data_;
};

/// Which views a robust score is made of.
enum class ScoreViews {
  kAll,        ///< about 100 of them where there are many more
  kFirst,      ///< about 25: for a first look
  kHalfPlanes  ///< the best of eight halves of kAll
};

/// First and last hypothesis to test at a pixel.
struct HypothesisBounds {
  std::uint16_t first = 0;
  std::uint16_t last = 0;
  bool operator==(const HypothesisBounds&) const = default;
};

/// An estimate packed so that the larger number is the one that stays where two meet: the nearer
/// hypothesis, then the higher confidence. 0: none.
using PackedEstimate = std::uint64_t;
PackedEstimate pack_estimate(float hypothesis, float confidence);
/// What an arrival must exceed in confidence at a pixel of a finished view that has `own`; 0 where
/// it has none.
float bar_of(PackedEstimate own, float finished_lead);
float hypothesis_of(PackedEstimate estimate);  ///< NaN for none
float confidence_of(PackedEstimate estimate);

/// Mean radiance of an estimate, working colour space.
struct Radiance {
  float r = 0, g = 0, b = 0;
};

/// How an estimate changes from pixel to pixel, hypothesis units per px.
struct Slope {
  float along_u = 0, along_v = 0;
};

/// Rows around a pixel that slope_fit looks at.
inline constexpr int kSlopeReach = 15;
/// The scan-line step follows columns in blocks of so many rows,
inline constexpr int kScanlineBlock = 16;
/// and looks at so many rows on both sides of a block.
inline constexpr int kScanlineReach = 16;
/// The winner of a scan-line step is the best score so near to it, hypotheses.
inline constexpr int kScanlineSearch = 2;

/// One pyramid level.
struct LevelShape {
  int level = 0;
  int width = 0;
  int height = 0;
};

/// Colour in a band of a pixel that shows nothing of the scene. No kernel reaches it, and a
/// negative red tells the samples that it has a part in.
inline constexpr float kMaskedColour = -1000;

/// How the rows of a band are encoded.
enum class BandEncoding {
  kBits8,   ///< [row][view][u][3] bytes as decoded
  kBits16,  ///< the same, 16 bit
  kFloat    ///< [row][view][3][u] floats in the working colour space
};

/// The steps of the method on some device. Each is also a kernel, a reference function, a test and
/// a benchmark of the same name. The caller holds maps and estimates; the backend holds the band
/// (rows of all views, as floats) and the scores of the last strip.
///
/// Calls: begin_level, then per band load_band, then steps on rows within it. All rows are rows of
/// the level; `ref` is a view index. Not thread-safe.
class Backend {
 public:
  virtual ~Backend() = default;
  virtual std::string name() const = 0;         ///< "reference" or "opencl"
  virtual std::string description() const = 0;  ///< The device, for reports.

  /// Views that keep estimates, in the order that `estimates` below has.
  virtual void set_active_views(const std::vector<int>& views) = 0;
  virtual void begin_level(const LevelShape& shape) = 0;
  /// rows: what is loaded, halo included. views: whose, ascending; the steps see no others.
  /// encoded: rows.size() rows of those views in the given encoding. mask: [row][view][u], 0: the
  /// pixel shows nothing of the scene and no sample is taken there; null: all do.
  virtual void load_band(RowRange rows, const std::vector<int>& views, const void* encoded,
                         BandEncoding encoding, const std::uint8_t* mask) = 0;

  virtual void edge_confidence(int ref, RowRange rows, StripMap<float>& confidence) = 0;
  /// Scores of `rows` where todo, kept until the next call of one of these two: the paper's,
  virtual void density_score(int ref, RowRange rows, const StripMap<std::uint8_t>& todo,
                             const StripMap<HypothesisBounds>& bounds) = 0;
  /// the robust one of colour and gradient (ScoreOptions::gradient).
  virtual void robust_score(int ref, RowRange rows, const StripMap<std::uint8_t>& todo,
                            const StripMap<HypothesisBounds>& bounds, ScoreViews views) = 0;
  /// Mean colour along the rays of the reference view's pixels under `disparity`; NaN: the pixel
  /// stays as it is. means: row v · channels() + c holds channel c of row v; gradients are left
  /// alone.
  virtual void ray_mean(int ref, RowRange rows, const StripMap<float>& disparity,
                        StripMap<float>& means) = 0;
  /// Until the next load_band or restore_reference the steps see the pixels of the reference view,
  /// in `rows`, with these colours and their gradients; what other views show stays.
  virtual void replace_reference(RowRange rows, const StripMap<float>& means) = 0;
  virtual void restore_reference() = 0;
  virtual int channels() const = 0;  ///< of a band
  /// Makes supported scores for `rows` out of those of the last call above, which cover
  /// support.radius rows more on both sides or end at the edge of the picture.
  virtual void score_support(int ref, RowRange rows, const StripMap<std::uint8_t>& todo,
                             const StripMap<HypothesisBounds>& bounds) = 0;
  /// The same along the slope of the surface. All hypotheses were tested.
  virtual void slanted_support(int ref, RowRange rows, const StripMap<std::uint8_t>& todo,
                               const StripMap<HypothesisBounds>& bounds,
                               const StripMap<Slope>& slopes) = 0;
  /// Follows scan-lines over the supported scores; winner() then goes by the result. rows: begin at
  /// a multiple of kScanlineBlock; supported scores and todo: of kScanlineReach rows more, clipped
  /// to the picture. All hypotheses were tested.
  virtual void scanline(int ref, RowRange rows, const StripMap<std::uint8_t>& todo) = 0;
  /// Slope of the surface at every estimate. in: rows grown by kSlopeReach; NaN: no estimate.
  virtual void slope_fit(int ref, RowRange rows, const StripMap<float>& in,
                         StripMap<Slope>& slopes) = 0;
  /// The best hypothesis by what the last step on scores left.
  virtual void winner(RowRange rows, const StripMap<std::uint8_t>& todo,
                      const StripMap<HypothesisBounds>& bounds, StripMap<float>& disparity,
                      StripMap<float>& contrast) = 0;
  /// The same scores at the hypotheses next to estimates; NaN where there is none or nothing to do.
  virtual void score_of_estimate(RowRange rows, const StripMap<std::uint8_t>& todo,
                                 const StripMap<float>& disparity, StripMap<float>& scores) = 0;
  /// Scores (without scan-lines) that winner() sees for one pixel, one per hypothesis; -1 where not
  /// tested.
  virtual std::vector<float> scores_at(int u, int v) = 0;
  /// in: rows grown by the radius. tolerance: colour distance; infinite makes it a plain median
  /// that needs no band.
  virtual void bilateral_median(int ref, RowRange rows, int radius, float tolerance,
                                const StripMap<float>& in, StripMap<float>& out) = 0;
  virtual void mean_radiance(int ref, RowRange rows, const StripMap<float>& disparity,
                             StripMap<Radiance>& radiance) = 0;
  /// estimates: [state_rows][active view][width], updated. Rays that leave state_rows are dropped.
  /// bars: alike; what arrives where one is above 0 must be more confident than it. Null: none is.
  virtual void propagation(int ref, RowRange rows, const StripMap<float>& disparity,
                           const StripMap<float>& confidence, const StripMap<Radiance>& radiance,
                           RowRange state_rows, const float* bars, PackedEstimate* estimates) = 0;
  /// small: [small_rows][loaded view][3][(width + 1) / 2]. The band covers rows 2v − 3 … 2v + 3 of
  /// them.
  virtual void downsample(RowRange small_rows, float* small) = 0;
};

/// What a backend needs to know about a run.
struct BackendSetup {
  DepthOptions options;
  HypothesisRange hypotheses;
  LightFieldKind kind = LightFieldKind::k3D;
  int bit_depth = 8;  ///< of level 0
};

/// Colour of an encoded value 0 … 2^bit_depth − 1 in the working space of the score, in [0, 1].
std::vector<float> colour_table(int bit_depth, bool linear_rgb);

/// Plain loops on one thread. S: a sampler of samplers/ (explicitly instantiated for each).
template <RaySampler S>
std::unique_ptr<Backend> make_reference_backend(const S& sampler, const BackendSetup& setup);

/// OpenCL kernels on the device that `device_selection` means, see select_device().
template <RaySampler S>
std::unique_ptr<Backend> make_opencl_backend(const S& sampler, const BackendSetup& setup,
                                             const std::string& device_selection);

}  // namespace gigaray
