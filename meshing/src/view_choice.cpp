// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "view_choice.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <queue>
#include <tuple>

#include "gigaray/core/error.h"

namespace gigaray {
namespace {

using Across = std::vector<std::array<std::uint32_t, 3>>;

constexpr int kMiddle = 128;
/// A view may be chosen when it shows a face at least this much as well as the best one, octaves;
/// to make pieces larger a little worse will do.
constexpr int kGood = 1, kGoodEnough = 2;
constexpr int kSmoothingPasses = 6;
/// Pieces with fewer faces are given to a neighbour's view where that sees them.
constexpr std::size_t kSmallPiece = 100;

class Choice {
 public:
  Choice(const FaceQualities& qualities, const Across& across)
      : qualities_(qualities),
        across_(across),
        best_(qualities.num_faces()),
        views_(qualities.num_faces(), -1) {
    for (int view = 0; view < qualities.num_views(); ++view)
      for (std::size_t face = 0; face < best_.size(); ++face)
        best_[face] = std::max(best_[face], qualities.code(view, face));
  }

  /// Takes the view that shows most of what is left, again and again. What a view gains only gets
  /// less, so one that is still first after a new count is the first of all.
  void cover() {
    std::priority_queue<std::pair<double, int>> queue;
    for (int view = 0; view < qualities_.num_views(); ++view) queue.emplace(gain(view), -view);
    while (!queue.empty()) {
      const int view = -queue.top().second;
      queue.pop();
      const double now = gain(view);
      if (now <= 0) continue;
      if (!queue.empty() && now < queue.top().first) {
        queue.emplace(now, -view);
        continue;
      }
      for (std::size_t face = 0; face < views_.size(); ++face)
        if (views_[face] < 0 && is_good(view, face, kGood)) views_[face] = view;
    }
  }

  /// Gives faces the view that two of their neighbours have.
  void smooth() {
    for (int pass = 0; pass < kSmoothingPasses; ++pass) {
      bool has_changed = false;
      for (std::size_t face = 0; face < views_.size(); ++face) {
        const auto [a, b, c] = neighbours(face);
        const int view = a == b || a == c ? a : b == c ? b : -1;
        if (view < 0 || view == views_[face] || !is_good(view, face, kGoodEnough)) continue;
        views_[face] = view;
        has_changed = true;
      }
      if (!has_changed) break;
    }
  }

  /// Gives small pieces to the neighbouring view with the longest common border that sees them.
  void absorb() {
    std::size_t count = 0;
    const std::vector<std::uint32_t> charts = charts_of(views_, across_, count);
    std::vector<std::size_t> begin(count + 1);
    for (const std::uint32_t chart : charts) ++begin[chart + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<std::uint32_t> faces(charts.size());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t face = 0; face < charts.size(); ++face)
      faces[next[charts[face]]++] = std::uint32_t(face);
    for (std::size_t chart = 0; chart < count; ++chart)
      if (begin[chart + 1] - begin[chart] < kSmallPiece)
        give_away({faces.begin() + std::ptrdiff_t(begin[chart]),
                   faces.begin() + std::ptrdiff_t(begin[chart + 1])});
  }

  std::vector<int> take() { return std::move(views_); }

 private:
  bool is_good(int view, std::size_t face, int octaves) const {
    const int code = qualities_.code(view, face);
    return code > 0 && code + octaves * FaceQualities::kOctave >= best_[face];
  }

  double gain(int view) const {
    double sum = 0;
    for (std::size_t face = 0; face < views_.size(); ++face)
      if (views_[face] < 0 && is_good(view, face, kGood))
        sum += FaceQualities::quality(best_[face]);
    return sum;
  }

  std::array<int, 3> neighbours(std::size_t face) const {
    std::array<int, 3> views{};
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t other = across_[face][i];
      views[i] = other == kNoFace ? -1 : views_[other];
    }
    return views;
  }

  void give_away(const std::vector<std::uint32_t>& piece) {
    const int own = views_[piece.front()];
    if (own < 0) return;
    std::map<int, int> borders;
    for (const std::uint32_t face : piece)
      for (const int view : neighbours(face))
        if (view >= 0 && view != own) ++borders[view];
    int chosen = -1, longest = 0;
    for (const auto& [view, length] : borders)
      if (length > longest && std::ranges::all_of(piece, [&, v = view](std::uint32_t face) {
            return is_good(v, face, kGoodEnough);
          }))
        std::tie(chosen, longest) = std::pair(view, length);
    if (chosen < 0) return;
    for (const std::uint32_t face : piece) views_[face] = chosen;
  }

  const FaceQualities& qualities_;
  const Across& across_;
  std::vector<std::uint8_t> best_;
  std::vector<int> views_;
};

}  // namespace

void FaceQualities::set(int view, const std::vector<float>& qualities) {
  GIGARAY_CHECK(qualities.size() == num_faces_);
  std::uint8_t* code = codes_.data() + std::size_t(view) * num_faces_;
  for (const float quality : qualities)
    *code++ = quality > 0 ? std::uint8_t(std::clamp(
                                kMiddle + int(std::lround(kOctave * std::log2(quality))), 1, 255))
                          : 0;
}

double FaceQualities::quality(std::uint8_t code) {
  return code == 0 ? 0 : std::exp2(double(code - kMiddle) / kOctave);
}

Across faces_across(const SurfaceMesh& mesh) {
  struct Side {
    std::uint32_t a, b, face, place;
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.faces.size());
  for (std::uint32_t face = 0; face < mesh.faces.size(); ++face)
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t a = mesh.faces[face][i], b = mesh.faces[face][(i + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), face, i});
    }
  std::ranges::sort(sides, {}, [](const Side& s) { return std::tuple(s.a, s.b, s.face); });
  Across across(mesh.faces.size(), {kNoFace, kNoFace, kNoFace});
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].a == sides[begin].a && sides[end].b == sides[begin].b)
      ++end;
    if (end != begin + 2) continue;
    const Side &one = sides[begin], &other = sides[begin + 1];
    across[one.face][one.place] = other.face;
    across[other.face][other.place] = one.face;
  }
  return across;
}

std::vector<int> choose_views(const FaceQualities& qualities, const Across& across) {
  Choice choice(qualities, across);
  choice.cover();
  choice.smooth();
  choice.absorb();
  choice.smooth();
  return choice.take();
}

std::vector<std::uint32_t> charts_of(const std::vector<int>& view_of_face, const Across& across,
                                     std::size_t& count) {
  std::vector<std::uint32_t> charts(view_of_face.size(), kNoFace), open;
  count = 0;
  for (std::uint32_t first = 0; first < charts.size(); ++first) {
    if (charts[first] != kNoFace) continue;
    charts[first] = std::uint32_t(count);
    open.push_back(first);
    while (!open.empty()) {
      const std::uint32_t face = open.back();
      open.pop_back();
      for (const std::uint32_t other : across[face])
        if (other != kNoFace && charts[other] == kNoFace &&
            view_of_face[other] == view_of_face[first]) {
          charts[other] = std::uint32_t(count);
          open.push_back(other);
        }
    }
    ++count;
  }
  return charts;
}

}  // namespace gigaray
