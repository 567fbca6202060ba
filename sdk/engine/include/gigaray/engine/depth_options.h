// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gigaray/core/api.h"
#include "gigaray/core/light_field.h"

namespace GIGARAY_API gigaray {

/// Edge confidence Ce and the mask Me (eq. 2): where a depth estimate is worth trying.
struct EdgeOptions {
  int radius = 4;           ///< Half the 1D window in px; 4 is the paper's 9 px. 1 … 16
  bool squared = true;      ///< Sum squared colour distances (true) or plain ones.
  float threshold = 0.02f;  ///< Pixels with Ce above it are tried. Negative: all pixels.
  bool opening = true;      ///< Morphological opening of the mask: drops isolated pixels.
};

/// Bandwidths of clean pictures.
inline constexpr float kLeastBandwidth = 0.015f, kLeastGradientBandwidth = 0.003f;

/// So many others to be compared with are few: what they say may be chance.
inline constexpr int kMostFewViews = 3;
/// Over a wide range these take wider steps, with ScoreOptions::from_noise: to so many hypotheses.
inline constexpr int kMostOfFewViews = 640;

/// Density score S (eq. 3–5) of a hypothesis.
struct ScoreOptions {
  bool linear_rgb = true;  ///< Compare linear RGB (sRGB EOTF); false: values as encoded.
  bool cubic = false;      ///< Catmull-Rom interpolation of samples; false: linear.
  /// Kernels of colour and of the gradient, of the other views (docs/method.md); false: the paper's
  /// Epanechnikov kernel of colour.
  bool gradient = false;
  float bandwidth = 0.02f;            ///< Kernel bandwidth h, colour in [0, 1]. > 0
  float gradient_bandwidth = 0.003f;  ///< The same for gradients. > 0; used with `gradient`
  float gradient_share = 0.7f;        ///< Share of the gradient in the kernel, 0 … 1
  /// Pictures that show the rounding of JPEG are cleaned of its blocks first (jpeg_blocks.h).
  bool remove_jpeg_blocks = false;
  /// Of posed photographs: gains that the pictures differ by are taken out first (exposures.h).
  bool even_exposures = false;
  float smoothing = 0;  ///< Gaussian that the pictures are smoothed by first, px; 0: none. 0 … 3
  /// Derive smoothing, both bandwidths, their shares and the support from the noise of the pictures
  /// and the number of views, and leave out ray_mean where they are clean. Where views are few,
  /// raise SupportOptions::jump_price and jump_sigma_colour.
  bool from_noise = false;
  /// Between the two looks of SupportOptions::slanted the reference view is replaced by the mean of
  /// what all views see along its rays: its own noise would limit the score. Needs gradient and
  /// slanted.
  bool ray_mean = false;
  int mean_shift_iterations = 10;  ///< Updates of the mean radiance (eq. 5); 0 … 100
  bool stop_early = true;          ///< Stop mean-shift where it moves no more; see density_score.cl
  /// Fewer views that see the point: the hypothesis is not tested. A share of all views, 0 … 1.
  float min_views = 0.2f;
  /// The sum of kernels is divided by the number of views that see the point, but at least by this
  /// share of all views. 0 … 1. With `gradient` only other views count, here and above, and those
  /// that are missing to this share count as undecided.
  float floor_views = 0;
  /// What a view that is missing to floor_views is taken to say, 0 … 1; used with `gradient`.
  float unseen = 0.5f;
  /// Views that stand far apart resample fine texture differently, by more where it is steeper: the
  /// bandwidth grows by colour_slack (px) times the length of the reference pixel's gradient,
  /// gradient_bandwidth by gradient_slack times it. ≥ 0; used with `gradient`.
  float colour_slack = 0;
  float gradient_slack = 0;
  /// With from_noise: the share where rays alone leave much open (ray_doubt()), 0 … 1.
  float gradient_share_in_doubt = 0.7f;
};

/// The same where the reference's pixels are means along rays (ScoreOptions::ray_mean): samples
/// differ from them by their own noise alone, so the bandwidths are narrower, down to their least
/// values.
ScoreOptions against_means(ScoreOptions score);

/// Bilateral support of the scores by neighbouring pixels, before the winner is chosen.
struct SupportOptions {
  int radius = 0;  ///< Half the window in px; 0: none (per-ray scores, as the paper). 0 … 8
  float sigma_colour = 0.03f;  ///< > 0
  float sigma_space = 4;       ///< px, > 0
  /// A second pass at level 0 with support along the slope that the first pass found: keeps slanted
  /// surfaces exact. Needs radius > 0.
  bool slanted = false;
  float max_slope = 9;  ///< Steepest slope, hypotheses per px. ≥ 0
  /// Beside silhouettes at level 0, a third look with the best half of the views. Needs `slanted`
  /// and ScoreOptions::gradient.
  bool half_planes = false;
  /// A last pass at level 0 that decides for every pixel beside a jump which side it belongs to, by
  /// its own rays and colours. Needs `slanted` and ScoreOptions::gradient.
  bool choose_sides = false;
  /// Of two views: estimates at level 0 that the other one doesn't confirm continue what is behind.
  /// Left out where any view is compared with more than one: what is hidden from one of two others
  /// the second mostly sees. Needs choose_sides.
  bool fill_hidden = false;
  /// A scan-line step (semi-global matching, Hirschmüller 2008) on the supported scores of level 0:
  /// a neighbour may differ by two hypotheses at small_price, by any number at jump_price, which
  /// falls with the colour difference. Needs radius > 0.
  bool scanline = false;
  float small_price = 0.05f;        ///< > 0
  float jump_price = 0.5f;          ///< > 0
  float jump_sigma_colour = 0.05f;  ///< > 0
  /// With ScoreOptions::from_noise: the radius where rays alone leave much open (ray_doubt()), and
  /// sigma_space grows alike. At least `radius`, at most 8; plans of memory hold for it.
  int radius_in_doubt = 0;
};

/// The winner, its confidence and the bilateral median (eq. 6–8).
struct WinnerOptions {
  bool refine = false;    ///< Vertex of the parabola through winner and neighbours.
  int median_radius = 5;  ///< Half the window in px; 5 is the paper's 11×11. 0: none. 0 … 8
  float median_tolerance = 0.1f;  ///< Colour distance ε. > 0
  bool weigh_by_edge = true;  ///< Confidence is Ce · (Smax − mean S), eq. 7; false: without Ce.
  float min_confidence = 0;   ///< Estimates at or below it are left to coarser levels.
  /// Report the confidence as a probability, see calibration.h; false: the bare number of eq. 7.
  bool calibrated = false;
  /// Where the best score is above the mean by no more than this share of itself, all hypotheses
  /// score alike: such pixels carry no information and get confidence 0. 0 … 1
  float min_relief = 0;
  /// The peak of a score curve are the hypotheses whose scores fall below the best one by no more
  /// than this share of the contrast. Where the surroundings look alike it is wide and its top is
  /// chance: above peak_width hypotheses the contrast counts peak_width / width, above widest_peak
  /// it is 0. 0 … 1; 0: not asked.
  float peak_share = 0;
  int peak_width = 4;    ///< ≥ 1
  int widest_peak = 12;  ///< ≥ peak_width
};

/// Propagation and fine-to-coarse.
struct PropagationOptions {
  float tolerance = 0.1f;  ///< Colour distance ε between mean radiance and a ray. > 0
  /// A view that is finished gives an estimate up for a nearer one that is more confident by this
  /// factor. 0: for any nearer one.
  float finished_lead = 0;
  /// Holes between estimates carried over from other views that are filled between their neighbours
  /// on level 0, and holes that are left to coarser levels: px. 0: none; 0 … 8
  int crack_width = 0;
  /// Posed photographs: the finished maps of all views are held against each other, and what a view
  /// says alone gives way to what several say (view_consensus.h). Needs WinnerOptions::calibrated.
  bool consensus = false;
  bool fine_to_coarse = true;   ///< false: level 0 alone, which then accepts everything.
  int final_median_radius = 1;  ///< Half the window of the final plain median; 0: none.
};

/// Everything that decides the result. paper_options() and auto_options() fill it.
struct DepthOptions {
  std::string preset = "auto";  ///< Name only, for reports.
  /// Tested range, level-0 px per view step; unstructured: inverse depths, 1/scene unit, ≥ 0, the
  /// same for all views. Empty: from the light field, else estimated.
  std::optional<DisparityRange> disparity;
  /// Number of hypotheses, 2 … 4096; 0: one every `hypothesis_step` (of few views kMostOfFewViews
  /// at most), unstructured `unstructured_step`.
  int hypotheses = 0;
  double hypothesis_step = 0.035;  ///< level-0 px per view step
  /// Way of a point from one hypothesis to the next in the view that stands in the middle of those
  /// that a view is compared with, ordered by that way; level-0 px.
  double unstructured_step = 0.5;
  /// Posed photographs whose smaller side has so many px are looked at in half the size first, and
  /// where they agree only what is around that is searched, along the slopes found there
  /// (coarse_guide.h). Of more than one view; 0: never. Used with SupportOptions::slanted and
  /// PropagationOptions::consensus.
  int coarse_first = 0;
  int most_partners = 0;  ///< Unstructured: LightField::most_partners; 0 … 1000
  EdgeOptions edge;
  ScoreOptions score;
  SupportOptions support;
  WinnerOptions winner;
  PropagationOptions propagation;

  /// Indices of the views that get depth. Empty: all.
  std::vector<int> views;

  /// Most memory to use, bytes; 0: three quarters of what is free. The result does not depend on
  /// it.
  double memory_bytes = 0;
  /// What the caller takes of these bytes meanwhile; counts in every limit and forecast.
  double memory_beside = 0;
  /// Where large intermediate data go when memory does not hold them. Empty: the folder for
  /// temporary files. Nothing is left there, even after a crash.
  std::string work_folder;
  /// Keep what Reconstruction::decision() tells the searched bounds from; 16 bytes per pixel of the
  /// coarser levels.
  bool keep_searches = false;

  /// Throws Error(kInvalidArgument) naming the field and its value.
  void check() const;
};

/// The paper's steps and constants (METHOD, presets): per-ray scores and nothing else.
DepthOptions paper_options();

/// The default: robust kernels of colour and gradient, bilateral support, sub-hypothesis winner.
DepthOptions auto_options();

/// By name, "paper" or "auto". Throws Error(kInvalidArgument).
DepthOptions preset_options(const std::string& name);

}  // namespace gigaray
