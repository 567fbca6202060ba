// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/engine/calibration.h"

#include <array>
#include <cmath>
#include <span>

namespace gigaray {
namespace {

struct Point {
  float value, right;
};

/// Middles of the bins of contrast and the mean share of right pixels over 14 scenes and variants.
constexpr std::array<Point, 11> kParallel{{{0.0f, 0.2f},
                                           {0.01f, 0.4f},
                                           {0.035f, 0.6f},
                                           {0.075f, 0.72f},
                                           {0.125f, 0.85f},
                                           {0.175f, 0.91f},
                                           {0.25f, 0.95f},
                                           {0.35f, 0.975f},
                                           {0.45f, 0.985f},
                                           {0.55f, 0.997f},
                                           {1.0f, 1.0f}}};

/// The same of posed photographs, whose contrast counts less where the peak is wide: eight captures
/// in narrow and wide steps, with and without changes of exposure.
constexpr std::array<Point, 13> kPosed{{{0.0f, 0.02f},
                                        {0.01f, 0.17f},
                                        {0.025f, 0.24f},
                                        {0.04f, 0.27f},
                                        {0.0625f, 0.34f},
                                        {0.0875f, 0.47f},
                                        {0.125f, 0.65f},
                                        {0.175f, 0.8f},
                                        {0.25f, 0.91f},
                                        {0.35f, 0.97f},
                                        {0.45f, 0.988f},
                                        {0.55f, 0.995f},
                                        {1.0f, 1.0f}}};

/// Views that agree on posed photographs, see view_consensus.h.
constexpr std::array<Point, 15> kAgreement{{{-0.65f, 0.03f},
                                            {-0.2f, 0.06f},
                                            {-0.05f, 0.22f},
                                            {0.025f, 0.42f},
                                            {0.075f, 0.52f},
                                            {0.125f, 0.62f},
                                            {0.175f, 0.7f},
                                            {0.25f, 0.78f},
                                            {0.35f, 0.86f},
                                            {0.45f, 0.91f},
                                            {0.55f, 0.94f},
                                            {0.65f, 0.963f},
                                            {0.75f, 0.977f},
                                            {0.85f, 0.988f},
                                            {1.0f, 0.998f}}};

float right_at(std::span<const Point> points, float value) {
  if (std::isnan(value)) return value;
  if (value <= points.front().value) return points.front().right;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point &low = points[i - 1], &high = points[i];
    if (value <= high.value)
      return low.right + (high.right - low.right) * (value - low.value) / (high.value - low.value);
  }
  return points.back().right;
}

}  // namespace

float calibrated_confidence(float contrast, LightFieldKind kind) {
  return right_at(
      kind == LightFieldKind::kUnstructured ? std::span<const Point>(kPosed) : kParallel, contrast);
}

float calibrated_agreement(float agreement) { return right_at(kAgreement, agreement); }

}  // namespace gigaray
