// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/adapters/drawing.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "gigaray/core/arguments.h"

namespace gigaray {
namespace {

// RGB, as all pictures here; OpenCV's own order is never seen because nothing is converted.
const cv::Scalar kPaper(255, 255, 255), kInk(40, 40, 40), kFaint(225, 225, 225),
    kGrey(130, 130, 130);
const cv::Scalar kRed(214, 39, 40), kBlue(31, 119, 180), kYellow(255, 230, 0), kBlack(0, 0, 0);

constexpr int kShift = 4;  // fractional bits of the coordinates given to OpenCV
constexpr double kFont = 0.42;
constexpr int kMargin = 12, kTickLength = 5;
constexpr int kLeft = 64, kBottom = 46;  // px, room for numbers beside and below a drawing

cv::Point fine(double x, double y) {
  return {int(std::lround(x * (1 << kShift))), int(std::lround(y * (1 << kShift)))};
}

void draw_line(cv::Mat& canvas, double x0, double y0, double x1, double y1,
               const cv::Scalar& colour, int thickness = 1) {
  cv::line(canvas, fine(x0, y0), fine(x1, y1), colour, thickness, cv::LINE_AA, kShift);
}

cv::Size size_of(const std::string& text) {
  int baseline = 0;
  return cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kFont, 1, &baseline);
}

/// align: where (x, y) is in the text, 0 left … 1 right; y is its middle.
void draw_text(cv::Mat& canvas, const std::string& text, double x, double y, double align,
               const cv::Scalar& colour = kInk) {
  const cv::Size size = size_of(text);
  const cv::Point corner(int(std::lround(x - align * size.width)),
                         int(std::lround(y + 0.5 * size.height)));
  cv::putText(canvas, text, corner, cv::FONT_HERSHEY_SIMPLEX, kFont, colour, 1, cv::LINE_AA);
}

std::string number(double value, int digits = 4) {
  char text[32];
  // The sum of many steps is only nearly zero.
  std::snprintf(text, sizeof text, "%.*g", digits, std::abs(value) < 1e-9 ? 0.0 : value);
  return text;
}

/// Multiples of 1, 2 or 5 times a power of ten inside [low, high], at most `most` of them.
std::vector<double> ticks(double low, double high, int most) {
  const double raw = (high - low) / std::max(most - 1, 1);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power >= raw) step = factor * power;
  std::vector<double> values;
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
    values.push_back(i * step);
  return values;
}

Image<std::uint16_t> picture_of(const cv::Mat& canvas) {
  Image<std::uint16_t> picture(canvas.cols, canvas.rows, 3);
  for (int v = 0; v < canvas.rows; ++v)
    std::copy_n(canvas.ptr<std::uint8_t>(v), canvas.cols * 3, picture.row(v));
  return picture;
}

}  // namespace

Image<std::uint16_t> draw_epi(const EpiDrawing& epi) {
  constexpr int kWidth = 1200, kHeight = 420;  // px aimed at
  const int columns = epi.pixels.width(), rows = epi.pixels.height();
  require_argument(columns > 0 && rows > 0 && epi.pixels.channels() == 3,
                   "epi.pixels: three channels and pixels are needed");
  require_argument(int(epi.s.size()) == rows && int(epi.line.size()) == rows,
                   "epi.s, epi.line: one for each row is needed");
  const int wide = std::clamp(kWidth / columns, 1, 16), tall = std::clamp(kHeight / rows, 4, 40);

  cv::Mat pixels(rows, columns, CV_8UC3), enlarged;
  for (int v = 0; v < rows; ++v)
    std::copy_n(epi.pixels.row(v), columns * 3, pixels.ptr<std::uint8_t>(v));
  cv::resize(pixels, enlarged, {}, wide, tall, cv::INTER_NEAREST);
  cv::Mat canvas(rows * tall + kMargin + kBottom, columns * wide + kLeft + kMargin, CV_8UC3,
                 kPaper);
  cv::Mat inside = canvas({kLeft, kMargin, enlarged.cols, enlarged.rows});
  enlarged.copyTo(inside);

  // In `inside`, the middle of a pixel.
  const auto x_of = [&](double u) { return (u - epi.first_u + 0.5) * wide - 0.5; };
  const auto y_of = [&](double row) { return (row + 0.5) * tall - 0.5; };
  const double rail = std::max(1.5 * wide, 3.0);
  const auto draw_rails = [&](const cv::Scalar& colour, int thickness) {
    for (int row = 0; row + 1 < rows; ++row)
      for (const double side : {-rail, rail})
        if (!std::isnan(epi.line[row]) && !std::isnan(epi.line[row + 1]))
          draw_line(inside, x_of(epi.line[row]) + side, y_of(row), x_of(epi.line[row + 1]) + side,
                    y_of(row + 1), colour, thickness);
  };
  draw_rails(kBlack, 3);
  draw_rails(kYellow, 1);
  const cv::Rect pixel((epi.reference_u - epi.first_u) * wide, epi.reference_row * tall, wide,
                       tall);
  cv::rectangle(inside, cv::Rect(pixel.x - 2, pixel.y - 2, pixel.width + 4, pixel.height + 4),
                kPaper);
  cv::rectangle(inside, cv::Rect(pixel.x - 1, pixel.y - 1, pixel.width + 2, pixel.height + 2),
                kRed);

  const double bottom = kMargin + enlarged.rows;
  for (const double u : ticks(epi.first_u, epi.first_u + columns - 1, 12)) {
    const double x = kLeft + x_of(u);
    draw_line(canvas, x, bottom, x, bottom + kTickLength, kInk);
    draw_text(canvas, number(u), x, bottom + 14, 0.5);
  }
  draw_text(canvas, "u, px", kLeft + 0.5 * enlarged.cols, bottom + 34, 0.5);
  const int every = std::max(1, (20 + tall - 1) / tall);
  for (int row = 0; row < rows; ++row) {
    if ((row - epi.reference_row) % every != 0) continue;
    const double y = kMargin + y_of(row);
    draw_line(canvas, kLeft - kTickLength, y, kLeft - 1, y, kInk);
    draw_text(canvas, number(epi.s[row], 3), kLeft - 8, y, 1.0,
              row == epi.reference_row ? kRed : kInk);
  }
  draw_text(canvas, "s", kLeft - 8, bottom + 14, 1.0);
  return picture_of(canvas);
}

Image<std::uint16_t> draw_samples(std::span<const SampleCell> cells) {
  constexpr int kAcross = 900;  // px aimed at
  require_argument(!cells.empty(), "cells: there are none");
  double s_min = cells[0].s, s_max = s_min, t_min = cells[0].t, t_max = t_min;
  for (const SampleCell& cell : cells) {
    s_min = std::min(s_min, cell.s), s_max = std::max(s_max, cell.s);
    t_min = std::min(t_min, cell.t), t_max = std::max(t_max, cell.t);
  }
  const double span = std::max(s_max - s_min, t_max - t_min) + 1;
  const double pitch = std::clamp(kAcross / span, 8.0, 48.0);
  const int width = int(std::ceil((s_max - s_min + 1) * pitch));
  const int height = int(std::ceil((t_max - t_min + 1) * pitch));
  cv::Mat canvas(height + kMargin + kBottom, std::max(width, 60) + kLeft + kMargin, CV_8UC3,
                 kPaper);
  const auto x_of = [&](double s) { return kLeft + (s - s_min + 0.5) * pitch; };
  const auto y_of = [&](double t) { return kMargin + (t - t_min + 0.5) * pitch; };

  const int side = std::max(int(0.82 * pitch), 6);
  for (const SampleCell& cell : cells) {
    const cv::Rect patch(int(std::lround(x_of(cell.s) - 0.5 * side)),
                         int(std::lround(y_of(cell.t) - 0.5 * side)), side, side);
    if (std::isnan(cell.colour[0])) {
      cv::rectangle(canvas, patch, kGrey);
      cv::line(canvas, patch.tl(), patch.br() - cv::Point(1, 1), kGrey);
      cv::line(canvas, {patch.x, patch.br().y - 1}, {patch.br().x - 1, patch.y}, kGrey);
    } else {
      const cv::Scalar colour(255 * cell.colour[0], 255 * cell.colour[1], 255 * cell.colour[2]);
      cv::rectangle(canvas, patch, colour, cv::FILLED);
    }
    if (cell.is_reference)
      cv::rectangle(canvas, cv::Rect(patch.x - 2, patch.y - 2, side + 4, side + 4), kRed, 2);
  }

  const auto tick_values = [&](double low, double high) {
    return high > low ? ticks(low, high, std::max(2, int((high - low) * pitch / 40)))
                      : std::vector<double>{low};
  };
  const double bottom = kMargin + height;
  for (const double s : tick_values(s_min, s_max)) {
    draw_line(canvas, x_of(s), bottom, x_of(s), bottom + kTickLength, kInk);
    draw_text(canvas, number(s), x_of(s), bottom + 14, 0.5);
  }
  for (const double t : tick_values(t_min, t_max)) {
    draw_line(canvas, kLeft - kTickLength, y_of(t), kLeft - 1, y_of(t), kInk);
    draw_text(canvas, number(t), kLeft - 8, y_of(t), 1.0);
  }
  draw_text(canvas, "s", kLeft + 0.5 * width, bottom + 34, 0.5);
  draw_text(canvas, "t", 8, kMargin + 0.5 * height, 0.0);
  return picture_of(canvas);
}

Image<std::uint16_t> draw_scores(std::span<const float> scores, DisparityRange range, double mean,
                                 std::span<const ScoreMark> marks) {
  constexpr int kWidth = 860, kHeight = 360, kTextRow = 18, kAxisName = 8;
  // A row of text above the curve for each mark, at worst, and one for the name of the axis.
  const int top = 22 + kTextRow * int(marks.size());
  require_argument(scores.size() >= 2 && range.min < range.max,
                   "scores, range: two scores or more of a range are needed");
  const auto is_tested = [](float score) { return score >= 0; };  // false for NaN
  double highest = 0;
  for (const float score : scores)
    if (is_tested(score)) highest = std::max(highest, double(score));
  if (highest == 0) highest = 1;
  highest *= 1.08;

  cv::Mat canvas(top + kHeight + kBottom, kLeft + kWidth + 2 * kMargin, CV_8UC3, kPaper);
  const auto x_of = [&](double d) {
    return kLeft + kWidth * (d - range.min) / (range.max - range.min);
  };
  const auto y_of = [&](double score) { return top + kHeight * (1 - score / highest); };
  const double right = kLeft + kWidth, bottom = top + kHeight;

  for (const double d : ticks(range.min, range.max, 11)) {
    draw_line(canvas, x_of(d), top, x_of(d), bottom, kFaint);
    draw_line(canvas, x_of(d), bottom, x_of(d), bottom + kTickLength, kInk);
    draw_text(canvas, number(d), x_of(d), bottom + 14, 0.5);
  }
  for (const double score : ticks(0, highest, 7)) {
    draw_line(canvas, kLeft, y_of(score), right, y_of(score), kFaint);
    draw_line(canvas, kLeft - kTickLength, y_of(score), kLeft, y_of(score), kInk);
    draw_text(canvas, number(score), kLeft - 8, y_of(score), 1.0);
  }
  draw_line(canvas, kLeft, top, kLeft, bottom, kInk);
  draw_line(canvas, kLeft, bottom, right, bottom, kInk);
  draw_text(canvas, "disparity d, px per view step", kLeft + 0.5 * kWidth, bottom + 34, 0.5);
  const double names_y = top - 12;
  draw_text(canvas, "score S(d)", kAxisName, names_y, 0.0);

  if (!std::isnan(mean)) {
    for (double x = kLeft; x < right; x += 10)
      draw_line(canvas, x, y_of(mean), std::min(x + 5, right), y_of(mean), kGrey);
    draw_text(canvas, "mean " + number(mean), right, y_of(mean) - 9, 1.0, kGrey);
  }
  const auto colour_of = [](std::size_t i) { return i == 0 ? kRed : kGrey; };
  for (std::size_t i = marks.size(); i-- > 0;) {
    const double x = x_of(marks[i].disparity);
    draw_line(canvas, x, top, x, bottom, colour_of(i));
  }
  // Names of marks, left to right, each in the lowest row where it touches no other.
  std::vector<double> row_ends(marks.size() + 1, 0.0);
  row_ends[0] = kAxisName + size_of("score S(d)").width + kMargin;
  std::vector<std::size_t> order(marks.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](std::size_t i) { return marks[i].disparity; });
  for (const std::size_t i : order) {
    const std::string name = marks[i].name + " " + number(marks[i].disparity);
    const double x = x_of(marks[i].disparity), align = (x - kLeft) / kWidth;
    const double begin = x - align * size_of(name).width;
    const auto row = std::ranges::find_if(row_ends, [&](double end) { return end <= begin; });
    *row = begin + size_of(name).width + kMargin;
    draw_text(canvas, name, x, names_y - kTextRow * double(row - row_ends.begin()), align,
              colour_of(i));
  }
  const double step = (range.max - range.min) / double(scores.size() - 1);
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (!is_tested(scores[i])) continue;
    const double x = x_of(range.min + double(i) * step);
    if (i + 1 < scores.size() && is_tested(scores[i + 1]))
      draw_line(canvas, x, y_of(scores[i]), x_of(range.min + double(i + 1) * step),
                y_of(scores[i + 1]), kBlue, 2);
    else
      cv::circle(canvas, fine(x, y_of(scores[i])), 1 << kShift, kBlue, cv::FILLED, cv::LINE_AA,
                 kShift);
  }
  return picture_of(canvas);
}

}  // namespace gigaray
