// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/engine/camera_order.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "disparity_range.h"
#include "gigaray/core/arguments.h"
#include "occlusion_votes.h"
#include "settle_direction.h"

namespace gigaray {
namespace {

/// How far another order must be ahead in mean agreement, 0 … 1, to replace the assumed one. On
/// real pictures the right order leads by 0.07 (focused) to 0.14.
constexpr double kClearlyBetter = 0.02;
/// Unfocused parallel cameras see positive disparities only, but for a few wrong matches: a share
/// of one sign that leaves no doubt, and one that decides when nothing else does.
constexpr double kOneSign = 0.98, kMostlyOneSign = 0.9;
/// Share of the places where surfaces hide each other that must speak for a sign, and how many.
constexpr double kClearOcclusion = 0.6;
constexpr int kLeastOcclusions = 20;

/// A turn of the camera plane: s = s_from_s · s + s_from_t · t, and so on.
struct Order {
  const char* ways;         ///< way of the camera as the old s rises, as the old t rises
  const char* ways_turned;  ///< the same with both axes turned around
  int s_from_s, s_from_t, t_from_s, t_from_t;

  View apply(View view, int sign) const {
    const double s = view.s, t = view.t;
    view.s = sign * (s_from_s * s + s_from_t * t) + 0.0;  // never -0
    view.t = sign * (t_from_s * s + t_from_t * t) + 0.0;
    return view;
  }
};

/// The assumed one first. Turning both axes around gives the other four of the eight.
constexpr std::array<Order, 4> kOrders{{{"right,down", "left,up", 1, 0, 0, 1},
                                        {"right,up", "left,down", 1, 0, 0, -1},
                                        {"down,right", "up,left", 0, 1, 1, 0},
                                        {"down,left", "up,right", 0, -1, 1, 0}}};

LightField turned(LightField light_field, const Order& order, int sign) {
  for (View& view : light_field.views) view = order.apply(view, sign);
  for (View& view : light_field.left_out) view = order.apply(view, sign);
  light_field.kind = kind_from_positions(light_field.views);
  return light_field;
}

struct Trial {
  const Order* order;
  std::optional<RangeEstimate> estimate;  ///< none: nothing matches
  double agreement() const { return estimate ? estimate->agreement : 0; }
};

/// On one line a mirrored axis is the other sign, which the disparities tell.
bool on_one_line(const std::vector<View>& views) {
  const auto same = [&](auto coordinate) {
    return std::all_of(views.begin(), views.end(), [&](const View& view) {
      return coordinate(view) == coordinate(views.front());
    });
  };
  return same([](const View& view) { return view.s; }) ||
         same([](const View& view) { return view.t; });
}

std::vector<Trial> try_orders(const LightField& light_field, const RunControl& control) {
  const bool line = on_one_line(light_field.views);
  SmallViews small(light_field);
  std::vector<Trial> trials;
  std::optional<Error> refusal;
  for (const Order& order : kOrders) {
    if (line && (order.s_from_t < 0 || order.t_from_t < 0)) continue;
    Trial trial{&order, std::nullopt};
    try {
      trial.estimate = estimate_disparity_range(turned(light_field, order, 1), small, control);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::kBadInput) throw;
      if (!refusal) refusal = error;
    }
    trials.push_back(trial);
  }
  if (std::none_of(trials.begin(), trials.end(), [](const Trial& t) { return t.estimate; }))
    throw *refusal;
  return trials;
}

enum class Sign { kRight, kWrong, kUnclear };

/// Does positive disparity mean nearer?
Sign sign_of(const LightField& light_field, const RangeEstimate& estimate,
             const RunControl& control) {
  const double negative = estimate.negative_share;
  if (negative >= kOneSign) return Sign::kWrong;
  if (negative <= 1 - kOneSign) return Sign::kRight;
  // A focused rig has both signs; then what hides what tells near from far.
  const OcclusionVotes votes = count_occlusions(light_field, estimate, control);
  if (votes.count() >= kLeastOcclusions) {
    if (votes.nearer > kClearOcclusion * votes.count()) return Sign::kRight;
    if (votes.farther > kClearOcclusion * votes.count()) return Sign::kWrong;
  }
  if (negative >= kMostlyOneSign) return Sign::kWrong;
  return negative <= 1 - kMostlyOneSign ? Sign::kRight : Sign::kUnclear;
}

std::string percent(double share) {
  char text[16];
  std::snprintf(text, sizeof text, "%.0f %%", 100 * share);
  return text;
}

}  // namespace

void doubt_positions(const LightField& light_field, const RunControl& control) {
  check(light_field);
  if (light_field.kind != LightFieldKind::k4D) return;
  constexpr double kClearLead = 0.05;
  static constexpr std::array<const char*, 4> kTurns{
      "as they are", "with the sign of down changed", "with right and down exchanged",
      "with right and down exchanged and the sign of one changed"};
  std::array<double, 4> agreement{};
  SmallViews small(light_field);
  for (std::size_t i = 0; i < kOrders.size(); ++i) {
    const LightField tried = turned(light_field, kOrders[i], 1);
    agreement[i] = measure_agreement(tried, central_views(tried), small, control);
  }
  const auto best = std::size_t(std::ranges::max_element(agreement) - agreement.begin());
  if (agreement[best] < agreement[0] + kClearLead) return;
  control.message("the stated positions are in doubt: views agree to " + percent(agreement[0]) +
                  " as they are, to " + percent(agreement[best]) + " " + kTurns[best]);
}

std::optional<SettledDirection> settle_direction(LightField& light_field,
                                                 const RunControl& control) {
  if (!light_field.sign_is_assumed) return std::nullopt;
  const std::vector<Trial> trials = try_orders(light_field, control);
  const auto best = std::max_element(
      trials.begin(), trials.end(),
      [](const Trial& a, const Trial& b) { return a.agreement() < b.agreement(); });
  const Trial& chosen =
      trials.front().estimate && best->agreement() < trials.front().agreement() + kClearlyBetter
          ? trials.front()
          : *best;
  double next = 0;  // agreement of the best of the others
  for (const Trial& trial : trials)
    if (trial.order != chosen.order) next = std::max(next, trial.agreement());

  RangeEstimate estimate = *chosen.estimate;
  const bool row = light_field.kind == LightFieldKind::k3D;
  light_field = turned(light_field, *chosen.order, 1);
  const Sign sign = sign_of(light_field, estimate, control);
  const bool turn = sign == Sign::kWrong, unclear = sign == Sign::kUnclear;
  if (turn) light_field = turned(light_field, kOrders.front(), -1);
  light_field.sign_is_assumed = false;
  if (turn) estimate.range = {-estimate.range.max, -estimate.range.min};

  std::string ways = turn ? chosen.order->ways_turned : chosen.order->ways;
  if (row) ways = ways.substr(0, ways.find(','));
  const bool as_assumed = &chosen == &trials.front() && !turn;
  SettledDirection settled{estimate.range, "", !unclear};
  if (!row || !as_assumed || unclear)
    settled.message = "direction " + ways + (as_assumed ? " as assumed" : ", other than assumed") +
                      ": views agree to " + percent(chosen.agreement()) +
                      ", in the next best order to " + percent(next) +
                      (unclear ? "; disparities have both signs and nothing tells near from far: "
                                 "OpenOptions::direction states it"
                               : "");
  return settled;
}

std::optional<DisparityRange> check_direction(LightField& light_field, const RunControl& control) {
  if (!light_field.sign_is_assumed) return std::nullopt;
  check(light_field);
  const auto settled = settle_direction(light_field, control);
  if (!settled) return std::nullopt;
  if (!settled->message.empty()) control.message(settled->message);
  return settled->range;
}

}  // namespace gigaray
