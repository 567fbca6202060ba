// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/baselines/labelling.h"

#include <opencv2/imgproc.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

namespace gigaray::baselines {
namespace {

/// One cut: pixels that gain by it take the label `alpha`. Returns how many did.
int expand(cv::Mat& labels, int alpha, const Volume& costs, const Smoothness& smoothness) {
  const int width = labels.cols, height = labels.rows;
  cv::detail::GCGraph<float> graph(unsigned(width * height), unsigned(4 * width * height));
  for (int i = 0; i < width * height; ++i) graph.addVtx();
  const auto step = [&](int a, int b) {
    return float(std::min(std::abs(a - b), smoothness.most_step));
  };
  const auto add_pair = [&](int p, int q, float weight) {
    // Both keep, q alone changes, p alone changes; nothing when both do (Kolmogorov and Zabih
    // 2004: how to cut with such a term).
    const int label_p = labels.ptr<int>()[p], label_q = labels.ptr<int>()[q];
    const float keep = weight * step(label_p, label_q), change_q = weight * step(label_p, alpha),
                change_p = weight * step(alpha, label_q);
    graph.addTermWeights(p, change_p - keep, 0);
    graph.addTermWeights(q, -change_p, 0);
    graph.addEdges(p, q, std::max(0.0f, change_q + change_p - keep), 0);  // rounding
  };
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      const int i = v * width + u;
      graph.addTermWeights(i, costs[alpha].at<float>(v, u),
                           costs[labels.at<int>(v, u)].at<float>(v, u));
      if (u + 1 < width) add_pair(i, i + 1, smoothness.right.at<float>(v, u));
      if (v + 1 < height) add_pair(i, i + width, smoothness.down.at<float>(v, u));
    }
  graph.maxFlow();
  int changed = 0;
  for (int i = 0; i < width * height; ++i) {
    int& label = labels.ptr<int>()[i];
    if (label == alpha || graph.inSourceSegment(i)) continue;
    label = alpha;
    ++changed;
  }
  return changed;
}

}  // namespace

cv::Mat expanded(cv::Mat labels, const Volume& costs, const Smoothness& smoothness, int rounds,
                 const RunControl& control) {
  GIGARAY_CHECK(labels.isContinuous());
  for (int round = 0; round < rounds; ++round) {
    int changed = 0;
    for (int alpha = 0; alpha < int(costs.size()); ++alpha) {
      control.throw_if_cancelled();
      changed += expand(labels, alpha, costs, smoothness);
    }
    if (changed == 0) break;
  }
  return labels;
}

}  // namespace gigaray::baselines
