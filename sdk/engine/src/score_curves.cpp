// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
//
// Why a pixel has its depth: its scores, as the winner is chosen from.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "gigaray/core/arguments.h"
#include "gigaray/engine/estimator.h"
#include "gigaray/engine/reconstruct.h"
#include "gigaray/samplers/any_sampler.h"
#include "prepared.h"

namespace gigaray {
namespace {

/// Looks at pixels of a view row by row, with all hypotheses, at level 0.
class CurvesOfView {
 public:
  CurvesOfView(const Prepared& run, const Device* device, int view)
      : run_(run),
        view_(view),
        width_(run.light_field.width),
        height_(run.light_field.height),
        workspace_(make_workspace(run, device)),
        sampler_(make_sampler(run.light_field)),
        partners_(std::visit([&](const auto& s) { return s.partners(view); }, sampler_)) {}

  /// Of the pixels of row v in these columns.
  std::vector<ScoreCurve> row(int v, const std::vector<int>& columns, const RunControl& control) {
    load(v, control);
    score(v, columns);
    std::vector<ScoreCurve> curves;
    for (const int u : columns) curves.push_back(curve(u, v));
    return curves;
  }

 private:
  /// The rows that windows around the row's pixels reach.
  RowRange strip(int v) const { return grown({v, v + 1}, radius(), height_); }
  int radius() const { return run_.options.support.radius; }
  std::size_t line() const { return std::size_t(width_) * 3; }

  void load(int v, const RunControl& control);
  void score(int v, const std::vector<int>& columns);
  ScoreCurve curve(int u, int v) const;

  const Prepared& run_;
  int view_, width_, height_;
  std::unique_ptr<Workspace> workspace_;
  AnySampler sampler_;
  std::vector<int> partners_;
  RowRange rows_;                       ///< that are loaded
  std::vector<std::uint16_t> encoded_;  ///< [row][partner][u][c]
  FloatMap disparity_, contrast_;       ///< of the row
};

/// Brings the rows that the windows reach in all views.
void CurvesOfView::load(int v, const RunControl& control) {
  constexpr int kTaps = 3;  // interpolation and gradients
  rows_ = std::visit(
      [&](const auto& s) {
        return s.rows_needed(view_, grown(strip(v), kTaps, height_), run_.hypotheses, height_);
      },
      sampler_);
  const PixelSource& pixels = *run_.light_field.pixels;
  const std::size_t loaded = partners_.size();
  encoded_.resize(rows_.size() * loaded * line());
  std::vector<std::uint8_t> mask(pixels.has_mask() ? encoded_.size() / 3 : 0);
  for (std::size_t i = 0; i < loaded; ++i) {
    control.throw_if_cancelled();
    Image<std::uint16_t> picture = read_view(run_.light_field, partners_[i]);
    const auto shown = take_mask(picture);
    for (int y = rows_.begin; y < rows_.end; ++y) {
      const std::size_t at = std::size_t(y - rows_.begin) * loaded + i;
      std::copy_n(picture.row(y), line(), encoded_.begin() + at * line());
      if (shown) std::copy_n(shown->row(y), width_, mask.begin() + at * width_);
    }
  }
  std::vector<std::uint8_t> bytes;
  if (pixels.bit_depth() == 8) bytes.assign(encoded_.begin(), encoded_.end());
  const auto to_device = [&](auto& values) {
    RowsOnDevice to{workspace_->allocate(values.size() * sizeof values[0]), rows_.begin,
                    int(loaded)};
    workspace_->write(*to.memory, std::as_bytes(std::span(values)));
    return to;
  };
  EncodedRows source;
  source.at = all_views(int(loaded));
  source.encoding = bytes.empty() ? BandEncoding::kBits16 : BandEncoding::kBits8;
  source.pixels = bytes.empty() ? to_device(encoded_) : to_device(bytes);
  if (!mask.empty()) source.shown = {to_device(mask), width_, 0};
  workspace_->begin_level({0, width_, height_}, rows_.size());
  workspace_->load_band(rows_, rows_, partners_, source);
}

/// The windows around the pixels are to do, with all hypotheses; maps are of the whole view.
void CurvesOfView::score(int v, const std::vector<int>& columns) {
  const RowRange all{0, height_}, window_rows = strip(v);
  const auto todo = workspace_->make_map<std::uint8_t>(width_, all);
  const auto bounds = workspace_->make_map<HypothesisBounds>(width_, all);
  const HypothesisBounds full{0, std::uint16_t(run_.hypotheses.count - 1)};
  StripMap<std::uint8_t> window(width_, window_rows);
  StripMap<HypothesisBounds> tested(width_, window_rows);
  for (int y = window_rows.begin; y < window_rows.end; ++y)
    for (const int u : columns)
      for (int x = std::max(u - radius(), 0); x <= std::min(u + radius(), width_ - 1); ++x) {
        window.row(y)[x] = 1;
        tested.row(y)[x] = full;
      }
  workspace_->put(window, todo);
  workspace_->put(tested, bounds);
  workspace_->hold_scores(0, window_rows);
  if (run_.options.score.gradient)
    workspace_->robust_score(view_, window_rows, todo, bounds, ScoreViews::kAll);
  else
    workspace_->density_score(view_, window_rows, todo, bounds);
  const RowRange row{v, v + 1};
  if (radius() > 0) workspace_->score_support(view_, row, todo, bounds);
  const auto disparity = workspace_->make_map<float>(width_, row);
  const auto contrast = workspace_->make_map<float>(width_, row);
  workspace_->winner(row, todo, bounds, disparity, contrast);
  const auto found = workspace_->get(disparity), sure = workspace_->get(contrast);
  disparity_ = FloatMap(width_, 1, 1, std::vector<float>(found.row(v), found.row(v) + width_));
  contrast_ = FloatMap(width_, 1, 1, std::vector<float>(sure.row(v), sure.row(v) + width_));
}

ScoreCurve CurvesOfView::curve(int u, int v) const {
  ScoreCurve curve;
  curve.scores = workspace_->scores_at(u, v);
  const float winner = disparity_(u, 0);
  curve.confidence = contrast_(u, 0);
  const float most = float((1 << run_.light_field.pixels->bit_depth()) - 1);
  const Radiance unseen{kNoEstimate, kNoEstimate, kNoEstimate};
  curve.samples.assign(run_.light_field.views.size(), unseen);
  for (std::size_t i = 0; i < partners_.size(); ++i) {
    const auto there = std::visit(
        [&](const auto& s) {
          return s.locate(view_, partners_[i], Ray{double(u), double(v), winner});
        },
        sampler_);
    if (!there ||
        !(there->u >= 0 && there->u <= width_ - 1 && there->v >= 0 && there->v <= height_ - 1))
      continue;
    const std::size_t x = std::size_t(std::lround(there->u)),
                      y = std::size_t(std::lround(there->v));
    const std::uint16_t* pixel =
        &encoded_[((y - rows_.begin) * partners_.size() + i) * line() + 3 * x];
    curve.samples[partners_[i]] = {pixel[0] / most, pixel[1] / most, pixel[2] / most};
  }
  // In the caller's unit.
  curve.hypotheses = run_.hypotheses;
  curve.disparity = winner;
  if (!run_.light_field.cameras.empty()) {
    const InverseDepthRange& range = *run_.light_field.cameras[view_].inverse_depth;
    curve.hypotheses = {range.min, range.max, run_.hypotheses.count};
    curve.disparity = float(range.min + winner * (range.max - range.min));
  }
  return curve;
}

/// Pixels by their row, with their places in the list.
std::map<int, std::vector<std::size_t>> by_row(const std::vector<PixelIndex>& pixels) {
  std::map<int, std::vector<std::size_t>> rows;
  for (std::size_t i = 0; i < pixels.size(); ++i) rows[pixels[i].v].push_back(i);
  return rows;
}

void require_inside(const LightField& light_field, int view,
                    const std::vector<PixelIndex>& pixels) {
  const bool has_view = view >= 0 && view < light_field.num_views();
  for (const PixelIndex& pixel : pixels)
    if (!has_view || pixel.u < 0 || pixel.u >= light_field.width || pixel.v < 0 ||
        pixel.v >= light_field.height)
      throw Error(ErrorCode::kInvalidArgument,
                  "pixel " + std::to_string(pixel.u) + " " + std::to_string(pixel.v) +
                      " is outside the picture of " + std::to_string(light_field.width) + "x" +
                      std::to_string(light_field.height));
}

}  // namespace

ScoreCurve probe(const LightField& light_field, const DepthOptions& options,
                 const BackendChoice& backend, int view_idx, int u, int v,
                 const RunControl& control) {
  // Before a device is opened.
  check(light_field);
  options.check();
  return Estimator::of(backend).probe(light_field, options, view_idx, u, v, control);
}

ScoreCurve Estimator::probe(const LightField& light_field, const DepthOptions& options,
                            int view_idx, int u, int v, const RunControl& control) const {
  return std::move(probe(light_field, options, view_idx, {{u, v}}, control).front());
}

std::vector<ScoreCurve> Estimator::probe(const LightField& light_field, const DepthOptions& options,
                                         int view_idx, const std::vector<PixelIndex>& pixels,
                                         const RunControl& control) const {
  return control.stop_or_fail([&] {
    return with_memory_errors("the scores of a pixel", [&] {
      return compute_curves(light_field, options, view_idx, pixels, control);
    });
  });
}

std::vector<ScoreCurve> Estimator::compute_curves(const LightField& light_field,
                                                  const DepthOptions& options, int view_idx,
                                                  const std::vector<PixelIndex>& pixels,
                                                  const RunControl& control) const {
  require_inside(light_field, view_idx, pixels);
  check(light_field);
  LightField given = kept_and_cleaned(light_field, options, control);
  DepthOptions wanted = options;
  require_direction(given, wanted, control);
  Prepared run = prepare(given, wanted, control);
  adapt_to_pictures(run, control);
  CurvesOfView view(run, devices_.empty() ? nullptr : &devices_.front(), view_idx);
  std::vector<ScoreCurve> curves(pixels.size());
  std::size_t done = 0;
  for (const auto& [v, places] : by_row(pixels)) {
    control.progress("scores", double(done), double(pixels.size()));
    std::vector<int> columns;
    for (const std::size_t i : places) columns.push_back(pixels[i].u);
    std::vector<ScoreCurve> found = view.row(v, columns, control);
    for (std::size_t i = 0; i < places.size(); ++i) curves[places[i]] = std::move(found[i]);
    done += places.size();
  }
  return curves;
}

}  // namespace gigaray
