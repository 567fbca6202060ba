// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <algorithm>

namespace gigaray {

/// How far the views of a level are, by what is to do in them: the first one has all pixels, the
/// others what is left to them, of which those that are done tell.
class LevelProgress {
 public:
  LevelProgress() = default;
  /// pixels: of a view.
  LevelProgress(int views, double pixels) : views_(views), pixels_(pixels) {}

  /// todo: pixels to do.
  void begin_view(double todo) {
    done_ += of_view_;
    others_ += view_ > 0 ? of_view_ : 0;
    ++view_;
    of_view_ = todo + kBesideScores * pixels_;
  }
  /// The part of the level that is done, with this part of the view at work. Never goes back.
  double share(double part_of_view) {
    if (view_ < 0) return 0;
    const double usual = view_ > 1 ? others_ / (view_ - 1) : kUsuallyLeft * pixels_;
    const double done = done_ + part_of_view * of_view_;
    const double all = done_ + of_view_ + (views_ - view_ - 1) * usual;
    return share_ = std::max(share_, all > 0 ? done / all : 0);
  }

 private:
  /// What a view takes beside scores, and what is usually to do in others than the first, in its
  /// pixels.
  static constexpr double kBesideScores = 0.02, kUsuallyLeft = 0.06;

  int views_ = 1;
  double pixels_ = 1;
  int view_ = -1;  ///< at work
  double of_view_ = 0, done_ = 0, others_ = 0;
  double share_ = 0;
};

}  // namespace gigaray
