// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "occlusion_votes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "gigaray/core/parallel.h"
#include "picture_bands.h"

namespace gigaray {
namespace {

/// View steps from the centre. Farther away the coarse disparities of the estimate miss by a pixel.
constexpr double kReach = 5;
constexpr std::size_t kMostViews = 48;
constexpr double kApart = 3;  ///< px by which two surfaces must move against each other
constexpr int kBeside = 2;    ///< px between points that count as on one place: surfaces have area
/// Colour distance, encoded, of a point to what the view shows there: it is seen, it is hidden.
constexpr float kSeen = 0.08f, kHidden = 0.15f;

using Colour = std::array<float, 3>;

/// Mean of the pixels that a pixel of the estimate's pyramid level stands for.
Colour colour_at(const Image<std::uint16_t>& picture, int u, int v, int size, float most) {
  Colour sum{};
  int count = 0;
  for (int y = std::max(v, 0); y < std::min(v + size, picture.height()); ++y)
    for (int x = std::max(u, 0); x < std::min(u + size, picture.width()); ++x, ++count)
      for (int c = 0; c < 3; ++c) sum[c] += float(picture(x, y, c)) / most;
  for (float& value : sum) value /= float(std::max(count, 1));
  return sum;
}

float distance(const Colour& a, const Colour& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// A match in another view: small px, and how far its colour is from what is seen there.
struct Landing {
  long u = 0, v = 0;
  float disparity = 0;
  float mismatch = 0;
};

std::vector<Landing> landings(const RangeEstimate& estimate, const std::vector<Colour>& colours,
                              const Image<std::uint16_t>& picture, double ds, double dt,
                              float most) {
  const int size = estimate.pixel_size;
  std::vector<Landing> landed;
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const RangeEstimate::Match& match = estimate.matches[i];
    const long u = std::lround((match.u + ds * match.disparity) / size);
    const long v = std::lround((match.v + dt * match.disparity) / size);
    if (u < 0 || v < 0 || (u + 1) * size > picture.width() || (v + 1) * size > picture.height())
      continue;
    const Colour seen = colour_at(picture, int(u) * size, int(v) * size, size, most);
    landed.push_back({u, v, match.disparity, distance(seen, colours[i])});
  }
  return landed;
}

/// Pairs on one place whose disparities are at least `apart`: one is seen and the other is not.
void count_pairs(const std::vector<Landing>& landed, long columns, double apart,
                 OcclusionVotes& votes) {
  std::unordered_multimap<long, const Landing*> at;
  for (const Landing& landing : landed) at.emplace(landing.v * columns + landing.u, &landing);
  for (const Landing& near : landed)
    for (long v = near.v - kBeside; v <= near.v + kBeside; ++v)
      for (long u = near.u - kBeside; u <= near.u + kBeside; ++u) {
        if (u < 0 || u >= columns) continue;
        const auto [begin, end] = at.equal_range(v * columns + u);
        for (auto it = begin; it != end; ++it) {
          const Landing& far = *it->second;
          if (near.disparity - far.disparity < apart) continue;
          votes.nearer += near.mismatch < kSeen && far.mismatch > kHidden;
          votes.farther += far.mismatch < kSeen && near.mismatch > kHidden;
        }
      }
}

}  // namespace

OcclusionVotes count_occlusions(const LightField& light_field, const RangeEstimate& estimate,
                                const RunControl& control) {
  const std::vector<int> order = views_from_centre(light_field);
  const View& centre = light_field.views[order.front()];
  const float most = float((1 << light_field.pixels->bit_depth()) - 1);
  const int size = estimate.pixel_size;

  const Image<std::uint16_t> own = read_view(light_field, order.front());
  std::vector<Colour> colours;
  for (const RangeEstimate::Match& match : estimate.matches)
    colours.push_back(colour_at(own, match.u, match.v, size, most));

  struct Look {
    int view;
    double ds, dt, steps;
    OcclusionVotes votes;
  };
  std::vector<Look> looks;
  for (auto view = order.rbegin(); view != order.rend() && looks.size() < kMostViews; ++view) {
    const double ds = centre.s - light_field.views[*view].s;
    const double dt = centre.t - light_field.views[*view].t;
    const double steps = std::hypot(ds, dt);
    if (steps == 0 || (steps > kReach && steps > 1.5 * estimate.radius)) continue;
    looks.push_back({*view, ds, dt, steps, {}});
  }
  parallel_for(
      int(looks.size()),
      [&](int i) {
        Look& look = looks[std::size_t(i)];
        const Image<std::uint16_t> picture = read_view(light_field, look.view);
        count_pairs(landings(estimate, colours, picture, look.ds, look.dt, most),
                    light_field.width / size + 1, kApart * size / look.steps, look.votes);
      },
      [&](int) { control.throw_if_cancelled(); }, pictures_at_once(light_field));
  OcclusionVotes votes;
  for (const Look& look : looks) {
    votes.nearer += look.votes.nearer;
    votes.farther += look.votes.farther;
  }
  return votes;
}

}  // namespace gigaray
