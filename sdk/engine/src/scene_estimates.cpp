// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/scene_estimates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gigaray/samplers/any_sampler.h"
#include "reference/density_score.h"
#include "reference/downsample.h"
#include "reference/edge_confidence.h"
#include "reference/unpack_channels.h"

namespace gigaray {
namespace {

using reference::Band;
using reference::Sample;

/// A few views of a light field as a light field of its own.
LightField subset(const LightField& light_field, const std::vector<int>& views) {
  class Subset : public PixelSource {
   public:
    Subset(std::shared_ptr<const PixelSource> all, std::vector<int> views)
        : all_(std::move(all)), views_(std::move(views)) {}
    Image<std::uint16_t> read(int view_idx) const override {
      return all_->read(views_.at(view_idx));
    }
    int bit_depth() const override { return all_->bit_depth(); }
    bool has_mask() const override { return all_->has_mask(); }

   private:
    std::shared_ptr<const PixelSource> all_;
    std::vector<int> views_;
  };
  LightField some = light_field;
  some.views.clear();
  some.cameras.clear();
  for (const int view : views) {
    some.views.push_back(light_field.views[view]);
    if (!light_field.cameras.empty()) some.cameras.push_back(light_field.cameras[view]);
  }
  some.pixels = std::make_shared<Subset>(light_field.pixels, views);
  return some;
}

/// A view as a band of its own, encoded RGB (and gradients), all rows.
Band view_band(const LightField& light_field, int view, int channels) {
  Image<std::uint16_t> picture = read_view(light_field, view);
  const auto mask = take_mask(picture);
  Band band{{0, picture.width(), picture.height()}, {0, picture.height()}, 1, channels, {}};
  band.data.resize(picture.size() / 3 * channels);
  std::vector<float> table(std::size_t(1) << light_field.pixels->bit_depth());
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = float(i) / float(table.size() - 1);
  // Values above 8 bits or not: the decoder always gives 16-bit integers.
  reference::unpack_channels(picture.data(), BandEncoding::kBits16, table, band);
  if (mask) reference::mask_pixels(mask->data(), band);
  return band;
}

/// Copies some rows of a view's own band to its place in a band of all views.
void place(const Band& view_rows, int view, Band& band) {
  for (int v = band.rows.begin; v < band.rows.end; ++v)
    for (int c = 0; c < band.channels; ++c)
      std::copy_n(view_rows.plane(0, v, c), band.shape.width, band.plane(view, v, c));
}

ScoreOptions colour_score(float bandwidth) {
  ScoreOptions score;
  score.gradient = true;
  score.gradient_share = 0;  // the triangle kernel of colour alone
  score.bandwidth = bandwidth;
  score.min_views = 0.6f;
  score.mean_shift_iterations = 0;
  return score;
}

struct PixelMatch {
  int u = 0, v = 0;  // px of the small pictures
  float disparity = 0;
  float score = 0;
  float lead = 0;  ///< over the best hypothesis elsewhere
};

constexpr int kSmallWidth = 320;  // px; the search runs on pictures no wider than this
constexpr int kMostViews = 9;     // around the centre
constexpr int kMostPixels = 3000;
/// More is the border of a mask.
constexpr float kMostEdge = 100;
constexpr float kReliableScore = 0.6f, kReliableLead = 0.15f;

/// The views of the line or square around the centre that the search looks at.
std::vector<int> central_views(const LightField& light_field, int count) {
  std::vector<int> views = views_from_centre(light_field);
  views.resize(std::min<std::size_t>(views.size(), count));
  return views;
}

Band small_band(const LightField& views) {
  Band all;
  for (int view = 0; view < views.num_views(); ++view) {
    Band one = view_band(views, view, 3);
    while (one.shape.width > kSmallWidth && std::min(one.shape.width, one.shape.height) > 32) {
      Band next{{one.shape.level + 1, (one.shape.width + 1) / 2, (one.shape.height + 1) / 2},
                {0, (one.shape.height + 1) / 2},
                1,
                3,
                {}};
      next.data.resize(std::size_t(next.shape.width) * next.shape.height * 3);
      reference::downsample(one, next.rows, next.data.data());
      one = std::move(next);
    }
    if (view == 0) {
      all = Band{one.shape, one.rows, views.num_views(), 3, {}};
      all.data.resize(one.data.size() * views.num_views());
    }
    place(one, view, all);
  }
  return all;
}

/// The best hypothesis of the pixels with the strongest edges of view 0 of a band.
template <RaySampler S>
std::vector<PixelMatch> match_edges(const Band& band, const S& level0_sampler, bool is_4d,
                                    const HypothesisRange& range, const RunControl& control,
                                    int most_pixels = kMostPixels) {
  const S sampler = level0_sampler.at_level(band.shape.level);
  StripMap<float> edges(band.shape.width, band.rows);
  reference::edge_confidence(band, 0, band.rows, EdgeOptions{2, false, 0, false}, is_4d, edges);
  struct Pixel {
    float edge;
    int u, v;
  };
  std::vector<Pixel> pixels;
  for (int v = 2; v < band.shape.height - 2; v += 2)
    for (int u = 2; u < band.shape.width - 2; u += 2) pixels.push_back({edges.row(v)[u], u, v});
  const std::size_t count = std::min<std::size_t>(pixels.size() / 3, most_pixels);
  std::nth_element(pixels.begin(), pixels.begin() + count, pixels.end(),
                   [](const Pixel& a, const Pixel& b) { return a.edge > b.edge; });
  pixels.resize(count);

  const ScoreOptions score = colour_score(0.08f);
  std::vector<PixelMatch> matches;
  std::vector<float> scores(range.count);
  for (const Pixel& pixel : pixels) {
    control.throw_if_cancelled();
    if (pixel.edge < 0.1f || pixel.edge > kMostEdge) continue;  // a flat picture tells nothing
    for (int i = 0; i < range.count; ++i)
      scores[i] = reference::density_score(
          band, sampler, 0, Ray{double(pixel.u), double(pixel.v), range.value(i)}, score);
    const int best = int(std::max_element(scores.begin(), scores.end()) - scores.begin());
    float elsewhere = 0;
    for (int i = 0; i < range.count; ++i)
      if (std::abs(i - best) > 6) elsewhere = std::max(elsewhere, scores[i]);
    matches.push_back(
        {pixel.u, pixel.v, float(range.value(best)), scores[best], scores[best] - elsewhere});
  }
  return matches;
}

}  // namespace

namespace {

/// A search of the whole range that views on a line or in a plane can have.
struct WideSearch {
  std::vector<PixelMatch> matches;
  HypothesisRange range;
  int level = 0;
  double radius = 0;  ///< view steps from the first view to the farthest one
};

WideSearch search_widely(const LightField& views, const RunControl& control, int most_pixels) {
  const Band band = small_band(views);
  WideSearch search;
  search.level = band.shape.level;
  for (const View& view : views.views)
    search.radius =
        std::max(search.radius, std::hypot(view.s - views.views[0].s, view.t - views.views[0].t));
  // A step moves the outermost view by half a pixel of the small pictures; the search ends where
  // neighbouring views differ by a sixteenth of the width.
  const double scale = double(1 << band.shape.level);
  const double most = band.shape.width / 16.0 * scale, step = 0.5 / search.radius * scale;
  search.range = {-most, most, int(std::ceil(2 * most / step)) | 1};
  const bool is_4d = views.kind != LightFieldKind::k3D;
  search.matches = std::visit(
      [&](const auto& sampler) {
        return match_edges(band, sampler, is_4d, search.range, control, most_pixels);
      },
      make_sampler(views));
  return search;
}

double mean_score(const std::vector<PixelMatch>& matches) {
  double sum = 0;
  for (const PixelMatch& match : matches) sum += match.score;
  return matches.empty() ? 0 : sum / double(matches.size());
}

}  // namespace

LightField central(const LightField& light_field) {
  return subset(light_field, central_views(light_field, kMostViews));
}

double measure_agreement(const LightField& light_field, const RunControl& control) {
  return mean_score(search_widely(light_field, control, kMostPixels / 5).matches);
}

RangeEstimate estimate_disparity_range(const LightField& light_field, const RunControl& control) {
  const auto [matches, search, level, radius] =
      search_widely(central(light_field), control, kMostPixels);
  RangeEstimate estimate;
  estimate.pixel_size = 1 << level;
  estimate.radius = radius;
  estimate.agreement = mean_score(matches);
  std::vector<float> reliable;
  for (const PixelMatch& match : matches) {
    if (match.score <= kReliableScore || match.lead <= kReliableLead) continue;
    reliable.push_back(match.disparity);
    estimate.matches.push_back({match.u << level, match.v << level, match.disparity});
  }
  constexpr std::size_t kLeast = 30;
  if (reliable.size() < kLeast)
    throw Error(
        ErrorCode::kBadInput,
        "the disparity range can't be estimated: too little in the pictures matches; give it "
        "with --disparity MIN MAX");
  std::sort(reliable.begin(), reliable.end());
  const auto percentile = [&](double p) {
    return double(reliable[std::size_t(p * double(reliable.size() - 1))]);
  };
  const double low = percentile(0.003), high = percentile(0.997);
  const double margin = std::max(0.12 * (high - low), search.step());
  estimate.range = {low - margin, high + margin};
  estimate.samples = long(reliable.size());
  for (const float d : reliable) estimate.negative_share += (d < 0) / double(reliable.size());
  return estimate;
}

namespace {

/// Inverse depths at which the middle of a picture is seen by at least half as many other cameras,
/// of those that look a similar way, as where most do.
InverseDepthRange shared_depths(const LightField& light_field, int ref) {
  const std::vector<Camera>& cameras = light_field.cameras;
  const Camera& camera = cameras[ref];
  // To the nearest camera, but for one that stands in the same place.
  constexpr double kSamePlace = 1e-3;  // of the distance to the farthest camera
  double step = std::numeric_limits<double>::infinity(), farthest = 0;
  const auto distance = [&](const Camera& other) {
    return (other.position() - camera.position()).norm();
  };
  for (const Camera& other : cameras) farthest = std::max(farthest, distance(other));
  for (const Camera& other : cameras)
    if (const double d = distance(other); d > kSamePlace * farthest) step = std::min(step, d);
  constexpr int kSteps = 96;
  constexpr double kNearest = 0.2, kFarthest = 1000;  // steps
  constexpr double kLeastCosine = 0.6;
  std::vector<double> inverse;
  std::vector<int> seen;
  for (int i = 0; i < kSteps; ++i) {
    const double z = step * kNearest * std::pow(kFarthest / kNearest, double(i) / (kSteps - 1));
    const Eigen::Vector3d point =
        camera.back_project((camera.width - 1) / 2.0, (camera.height - 1) / 2.0, z);
    int count = 0;
    for (std::size_t j = 0; j < cameras.size(); ++j)
      count += int(j) != ref && cameras[j].direction().dot(camera.direction()) > kLeastCosine &&
               cameras[j].sees(point);
    inverse.push_back(1 / z);
    seen.push_back(count);
  }
  const int most = *std::max_element(seen.begin(), seen.end());
  InverseDepthRange range{0, 0};
  for (int i = 0; i < kSteps; ++i) {
    if (most == 0 || 2 * seen[i] < most) continue;
    range.max = std::max(range.max, inverse[i]);
    range.min = i + 1 == kSteps ? 0 : inverse[i];  // z rises: the last one stays
  }
  return range;
}

/// Points of the scene on strong edges of a view.
std::vector<Eigen::Vector3d> match_points(const LightField& light_field, int ref,
                                          const RunControl& control) {
  const UnstructuredSampler all(light_field.cameras);
  std::vector<int> chosen = all.partners(ref);
  std::erase(chosen, ref);
  // The nearest ones: a coarse search finds most in what looks alike.
  const Eigen::Vector3d here = light_field.cameras[ref].position();
  std::sort(chosen.begin(), chosen.end(), [&](int a, int b) {
    return (light_field.cameras[a].position() - here).norm() <
           (light_field.cameras[b].position() - here).norm();
  });
  chosen.resize(std::min<std::size_t>(chosen.size(), 4));
  if (chosen.empty()) return {};
  chosen.insert(chosen.begin(), ref);
  const LightField views = subset(light_field, chosen);
  const UnstructuredSampler sampler(views.cameras);
  const Band band = small_band(views);
  double travel = 0;
  for (int other = 1; other < views.num_views(); ++other)
    travel = std::max(travel, sampler.travel(0, other));
  constexpr int kMostSteps = 600, kMostEdgePixels = 600;
  const int count = std::clamp(int(2 * travel / double(1 << band.shape.level)), 32, kMostSteps);
  std::vector<Eigen::Vector3d> points;
  for (const PixelMatch& match :
       match_edges(band, sampler, true, {0, 1, count}, control, kMostEdgePixels)) {
    if (match.score <= kReliableScore || match.lead <= kReliableLead) continue;
    const double w = sampler.inverse_depth(0, match.disparity);
    if (w <= 0) continue;
    points.push_back(views.cameras[0].back_project(match.u << band.shape.level,
                                                   match.v << band.shape.level, 1 / w));
  }
  return points;
}

}  // namespace

void estimate_inverse_depths(LightField& light_field, const RunControl& control, bool read_pixels) {
  constexpr std::size_t kMostViewsMatched = 8, kLeastPoints = 30;
  std::vector<Camera>& cameras = light_field.cameras;
  std::vector<int> lacking;
  for (int i = 0; i < light_field.num_views(); ++i) {
    if (cameras[i].inverse_depth) continue;
    lacking.push_back(i);
    const InverseDepthRange bound = shared_depths(light_field, i);
    if (!(bound.max > bound.min))
      throw Error(ErrorCode::kBadInput,
                  "view " + light_field.views[i].name +
                      " shares nothing with any other along its axis; is its pose right?");
    cameras[i].inverse_depth = bound;
  }
  if (!read_pixels) return;

  std::vector<Eigen::Vector3d> points;
  const std::size_t stride = (lacking.size() + kMostViewsMatched - 1) / kMostViewsMatched;
  for (std::size_t i = 0; i < lacking.size(); i += stride) {
    control.progress("range", double(i), double(lacking.size()));
    const auto more = match_points(light_field, lacking[i], control);
    points.insert(points.end(), more.begin(), more.end());
  }
  if (points.size() < kLeastPoints)
    throw Error(ErrorCode::kBadInput,
                "the range of depths can't be estimated: too little in the pictures matches; give "
                "inverse depths with --disparity MIN MAX");
  for (const int i : lacking) {
    std::vector<double> depths;
    for (const Eigen::Vector3d& point : points)
      if (cameras[i].sees(point)) depths.push_back(cameras[i].project(point).z());
    if (const auto range = range_of_depths(std::move(depths))) cameras[i].inverse_depth = range;
  }
}

namespace {

/// The centre view first, then some of those that it is compared with.
std::vector<int> noise_views(const LightField& light_field, std::size_t most) {
  const int centre = centre_view(light_field);
  std::vector<int> partners =
      std::visit([&](const auto& s) { return s.partners(centre); }, make_sampler(light_field));
  std::vector<int> chosen{centre};
  const std::size_t stride = (partners.size() + most - 1) / most;
  for (std::size_t i = 0; i < partners.size(); i += stride)
    if (partners[i] != centre) chosen.push_back(partners[i]);
  return chosen;
}

}  // namespace

NoiseEstimate estimate_noise(const LightField& light_field, const HypothesisRange& hypotheses,
                             const RunControl& control) {
  constexpr int kGrid = 8, kMostRows = 16;
  // Of unstructured views a row needs much of each.
  const bool unstructured = light_field.kind == LightFieldKind::kUnstructured;
  const LightField views = subset(light_field, noise_views(light_field, unstructured ? 9 : 25));

  // The rows, each with what it reaches in other views; in one band where that is much.
  const int height = light_field.height;
  const int rows = std::min(kMostRows, std::max(1, height / kGrid));
  std::vector<RowRange> needed;
  std::vector<int> centres;
  const AnySampler sampler = make_sampler(views);
  int rows_of_all = 0;
  for (int i = 0; i < rows; ++i) {
    const int v = int((i + 0.5) * height / rows);
    centres.push_back(v);
    needed.push_back(std::visit(
        [&](const auto& s) {
          return s.rows_needed(0, grown({v, v + 1}, 3, height), hypotheses, height);
        },
        sampler));
    rows_of_all += needed.back().size();
  }
  const bool together = rows_of_all > height;
  if (together) needed.assign(1, {0, height});
  std::vector<Band> bands;
  for (const RowRange& range : needed) {
    Band band{{0, light_field.width, height}, range, views.num_views(), 5, {}};
    band.data.resize(std::size_t(range.size()) * band.num_views * 5 * band.shape.width);
    bands.push_back(std::move(band));
  }
  for (int view = 0; view < views.num_views(); ++view) {
    control.progress("noise", view, views.num_views());
    const Band one = view_band(views, view, 5);
    for (Band& band : bands) place(one, view, band);
  }

  constexpr float kColourCap = 0.3f, kGradientCap = 0.2f;
  std::vector<float> colour, gradient, lead;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const Band& band = bands[together ? 0 : i];
    control.throw_if_cancelled();
    for (int u = kGrid / 2; u < light_field.width; u += kGrid) {
      const Sample own = band.pixel(0, u, centres[i]);
      if (std::abs(own[0] - 0.5F) > reference::kMaskedBeyond) continue;
      float best_colour = kColourCap, best_gradient = kGradientCap, sum_of_all = 0;
      int tested = 0;
      for (int h = 0; h < hypotheses.count; ++h) {
        const Ray ray{double(u), double(centres[i]), hypotheses.value(h)};
        float sum_colour = 0, sum_gradient = 0;
        int count = 0;
        std::visit(
            [&](const auto& s) {
              for (int other = 1; other < views.num_views(); ++other) {
                const auto there = s.locate(0, other, ray);
                const auto sample =
                    there ? reference::sample_at(band, other, there->u, there->v, true)
                          : std::nullopt;
                if (!sample) continue;
                sum_colour += std::min(kColourCap, reference::colour_distance(*sample, own));
                sum_gradient += std::min(kGradientCap,
                                         std::hypot((*sample)[3] - own[3], (*sample)[4] - own[4]));
                ++count;
              }
            },
            sampler);
        if (2 * count < views.num_views() - 1) continue;
        sum_of_all += sum_colour / count;
        ++tested;
        best_colour = std::min(best_colour, sum_colour / count);
        best_gradient = std::min(best_gradient, sum_gradient / count);
      }
      if (tested > 0) lead.push_back(sum_of_all / tested / std::max(best_colour, 1e-4f) - 1);
      colour.push_back(best_colour);
      gradient.push_back(best_gradient);
    }
  }
  const auto smallest = [](std::vector<float>& values, double share) {
    if (values.empty()) return 0.0;
    const auto at = values.begin() + long(share * double(values.size()));
    std::nth_element(values.begin(), at, values.end());
    return double(*at);
  };
  return {smallest(colour, 0.25), smallest(gradient, 0.25), smallest(lead, 0.5)};
}

void apply_noise(const NoiseEstimate& noise, DepthOptions& options) {
  options.score.bandwidth = std::max(kLeastBandwidth, float(4 * noise.colour));
  options.score.gradient_bandwidth = std::max(kLeastGradientBandwidth, float(2.5 * noise.gradient));
  options.support.sigma_colour = float(std::max(0.03, 2 * noise.colour));
}

}  // namespace gigaray
