// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// The plain loops that the kernels are checked against, on input whose answer is known.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "gigaray/samplers/any_sampler.h"
#include "reference/bilateral_median.h"
#include "reference/density_score.h"
#include "reference/downsample.h"
#include "reference/edge_confidence.h"
#include "reference/propagation.h"
#include "reference/robust_score.h"
#include "reference/scanline.h"
#include "reference/score_support.h"
#include "reference/slope_fit.h"
#include "reference/unpack_channels.h"
#include "reference/winner.h"
#include "src/make_workspace.h"
#include "support/analytic_field.h"

namespace gigaray::testing_support {
namespace {

using reference::Band;
using reference::Scores;

constexpr float kRounding = 1e-6f;
constexpr float kStep = 0.035f;  // between hypotheses

/// A band of all rows with value(view, u, v, c) everywhere.
template <class Value>
Band band_of(int width, int height, int views, int channels, Value value) {
  Band band{{0, width, height}, {0, height}, views, channels, {}};
  band.data.resize(std::size_t(width) * height * views * channels);
  for (int v = 0; v < height; ++v)
    for (int view = 0; view < views; ++view)
      for (int c = 0; c < channels; ++c)
        for (int u = 0; u < width; ++u) band.plane(view, v, c)[u] = float(value(view, u, v, c));
  return band;
}

/// A plane at a disparity, linear colours.
Band plane_band(const std::vector<View>& views, double disparity, int width, int height) {
  const WavePattern pattern(4);
  return band_of(width, height, int(views.size()), 3, [&](int view, int u, int v, int c) {
    return pattern(u + views[view].s * disparity, v + views[view].t * disparity, c);
  });
}

ScoreOptions paper_score() { return paper_options().score; }

TEST(ReferenceScore, PeaksAtTheTrueDisparity) {
  const HypothesisRange hypotheses{-1, 2, 61};
  for (const auto& views : {irregular_row(), irregular_grid()}) {
    const Band band = plane_band(views, 0.65, 93, 31);
    const GridSampler sampler(views);
    for (const int u : {20, 46, 70}) {
      int best = 0;
      std::vector<float> scores;
      for (int i = 0; i < hypotheses.count; ++i) {
        const Ray ray{double(u), 15, hypotheses.value(i)};
        scores.push_back(reference::density_score(band, sampler, 3, ray, paper_score()));
        if (scores[i] > scores[best]) best = i;
        EXPECT_LE(scores[i], 1 + kRounding);
      }
      EXPECT_NEAR(hypotheses.value(best), 0.65, hypotheses.step());
      EXPECT_GT(scores[best], 0.9f);
    }
  }
}

TEST(ReferenceScore, IsOneWhereAllViewsSeeTheSame) {
  const auto views = row_of_views(5);
  const Band flat = band_of(31, 3, 5, 5, [](int, int, int, int c) { return c < 3 ? 0.4 : 0.0; });
  const EpiSampler sampler(views);
  for (const double h : {-1.0, 0.0, 0.77}) {
    EXPECT_NEAR(reference::density_score(flat, sampler, 2, {15, 1, h}, paper_score()), 1,
                kRounding);
    EXPECT_NEAR(reference::robust_score(flat, sampler, 2, {15, 1, h}, flat.pixel(2, 15, 1),
                                        auto_options().score, std::vector<std::uint8_t>(5, 1), 1),
                1, kRounding);
  }
}

TEST(ReferenceScore, ViewsThatDontSeeThePointAreLeftOut) {
  const auto views = row_of_views(5);  // s = -2 … 2
  const Band flat = band_of(31, 3, 5, 3, [](int, int, int, int) { return 0.4; });
  const EpiSampler sampler(views);
  ScoreOptions score = paper_score();
  // At the left edge with d = 1 the two views to the right don't see the point: 3 of 5 are left.
  score.min_views = 0.6f;
  EXPECT_NEAR(reference::density_score(flat, sampler, 2, {0, 1, 1}, score), 1, kRounding);
  score.min_views = 0.61f;
  EXPECT_EQ(reference::density_score(flat, sampler, 2, {0, 1, 1}, score), -1);
  score.min_views = 0;
  score.floor_views = 1;
  EXPECT_NEAR(reference::density_score(flat, sampler, 2, {0, 1, 1}, score), 0.6, kRounding);
}

TEST(ReferenceScore, MeanShiftFindsTheColourMostViewsAgreeOn) {
  // Four views agree on 0.5, the reference view is off by noise of half the bandwidth.
  std::vector<reference::Sample> samples(4, {0.5f, 0.5f, 0.5f});
  const reference::Sample own{0.51f, 0.5f, 0.5f};
  samples.push_back(own);
  ScoreOptions score = paper_score();
  const auto start = reference::mean_shift(samples, own, score, 0);
  EXPECT_EQ(start[0], 0.51f);
  const auto one = reference::mean_shift(samples, own, score, 1);
  // Kernel of the four: 1 - (0.5)^2 = 0.75, of its own: 1.
  EXPECT_NEAR(one[0], (4 * 0.75 * 0.5 + 0.51) / (4 * 0.75 + 1), kRounding);
  EXPECT_LT(std::abs(reference::mean_shift(samples, own, score, 10)[0] - 0.502f), 1e-3f);
}

TEST(ReferenceEdges, AStepCountsWhatLiesOnItsOtherSide) {
  const Band step = band_of(31, 9, 1, 3, [](int, int u, int, int) { return u < 15 ? 0.2 : 0.5; });
  const double squared = 3 * 0.3 * 0.3, plain = std::sqrt(squared);
  for (const bool both_axes : {false, true}) {
    StripMap<float> edges(31, step.rows);
    reference::edge_confidence(step, 0, step.rows, {4, true, 0, false}, both_axes, edges);
    EXPECT_EQ(edges.row(4)[10], 0);
    EXPECT_NEAR(edges.row(4)[11], squared, kRounding);
    EXPECT_NEAR(edges.row(4)[14], 4 * squared, kRounding);
    EXPECT_NEAR(edges.row(4)[15], 4 * squared, kRounding);
    EXPECT_EQ(edges.row(4)[19], 0);
    EXPECT_EQ(edges.row(4)[0], 0);
    reference::edge_confidence(step, 0, step.rows, {4, false, 0, false}, both_axes, edges);
    EXPECT_NEAR(edges.row(4)[14], 4 * plain, kRounding);
  }
}

TEST(ReferenceEdges, AStepAlongVCountsWithBothAxesOnly) {
  const Band step = band_of(15, 21, 1, 3, [](int, int, int v, int) { return v < 10 ? 0.2 : 0.5; });
  StripMap<float> edges(15, step.rows);
  reference::edge_confidence(step, 0, step.rows, {2, true, 0, false}, false, edges);
  EXPECT_EQ(edges.row(9)[7], 0);
  reference::edge_confidence(step, 0, step.rows, {2, true, 0, false}, true, edges);
  EXPECT_NEAR(edges.row(9)[7], 2 * 3 * 0.3 * 0.3, kRounding);
}

TEST(ReferenceUnpack, GradientsOfARampAreItsSlope) {
  const int width = 17, height = 9;
  std::vector<float> encoded(std::size_t(width) * height * 3);
  for (int v = 0; v < height; ++v)
    for (int c = 0; c < 3; ++c)
      for (int u = 0; u < width; ++u)
        encoded[(std::size_t(v) * 3 + c) * width + u] = 0.01f * float(u) - 0.02f * float(v) + 0.5f;
  Band band = band_of(width, height, 1, 5, [](int, int, int, int) { return 0; });
  reference::unpack_channels(encoded.data(), BandEncoding::kFloat, {}, band);
  EXPECT_NEAR(band.pixel(0, 8, 4)[3], 0.01, kRounding);
  EXPECT_NEAR(band.pixel(0, 8, 4)[4], -0.02, kRounding);
  EXPECT_NEAR(band.pixel(0, 0, 4)[3], 0.005, kRounding)
      << "the edge pixel stands in for its neighbour";
  EXPECT_NEAR(band.pixel(0, 8, height - 1)[4], -0.01, kRounding);
}

TEST(ReferenceUnpack, TablesTurnIntegersIntoColours) {
  for (const int bits : {8, 16}) {
    const auto linear = colour_table(bits, true), encoded = colour_table(bits, false);
    EXPECT_EQ(linear.size(), std::size_t(1) << bits);
    for (const auto& table : {linear, encoded}) {
      EXPECT_EQ(table.front(), 0);
      EXPECT_EQ(table.back(), 1);
      EXPECT_TRUE(std::is_sorted(table.begin(), table.end()));
    }
    // Half the code is 21.4 % of the light.
    EXPECT_NEAR(linear[linear.size() / 2], 0.214, 3e-3);
    EXPECT_NEAR(encoded[encoded.size() / 2], 0.5, 3e-3);
  }
}

struct WinnerRow {
  HypothesisRange hypotheses{1, 2, 11};
  Scores scores{{0, 1}, 11, 1};
  StripMap<std::uint8_t> todo{1, {0, 1}};
  StripMap<HypothesisBounds> bounds{1, {0, 1}};
  StripMap<float> disparity{1, {0, 1}}, contrast{1, {0, 1}};

  explicit WinnerRow(std::vector<float> values) {
    std::copy(values.begin(), values.end(), scores.data.begin());
    todo.row(0)[0] = 1;
    bounds.row(0)[0] = {0, 10};
  }
  float find(bool refine) {
    WinnerOptions options;
    options.refine = refine;
    return find(options);
  }
  float find(const WinnerOptions& options) {
    reference::winner({0, 1}, scores, scores, 0, hypotheses, options, todo, bounds, disparity,
                      contrast);
    return disparity.row(0)[0];
  }
};

TEST(ReferenceWinner, TakesTheBestAndComparesWithTheMean) {
  WinnerRow row({0, 0, 0.5f, 0, 0, 0, 0, 0.6f, 0, 0, 0});
  EXPECT_NEAR(row.find(false), 1.7, kRounding);
  EXPECT_NEAR(row.contrast.row(0)[0], 0.6 - 1.1 / 11, kRounding);
}

TEST(ReferenceWinner, AWidePeakCountsLessAndAVeryWideOneNothing) {
  WinnerOptions options;
  options.peak_share = 0.3f;
  options.peak_width = 2;
  options.widest_peak = 4;
  WinnerRow narrow({0, 0, 0, 0.8f, 0.9f, 0, 0, 0, 0, 0, 0});
  narrow.find(options);
  EXPECT_NEAR(narrow.contrast.row(0)[0], 0.9 - 1.7 / 11, kRounding);
  WinnerRow wide({0, 0, 0, 0.8f, 0.9f, 0.8f, 0.8f, 0, 0, 0, 0});
  EXPECT_NEAR(wide.find(options), 1.4, kRounding);
  EXPECT_NEAR(wide.contrast.row(0)[0], (0.9 - 3.3 / 11) * 2 / 4, kRounding);
  WinnerRow plateau({0, 0, 0, 0.8f, 0.9f, 0.8f, 0.8f, 0.8f, 0, 0, 0});
  plateau.find(options);
  EXPECT_EQ(plateau.contrast.row(0)[0], 0);
}

TEST(ReferenceWinner, OfEqualScoresTheFartherWins) {
  WinnerRow row({0, 0.5f, 0, 0, 0.5f, 0.5f, 0, 0, 0, 0, 0});
  EXPECT_NEAR(row.find(false), 1.1, kRounding);
}

TEST(ReferenceWinner, UntestedHypothesesDontCount) {
  WinnerRow row({-1, -1, -1, 0.2f, 0.4f, -1, -1, -1, -1, -1, -1});
  EXPECT_NEAR(row.find(true), 1.4, kRounding) << "no parabola beside an untested one";
  EXPECT_NEAR(row.contrast.row(0)[0], 0.4 - 0.3, kRounding);
  WinnerRow none(std::vector<float>(11, -1));
  EXPECT_TRUE(std::isnan(none.find(false)));
  EXPECT_EQ(none.contrast.row(0)[0], 0);
}

TEST(ReferenceWinner, BoundsLimitTheSearch) {
  WinnerRow row({0.9f, 0, 0, 0.2f, 0.4f, 0.1f, 0, 0, 0, 0, 0.8f});
  row.bounds.row(0)[0] = {2, 6};
  EXPECT_NEAR(row.find(false), 1.4, kRounding);
  row.todo.row(0)[0] = 0;
  EXPECT_TRUE(std::isnan(row.find(false)));
}

TEST(ReferenceWinner, RefinementFindsTheVertexOfAParabola) {
  for (const double vertex : {0.37, 0.52, 0.641}) {
    std::vector<float> values;
    for (int i = 0; i < 11; ++i) values.push_back(float(0.9 - std::pow(i / 10.0 - vertex, 2)));
    EXPECT_NEAR(WinnerRow(values).find(true), 1 + vertex, 1e-4);
  }
  // At the end of the range there is nothing to fit.
  std::vector<float> rising;
  for (int i = 0; i < 11; ++i) rising.push_back(0.05f * float(i));
  EXPECT_NEAR(WinnerRow(rising).find(true), 2, kRounding);
}

StripMap<float> strip_of(const std::vector<std::vector<float>>& rows) {
  StripMap<float> map(int(rows[0].size()), {0, int(rows.size())});
  for (int v = 0; v < int(rows.size()); ++v) std::copy(rows[v].begin(), rows[v].end(), map.row(v));
  return map;
}

TEST(ReferenceMedian, OfAnEvenNumberTakesTheLowerMiddle) {
  const float none = kNoEstimate;
  const Band band = band_of(3, 1, 1, 3, [](int, int, int, int) { return 0.5; });
  const auto in = strip_of({{4, 1, none}});
  StripMap<float> out(3, {0, 1});
  reference::bilateral_median(band, 0, {0, 1}, 1, 0.1f, in, out);
  EXPECT_EQ(out.row(0)[0], 1);
  EXPECT_EQ(out.row(0)[1], 1);
  EXPECT_TRUE(std::isnan(out.row(0)[2])) << "a median fills no hole";
}

TEST(ReferenceMedian, PixelsOfAnotherColourDontCount) {
  const Band band = band_of(5, 1, 1, 3, [](int, int u, int, int) { return u == 2 ? 0.2 : 0.8; });
  const auto in = strip_of({{7, 7, 1, 7, 7}});
  StripMap<float> out(5, {0, 1});
  reference::bilateral_median(band, 0, {0, 1}, 2, 0.1f, in, out);
  EXPECT_EQ(out.row(0)[2], 1);
  reference::bilateral_median(band, 0, {0, 1}, 2, std::numeric_limits<float>::infinity(), in, out);
  EXPECT_EQ(out.row(0)[2], 7);
}

TEST(ReferenceSupport, NeighboursOfTheSameColourDecide) {
  // A pixel that scores 1 among eight of its colour that score 0.2, and a column of another colour.
  const Band band = band_of(5, 3, 1, 3, [](int, int u, int, int) { return u == 4 ? 0.0 : 0.5; });
  Scores scores({0, 3}, 1, 5);
  for (int v = 0; v < 3; ++v)
    for (int u = 0; u < 5; ++u) scores.at(u, v, 0) = u == 4 ? 0.9f : 0.2f;
  scores.at(2, 1, 0) = 1;
  StripMap<std::uint8_t> todo(5, {0, 3});
  StripMap<HypothesisBounds> bounds(5, {0, 3});
  for (int u = 0; u < 5; ++u) todo.row(1)[u] = 1;
  const Scores supported =
      reference::score_support(band, 0, {1, 2}, {1, 0.03f, 1e6f}, todo, bounds, scores);
  EXPECT_NEAR(supported.at(2, 1, 0), (8 * 0.2 + 1) / 9, 1e-5);
  EXPECT_NEAR(supported.at(3, 1, 0), (5 * 0.2 + 1) / 6, 1e-5)
      << "its neighbours at the right don't count";
  EXPECT_NEAR(supported.at(4, 1, 0), 0.9, 1e-5);
}

TEST(ReferenceSupport, AlongTheSlopeASlantedSurfaceKeepsItsPeak) {
  // Hypothesis i scores 1 - |i - u| / 8: the surface rises by a hypothesis per pixel.
  const Band flat = band_of(15, 1, 1, 3, [](int, int, int, int) { return 0.5; });
  const HypothesisRange hypotheses{0, 7, 15};  // steps of 0.5
  Scores scores({0, 1}, 15, 15);
  for (int u = 0; u < 15; ++u)
    for (int i = 0; i < 15; ++i) scores.at(u, 0, i) = 1 - std::abs(i - u) / 8.0f;
  StripMap<std::uint8_t> todo(15, {0, 1});
  StripMap<HypothesisBounds> bounds(15, {0, 1});
  StripMap<Slope> slopes(15, {0, 1});
  todo.row(0)[7] = 1;
  bounds.row(0)[7] = {0, 14};
  slopes.row(0)[7] = {0.5f, 0};
  const SupportOptions support{3, 0.03f, 1e6f};
  const Scores plain = reference::score_support(flat, 0, {0, 1}, support, todo, bounds, scores);
  const Scores slanted = reference::slanted_support(flat, 0, {0, 1}, support, hypotheses, todo,
                                                    bounds, slopes, scores);
  EXPECT_NEAR(slanted.at(7, 0, 7), 1, 1e-5);
  EXPECT_NEAR(plain.at(7, 0, 7), 1 - 12.0 / 7 / 8, 1e-5);
}

/// A mask of all pixels.
StripMap<std::uint8_t> all_of(const StripMap<float>& map) {
  StripMap<std::uint8_t> mask(map.width(), map.rows());
  for (int v = map.rows().begin; v < map.rows().end; ++v) std::fill_n(mask.row(v), map.width(), 1);
  return mask;
}

TEST(ReferenceSlopes, OfAPlaneAreFoundDespiteHolesAndOutliers) {
  const Band flat = band_of(61, 41, 1, 3, [](int, int, int, int) { return 0.5; });
  StripMap<float> in(61, {0, 41});
  for (int v = 0; v < 41; ++v)
    for (int u = 0; u < 61; ++u) {
      in.row(v)[u] = 0.013f * float(u) - 0.007f * float(v);
      if ((u + 2 * v) % 7 == 0) in.row(v)[u] = kNoEstimate;
      if ((u + v) % 11 == 0) in.row(v)[u] += 3;
    }
  StripMap<Slope> slopes(61, {0, 41});
  reference::slope_fit(flat, 0, {0, 41}, kStep, 0.3f, all_of(in).view(), in.view(), slopes);
  EXPECT_NEAR(slopes.row(20)[31].along_u, 0.013, 5e-4);
  EXPECT_NEAR(slopes.row(20)[31].along_v, -0.007, 5e-4);
  reference::slope_fit(flat, 0, {20, 21}, kStep, 0.005f, all_of(in).view(), in.view(), slopes);
  EXPECT_EQ(slopes.row(20)[31].along_u, 0.005f) << "no steeper than allowed";
}

TEST(ReferenceSlopes, NothingIsSaidWithoutAnEstimate) {
  const Band flat = band_of(31, 31, 1, 3, [](int, int, int, int) { return 0.5; });
  StripMap<float> in(31, {0, 31});
  for (int v = 0; v < 31; ++v)
    for (int u = 0; u < 31; ++u) in.row(v)[u] = u == 15 ? kNoEstimate : 0.01f * float(u);
  StripMap<Slope> slopes(31, {0, 31});
  reference::slope_fit(flat, 0, {0, 31}, kStep, 0.3f, all_of(in).view(), in.view(), slopes);
  EXPECT_EQ(slopes.row(15)[15].along_u, 0);
  EXPECT_GT(slopes.row(15)[16].along_u, 0.009f);
}

TEST(ReferenceDownsample, KeepsConstantsAndPutsPixelIOnPixel2I) {
  const Band flat = band_of(13, 9, 2, 3, [](int, int, int, int c) { return 0.2 + 0.1 * c; });
  std::vector<float> small(std::size_t(5) * 2 * 3 * 7);
  reference::downsample(flat, {0, 5}, small.data());
  for (std::size_t i = 0; i < small.size(); ++i)
    EXPECT_NEAR(small[i], 0.2 + 0.1 * double(i / 7 % 3), kRounding);
  const Band ramp =
      band_of(21, 15, 1, 3, [](int, int u, int v, int) { return 0.01 * u + 0.03 * v; });
  small.resize(std::size_t(8) * 3 * 11);
  reference::downsample(ramp, {0, 8}, small.data());
  // Symmetric weights keep a ramp where the window is whole.
  EXPECT_NEAR(small[(3 * 3 + 0) * 11 + 4], 0.01 * 8 + 0.03 * 6, kRounding);
}

/// Propagates one row of estimates of view 0 into all views; nothing is there before.
struct Rays {
  int width;
  std::vector<View> views;
  StripMap<float> disparity, confidence;
  StripMap<Radiance> radiance;
  std::vector<PackedEstimate> estimates;
  bool are_finished = false;

  Rays(int width, std::vector<View> views)
      : width(width),
        views(std::move(views)),
        disparity(width, {0, 1}),
        confidence(width, {0, 1}),
        radiance(width, {0, 1}) {
    std::fill_n(disparity.row(0), width, kNoEstimate);
    estimates.resize(this->views.size() * width);
  }
  void propagate(const Band& band) {
    std::vector<int> active(views.size());
    for (int i = 0; i < int(active.size()); ++i) active[i] = i;
    const EpiSampler sampler(views);
    const int finished = are_finished ? int(views.size()) : 0;
    std::vector<float> bars(estimates.size());
    const reference::StoredRows<float> all_bars{bars.data(), 0, int(views.size()), width};
    const reference::StoredRows<PackedEstimate> all{estimates.data(), 0, int(views.size()), width};
    reference::set_bars(sampler, 0, {0, 1}, active, disparity.view(), 1, {0, 1}, finished, 2, all,
                        all_bars);
    reference::propagation(band, sampler, 0, {0, 1}, active, PropagationOptions{}, disparity.view(),
                           confidence.view(), radiance.view(), {0, 1}, finished, all_bars, all);
  }
  PackedEstimate at(int view, int u) const { return estimates[std::size_t(view) * width + u]; }
};

TEST(ReferencePropagation, TheNearerStaysThenTheMoreConfident) {
  const Band flat = band_of(21, 1, 2, 3, [](int, int, int, int) { return 0.5; });
  Rays rays(21, {{"a", 0, 0}, {"b", 1, 0}});
  std::fill_n(rays.radiance.row(0), 21, Radiance{0.5f, 0.5f, 0.5f});
  // Three rays of view a meet at pixel 5 of view b.
  rays.disparity.row(0)[6] = 1;
  rays.confidence.row(0)[6] = 0.9f;
  rays.disparity.row(0)[8] = 3;
  rays.confidence.row(0)[8] = 0.1f;
  rays.disparity.row(0)[5] = 0;
  rays.confidence.row(0)[5] = 0.99f;
  rays.propagate(flat);
  EXPECT_EQ(hypothesis_of(rays.at(1, 5)), 3);
  EXPECT_EQ(confidence_of(rays.at(1, 5)), 0.1f);
  // In its own view every ray stays where it is.
  EXPECT_EQ(hypothesis_of(rays.at(0, 6)), 1);
  EXPECT_EQ(hypothesis_of(rays.at(0, 5)), 0);
  // The same disparity: the higher confidence stays, in any order.
  rays.confidence.row(0)[8] = 0.4f;
  rays.propagate(flat);
  EXPECT_EQ(confidence_of(rays.at(1, 5)), 0.4f);
  rays.confidence.row(0)[8] = 0.2f;
  rays.propagate(flat);
  EXPECT_EQ(confidence_of(rays.at(1, 5)), 0.4f);
}

TEST(ReferencePropagation, AFinishedViewGivesUpForWhatIsNearerAndLeads) {
  const Band flat = band_of(21, 1, 2, 3, [](int, int, int, int) { return 0.5; });
  Rays rays(21, {{"a", 0, 0}, {"b", 1, 0}});
  std::fill_n(rays.radiance.row(0), 21, Radiance{0.5f, 0.5f, 0.5f});
  const auto arrive = [&](float disparity, float confidence) {
    std::fill_n(rays.disparity.row(0), 21, kNoEstimate);
    rays.disparity.row(0)[5 + int(disparity)] = disparity;
    rays.confidence.row(0)[5 + int(disparity)] = confidence;
    rays.propagate(flat);
    return hypothesis_of(rays.at(1, 5));
  };
  rays.are_finished = true;
  EXPECT_EQ(arrive(1, 0.2f), 1);  // nothing was there
  EXPECT_EQ(arrive(3, 0.4f), 1);  // nearer, but not more than twice as confident
  EXPECT_EQ(arrive(0, 0.9f), 1);  // confident, but farther
  EXPECT_EQ(arrive(3, 0.5f), 3);
  // An estimate without confidence stays before another one without.
  rays.estimates.assign(rays.estimates.size(), pack_estimate(1, 0));
  EXPECT_EQ(arrive(3, 0), 1);
}

TEST(ReferencePropagation, WhatArrivesTogetherIsHeldAgainstWhatWasThereBefore) {
  const Band flat = band_of(21, 1, 2, 3, [](int, int, int, int) { return 0.5; });
  Rays rays(21, {{"a", 0, 0}, {"b", 1, 0}});
  std::fill_n(rays.radiance.row(0), 21, Radiance{0.5f, 0.5f, 0.5f});
  rays.are_finished = true;
  rays.estimates[21 + 5] = pack_estimate(1, 0.1f);
  // Both lead over what was there; the nearer of them stays though it does not lead over the other.
  rays.disparity.row(0)[7] = 2;
  rays.confidence.row(0)[7] = 0.3f;
  rays.disparity.row(0)[8] = 3;
  rays.confidence.row(0)[8] = 0.3f;
  rays.propagate(flat);
  EXPECT_EQ(hypothesis_of(rays.at(1, 5)), 3);
}

TEST(ReferencePropagation, AnOccluderIsSkippedAndTheWalkGoesOn) {
  // View b sees something else there, view c behind it sees the point again.
  const Band band =
      band_of(21, 1, 3, 3, [](int view, int, int, int) { return view == 1 ? 0.9 : 0.5; });
  Rays rays(21, {{"a", 0, 0}, {"b", 1, 0}, {"c", 2, 0}});
  rays.radiance.row(0)[10] = {0.5f, 0.5f, 0.5f};
  rays.disparity.row(0)[10] = 2;
  rays.propagate(band);
  EXPECT_EQ(rays.at(1, 8), 0u);
  EXPECT_EQ(hypothesis_of(rays.at(2, 6)), 2);
  long set = 0;
  for (const PackedEstimate estimate : rays.estimates) set += estimate != 0;
  EXPECT_EQ(set, 2) << "the own pixel and the one in c";
}

TEST(ReferencePropagation, RaysThatLeaveThePictureAreDropped) {
  const Band flat = band_of(21, 1, 2, 3, [](int, int, int, int) { return 0.5; });
  Rays rays(21, {{"a", 0, 0}, {"b", 1, 0}});
  std::fill_n(rays.radiance.row(0), 21, Radiance{0.5f, 0.5f, 0.5f});
  rays.disparity.row(0)[1] = 3;
  rays.disparity.row(0)[19] = -3;
  rays.propagate(flat);
  for (int u = 0; u < 21; ++u) EXPECT_EQ(rays.at(1, u), 0u) << u;
}

}  // namespace
}  // namespace gigaray::testing_support
