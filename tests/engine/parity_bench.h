// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "engine/host_steps.h"
#include "gigaray/samplers/any_sampler.h"
#include "opencl/opencl_workspace.h"
#include "support/analytic_field.h"

namespace gigaray::testing_support {

/// How far two workspaces are apart.
struct Difference {
  double largest = 0;
  long values = 0;
  long one_sided = 0;  ///< A value on one side, NaN or none on the other.
  long apart = 0;      ///< Beyond a tolerance, where few may be; see the test.

  void add(double a, double b) {
    ++values;
    if (std::isnan(a) != std::isnan(b))
      ++one_sided;
    else if (!std::isnan(a))
      largest = std::max(largest, std::abs(a - b));
  }
  void add(const Difference& other) {
    largest = std::max(largest, other.largest);
    values += other.values;
    one_sided += other.one_sided;
    apart += other.apart;
  }
};

/// The largest differences per sampler and stage over all tests of this process.
class ParityTable {
 public:
  static ParityTable& instance() {
    static ParityTable table;
    return table;
  }
  void add(const std::string& sampler, const std::string& stage, const Difference& difference) {
    rows_[{stage, sampler}].add(difference);
  }
  void print() const {
    std::printf("\n%-34s %-6s %12s %10s %8s\n", "stage: reference against OpenCL", "sampler",
                "largest", "values", "apart");
    for (const auto& [key, row] : rows_)
      std::printf("%-34s %-6s %12.3g %10ld %8ld\n", key.first.c_str(), key.second.c_str(),
                  row.largest, row.values, row.apart + row.one_sided);
  }

 private:
  std::map<std::pair<std::string, std::string>, Difference> rows_;
};

/// Sizes and encoding of a band that both workspaces work on.
struct ParityCase {
  int width, height;
  RowRange rows;  ///< what the steps work on; the band holds more where the picture has more
  BandEncoding encoding = BandEncoding::kBits8;
  int level = 0;
};

/// Odd sizes, just below, at and above multiples of the widest lanes, one row, bands in the middle.
inline const std::vector<ParityCase>& parity_cases() {
  static const std::vector<ParityCase> cases = {
      {7, 5, {0, 5}},
      {15, 11, {0, 11}, BandEncoding::kBits16},
      {16, 3, {0, 3}, BandEncoding::kFloat, 2},
      {17, 1, {0, 1}},
      {33, 24, {11, 12}, BandEncoding::kFloat, 1},
      {93, 31, {9, 16}, BandEncoding::kBits16},
      {144, 37, {29, 37}},
  };
  return cases;
}

template <class S>
struct ParityRig;
template <>
struct ParityRig<EpiSampler> {
  static constexpr const char* kName = "Epi";
  static constexpr LightFieldKind kKind = LightFieldKind::k3D;
  static std::vector<View> regular() { return row_of_views(9); }
  static std::vector<View> irregular() { return irregular_row(); }
  static HypothesisRange hypotheses() { return {-1.31, 1.73, 19}; }
  static EpiSampler sampler(const std::vector<View>& views, int, int) { return EpiSampler(views); }
};
template <>
struct ParityRig<GridSampler> {
  static constexpr const char* kName = "Grid";
  static constexpr LightFieldKind kKind = LightFieldKind::k4D;
  static std::vector<View> regular() { return grid_of_views(3, 3); }
  static std::vector<View> irregular() { return irregular_grid(); }
  static HypothesisRange hypotheses() { return {-1.31, 1.73, 19}; }
  static GridSampler sampler(const std::vector<View>& views, int, int) {
    return GridSampler(views);
  }
};
template <>
struct ParityRig<UnstructuredSampler> {
  static constexpr const char* kName = "Unstr";
  static constexpr LightFieldKind kKind = LightFieldKind::kUnstructured;
  static std::vector<View> regular() { return grid_of_views(3, 3); }
  static std::vector<View> irregular() { return irregular_grid(); }
  static HypothesisRange hypotheses() { return {0, 1, 19}; }
  static UnstructuredSampler sampler(const std::vector<View>& views, int width, int height) {
    return UnstructuredSampler(cameras_around(views, width, height));
  }
};

/// Both workspaces over one band of smooth, random and flat content, and maps to call them with.
template <RaySampler S>
class ParityBench {
 public:
  ParityBench(const ParityCase& size, DepthOptions options,
              const std::vector<View>& views = ParityRig<S>::irregular(),
              const HypothesisRange& hypotheses = ParityRig<S>::hypotheses(),
              const opencl::TuningOverrides& tuning = {})
      : size_(size),
        hypotheses_(hypotheses),
        sampler_(ParityRig<S>::sampler(views, size.width << size.level, size.height << size.level)),
        random_(size.width) {
    if (!S::kRaysShiftAlike) options.score.cubic = false;  // as prepared by reconstruct()
    const WorkspaceSetup setup{options, hypotheses_, ParityRig<S>::kKind,
                               size.encoding == BandEncoding::kBits16 ? 16 : 8};
    reference = std::make_unique<HostSteps>(make_reference_workspace(sampler_, setup));
    opencl = std::make_unique<HostSteps>(
        opencl::make_tuned_workspace(sampler_, setup, Device::open().opened(), tuning));
    // No window reaches farther.
    const int halo =
        std::max({kSlopeReach, kScanlineReach + options.support.radius, kSideColours}) + 3;
    loaded = rows_of_all(grown(size.rows, halo, size.height));
    fill(views);
    std::vector<int> active(sampler_.num_views());
    for (int i = 0; i < int(active.size()); ++i) active[i] = int(active.size()) - 1 - i;
    active.pop_back();  // one view keeps no estimates
    active_count = int(active.size());
    for (HostSteps* steps : {reference.get(), opencl.get()}) {
      steps->workspace().set_active_views(active);
      steps->begin_level({size.level, size.width, size.height});
      steps->load_band(loaded, all_views(sampler_.num_views()), encoded_, size.encoding);
    }
  }

  int width() const { return size_.width; }
  int height() const { return size_.height; }
  RowRange rows() const { return size_.rows; }
  /// The rows and `halo` more, clipped.
  RowRange around(int halo) const { return grown(size_.rows, halo, size_.height); }
  const HypothesisRange& hypotheses() const { return hypotheses_; }
  const S& sampler() const { return sampler_; }
  /// Rows that rays of `rows` of any view need.
  RowRange rows_of_all(RowRange rows) const {
    const S level = sampler_.at_level(size_.level);
    RowRange all = rows;
    for (int ref = 0; ref < level.num_views(); ++ref) {
      const RowRange needed = level.rows_needed(ref, rows, hypotheses_, size_.height);
      all = {std::min(all.begin, needed.begin), std::max(all.end, needed.end)};
    }
    return all;
  }
  double uniform() { return double(random_()) / 4294967296.0; }

  /// Most pixels; whole blocks are empty.
  StripMap<std::uint8_t> random_todo(RowRange rows) {
    StripMap<std::uint8_t> todo(width(), rows);
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < width(); ++u)
        todo.row(v)[u] = uniform() < 0.7 && !(u >= 32 && u < 64 && v % 3 == 0);
    return todo;
  }
  StripMap<std::uint8_t> all_todo(RowRange rows) {
    StripMap<std::uint8_t> todo(width(), rows);
    for (int v = rows.begin; v < rows.end; ++v) std::fill_n(todo.row(v), width(), 1);
    return todo;
  }
  StripMap<HypothesisBounds> full_bounds(RowRange rows) {
    StripMap<HypothesisBounds> bounds(width(), rows);
    for (int v = rows.begin; v < rows.end; ++v)
      std::fill_n(bounds.row(v), width(),
                  HypothesisBounds{0, std::uint16_t(hypotheses_.count - 1)});
    return bounds;
  }
  /// Half of the pixels search a part of the range.
  StripMap<HypothesisBounds> random_bounds(RowRange rows) {
    StripMap<HypothesisBounds> bounds = full_bounds(rows);
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < width(); ++u) {
        if (uniform() < 0.5) continue;
        const auto a = std::uint16_t(uniform() * hypotheses_.count);
        const auto b = std::uint16_t(uniform() * hypotheses_.count);
        bounds.row(v)[u] = {std::min(a, b), std::max(a, b)};
      }
    return bounds;
  }
  /// Hypotheses of the range, neighbours alike, with holes.
  StripMap<float> random_disparity(RowRange rows, double share) {
    StripMap<float> map(width(), rows);
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < width(); ++u)
        map.row(v)[u] =
            uniform() < share
                ? float(hypotheses_.min + uniform() * (hypotheses_.max - hypotheses_.min))
                : kNoEstimate;
    return map;
  }
  /// Estimates of a slanted surface with noise, outliers and holes.
  StripMap<float> slanted_disparity(RowRange rows) {
    StripMap<float> map(width(), rows);
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < width(); ++u) {
        map.row(v)[u] = float(0.01 * u - 0.02 * v + 0.05 * uniform() + (uniform() < 0.1 ? 1 : 0));
        if (uniform() < 0.2) map.row(v)[u] = kNoEstimate;
      }
    return map;
  }
  /// Two surfaces whose border runs down the picture in steps, with noise and holes.
  StripMap<float> stepped_disparity(RowRange rows) {
    const double low = hypotheses_.value(hypotheses_.count / 4),
                 high = hypotheses_.value(3 * hypotheses_.count / 4);
    StripMap<float> map(width(), rows);
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < width(); ++u) {
        const bool near = (u + v / 3) % 11 < 5;
        map.row(v)[u] = float((near ? high : low) + 0.02 * uniform());
        if (uniform() < 0.05) map.row(v)[u] = kNoEstimate;
      }
    return map;
  }
  StripMap<Slope> random_slopes(RowRange rows) {
    StripMap<Slope> map(width(), rows);
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < width(); ++u)
        map.row(v)[u] = {float(0.6 * (uniform() - 0.5)), float(0.6 * (uniform() - 0.5))};
    return map;
  }
  StripMap<float> random_values(RowRange rows) {
    StripMap<float> map(width(), rows);
    for (int v = rows.begin; v < rows.end; ++v)
      for (int u = 0; u < width(); ++u) map.row(v)[u] = float(uniform());
    return map;
  }

  std::unique_ptr<HostSteps> reference, opencl;
  RowRange loaded;
  int active_count = 0;

 private:
  void fill(const std::vector<View>& views) {
    const WavePattern pattern(5);
    const double most = size_.encoding == BandEncoding::kBits16 ? 65535 : 255;
    const std::size_t value_bytes = size_.encoding == BandEncoding::kBits8    ? 1
                                    : size_.encoding == BandEncoding::kBits16 ? 2
                                                                              : 4;
    const double scale = std::ldexp(1.0, size_.level);
    encoded_.resize(std::size_t(loaded.size()) * views.size() * 3 * width() * value_bytes);
    for (int v = loaded.begin; v < loaded.end; ++v)
      for (int view = 0; view < int(views.size()); ++view)
        for (int u = 0; u < width(); ++u)
          for (int c = 0; c < 3; ++c) {
            // A plane at disparity 0.6 with noise; stripes of it are random or flat.
            double value =
                pattern(u * scale + views[view].s * 0.6, v * scale + views[view].t * 0.6, c) +
                0.01 * (uniform() - 0.5);
            if (3 * u >= width() && 2 * u < width()) value = uniform();
            if (3 * u >= 2 * width() && 6 * u < 5 * width()) value = 0.25 * (c + 1);
            const std::size_t line =
                (std::size_t(v - loaded.begin) * views.size() + view) * 3 * width();
            const std::size_t interleaved = line + 3 * u + c;
            if (value_bytes == 1)
              encoded_[interleaved] = std::uint8_t(std::lround(value * most));
            else if (value_bytes == 2)
              reinterpret_cast<std::uint16_t*>(encoded_.data())[interleaved] =
                  std::uint16_t(std::lround(value * most));
            else
              reinterpret_cast<float*>(encoded_.data())[line + std::size_t(c) * width() + u] =
                  float(value);
          }
  }

  ParityCase size_;
  HypothesisRange hypotheses_;
  S sampler_;
  std::mt19937 random_;
  std::vector<std::uint8_t> encoded_;
};

inline Difference compare(const StripMap<float>& a, const StripMap<float>& b, RowRange rows) {
  Difference difference;
  for (int v = rows.begin; v < rows.end; ++v)
    for (int u = 0; u < a.width(); ++u) difference.add(a.row(v)[u], b.row(v)[u]);
  return difference;
}
inline Difference compare(const StripMap<Radiance>& a, const StripMap<Radiance>& b,
                          const StripMap<float>& where, RowRange rows) {
  Difference difference;
  for (int v = rows.begin; v < rows.end; ++v)
    for (int u = 0; u < a.width(); ++u) {
      if (std::isnan(where.row(v)[u])) continue;
      const Radiance &x = a.row(v)[u], &y = b.row(v)[u];
      difference.add(x.r, y.r);
      difference.add(x.g, y.g);
      difference.add(x.b, y.b);
    }
  return difference;
}
inline Difference compare(const StripMap<Slope>& a, const StripMap<Slope>& b, RowRange rows) {
  Difference difference;
  for (int v = rows.begin; v < rows.end; ++v)
    for (int u = 0; u < a.width(); ++u) {
      difference.add(a.row(v)[u].along_u, b.row(v)[u].along_u);
      difference.add(a.row(v)[u].along_v, b.row(v)[u].along_v);
    }
  return difference;
}
/// Means along the rays of view `ref` for random estimates, by both workspaces; `means` gets those
/// of the reference.
template <RaySampler S>
Difference compare_ray_means(ParityBench<S>& bench, int ref, RowRange rows,
                             StripMap<float>& means) {
  const int channels = bench.reference->channels();
  const auto disparity = bench.random_disparity(rows, 0.9);
  means = StripMap<float>(bench.width(), {channels * rows.begin, channels * rows.end});
  StripMap<float> actual = means;
  bench.reference->ray_mean(ref, rows, disparity, means);
  bench.opencl->ray_mean(ref, rows, disparity, actual);
  Difference difference;
  for (int v = rows.begin; v < rows.end; ++v)
    for (int c = 0; c < 3; ++c)
      for (int u = 0; u < bench.width(); ++u)
        difference.add(means.row(channels * v + c)[u], actual.row(channels * v + c)[u]);
  return difference;
}

/// What pixels of view `ref` say about the sides of jumps, and what is chosen by that, on both
/// workspaces. Few differ: where a place between two pixels is rounded to another one, or an answer
/// to the other side of the lead.
template <RaySampler S>
std::pair<Difference, Difference> compare_sides(ParityBench<S>& bench, int ref, double tolerance) {
  const RowRange rows = bench.rows(), around = bench.around(kSideColours);
  const auto disparity = bench.stepped_disparity(bench.around(kSideColours + kSideReach));
  const auto confidence = bench.random_values(around);
  const auto todo = bench.random_todo(around);
  const float jump = 2 * float(bench.hypotheses().step());
  StripMap<float> expected(bench.width(), around), actual = expected;
  bench.reference->side_evidence(ref, around, jump, todo, disparity, expected);
  bench.opencl->side_evidence(ref, around, jump, todo, disparity, actual);
  const auto differences = [&](const StripMap<float>& a, const StripMap<float>& b,
                               RowRange compared, Difference& difference) {
    for (int v = compared.begin; v < compared.end; ++v)
      for (int u = 0; u < bench.width(); ++u) {
        if (std::abs(a.row(v)[u] - b.row(v)[u]) > tolerance)
          ++difference.values, ++difference.apart;
        else
          difference.add(a.row(v)[u], b.row(v)[u]);
      }
  };
  Difference evidence, choice;
  differences(expected, actual, around, evidence);
  StripMap<float> chosen(bench.width(), rows), chosen_confidence = chosen, other = chosen,
                                               other_confidence = chosen;
  bench.reference->choose_sides(ref, rows, jump, disparity, confidence, expected, chosen,
                                chosen_confidence);
  bench.opencl->choose_sides(ref, rows, jump, disparity, confidence, expected, other,
                             other_confidence);
  differences(chosen, other, rows, choice);
  differences(chosen_confidence, other_confidence, rows, choice);
  return {evidence, choice};
}

/// What is hidden from the views that `ref` is compared with, what is guessed and what it is filled
/// with, on both workspaces.
template <RaySampler S>
std::array<Difference, 3> compare_hidden(ParityBench<S>& bench, int ref) {
  const RowRange rows = bench.rows(), around = bench.around(kSpeckReach);
  const auto disparity = bench.stepped_disparity(bench.around(kSpeckReach + kHiddenReach));
  const auto confidence = bench.random_values(bench.around(kSpeckReach + kHiddenReach));
  const auto todo = bench.random_todo(around);
  const float apart = 1.3f * float(bench.hypotheses().step());
  StripMap<std::uint8_t> hidden(bench.width(), around), other_hidden = hidden;
  bench.reference->find_hidden(ref, around, apart, todo, disparity, confidence, hidden);
  bench.opencl->find_hidden(ref, around, apart, todo, disparity, confidence, other_hidden);
  StripMap<std::uint8_t> guessed(bench.width(), rows), other_guessed = guessed;
  bench.reference->find_specks(rows, apart, todo, disparity, hidden, guessed);
  bench.opencl->find_specks(rows, apart, todo, disparity, hidden, other_guessed);
  StripMap<float> filled = disparity, other_filled = disparity, sure = confidence,
                  other_sure = confidence;
  bench.reference->fill_hidden(rows, apart, guessed, filled, sure);
  bench.opencl->fill_hidden(rows, apart, guessed, other_filled, other_sure);
  std::array<Difference, 3> differences;
  const auto flags = [&](const StripMap<std::uint8_t>& a, const StripMap<std::uint8_t>& b,
                         RowRange compared, Difference& difference) {
    for (int v = compared.begin; v < compared.end; ++v)
      for (int u = 0; u < bench.width(); ++u) {
        ++difference.values;
        difference.apart += a.row(v)[u] != b.row(v)[u];
      }
  };
  flags(hidden, other_hidden, around, differences[0]);
  flags(guessed, other_guessed, rows, differences[1]);
  for (int v = rows.begin; v < rows.end; ++v)
    for (int u = 0; u < bench.width(); ++u) {
      differences[2].add(filled.row(v)[u], other_filled.row(v)[u]);
      differences[2].add(sure.row(v)[u], other_sure.row(v)[u]);
    }
  return differences;
}

/// Scores of all pixels to do, those beyond their bounds too. `unstable`: larger differences are
/// counted.
template <RaySampler S>
Difference compare_scores(ParityBench<S>& bench, RowRange rows, const StripMap<std::uint8_t>& todo,
                          double unstable) {
  Difference difference;
  for (int v = rows.begin; v < rows.end; ++v)
    // Scores are fetched one by one: of wide pictures every third pixel, which meets every lane.
    for (int u = 0; u<bench.width(); u += bench.width()> 64 ? 3 : 1) {
      if (!todo.row(v)[u]) continue;
      const auto expected = bench.reference->scores_at(u, v);
      const auto actual = bench.opencl->scores_at(u, v);
      for (std::size_t i = 0; i < expected.size(); ++i) {
        const bool untested = expected[i] < 0;
        if (untested != (actual[i] < 0))
          ++difference.one_sided;
        else if (std::abs(expected[i] - actual[i]) > unstable)
          ++difference.apart, ++difference.values;
        else
          difference.add(expected[i], actual[i]);
      }
    }
  return difference;
}

}  // namespace gigaray::testing_support
