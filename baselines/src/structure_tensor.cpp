// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// Slopes of epipolar-plane images by the structure tensor (Wanner and Goldlücke 2012).
#include <fmt/format.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "gigaray/baselines/epi_stack.h"
#include "gigaray/baselines/labelling.h"
#include "gigaray/baselines/methods.h"
#include "gigaray/baselines/pictures.h"

namespace gigaray::baselines {
namespace {

constexpr double kInner = 0.8, kOuter = 1.6;  ///< Gaussians of gradients and of the tensor, px
constexpr int kTaps = 2;                      ///< of the Gaussians along s, on each side
constexpr int kEachSide = 2 * kTaps;          ///< views
constexpr float kSteepest = 1;                ///< px per view after shearing

constexpr int kLabels = 64;
constexpr int kMostStep = 8, kRounds = 2;
constexpr float kWeight = 0.08f, kMostCost = 6;  ///< costs in labels, times coherence
constexpr float kEdge = 10;                      ///< grey levels

struct Slopes {
  cv::Mat disparity;  ///< px per view step
  cv::Mat coherence;  ///< 0 … 1
};

/// weights of a Gaussian, and of its derivative for a slope of 1.
void kernels(double sigma, std::vector<float>& smooth, std::vector<float>& derivative) {
  float sum = 0, slope = 0;
  for (int k = -kTaps; k <= kTaps; ++k) {
    smooth.push_back(float(std::exp(-k * k / (2 * sigma * sigma))));
    derivative.push_back(float(k) * smooth.back());
    sum += smooth.back();
    slope += float(k * k) * smooth.back();
  }
  for (float& weight : smooth) weight /= sum;
  for (float& weight : derivative) weight /= slope;
}

/// The stack as if all points were farther by `shear` px per view step, CV_32FC3.
std::vector<cv::Mat> sheared(const EpiStack& stack, const std::vector<cv::Mat>& pictures,
                             double shear) {
  std::vector<cv::Mat> result;
  for (int j = 0; j < stack.size(); ++j) {
    const cv::Mat shift = (cv::Mat_<double>(2, 3) << 1, 0, -stack.views[j].steps * shear, 0, 1, 0);
    cv::Mat picture, moved;
    pictures[j].convertTo(picture, CV_32F);
    cv::warpAffine(picture, moved, shift, picture.size(), cv::INTER_CUBIC | cv::WARP_INVERSE_MAP,
                   cv::BORDER_REPLICATE);
    result.push_back(moved);
  }
  return result;
}

cv::Mat channel_sum(const cv::Mat& product) {
  cv::Mat sum;
  cv::transform(product, sum, cv::Matx13f(1, 1, 1));
  return sum;
}

/// Slope and coherence around the reference of a sheared stack, by views.
Slopes tensor(const std::vector<cv::Mat>& stack, int reference) {
  std::vector<float> smooth, derivative, outer, unused;
  kernels(kInner, smooth, derivative);
  kernels(kOuter, outer, unused);
  const cv::Mat row_derivative(1, 2 * kTaps + 1, CV_32F, derivative.data());
  const cv::Size inner_size(2 * kTaps + 1, 1), outer_size(2 * 4 + 1, 1);
  cv::Mat uu, us, ss;
  const int last = int(stack.size()) - 1;
  for (int j = reference - kTaps; j <= reference + kTaps; ++j) {
    if (j < 0 || j > last) continue;
    cv::Mat along_s = cv::Mat::zeros(stack[0].size(), CV_32FC3), along_u = along_s.clone();
    for (int k = -kTaps; k <= kTaps; ++k) {
      const cv::Mat& view = stack[std::clamp(j + k, 0, last)];
      along_u += smooth[k + kTaps] * view;
      along_s += derivative[k + kTaps] * view;
    }
    cv::filter2D(along_u, along_u, -1, row_derivative, {-1, -1}, 0, cv::BORDER_REPLICATE);
    cv::GaussianBlur(along_s, along_s, inner_size, kInner, 0, cv::BORDER_REPLICATE);
    const float weight = outer[j - reference + kTaps];
    const cv::Mat products[] = {channel_sum(along_u.mul(along_u, weight)),
                                channel_sum(along_u.mul(along_s, weight)),
                                channel_sum(along_s.mul(along_s, weight))};
    if (uu.empty()) {
      uu = products[0], us = products[1], ss = products[2];
    } else {
      uu += products[0], us += products[1], ss += products[2];
    }
  }
  for (cv::Mat* sum : {&uu, &us, &ss})
    cv::GaussianBlur(*sum, *sum, outer_size, kOuter, 0, cv::BORDER_REPLICATE);

  Slopes slopes{cv::Mat(uu.size(), CV_32F), cv::Mat(uu.size(), CV_32F)};
  for (int v = 0; v < uu.rows; ++v)
    for (int u = 0; u < uu.cols; ++u) {
      const float a = uu.at<float>(v, u), b = us.at<float>(v, u), c = ss.at<float>(v, u);
      // The gradient's direction; a point moves to the left as s rises.
      slopes.disparity.at<float>(v, u) = std::tan(0.5f * std::atan2(2 * b, a - c));
      slopes.coherence.at<float>(v, u) =
          ((a - c) * (a - c) + 4 * b * b) / ((a + c) * (a + c) + 1e-3f);
    }
  return slopes;
}

/// Of all shears the most coherent slope.
Slopes slopes_of(const EpiStack& stack, const Problem& problem, const RunControl& control) {
  const std::vector<cv::Mat> pictures = stack.pictures(problem);
  const DisparityRange range = problem.range;
  const double step = stack.step();
  Slopes best{cv::Mat(pictures[0].size(), CV_32F, cv::Scalar(kNoEstimate)),
              cv::Mat::zeros(pictures[0].size(), CV_32F)};
  // Whole px per view, so that slopes between them are small.
  for (long k = std::lround(range.min * step); k <= std::lround(range.max * step); ++k) {
    const double shear = double(k) / step;
    control.throw_if_cancelled();
    const Slopes slopes = tensor(sheared(stack, pictures, shear), stack.reference);
    for (int v = 0; v < best.disparity.rows; ++v)
      for (int u = 0; u < best.disparity.cols; ++u) {
        const float slope = slopes.disparity.at<float>(v, u);
        const auto disparity = float(shear + slope / step);
        const float coherence = slopes.coherence.at<float>(v, u);
        if (!(std::abs(slope) <= kSteepest) || disparity < range.min || disparity > range.max ||
            coherence <= best.coherence.at<float>(v, u))
          continue;
        best.disparity.at<float>(v, u) = disparity;
        best.coherence.at<float>(v, u) = coherence;
      }
  }
  return best;
}

Slopes of_all(const std::vector<EpiStack>& stacks, const Problem& problem,
              const RunControl& control) {
  Slopes result;
  for (const EpiStack& stack : stacks) {
    Slopes slopes = slopes_of(stack, problem, control);
    if (stack.direction == Direction::kColumn)
      for (cv::Mat* map : {&slopes.disparity, &slopes.coherence}) cv::transpose(*map, *map);
    if (result.disparity.empty()) {
      result = slopes;
      continue;
    }
    const cv::Mat is_better = slopes.coherence > result.coherence;
    slopes.disparity.copyTo(result.disparity, is_better);
    slopes.coherence.copyTo(result.coherence, is_better);
  }
  return result;
}

/// The labels that agree with their neighbours; where the slope itself is near its label, the
/// slope.
cv::Mat labelled(const Slopes& slopes, const cv::Mat& picture, DisparityRange range,
                 const RunControl& control) {
  const float step = float(range.max - range.min) / (kLabels - 1);
  const cv::Size size = picture.size();
  const auto label_at = [&](int v, int u) {
    return (slopes.disparity.at<float>(v, u) - float(range.min)) / step;
  };
  Volume costs;
  for (int label = 0; label < kLabels; ++label) {
    costs.emplace_back(size, CV_32F);
    for (int v = 0; v < size.height; ++v)
      for (int u = 0; u < size.width; ++u) {
        const float off = std::abs(label_at(v, u) - float(label));
        costs.back().at<float>(v, u) =
            std::isfinite(off) ? slopes.coherence.at<float>(v, u) * std::min(off, kMostCost) : 0;
      }
  }
  cv::Mat grey;
  cv::cvtColor(picture, grey, cv::COLOR_RGB2GRAY);
  Smoothness smoothness{cv::Mat(size, CV_32F), cv::Mat(size, CV_32F), kMostStep};
  cv::Mat labels(size, CV_32S);
  for (int v = 0; v < size.height; ++v)
    for (int u = 0; u < size.width; ++u) {
      const auto weight = [&](int x, int y) {
        const int gap = std::abs(
            grey.at<std::uint8_t>(v, u) -
            grey.at<std::uint8_t>(std::min(y, size.height - 1), std::min(x, size.width - 1)));
        return kWeight + (1 - kWeight) * std::exp(-float(gap) / kEdge);
      };
      smoothness.right.at<float>(v, u) = weight(u + 1, v);
      smoothness.down.at<float>(v, u) = weight(u, v + 1);
      const float label = label_at(v, u);
      labels.at<int>(v, u) = std::isfinite(label) ? int(std::lround(label)) : 0;
    }
  labels = expanded(labels, costs, smoothness, kRounds, control);
  cv::Mat disparity(size, CV_32F);
  for (int v = 0; v < size.height; ++v)
    for (int u = 0; u < size.width; ++u) {
      const int label = labels.at<int>(v, u);
      const bool is_near = std::abs(label_at(v, u) - float(label)) <= 1;
      disparity.at<float>(v, u) =
          is_near ? slopes.disparity.at<float>(v, u) : float(range.min) + step * float(label);
    }
  return disparity;
}

/// All views of the row and the column through the view, as far as the filters reach.
std::vector<Trial> trials(const Problem& problem, bool with_labelling) {
  std::vector<EpiStack> stacks;
  std::vector<int> views{problem.view};
  for (const Direction direction : {Direction::kRow, Direction::kColumn})
    if (auto stack = epi_stack(problem, direction, kEachSide)) {
      const std::vector<int> own = stack->views_from_reference();
      views.insert(views.end(), own.begin() + 1, own.end());
      stacks.push_back(std::move(*stack));
    }
  if (stacks.empty()) return {};
  const auto run = [=](const RunControl& control) {
    const Slopes slopes = of_all(stacks, problem, control);
    cv::Mat disparity = slopes.disparity;
    if (with_labelling)
      disparity =
          labelled(slopes, picture_of(problem.light_field, problem.view), problem.range, control);
    fill_from_farther(disparity);
    return Estimate{map_of(disparity), views};
  };
  return {{fmt::format("{} views", views.size()), run}};
}

constexpr const char* kParameters =
    "gradients with σ 0.8, tensor with σ 1.6, 9 views of the row and, in 4D, of the column, "
    "the more coherent one; whole shears over the range, slopes up to 1 px per view";

}  // namespace

Baseline structure_tensor() {
  return {"structure_tensor", "Structure tensor", "Wanner and Goldlücke 2012, local", kParameters,
          [](const Problem& problem) { return trials(problem, false); }};
}

Baseline structure_tensor_labelled() {
  return {"structure_tensor_labelled", "Structure tensor, global labelling",
          "Wanner and Goldlücke 2012; alpha expansion in place of their convex relaxation",
          fmt::format("{}; 64 labels, coherence times the distance (at most 6), neighbours pay "
                      "exp(−|grey difference| / 10), at least 0.08, per step, at most 8",
                      kParameters),
          [](const Problem& problem) { return trials(problem, true); }};
}

}  // namespace gigaray::baselines
