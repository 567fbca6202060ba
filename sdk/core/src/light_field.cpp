// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
#include "gigaray/core/light_field.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <tuple>

#include "gigaray/core/arguments.h"

namespace gigaray {
namespace {

class PicturesInMemory : public PixelSource {
 public:
  PicturesInMemory(std::vector<Image<std::uint16_t>> pictures, int bit_depth)
      : pictures_(std::move(pictures)), bit_depth_(bit_depth) {}
  Image<std::uint16_t> read(int view_idx) const override {
    require_argument(view_idx >= 0 && std::size_t(view_idx) < pictures_.size(),
                     "view_idx: there is no picture of this view");
    return pictures_[std::size_t(view_idx)];
  }
  int bit_depth() const override { return bit_depth_; }
  bool is_held() const override { return true; }

 private:
  std::vector<Image<std::uint16_t>> pictures_;
  int bit_depth_;
};

class PicturesOfLightField : public PixelSource {
 public:
  PicturesOfLightField(LightField light_field, std::vector<int> which)
      : light_field_(std::move(light_field)), which_(std::move(which)) {}
  Image<std::uint16_t> read(int view_idx) const override {
    require_argument(view_idx >= 0 && std::size_t(view_idx) < which_.size(),
                     "view_idx: there is no picture of this view");
    return read_view(light_field_, which_[std::size_t(view_idx)]);
  }
  bool has_mask() const override { return light_field_.pixels->has_mask(); }
  int bit_depth() const override { return light_field_.pixels->bit_depth(); }
  bool is_held() const override { return light_field_.pixels->is_held(); }
  void let_go(int view_idx) const override {
    light_field_.pixels->let_go(which_.at(std::size_t(view_idx)));
  }

 private:
  LightField light_field_;
  std::vector<int> which_;
};

void check_view(const LightField& light_field, int view_idx) {
  require_argument(light_field.pixels != nullptr, "light_field.pixels: is null");
  if (view_idx < 0 || view_idx >= light_field.num_views())
    throw Error(ErrorCode::kInvalidArgument, "view " + std::to_string(view_idx) + ": there are " +
                                                 std::to_string(light_field.num_views()) +
                                                 " views");
}

[[noreturn]] void bad(const std::string& message) { throw Error(ErrorCode::kBadInput, message); }

double distance(const View& a, const View& b) { return std::hypot(a.s - b.s, a.t - b.t); }

}  // namespace

const char* to_string(LightFieldKind kind) {
  switch (kind) {
    case LightFieldKind::k3D:
      return "3D";
    case LightFieldKind::k4D:
      return "4D";
    case LightFieldKind::kUnstructured:
      return "unstructured";
  }
  return "?";
}

void check(const LightField& light_field) {
  if (!light_field.pixels) bad("the light field has no pixels");
  if (light_field.width < 1 || light_field.height < 1) bad("the pictures are empty");
  if (light_field.num_views() < 2) bad("a light field needs two views or more, there is only one");
  std::set<std::string> names;
  std::set<std::pair<double, double>> places;
  for (const View& view : light_field.views) {
    if (!std::isfinite(view.s) || !std::isfinite(view.t))
      bad("view " + view.name + ": its position is not a finite number");
    if (!names.insert(view.name).second) bad("two views are named " + view.name);
    if (light_field.kind != LightFieldKind::kUnstructured &&
        !places.insert({view.s, view.t}).second)
      bad("view " + view.name + " stands at the same position as another view");
  }
  if (light_field.kind != LightFieldKind::kUnstructured) return;
  if (light_field.cameras.size() != light_field.views.size())
    bad("an unstructured light field needs a camera for every view");
  for (std::size_t i = 0; i < light_field.views.size(); ++i) {
    const Camera& camera = light_field.cameras[i];
    check(camera, "view " + light_field.views[i].name);
    if (camera.width > light_field.width || camera.height > light_field.height)
      bad("view " + light_field.views[i].name + ": its camera is larger than the light field");
  }
}

Image<std::uint16_t> read_view(const LightField& light_field, int view_idx) {
  check_view(light_field, view_idx);
  Image<std::uint16_t> picture = light_field.pixels->read(view_idx);
  const auto size = [](int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
  };
  const int channels = light_field.pixels->has_mask() ? 4 : 3;
  if (picture.width() != light_field.width || picture.height() != light_field.height ||
      picture.channels() != channels)
    bad("view " + light_field.views[view_idx].name + " is " +
        size(picture.width(), picture.height()) + ", the others are " +
        size(light_field.width, light_field.height));
  return picture;
}

std::shared_ptr<const PixelSource> pictures_of(LightField light_field, std::vector<int> which) {
  for (const int view : which) check_view(light_field, view);
  return std::make_shared<PicturesOfLightField>(std::move(light_field), std::move(which));
}

LightField without(LightField light_field, const std::vector<int>& views) {
  if (views.empty()) return light_field;
  for (const int view : views) check_view(light_field, view);
  require_argument(
      light_field.cameras.empty() || light_field.cameras.size() == light_field.views.size(),
      "light_field.cameras: one for each view is needed");
  LightField rest = light_field;
  rest.views.clear();
  rest.cameras.clear();
  std::vector<int> kept;
  for (int i = 0; i < light_field.num_views(); ++i) {
    if (std::find(views.begin(), views.end(), i) != views.end()) {
      rest.left_out.push_back(light_field.views[i]);
      light_field.pixels->let_go(i);
      continue;
    }
    kept.push_back(i);
    rest.views.push_back(light_field.views[i]);
    if (!light_field.cameras.empty()) rest.cameras.push_back(light_field.cameras[i]);
  }
  if (kept.size() < 2)
    throw Error(ErrorCode::kInvalidArgument,
                "views to leave out: two views or more must be left of " +
                    std::to_string(light_field.num_views()));
  rest.pixels = pictures_of(std::move(light_field), std::move(kept));
  return rest;
}

std::optional<Mask> take_mask(Image<std::uint16_t>& picture) {
  if (picture.channels() < 4) return std::nullopt;
  const int width = picture.width(), height = picture.height();
  Image<std::uint16_t> colours(width, height, 3);
  Mask mask(width, height);
  for (int v = 0; v < height; ++v)
    for (int u = 0; u < width; ++u) {
      for (int c = 0; c < 3; ++c) colours(u, v, c) = picture(u, v, c);
      mask(u, v) = picture(u, v, 3) > 0;
    }
  picture = std::move(colours);
  return mask;
}

std::vector<int> views_from_centre(const LightField& light_field) {
  std::vector<int> order(light_field.views.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int i) {
    const View& view = light_field.views[i];
    // Rounded, so that rounding errors of measured positions don't decide between mirror images.
    const double radius = std::round(1e6 * std::hypot(view.s, view.t));
    return std::tuple(radius, view.s, view.t);
  };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  return order;
}

int centre_view(const LightField& light_field) {
  require_argument(!light_field.views.empty(), "views: there are none");
  return views_from_centre(light_field).front();
}

double normalise_positions(std::vector<View>& views) {
  require_argument(views.size() >= 2, "views: two or more are needed");
  const auto [s_min, s_max] = std::minmax_element(
      views.begin(), views.end(), [](const View& a, const View& b) { return a.s < b.s; });
  const auto [t_min, t_max] = std::minmax_element(
      views.begin(), views.end(), [](const View& a, const View& b) { return a.t < b.t; });
  const double s_mid = (s_min->s + s_max->s) / 2;
  const double t_mid = (t_min->t + t_max->t) / 2;

  std::vector<double> nearest(views.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < views.size(); ++i)
    for (std::size_t j = 0; j < views.size(); ++j)
      if (i != j) nearest[i] = std::min(nearest[i], distance(views[i], views[j]));
  std::nth_element(nearest.begin(), nearest.begin() + nearest.size() / 2, nearest.end());
  const double step = nearest[nearest.size() / 2];
  if (!(step > 0)) bad("the positions of the views are all the same");
  for (View& view : views) {
    view.s = (view.s - s_mid) / step;
    view.t = (view.t - t_mid) / step;
  }
  return step;
}

double place_by_cameras(LightField& light_field) {
  const auto count = Eigen::Index(light_field.cameras.size());
  require_argument(count >= 2 && light_field.cameras.size() == light_field.views.size(),
                   "cameras: two or more are needed, one for each view");
  Eigen::Matrix3Xd positions(3, count);
  for (Eigen::Index i = 0; i < count; ++i)
    positions.col(i) = light_field.cameras[std::size_t(i)].position();

  // Cameras at one place, as those of exposure brackets, are no neighbours.
  constexpr double kSamePlace = 1e-6;  // of the spread
  const double same =
      kSamePlace * (positions.rowwise().maxCoeff() - positions.rowwise().minCoeff()).norm();
  std::vector<double> nearest;
  for (Eigen::Index i = 0; i < count; ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index j = 0; j < count; ++j)
      if (const double away = (positions.col(i) - positions.col(j)).norm(); away > same)
        least = std::min(least, away);
    if (std::isfinite(least)) nearest.push_back(least);
  }
  if (nearest.empty())
    bad("the cameras all stand at one place: there is no parallax to see depth by");
  const auto middle_one = nearest.begin() + std::ptrdiff_t(nearest.size() / 2);
  std::nth_element(nearest.begin(), middle_one, nearest.end());
  const double step = *middle_one;

  const Eigen::Vector3d middle = positions.rowwise().mean();
  positions.colwise() -= middle;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(positions * positions.transpose());
  // Signs that don't depend on the solver: the larger component positive.
  const auto axis = [&](int column) {
    Eigen::Vector3d direction = spread.eigenvectors().col(column);
    Eigen::Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    return Eigen::Vector3d(direction * (direction[largest] < 0 ? -1 : 1));
  };
  const Eigen::Vector3d first = axis(2), second = axis(1);
  for (Eigen::Index i = 0; i < count; ++i) {
    View& view = light_field.views[std::size_t(i)];
    view.s = first.dot(positions.col(i)) / step;
    view.t = second.dot(positions.col(i)) / step;
  }
  return step;
}

LightFieldKind kind_from_positions(const std::vector<View>& views) {
  const bool one_row = std::all_of(views.begin(), views.end(),
                                   [&](const View& view) { return view.t == views.front().t; });
  return one_row ? LightFieldKind::k3D : LightFieldKind::k4D;
}

std::shared_ptr<const PixelSource> pixels_in_memory(std::vector<Image<std::uint16_t>> pictures,
                                                    int bit_depth) {
  require_argument(bit_depth >= 1 && bit_depth <= 16, "bit_depth: must be between 1 and 16");
  return std::make_shared<PicturesInMemory>(std::move(pictures), bit_depth);
}

}  // namespace gigaray
