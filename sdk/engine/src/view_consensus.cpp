// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "view_consensus.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gigaray/calibration.h"
#include "gigaray/parallel.h"

namespace gigaray {
namespace {

/// Other views that are asked: the nearest, which see the same.
constexpr std::size_t kMostAsked = 8;
/// The view's own estimate was found with its own pixels: it counts so many times.
constexpr float kOwnShare = 2;
/// So much more must speak for another estimate than for the own one.
constexpr float kLead = 0.3f;
/// In a mean of estimates that nobody trusts all count alike.
constexpr float kLeastWeight = 1e-3f;

/// An estimate and how likely it is right.
struct Claim {
  float hypothesis = kNoEstimate;
  float right = 0;

  float weight() const { return right * right; }
};

/// Rows of a view's map as claims.
class Claims {
 public:
  Claims(const FinishedMaps& maps, int active_idx, RowRange rows)
      : width_(maps.width()), rows_(rows), claims_(std::size_t(width_) * rows.size()) {
    std::vector<float> hypotheses(width_), contrasts(width_);
    for (int v = rows.begin; v < rows.end; ++v) {
      maps.read(active_idx, v, hypotheses.data(), contrasts.data(), nullptr);
      for (int u = 0; u < width_; ++u)
        row(v)[u] = {hypotheses[u],
                     calibrated_confidence(contrasts[u], LightFieldKind::kUnstructured)};
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

 private:
  int width_;
  RowRange rows_;
  std::vector<Claim> claims_;
};

/// Another view, and what it says of the pixels of the reference.
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
      Claim* seen = there ? witness.here.at(there->u, there->v) : nullptr;
      if (!seen) continue;
      const Claim carried{float(there->hypothesis), claim.right};
      if (std::isnan(seen->hypothesis) || carried.hypothesis > seen->hypothesis ||
          (carried.hypothesis == seen->hypothesis && carried.right > seen->right))
        *seen = carried;
    }
}

/// The views around a reference, in a band of its rows.
class Council {
 public:
  Council(float tolerance, std::vector<Witness> witnesses)
      : tolerance_(tolerance), witnesses_(std::move(witnesses)) {
    parallel_for(
        int(witnesses_.size()), [&](int i) { carry_over(witnesses_[i]); }, [](int) {});
  }

  struct Verdict {
    float hypothesis = kNoEstimate, confidence = kNoEstimate;
  };
  Verdict decide(int u, int v, const Claim& own) const {
    if (std::isnan(own.hypothesis)) return {};
    Opinion best = opinion_of(u, v, own.hypothesis, own);
    float most = best.balance + kLead;
    for (std::size_t i = 0; i < witnesses_.size(); ++i) {
      const float proposed = witnesses_[i].here.row(v)[u].hypothesis;
      if (std::isnan(proposed) || was_proposed(u, v, proposed, own, i)) continue;
      const Opinion opinion = opinion_of(u, v, proposed, own);
      if (!(opinion.balance > most)) continue;
      most = opinion.balance;
      best = opinion;
    }
    const float confidence =
        best.asked > 0 ? calibrated_agreement(best.balance / (kOwnShare + float(best.asked)))
                       : own.right;
    return {best.mean, confidence};
  }

 private:
  struct Opinion {
    float mean = 0;     ///< of the estimates that are the same
    float balance = 0;  ///< what speaks for it, less what speaks against it
    int asked = 0;      ///< views that have the point in their pictures
  };

  /// Has one as good as this been asked about?
  bool was_proposed(int u, int v, float hypothesis, const Claim& own, std::size_t before) const {
    const float alike = 0.25f * tolerance_;
    if (std::abs(own.hypothesis - hypothesis) <= alike) return true;
    for (std::size_t i = 0; i < before; ++i)
      if (std::abs(witnesses_[i].here.row(v)[u].hypothesis - hypothesis) <= alike) return true;
    return false;
  }

  Opinion opinion_of(int u, int v, float hypothesis, const Claim& own) const {
    float weights = 0, sum = 0;
    const auto shares = [&](const Claim& claim) {
      if (!(std::abs(claim.hypothesis - hypothesis) <= tolerance_)) return false;
      weights += claim.weight() + kLeastWeight;
      sum += (claim.weight() + kLeastWeight) * (claim.hypothesis - hypothesis);
      return true;
    };
    Opinion opinion;
    if (shares(own)) opinion.balance += kOwnShare * own.weight();
    for (const Witness& witness : witnesses_) {
      const Claim& claim = witness.here.row(v)[u];
      if (shares(claim)) opinion.balance += claim.weight();
      const auto there = witness.to(Ray{double(u), double(v), hypothesis});
      const Claim* seen = there ? witness.own.at(there->u, there->v) : nullptr;
      if (!seen) continue;
      ++opinion.asked;
      const bool sees_through = seen->hypothesis < float(there->hypothesis) - tolerance_;
      if (sees_through) opinion.balance -= seen->weight();
    }
    opinion.mean = hypothesis + sum / weights;
    return opinion;
  }

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
  const Claims own(maps, active_idx, band);
  StripMap<float> hypotheses(width, band), confidences(width, band);
  StripMap<std::int8_t> levels(width, band);
  parallel_for(
      band.size(),
      [&](int row) {
        const int v = band.begin + row;
        maps.read(active_idx, v, nullptr, nullptr, levels.row(v));
        for (int u = 0; u < width; ++u) {
          const Council::Verdict verdict = council.decide(u, v, own.row(v)[u]);
          hypotheses.row(v)[u] = verdict.hypothesis;
          confidences.row(v)[u] = verdict.confidence;
        }
      },
      [](int) {});
  agreed.put(active_idx, hypotheses.view(), confidences.view(), levels.view());
}

}  // namespace

FinishedMaps view_consensus(const UnstructuredSampler& sampler, const std::vector<int>& active,
                            const FinishedMaps& maps, double step, const std::string& folder,
                            const RunControl& control, std::size_t bytes_at_once) {
  const int width = maps.width(), height = maps.height();
  const float tolerance = float(kSameEstimate * step);
  FinishedMaps agreed(int(active.size()), width, height, folder);
  for (std::size_t i = 0; i < active.size(); ++i) {
    control.progress("agreement", double(i), double(active.size()));
    const int ref = active[i];
    const std::vector<int> asked = asked_views(sampler, active, ref);
    const double row_bytes = 2.0 * sizeof(Claim) * width * double(asked.size() + 1);
    const int rows_at_once = int(std::clamp(double(bytes_at_once) / row_bytes, 1.0, 1.0 * height));
    for (int begin = 0; begin < height; begin += rows_at_once) {
      control.throw_if_cancelled();
      const RowRange band{begin, std::min(begin + rows_at_once, height)};
      const RowRange reached = sampler.rows_needed(ref, band, HypothesisRange{0, 1}, height);
      std::vector<Witness> witnesses;
      for (const int place : asked)
        witnesses.push_back({sampler.way(ref, active[place]), sampler.way(active[place], ref),
                             Claims(maps, place, reached), Claims(width, band)});
      agree_on_band(Council(tolerance, std::move(witnesses)), maps, int(i), band, agreed);
    }
  }
  control.progress("agreement", 1, 1);
  return agreed;
}

}  // namespace gigaray
