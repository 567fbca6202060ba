// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "view_consensus.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "gigaray/core/parallel.h"
#include "gigaray/engine/calibration.h"

namespace gigaray {
namespace {

/// Other views that are asked: the nearest, which see the same.
constexpr std::size_t kMostAsked = 8;
/// The view's own estimate was found with its own pixels: it counts so many times.
constexpr float kOwnShare = 2;
/// So much more must speak for another estimate than for the own one.
constexpr float kLead = 0.3f;
/// Proposals that are nearer to each other are one, in tolerances.
constexpr float kAlike = 0.25f;
/// In a mean of estimates that nobody trusts all count alike.
constexpr float kLeastWeight = 1e-3f;
/// Neighbouring pixels that are no farther apart show one surface, in tolerances.
constexpr float kOneSurface = 3;
/// Estimates carried over from other views may lie beyond the range of a view; those that are
/// beyond it by more than this share are left as they are.
constexpr double kReach = 0.25;
/// The second pass looks at what the first one mended.
constexpr int kPasses = 2;

struct Pass {
  int index;
  float tolerance;

  /// What a map has as confidence, as a probability: before the first pass it is contrast.
  float right_of(float confidence) const {
    return index > 0 ? confidence
                     : calibrated_confidence(confidence, LightFieldKind::kUnstructured);
  }
};

/// An estimate and how likely it is right.
struct Claim {
  float hypothesis = kNoEstimate;
  float right = 0;

  float weight() const { return right * right; }
};

bool is_reached(float hypothesis) {  // NaN is not
  return hypothesis >= -kReach && hypothesis <= 1 + kReach;
}

/// Rows of a view's map as claims.
class Claims {
 public:
  Claims(const FinishedMaps& maps, int active_idx, RowRange rows, const Pass& pass)
      : width_(maps.width()), rows_(rows), claims_(std::size_t(width_) * rows.size()) {
    std::vector<float> hypotheses(width_), confidences(width_);
    for (int v = rows.begin; v < rows.end; ++v) {
      maps.read(active_idx, v, hypotheses.data(), confidences.data(), nullptr);
      for (int u = 0; u < width_; ++u) row(v)[u] = {hypotheses[u], pass.right_of(confidences[u])};
    }
  }
  /// Nothing is claimed.
  Claims(int width, RowRange rows)
      : width_(width), rows_(rows), claims_(std::size_t(width) * rows.size()) {}

  RowRange rows() const { return rows_; }
  int width() const { return width_; }
  Claim* row(int v) { return claims_.data() + std::size_t(v - rows_.begin) * width_; }
  const Claim* row(int v) const { return const_cast<Claims*>(this)->row(v); }
  /// At the nearest pixel; null: outside.
  Claim* at(double u, double v) {
    if (!(u > -0.5 && v > rows_.begin - 0.5 && u < width_ - 0.5 && v < rows_.end - 0.5))
      return nullptr;
    return row(int(v + 0.5)) + int(u + 0.5);
  }
  const Claim* at(double u, double v) const { return const_cast<Claims*>(this)->at(u, v); }
  /// Of the pixels around (u, v), without its own; NaN: there is none.
  float median_around(int u, int v) const {
    std::array<float, 8> around;
    int count = 0;
    for (int y = std::max(v - 1, rows_.begin); y < std::min(v + 2, rows_.end); ++y)
      for (int x = std::max(u - 1, 0); x < std::min(u + 2, width_); ++x) {
        const float hypothesis = row(y)[x].hypothesis;
        if ((x != u || y != v) && !std::isnan(hypothesis)) around[count++] = hypothesis;
      }
    if (count == 0) return kNoEstimate;
    std::nth_element(around.begin(), around.begin() + count / 2, around.begin() + count);
    return around[count / 2];
  }
  /// Between the four pixels around where they show one surface, else at the nearest.
  std::optional<Claim> between(double u, double v, float most_apart) const {
    const Claim* nearest = at(u, v);
    if (!nearest) return std::nullopt;
    const int left = int(u), top = int(v);
    if (!(u >= 0 && v >= rows_.begin && left + 1 < width_ && top + 1 < rows_.end)) return *nearest;
    const Claim* upper = row(top) + left;
    const Claim* lower = row(top + 1) + left;
    const std::array corners{upper[0].hypothesis, upper[1].hypothesis, lower[0].hypothesis,
                             lower[1].hypothesis};
    const auto is_unknown = [](float hypothesis) { return std::isnan(hypothesis); };
    if (std::ranges::any_of(corners, is_unknown)) return *nearest;
    const auto [least, most] = std::ranges::minmax(corners);
    if (most - least > most_apart) return *nearest;
    const float x = float(u) - float(left), y = float(v) - float(top);
    const auto mean = [&](auto field) {
      const float above = field(upper[0]) + x * (field(upper[1]) - field(upper[0]));
      const float below = field(lower[0]) + x * (field(lower[1]) - field(lower[0]));
      return above + y * (below - above);
    };
    return Claim{mean([](const Claim& c) { return c.hypothesis; }),
                 mean([](const Claim& c) { return c.right; })};
  }

 private:
  int width_;
  RowRange rows_;
  std::vector<Claim> claims_;
};

/// Another view, and what it says of the pixels of the reference: hypotheses alone.
struct Witness {
  UnstructuredSampler::Way to, from;
  Claims own, here;
};

/// Brings the claims of a view to the pixels of the reference; of several the nearest point's.
void carry_over(Witness& witness) {
  for (int v = witness.own.rows().begin; v < witness.own.rows().end; ++v)
    for (int u = 0; u < witness.own.width(); ++u) {
      const Claim& claim = witness.own.row(v)[u];
      if (std::isnan(claim.hypothesis)) continue;
      const auto there = witness.from(Ray{double(u), double(v), claim.hypothesis});
      if (!there || !is_reached(float(there->hypothesis))) continue;
      Claim* before = witness.here.at(there->u, there->v);
      if (before && !(before->hypothesis >= float(there->hypothesis)))
        before->hypothesis = float(there->hypothesis);
    }
}

/// The views around a reference, in a band of its rows.
class Council {
 public:
  Council(const Pass& pass, std::vector<Witness> witnesses)
      : pass_(pass), tolerance_(pass.tolerance), witnesses_(std::move(witnesses)) {
    parallel_for(
        int(witnesses_.size()), [&](int i) { carry_over(witnesses_[i]); }, [](int) {});
  }

  const Pass& pass() const { return pass_; }

  struct Verdict {
    float hypothesis, confidence;
  };
  /// own: the view's claims around the pixel, a row above and below at least.
  Verdict decide(int u, int v, const Claims& own) const {
    const Claim& held = own.row(v)[u];
    if (!is_reached(held.hypothesis)) return {held.hypothesis, held.right};
    Opinion best = opinion_of(u, v, held.hypothesis, held);
    float most = best.balance + kLead;
    std::array<float, kMostAsked + 1> proposals;
    int count = 0;
    const auto propose = [&](float proposed) {
      const auto alike = [&](float other) {
        return std::abs(other - proposed) <= kAlike * tolerance_;
      };
      if (!is_reached(proposed) || alike(held.hypothesis) ||
          std::any_of(proposals.begin(), proposals.begin() + count, alike))
        return;
      proposals[count++] = proposed;
      const Opinion opinion = opinion_of(u, v, proposed, held);
      if (!(opinion.balance > most)) return;
      most = opinion.balance;
      best = opinion;
    };
    propose(own.median_around(u, v));
    for (const Witness& witness : witnesses_) propose(witness.here.row(v)[u].hypothesis);
    if (best.asked == 0) return {best.mean, held.right};
    const float agreement = best.balance / (kOwnShare + float(best.asked));
    const float right = calibrated_agreement(agreement);
    // Views that took over from each other agree: no pass makes them surer than the first.
    return {best.mean, pass_.index == 0 ? right : std::min(right, held.right)};
  }

 private:
  struct Opinion {
    float mean = 0;     ///< of the estimates that are the same
    float balance = 0;  ///< what speaks for it, less what speaks against it
    int asked = 0;      ///< views that have the point in their pictures
  };

  Opinion opinion_of(int u, int v, float hypothesis, const Claim& own) const {
    float weights = 0, sum = 0;
    const auto share = [&](float estimate, float weight) {
      weights += weight + kLeastWeight;
      sum += (weight + kLeastWeight) * (estimate - hypothesis);
    };
    Opinion opinion;
    if (std::abs(own.hypothesis - hypothesis) <= tolerance_) {
      share(own.hypothesis, own.weight());
      opinion.balance += kOwnShare * own.weight();
    }
    for (const Witness& witness : witnesses_) {
      const auto there = witness.to(Ray{double(u), double(v), hypothesis});
      const auto seen =
          there ? witness.own.between(there->u, there->v, kOneSurface * tolerance_) : std::nullopt;
      if (!seen) continue;
      ++opinion.asked;
      const float beyond = float(there->hypothesis) - seen->hypothesis;
      if (std::abs(beyond) <= tolerance_) {
        const auto back = witness.from(Ray{there->u, there->v, seen->hypothesis});
        if (!back) continue;
        share(float(back->hypothesis), seen->weight());
        opinion.balance += seen->weight();
      } else if (beyond > 0) {  // it sees through
        opinion.balance -= seen->weight();
      }
    }
    opinion.mean = hypothesis;
    if (weights > 0)
      opinion.mean += sum / weights;
    else
      opinion.balance = -std::numeric_limits<float>::infinity();
    return opinion;
  }

  const Pass pass_;
  const float tolerance_;
  std::vector<Witness> witnesses_;
};

/// Places in `active` of the views that are asked about `ref`.
std::vector<int> asked_views(const UnstructuredSampler& sampler, const std::vector<int>& active,
                             int ref) {
  std::vector<int> asked;
  for (const int view : sampler.nearest_partners(ref, std::size_t(sampler.num_views()))) {
    const auto found = std::ranges::find(active, view);
    if (found != active.end()) asked.push_back(int(found - active.begin()));
    if (asked.size() == kMostAsked) break;
  }
  return asked;
}

/// A band of a view, from old maps to new ones.
void agree_on_band(const Council& council, const FinishedMaps& maps, int active_idx, RowRange band,
                   FinishedMaps& agreed) {
  const int width = maps.width();
  const Claims own(maps, active_idx, grown(band, 1, maps.height()), council.pass());
  StripMap<float> hypotheses(width, band), confidences(width, band);
  StripMap<std::int8_t> levels(width, band);
  parallel_for(
      band.size(),
      [&](int row) {
        const int v = band.begin + row;
        maps.read(active_idx, v, nullptr, nullptr, levels.row(v));
        for (int u = 0; u < width; ++u) {
          const Council::Verdict verdict = council.decide(u, v, own);
          hypotheses.row(v)[u] = verdict.hypothesis;
          confidences.row(v)[u] = verdict.confidence;
        }
      },
      [](int) {});
  agreed.put(active_idx, hypotheses.view(), confidences.view(), levels.view());
}

FinishedMaps agree(const UnstructuredSampler& sampler, const std::vector<int>& active,
                   const FinishedMaps& maps, const Pass& pass, const std::string& folder,
                   const RunControl& control, std::size_t bytes_at_once) {
  const int width = maps.width(), height = maps.height();
  FinishedMaps agreed(int(active.size()), width, height, folder);
  for (std::size_t i = 0; i < active.size(); ++i) {
    control.progress("agreement", double(pass.index) + double(i) / double(active.size()), kPasses);
    const int ref = active[i];
    const std::vector<int> asked = asked_views(sampler, active, ref);
    const double row_bytes = 2.0 * sizeof(Claim) * width * double(asked.size() + 1);
    const int rows_at_once = int(std::clamp(double(bytes_at_once) / row_bytes, 1.0, 1.0 * height));
    for (int begin = 0; begin < height; begin += rows_at_once) {
      control.throw_if_cancelled();
      const RowRange band{begin, std::min(begin + rows_at_once, height)};
      // A row more: what is carried over is rounded to the nearest.
      const RowRange reached = sampler.rows_needed(ref, grown(band, 1, height),
                                                   HypothesisRange{-kReach, 1 + kReach}, height);
      std::vector<Witness> witnesses;
      for (const int place : asked)
        witnesses.push_back({sampler.way(ref, active[place]), sampler.way(active[place], ref),
                             Claims(maps, place, reached, pass), Claims(width, band)});
      agree_on_band(Council(pass, std::move(witnesses)), maps, int(i), band, agreed);
    }
  }
  return agreed;
}

}  // namespace

FinishedMaps view_consensus(const UnstructuredSampler& sampler, const std::vector<int>& active,
                            FinishedMaps maps, double step, const std::string& folder,
                            const RunControl& control, std::size_t bytes_at_once) {
  for (int i = 0; i < kPasses; ++i)
    maps = agree(sampler, active, maps, {i, float(kSameEstimate * step)}, folder, control,
                 bytes_at_once);
  control.progress("agreement", 1, 1);
  return maps;
}

}  // namespace gigaray
