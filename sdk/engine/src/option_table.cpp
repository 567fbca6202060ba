// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/engine/option_table.h"

#include <cmath>
#include <limits>

#include "gigaray/core/error.h"

namespace gigaray {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr OptionBounds kAny{-kInfinite, kInfinite}, kNotNegative{0, kInfinite}, kShare{0, 1};
constexpr OptionBounds kAboveZero{1e-6, 100}, kZeroOrMore{0, 100};

// The name of a field is the way to it.
#define GIGARAY_FIELD(path) \
#path, +[](DepthOptions & options) -> decltype((options.path)) { return options.path; }

const std::vector<DepthOption>& table() {
  static const std::vector<DepthOption> kTable{
      {GIGARAY_FIELD(preset), kAny, "",
       "name for reports; what it stands for is in all the others"},
      {GIGARAY_FIELD(disparity), kAny, "px per view step; posed: 1 / scene unit",
       "tested range; none: from the light field, else estimated"},
      {GIGARAY_FIELD(hypotheses),
       {2, 4096, true},
       "",
       "number of hypotheses; 0: one every hypothesis_step or unstructured_step"},
      {GIGARAY_FIELD(hypothesis_step),
       {1e-4, 100},
       "px per view step",
       "from one hypothesis to the next"},
      {GIGARAY_FIELD(unstructured_step),
       {1e-3, 100},
       "px",
       "posed: way of a point from one hypothesis to the next, in the view in the middle of those "
       "compared with"},
      {GIGARAY_FIELD(coarse_first),
       {0, 1 << 20},
       "px",
       "posed: photographs whose smaller side has so many are looked at in half the size first; 0: "
       "never. Used with support.slanted and propagation.consensus"},
      {GIGARAY_FIELD(most_partners),
       {0, 1000},
       "views",
       "posed: others that a view is compared with; 0: all that share enough"},

      {GIGARAY_FIELD(edge.radius), {1, 16}, "px", "half the window of the edge confidence"},
      {GIGARAY_FIELD(edge.squared), kAny, "", "sum squared colour distances, or plain ones"},
      {GIGARAY_FIELD(edge.threshold), kAny, "",
       "pixels with an edge confidence above it are tried; negative: all"},
      {GIGARAY_FIELD(edge.opening), kAny, "", "drop isolated pixels of the mask"},

      {GIGARAY_FIELD(score.linear_rgb), kAny, "", "compare linear RGB, or values as encoded"},
      {GIGARAY_FIELD(score.cubic), kAny, "", "samples by Catmull-Rom, or linear"},
      {GIGARAY_FIELD(score.gradient), kAny, "",
       "kernels of colour and gradient of the other views, or the paper's of colour"},
      {GIGARAY_FIELD(score.bandwidth), kAboveZero, "colour, 0 … 1",
       "width of the kernel of colour"},
      {GIGARAY_FIELD(score.gradient_bandwidth), kAboveZero, "colour per px",
       "width of the kernel of the gradient"},
      {GIGARAY_FIELD(score.gradient_share), kShare, "", "share of the gradient in the kernel"},
      {GIGARAY_FIELD(score.remove_jpeg_blocks), kAny, "",
       "clean pictures that show the rounding of JPEG of its blocks first"},
      {GIGARAY_FIELD(score.even_exposures), kAny, "",
       "posed: take out gains of the pictures first"},
      {GIGARAY_FIELD(score.smoothing),
       {0, 3},
       "px",
       "Gaussian that pictures are smoothed by first"},
      {GIGARAY_FIELD(score.from_noise), kAny, "",
       "derive smoothing, bandwidths, shares and support from the noise and the number of views"},
      {GIGARAY_FIELD(score.ray_mean), kAny, "",
       "second look against means along rays; needs score.gradient and support.slanted"},
      {GIGARAY_FIELD(score.mean_shift_iterations), {0, 100}, "", "updates of the mean radiance"},
      {GIGARAY_FIELD(score.stop_early), kAny, "", "stop mean-shift where it moves no more"},
      {GIGARAY_FIELD(score.min_views), kShare, "share of all views",
       "hypotheses that fewer views see are not tested"},
      {GIGARAY_FIELD(score.floor_views), kShare, "share of all views",
       "a score is divided by at least so many views"},
      {GIGARAY_FIELD(score.unseen), kShare, "", "what a view missing to score.floor_views says"},
      {GIGARAY_FIELD(score.colour_slack), kZeroOrMore, "px",
       "the bandwidth grows by it times the gradient of the reference"},
      {GIGARAY_FIELD(score.gradient_slack), kZeroOrMore, "",
       "the bandwidth of the gradient grows by it times the gradient"},
      {GIGARAY_FIELD(score.gradient_share_in_doubt), kShare, "",
       "with score.from_noise: the share where rays alone leave much open"},

      {GIGARAY_FIELD(support.radius),
       {0, 8},
       "px",
       "half the window of bilateral support; 0: none. Above 0 needs score.min_views 0"},
      {GIGARAY_FIELD(support.sigma_colour), kAboveZero, "colour, 0 … 1", "support by colour"},
      {GIGARAY_FIELD(support.sigma_space), kAboveZero, "px", "support by distance"},
      {GIGARAY_FIELD(support.slanted), kAny, "",
       "second pass with support along the slope that was found; needs support.radius"},
      {GIGARAY_FIELD(support.max_slope), kZeroOrMore, "hypotheses per px", "steepest slope"},
      {GIGARAY_FIELD(support.half_planes), kAny, "",
       "beside silhouettes a look with the best half of the views; needs support.slanted and "
       "score.gradient"},
      {GIGARAY_FIELD(support.choose_sides), kAny, "",
       "decide which side of a jump a pixel belongs to; needs support.slanted and score.gradient"},
      {GIGARAY_FIELD(support.fill_hidden), kAny, "",
       "two views: what the other one hides continues what is behind; needs support.choose_sides"},
      {GIGARAY_FIELD(support.scanline), kAny, "",
       "scan-line step on the scores of level 0; needs support.radius"},
      {GIGARAY_FIELD(support.small_price), kAboveZero, "score", "price of two hypotheses"},
      {GIGARAY_FIELD(support.jump_price), kAboveZero, "score", "price of any number of hypotheses"},
      {GIGARAY_FIELD(support.jump_sigma_colour), kAboveZero, "colour, 0 … 1",
       "by which support.jump_price falls"},
      {GIGARAY_FIELD(support.radius_in_doubt),
       {0, 8},
       "px",
       "with score.from_noise: the radius where rays alone leave much open, at least "
       "support.radius"},

      {GIGARAY_FIELD(winner.refine), kAny, "",
       "vertex of the parabola through winner and neighbours"},
      {GIGARAY_FIELD(winner.median_radius),
       {0, 8},
       "px",
       "half the window of the bilateral median; 0: none"},
      {GIGARAY_FIELD(winner.median_tolerance), kAboveZero, "colour, 0 … 1",
       "colour distance of the median"},
      {GIGARAY_FIELD(winner.weigh_by_edge), kAny, "",
       "multiply the confidence by that of the edge"},
      {GIGARAY_FIELD(winner.min_confidence), kAny, "",
       "estimates at or below it are left to coarser levels"},
      {GIGARAY_FIELD(winner.calibrated), kAny, "",
       "confidence as the probability of being right, or the bare number"},
      {GIGARAY_FIELD(winner.min_relief), kShare, "",
       "confidence 0 where the best score is above the mean by no more than this share of it"},
      {GIGARAY_FIELD(winner.peak_share), kShare, "share of the contrast",
       "hypotheses within it of the best score are its peak; 0: not asked"},
      {GIGARAY_FIELD(winner.peak_width), {1, 4096}, "hypotheses", "wider peaks count for less"},
      {GIGARAY_FIELD(winner.widest_peak),
       {1, 4096},
       "hypotheses",
       "wider ones count for nothing; at least winner.peak_width"},

      {GIGARAY_FIELD(propagation.tolerance), kAboveZero, "colour, 0 … 1",
       "colour distance between mean radiance and a ray"},
      {GIGARAY_FIELD(propagation.finished_lead), kZeroOrMore, "",
       "a finished view gives way to nearer estimates more confident by this factor"},
      {GIGARAY_FIELD(propagation.crack_width),
       {0, 8},
       "px",
       "holes filled between estimates carried over; 0: none"},
      {GIGARAY_FIELD(propagation.consensus), kAny, "",
       "posed: what a view says alone gives way to what several say; needs winner.calibrated"},
      {GIGARAY_FIELD(propagation.fine_to_coarse), kAny, "", "coarser levels, or level 0 alone"},
      {GIGARAY_FIELD(propagation.final_median_radius),
       {0, 8},
       "px",
       "half the window of the last plain median; 0: none"},

      {GIGARAY_FIELD(views), kNotNegative, "indices", "views that get depth; none: all"},
      {GIGARAY_FIELD(memory_bytes), kNotNegative, "bytes",
       "most memory to use; 0: three quarters of what is free. No effect on the result"},
      {GIGARAY_FIELD(memory_beside), kNotNegative, "bytes",
       "what the caller takes of it meanwhile"},
      {GIGARAY_FIELD(work_folder), kAny, "",
       "for data that memory does not hold; empty: the folder for temporary files"},
      {GIGARAY_FIELD(keep_searches), kAny, "",
       "keep what Reconstruction::decision() tells bounds from"},
  };
  return kTable;
}

#undef GIGARAY_FIELD

constexpr const char* kReferenceHead =
    R"(# Options of a depth run

Made by `gigaray depth --list-options`; a test holds it equal to the program. Each is a field of
`DepthOptions` (`gigaray/engine/depth_options.h` says more), set by `gigaray depth --set NAME=VALUE`, by a
file for `--options`, or by `set_option()`. *posed*: of light fields with cameras anywhere. Levels, views and
words: [the method](method.md).

| name | type | range | unit | auto | paper | meaning |
|---|---|---|---|---|---|---|
)";

std::string range_text(const DepthOption& option) {
  const auto number = [](double value) {
    return std::isinf(value) ? std::string("…") : to_text(value);
  };
  const OptionBounds& bounds = option.bounds;
  switch (option.type()) {
    case OptionType::kBool:
      return "true, false";
    case OptionType::kInteger:
    case OptionType::kNumber:
      break;
    default:
      return "";
  }
  if (std::isinf(bounds.least)) return "any";
  if (std::isinf(bounds.most)) return "≥ " + number(bounds.least);
  return (bounds.or_zero ? "0, " : "") + number(bounds.least) + " … " + number(bounds.most);
}

}  // namespace

const std::vector<DepthOption>& depth_option_table() { return table(); }

const DepthOption* find_depth_option(std::string_view name) {
  for (const DepthOption& option : table())
    if (name == option.name) return &option;
  return nullptr;
}

void set_option(DepthOptions& options, std::string_view name, const OptionValue& value) {
  const DepthOption* option = find_depth_option(name);
  if (!option) throw Error(ErrorCode::kInvalidArgument, "there is no option " + std::string(name));
  option->set(options, value);
}

std::vector<NamedValue> option_values(const DepthOptions& options) {
  std::vector<NamedValue> values;
  for (const DepthOption& option : table()) values.push_back({option.name, option.get(options)});
  return values;
}

std::string option_reference() {
  std::string text = kReferenceHead;
  const DepthOptions automatic = auto_options(), paper = paper_options();
  for (const DepthOption& option : table()) {
    for (const std::string& cell :
         {"`" + std::string(option.name) + "`", std::string(to_string(option.type())),
          range_text(option), std::string(option.unit), to_text(option.get(automatic)),
          to_text(option.get(paper)), std::string(option.meaning)})
      text += "| " + cell + (cell.empty() ? "" : " ");
    text += "|\n";
  }
  return text;
}

}  // namespace gigaray
