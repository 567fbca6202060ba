// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// OpenCV's block matchers.
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "gigaray/baselines/methods.h"

namespace gigaray::baselines {
namespace {

constexpr int kSgbmBlock = 3, kBmBlock = 9;

/// disparity(wide reference, wide other): the pair with margins, so that the columns are matched
/// whose range leaves the picture; 16ths of px.
template <class Matcher>
cv::Mat matched(const Pair& pair, Matcher& matcher) {
  const int count = (pair.labels() + 15) / 16 * 16, end = pair.least + count;
  // Also as much as half a block, around which StereoBM has no estimate.
  constexpr int kRim = kBmBlock / 2;
  const int margin = std::max(0, end) + std::max(0, -pair.least) + kRim;
  matcher.setMinDisparity(pair.least);
  matcher.setNumDisparities(count);
  cv::Mat reference, other, fixed, disparity;
  cv::copyMakeBorder(pair.reference, reference, kRim, kRim, margin, margin, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(pair.other, other, kRim, kRim, margin, margin, cv::BORDER_REPLICATE);
  if constexpr (std::is_same_v<Matcher, cv::StereoBM>) {
    cv::cvtColor(reference, reference, cv::COLOR_RGB2GRAY);
    cv::cvtColor(other, other, cv::COLOR_RGB2GRAY);
  }
  matcher.compute(reference, other, fixed);
  const cv::Rect inside({margin, kRim}, pair.reference.size());
  fixed(inside).convertTo(disparity, CV_32F, 1.0 / 16);
  disparity.setTo(kNoEstimate, disparity < pair.least);
  return disparity;
}

}  // namespace

Baseline sgbm() {
  const Match match = [](const Pair& pair, const RunControl&) {
    // Of blocks of 3 … 11 px with and without a higher cap of the prefilter the best on HCI scenes.
    const auto matcher = cv::StereoSGBM::create(0, 16, kSgbmBlock, 8 * 3 * kSgbmBlock * kSgbmBlock,
                                                32 * 3 * kSgbmBlock * kSgbmBlock, 1, 31, 10, 50, 2,
                                                cv::StereoSGBM::MODE_HH);
    return matched(pair, *matcher);
  };
  return {"sgbm", "Semi-global block matching", "Hirschmüller 2008; OpenCV StereoSGBM",
          "blockSize 3, P1 216, P2 864, disp12MaxDiff 1, preFilterCap 31, uniquenessRatio 10, "
          "speckleWindowSize 50, speckleRange 2, MODE_HH; holes from the farther neighbour",
          [match](const Problem& problem) { return pair_trials(problem, match, 1024); }};
}

Baseline bm() {
  const Match match = [](const Pair& pair, const RunControl&) {
    const auto matcher = cv::StereoBM::create(16, kBmBlock);
    matcher->setPreFilterCap(31);
    matcher->setUniquenessRatio(10);
    matcher->setSpeckleWindowSize(50);
    matcher->setSpeckleRange(2);
    matcher->setDisp12MaxDiff(1);
    return matched(pair, *matcher);
  };
  return {"bm", "Block matching", "Konolige 1998; OpenCV StereoBM",
          "blockSize 9, preFilterCap 31, textureThreshold 10, uniquenessRatio 10, disp12MaxDiff 1, "
          "speckleWindowSize 50, speckleRange 2; holes from the farther neighbour",
          [match](const Problem& problem) { return pair_trials(problem, match, 1024); }};
}

}  // namespace gigaray::baselines
