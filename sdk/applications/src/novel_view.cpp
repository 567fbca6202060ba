// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/applications/novel_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <numeric>
#include <optional>

#include "gigaray/core/arguments.h"
#include "gigaray/core/parallel.h"

namespace gigaray {
namespace {

constexpr int kMostSources = 32;
/// How far the colours of a silhouette reach into the background, px.
constexpr int kSilhouette = 3;

/// Inverse depth that a source's points give the new view.
class SplatMap {
 public:
  SplatMap(const Camera& camera, const DepthView& source, float tolerance)
      : nearest_(camera.width, camera.height, 1, kNoEstimate) {
    const Camera& from = source.camera;
    Image<float> sum(camera.width, camera.height), weight(camera.width, camera.height);
    // Two passes: the front, then the mean of the points that belong to it.
    for (const bool front : {true, false})
      for (int v = 0; v < source.inverse_depth.height(); ++v)
        for (int u = 0; u < source.inverse_depth.width(); ++u) {
          const float w = source.inverse_depth(u, v);
          if (!(w > 0)) continue;
          const Eigen::Vector3d seen = camera.project(from.back_project(u, v, 1 / w));
          if (!(seen.z() > 0)) continue;
          const float there = float(1 / seen.z());
          // A pixel of the source covers so many of the new view.
          const double size = camera.focal_u / from.focal_u / (seen.z() * w);
          const double radius = std::clamp(0.75 * size, 0.75, 4.0);
          for_each_pixel(seen, radius, [&](int x, int y, double distance) {
            float& nearest = nearest_(x, y);
            if (front) {
              if (!(nearest >= there)) nearest = there;
            } else if (nearest - there <= tolerance) {
              const float part = float(std::max(1e-3, 1 - distance / (radius + 0.25)));
              sum(x, y) += part * there;
              weight(x, y) += part;
            }
          });
        }
    for (std::size_t i = 0; i < nearest_.size(); ++i)
      if (weight.data()[i] > 0) nearest_.data()[i] = sum.data()[i] / weight.data()[i];
  }

  float operator()(int u, int v) const { return nearest_(u, v); }

 private:
  template <class Visit>
  void for_each_pixel(const Eigen::Vector3d& place, double radius, Visit visit) const {
    if (!(std::abs(place.x()) < 1e8 && std::abs(place.y()) < 1e8)) return;
    const int u0 = std::max(0, int(std::ceil(place.x() - radius)));
    const int u1 = std::min(nearest_.width() - 1, int(std::floor(place.x() + radius)));
    const int v0 = std::max(0, int(std::ceil(place.y() - radius)));
    const int v1 = std::min(nearest_.height() - 1, int(std::floor(place.y() + radius)));
    for (int v = v0; v <= v1; ++v)
      for (int u = u0; u <= u1; ++u)
        visit(u, v, std::max(std::abs(u - place.x()), std::abs(v - place.y())));
  }

  FloatMap nearest_;
};

/// How a source sees a point.
enum class Sight { kOutside, kSees, kHidden, kSeesThrough };

struct Look {
  Sight sight = Sight::kOutside;
  Eigen::Vector3d place;  ///< u, v, z in the source
};

class Renderer {
 public:
  Renderer(const Camera& camera, std::span<const DepthView> sources, int bit_depth,
           const NovelViewOptions& options)
      : camera_(camera),
        sources_(sources),
        most_(double((1 << bit_depth) - 1)),
        options_(options),
        tolerance_(float(options.tolerance)) {
    if (!(tolerance_ > 0)) tolerance_ = 0.01f * span_of_sources();
    for (const DepthView& source : sources_)
      votes_.push_back((source.camera.position() - camera_.position()).norm());
    std::vector<double> sorted = votes_;
    std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
    const double usual = std::max(sorted[sorted.size() / 2], 1e-12);
    for (double& vote : votes_) vote = 1 / (vote / usual + 0.1);
  }

  NovelView run(const RunControl& control) {
    std::vector<std::optional<SplatMap>> splats(sources_.size());
    parallel_for(
        int(sources_.size()), [&](int i) { splats[i].emplace(camera_, sources_[i], tolerance_); },
        [&](int) { control.throw_if_cancelled(); });
    for (auto& splat : splats) splats_.push_back(std::move(*splat));
    NovelView view{Image<std::uint16_t>(camera_.width, camera_.height, 3),
                   FloatMap(camera_.width, camera_.height, 1, kNoEstimate),
                   Mask(camera_.width, camera_.height)};
    parallel_for(
        camera_.height,
        [&](int v) {
          for (int u = 0; u < camera_.width; ++u) view.inverse_depth(u, v) = front_of(u, v);
          for (int u = 0; u < camera_.width; ++u) {
            const float front = view.inverse_depth(u, v);
            view.seen(u, v) =
                !std::isnan(front) && mix(u, v, front, {Sight::kSees}, &view.picture(u, v));
            if (!view.seen(u, v)) view.inverse_depth(u, v) = kNoEstimate;
          }
          fill_row(view, v);
        },
        [&](int) { control.throw_if_cancelled(); });
    return view;
  }

 private:
  float span_of_sources() const {
    float least = std::numeric_limits<float>::max(), most = 0;
    for (const DepthView& source : sources_)
      for (const float w : source.inverse_depth) {
        if (!(w > 0)) continue;
        least = std::min(least, w);
        most = std::max(most, w);
      }
    return most > least ? most - least : 1;
  }

  Look look(const DepthView& source, const Eigen::Vector3d& point) const {
    Look look{Sight::kOutside, source.camera.project(point)};
    if (!(look.place.z() > 0)) return look;
    const double u = look.place.x(), v = look.place.y();
    if (!(u > -0.5 && v > -0.5 && u < source.camera.width - 0.5 && v < source.camera.height - 0.5))
      return look;
    const float there =
        source.inverse_depth(int(std::lround(std::abs(u))), int(std::lround(std::abs(v))));
    const float here = float(1 / look.place.z());
    if (std::abs(there - here) <= tolerance_)
      look.sight = Sight::kSees;
    else
      look.sight = there < here ? Sight::kSeesThrough : Sight::kHidden;  // NaN tells nothing
    return look;
  }

  /// Inverse depth of the nearest surface that more votes of the sources see than see through.
  float front_of(int u, int v) const {
    std::array<float, kMostSources> candidates;
    int count = 0;
    for (const SplatMap& splat : splats_)
      if (const float w = splat(u, v); !std::isnan(w)) candidates[count++] = w;
    std::sort(candidates.begin(), candidates.begin() + count, std::greater<>());
    float best = kNoEstimate;
    double best_lead = std::numeric_limits<double>::lowest();
    for (int i = 0; i < count; ++i) {
      // Candidates of one surface stand for each other.
      if (i > 0 && candidates[i - 1] - candidates[i] < 0.25f * tolerance_) continue;
      const Eigen::Vector3d point = camera_.back_project(u, v, 1 / candidates[i]);
      double lead = 0;
      for (std::size_t k = 0; k < sources_.size(); ++k) {
        const Sight sight = look(sources_[k], point).sight;
        lead += sight == Sight::kSees ? votes_[k] : sight == Sight::kSeesThrough ? -votes_[k] : 0;
      }
      if (lead > best_lead) {
        best = candidates[i];
        best_lead = lead;
      }
      if (lead > 0) break;
    }
    if (std::isnan(best)) return best;
    // The mean of what the sources say of this surface.
    float sum = 0, number = 0;
    for (int i = 0; i < count; ++i)
      if (std::abs(candidates[i] - best) <= tolerance_) {
        sum += candidates[i];
        ++number;
      }
    return sum / number;
  }

  /// Gaps show the farther of their two sides: what comes into sight is behind. Where every source
  /// has something in front of that, the background beside is drawn out, from where nothing of the
  /// silhouette is left in its colour.
  void fill_row(NovelView& view, int v) const {
    FloatMap& map = view.inverse_depth;
    const int width = map.width();
    for (int u = 0; u < width; ++u) {
      if (!std::isnan(map(u, v))) continue;
      int end = u;
      while (end < width && std::isnan(map(end, v))) ++end;
      if (u == 0 && end == width) return;
      const bool from_left = end == width || (u > 0 && map(u - 1, v) <= map(end, v));
      const int side = from_left ? u - 1 : end;
      const float behind = map(side, v);
      int clear = side;
      for (int x = side; x >= 0 && x < width && std::abs(x - side) <= kSilhouette &&
                         std::abs(map(x, v) - behind) <= tolerance_;
           x += from_left ? -1 : 1)
        clear = x;
      for (; u < end; ++u) {
        map(u, v) = behind;
        if (!mix(u, v, map(u, v), {Sight::kSees, Sight::kSeesThrough}, &view.picture(u, v)))
          std::copy_n(&view.picture(clear, v), 3, &view.picture(u, v));
      }
    }
  }

  static std::array<double, 3> sample(const DepthView& source, double u, double v) {
    const Image<std::uint16_t>& picture = source.picture;
    u = std::clamp(u, 0.0, double(picture.width() - 1));
    v = std::clamp(v, 0.0, double(picture.height() - 1));
    const int u0 = std::min(int(u), std::max(0, picture.width() - 2));
    const int v0 = std::min(int(v), std::max(0, picture.height() - 2));
    const int u1 = std::min(u0 + 1, picture.width() - 1);
    const int v1 = std::min(v0 + 1, picture.height() - 1);
    const double a = u - u0, b = v - v0;
    std::array<double, 3> colour;
    for (int c = 0; c < 3; ++c)
      colour[c] = (1 - b) * ((1 - a) * picture(u0, v0, c) + a * picture(u1, v0, c)) +
                  b * ((1 - a) * picture(u0, v1, c) + a * picture(u1, v1, c));
    return colour;
  }

  /// Angle between the looks, worse resolution, nearness to the border: rad.
  double penalty(const DepthView& source, const Look& look, const Eigen::Vector3d& point) const {
    const BlendOptions& blend = options_.blend;
    const Eigen::Vector3d there = point - source.camera.position();
    const Eigen::Vector3d here = point - camera_.position();
    const double angle = std::atan2(there.cross(here).norm(), there.dot(here));
    const double scale = (there.norm() / source.camera.focal_u) / (here.norm() / camera_.focal_u);
    const double coarser = std::max(0.0, std::log2(scale));
    const double margin_u =
        std::min(look.place.x() + 0.5, source.camera.width - 0.5 - look.place.x()) /
        (blend.border * source.camera.width);
    const double margin_v =
        std::min(look.place.y() + 0.5, source.camera.height - 0.5 - look.place.y()) /
        (blend.border * source.camera.height);
    const double outside = std::clamp(1 - std::min(margin_u, margin_v), 0.0, 1.0);
    return angle + blend.resolution * coarser + blend.field * outside;
  }

  /// The colour of a point, of the sources that see it in one of these ways; false: there are none.
  bool mix(int u, int v, float inverse_depth, std::initializer_list<Sight> sights,
           std::uint16_t* result) const {
    struct Part {
      double penalty;
      std::array<double, 3> colour;
    };
    std::array<Part, kMostSources> parts;
    int count = 0;
    const Eigen::Vector3d point = camera_.back_project(u, v, 1 / inverse_depth);
    for (const DepthView& source : sources_) {
      const Look found = look(source, point);
      if (std::ranges::find(sights, found.sight) != sights.end())
        parts[count++] = {penalty(source, found, point),
                          sample(source, found.place.x(), found.place.y())};
    }
    if (count == 0) return false;
    const auto begin = parts.begin(), end = parts.begin() + count;
    std::array<double, 3> sum{};
    double total = 0;
    if (!options_.blend.view_dependent) {
      for (auto part = begin; part != end; ++part) {
        for (int c = 0; c < 3; ++c) sum[c] += part->colour[c];
        total += 1;
      }
    } else {
      std::sort(begin, end, [](const Part& a, const Part& b) { return a.penalty < b.penalty; });
      // The first view that is left out sets the penalty that counts nothing, so that weights
      // change smoothly.
      const int taken = std::min(count, options_.blend.most_views);
      const double none =
          taken < count ? parts[taken].penalty : 2 * parts[taken - 1].penalty + 1e-9;
      for (int i = 0; i < taken; ++i) {
        const double weight = (1 - parts[i].penalty / none) / (parts[i].penalty + 1e-6) + 1e-9;
        for (int c = 0; c < 3; ++c) sum[c] += weight * parts[i].colour[c];
        total += weight;
      }
    }
    for (int c = 0; c < 3; ++c)
      result[c] = std::uint16_t(std::lround(std::clamp(sum[c] / total, 0.0, most_)));
    return true;
  }

  const Camera& camera_;
  std::span<const DepthView> sources_;
  double most_;
  const NovelViewOptions& options_;
  float tolerance_;
  std::vector<double> votes_;  ///< of the sources: near ones count more
  std::vector<SplatMap> splats_;
};

}  // namespace

NovelView render_view(const Camera& camera, std::span<const DepthView> sources, int bit_depth,
                      const NovelViewOptions& options, const RunControl& control) {
  if (sources.empty() || sources.size() > kMostSources)
    throw Error(ErrorCode::kInvalidArgument, "a novel view is made of 1 … " +
                                                 std::to_string(kMostSources) + " views, not of " +
                                                 std::to_string(sources.size()));
  require_argument(bit_depth >= 1 && bit_depth <= 16, "bit_depth: must be between 1 and 16");
  require_argument(
      camera.width >= 1 && camera.height >= 1 && camera.focal_u > 0 && camera.focal_v > 0,
      "camera: needs a width, a height and focal lengths above 0");
  if (options.blend.most_views < 1)
    throw Error(ErrorCode::kInvalidArgument, "a pixel needs one view or more to be mixed of");
  for (const DepthView& source : sources)
    require_argument(source.picture.width() == source.camera.width &&
                         source.picture.height() == source.camera.height &&
                         source.picture.channels() >= 3 &&
                         source.inverse_depth.width() == source.camera.width &&
                         source.inverse_depth.height() == source.camera.height,
                     "sources: picture and inverse_depth must be as large as the camera's, the "
                     "picture with three channels");
  return Renderer(camera, sources, bit_depth, options).run(control);
}

std::vector<int> nearest_cameras(const std::vector<Camera>& cameras, const Camera& camera, int most,
                                 int exclude) {
  if (cameras.empty() || most <= 0) return {};
  std::vector<double> distances;
  for (const Camera& other : cameras)
    distances.push_back((other.position() - camera.position()).norm());
  // A turn by a radian counts as the median distance.
  std::vector<double> sorted = distances;
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  const double scale = std::max(sorted[sorted.size() / 2], 1e-12);
  for (std::size_t i = 0; i < cameras.size(); ++i)
    distances[i] +=
        scale * std::acos(std::clamp(cameras[i].direction().dot(camera.direction()), -1.0, 1.0));
  std::vector<int> order;
  for (int i = 0; i < int(cameras.size()); ++i)
    if (i != exclude) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return distances[a] < distances[b]; });
  if (int(order.size()) > most) order.resize(most);
  return order;
}

Camera between(const Camera& a, const Camera& b, double part) {
  const auto mix = [&](double x, double y) { return (1 - part) * x + part * y; };
  Camera camera = a;
  camera.focal_u = mix(a.focal_u, b.focal_u);
  camera.focal_v = mix(a.focal_v, b.focal_v);
  camera.centre_u = mix(a.centre_u, b.centre_u);
  camera.centre_v = mix(a.centre_v, b.centre_v);
  const Eigen::Quaterniond from(a.rotation), to(b.rotation);
  camera.rotation = from.slerp(part, to).toRotationMatrix();
  camera.translation = -camera.rotation * ((1 - part) * a.position() + part * b.position());
  return camera;
}

}  // namespace gigaray
