// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>

#include "gigaray/baselines/disparity_sampler.h"
#include "gigaray/baselines/pair.h"
#include "gigaray/baselines/pictures.h"
#include "gigaray/calibration/rectifying_rotation.h"

namespace gigaray::baselines {
namespace {

constexpr double kMostAhead = 0.7;    ///< sine of the angle between the way to it and sideways
constexpr double kLeastCosine = 0.3;  ///< between the pixels of the view and the rectified camera
constexpr double kMostPixels = 4;     ///< of the rectified picture, times those of the view

/// Two cameras of one rotation, the other to the right: what the first sees at (u, v) at depth z
/// the other sees at (u - focal * baseline / z + offset, v).
struct Rectified {
  Camera reference, other;
  double baseline = 0;         ///< scene units
  int offset = 0;              ///< px
  double least = 0, most = 0;  ///< of focal * baseline / z over the view and its range of depths
};

std::array<Eigen::Vector2d, 4> corners(const Camera& camera) {
  const double right = camera.width - 1, bottom = camera.height - 1;
  return {{{0, 0}, {right, 0}, {0, bottom}, {right, bottom}}};
}

/// z of the pixel's point in the rectified camera over that in its own.
double scale_of_depth(const Camera& camera, const Camera& rectified, double u, double v) {
  const Eigen::Vector3d ray((u - camera.centre_u) / camera.focal_u,
                            (v - camera.centre_v) / camera.focal_v, 1);
  return (rectified.rotation * camera.rotation.transpose() * ray).z();
}

/// inverse: depths to search, of the reference. Nothing where the views can't be made a pair.
std::optional<Rectified> rectified(const Camera& reference, const Camera& other,
                                   InverseDepthRange inverse) {
  const Eigen::Vector3d way = other.position() - reference.position();
  Rectified pair;
  pair.baseline = way.norm();
  if (!(pair.baseline > 0) || std::abs(way.dot(reference.direction())) > kMostAhead * pair.baseline)
    return {};
  Eigen::Matrix3d rotation = rectifying_rotation(reference.rotation, way);
  if (rotation.row(0) * way < 0) rotation.topRows<2>() *= -1;

  Camera& turned = pair.reference;
  turned.rotation = rotation;
  turned.translation = -rotation * reference.position();
  turned.focal_u = turned.focal_v = reference.focal_u;
  Eigen::AlignedBox2d box;
  double least_scale = 1e9, most_scale = 0;
  for (const Eigen::Vector2d& corner : corners(reference)) {
    const double scale = scale_of_depth(reference, turned, corner.x(), corner.y());
    if (!(scale > kLeastCosine)) return {};
    least_scale = std::min(least_scale, scale);
    most_scale = std::max(most_scale, scale);
    box.extend(turned.project(reference.back_project(corner.x(), corner.y(), 1)).head<2>().eval());
  }
  const Eigen::Vector2d size = box.sizes().array().ceil() + 1;
  if (size.prod() > kMostPixels * reference.width * reference.height) return {};
  turned.width = int(size.x());
  turned.height = int(size.y());
  turned.centre_u = -box.min().x();
  turned.centre_v = -box.min().y();

  pair.least = turned.focal_u * pair.baseline * inverse.min / most_scale;
  pair.most = turned.focal_u * pair.baseline * inverse.max / least_scale;
  pair.offset = int(std::floor(pair.least));
  pair.other = turned;
  pair.other.translation = -rotation * other.position();
  pair.other.centre_u += pair.offset;
  return pair;
}

cv::Mat turned_picture(const cv::Mat& picture, const Camera& from, const Camera& to, int how,
                       int border) {
  cv::Mat homography, result;
  cv::eigen2cv(homography_between(to, from), homography);
  cv::warpPerspective(picture, result, homography, {to.width, to.height},
                      how | cv::WARP_INVERSE_MAP, border);
  return result;
}

Pair read_pair(const Problem& problem, int other, const Rectified& views) {
  const std::vector<Camera>& cameras = problem.light_field.cameras;
  cv::Mat shown;
  const cv::Mat reference = picture_of(problem.light_field, problem.view, &shown);
  Pair pair;
  pair.reference = turned_picture(reference, cameras[problem.view], views.reference,
                                  cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  pair.other = turned_picture(picture_of(problem.light_field, other), cameras[other], views.other,
                              cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  pair.shown = turned_picture(shown, cameras[problem.view], views.reference, cv::INTER_NEAREST,
                              cv::BORDER_CONSTANT);
  pair.least = int(std::floor(views.least)) - views.offset - 1;
  pair.most = int(std::ceil(views.most)) - views.offset + 1;
  return pair;
}

cv::Mat to_view(const cv::Mat& of_pair, const Problem& problem, const Rectified& views) {
  const LightField& light_field = problem.light_field;
  const Camera& camera = light_field.cameras[problem.view];
  const Eigen::Matrix3d turn = homography_between(camera, views.reference);
  const double unit = disparity_of_inverse_depth(light_field, problem.view) /
                      (views.reference.focal_u * views.baseline);
  cv::Mat result(light_field.height, light_field.width, CV_32F);
  for (int v = 0; v < result.rows; ++v)
    for (int u = 0; u < result.cols; ++u) {
      const Eigen::Vector2d at = (turn * Eigen::Vector3d(u, v, 1)).hnormalized();
      const int x = std::clamp(int(std::lround(at.x())), 0, of_pair.cols - 1),
                y = std::clamp(int(std::lround(at.y())), 0, of_pair.rows - 1);
      result.at<float>(v, u) = float((of_pair.at<float>(y, x) + views.offset) *
                                     scale_of_depth(camera, views.reference, u, v) * unit);
    }
  return result;
}

}  // namespace

std::vector<PairOfViews> pairs_of_cameras(const Problem& problem) {
  const std::vector<Camera>& cameras = problem.light_field.cameras;
  const double unit = disparity_of_inverse_depth(problem.light_field, problem.view);
  const InverseDepthRange inverse{std::max(0.0, problem.range.min / unit),
                                  problem.range.max / unit};
  std::vector<Camera> ranged = cameras;
  for (Camera& camera : ranged) camera.inverse_depth = inverse;
  const UnstructuredSampler sampler(ranged, problem.light_field.most_partners);
  std::vector<std::pair<int, Rectified>> possible;
  for (const int other : sampler.partners(problem.view)) {
    if (other == problem.view) continue;
    if (auto views = rectified(cameras[problem.view], cameras[other], inverse))
      possible.emplace_back(other, *views);
  }
  const auto distance = [](const auto& views) { return views.second.baseline; };
  std::ranges::stable_sort(possible, {}, distance);
  std::vector<double> distances;
  for (const auto& views : possible) distances.push_back(distance(views));
  std::vector<PairOfViews> pairs;
  for (const int i : doubling(distances)) {
    const auto& [other, views] = possible[i];
    pairs.push_back(
        {other, views.most - views.least,
         [problem, other = other, views = views] { return read_pair(problem, other, views); },
         [problem, views = views](const cv::Mat& disparity) {
           return to_view(disparity, problem, views);
         }});
  }
  return pairs;
}

}  // namespace gigaray::baselines
