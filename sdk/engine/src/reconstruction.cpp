// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/engine/reconstruct.h"

#include <algorithm>
#include <limits>

#include "gigaray/core/arguments.h"
#include "gigaray/core/parallel.h"
#include "gigaray/engine/calibration.h"
#include "reconstruction_impl.h"
#include "reference/bilateral_median.h"

namespace gigaray {

int Reconstruction::Impl::active_index(int view) const {
  const auto found = std::find(active.begin(), active.end(), view);
  if (found == active.end())
    throw Error(ErrorCode::kInvalidArgument,
                "view " + std::to_string(view) + " was not asked for, it has no depth");
  return int(found - active.begin());
}

Reconstruction::Reconstruction(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Reconstruction::Reconstruction(Reconstruction&&) noexcept = default;
Reconstruction& Reconstruction::operator=(Reconstruction&&) noexcept = default;
Reconstruction::~Reconstruction() = default;

const DepthOptions& Reconstruction::options() const { return impl_->options; }
HypothesisRange Reconstruction::hypotheses() const {
  if (impl_->cameras.empty()) return impl_->hypotheses;
  const InverseDepthRange all = all_inverse_depths(impl_->cameras);
  return {all.min, all.max, impl_->hypotheses.count};
}
const LightField& Reconstruction::light_field() const { return impl_->light_field; }
const std::vector<Camera>& Reconstruction::cameras() const { return impl_->cameras; }
const std::vector<int>& Reconstruction::views() const { return impl_->views; }
int Reconstruction::num_levels() const { return int(impl_->plan.levels.size()); }
const std::string& Reconstruction::device() const { return impl_->device; }
const std::map<std::string, double>& Reconstruction::seconds() const { return impl_->seconds; }
const Forecast& Reconstruction::forecast() const { return impl_->plan.forecast; }
std::size_t Reconstruction::num_tuples() const { return impl_->tuples.size(); }
void Reconstruction::for_each_tuple(const std::function<void(const RayTuple&)>& visit) const {
  impl_->tuples.for_each([&](RayTuple tuple) {
    tuple.hypothesis = impl_->disparity_of(tuple.view, tuple.hypothesis);
    visit(tuple);
  });
}

namespace {

/// The plain median of the end.
void take_median(int radius, FloatMap& map) {
  const int width = map.width(), height = map.height();
  StripMap<float> in(width, {0, height}), out = in;
  for (int v = 0; v < height; ++v) std::copy_n(map.row(v), width, in.row(v));
  const reference::Band no_colours{{0, width, height}, {0, height}, 0, 3, {}};
  constexpr int kRows = 32;
  parallel_for((height + kRows - 1) / kRows,
               [&](int i) {
                 const RowRange rows{i * kRows, std::min((i + 1) * kRows, height)};
                 reference::bilateral_median(no_colours, 0, rows, radius,
                                             std::numeric_limits<float>::infinity(), in.view(),
                                             out);
                 for (int v = rows.begin; v < rows.end; ++v)
                   std::copy_n(out.row(v), width, map.row(v));
               },
               [](int) {});
}

}  // namespace

ViewDepth Reconstruction::view(int view_idx) const {
  const int active = impl_->active_index(view_idx);
  const int width = impl_->maps.width(), height = impl_->maps.height();
  ViewDepth depth{FloatMap(width, height), FloatMap(width, height),
                  Image<std::int8_t>(width, height)};
  for (int v = 0; v < height; ++v)
    impl_->maps.read(active, v, depth.disparity.row(v), depth.confidence.row(v),
                     depth.level.row(v));
  if (impl_->options.winner.calibrated && !impl_->agreed)
    for (float& confidence : depth.confidence)
      confidence = calibrated_confidence(confidence, impl_->light_field.kind);
  for (float& value : depth.disparity) value = impl_->disparity_of(view_idx, value);
  const int radius = impl_->options.propagation.final_median_radius;
  if (radius > 0) take_median(radius, depth.disparity);
  return depth;
}

void drop_unsure(float min_confidence, ViewDepth& depth) {
  require_argument(depth.confidence.width() == depth.disparity.width() &&
                       depth.confidence.height() == depth.disparity.height(),
                   "depth.confidence: must be as large as the disparity");
  for (int v = 0; v < depth.disparity.height(); ++v)
    for (int u = 0; u < depth.disparity.width(); ++u)
      if (!(depth.confidence(u, v) >= min_confidence)) depth.disparity(u, v) = kNoEstimate;
}

}  // namespace gigaray
