// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Gigaray authors
// COLMAP's camera models, https://colmap.github.io/cameras.html: OpenCV's radial, tangential and
// rational distortion; its fisheye (Kannala and Brandt 2006); FOV (Devernay and Faugeras 2001);
// thin prism (Weng et al. 1992); Fisheye624 of Project Aria; division (Fitzgibbon 2001); enhanced
// unified (Khomutenko et al. 2016). All but FOV, division and EUCM are one formula with some
// coefficients at 0, of the direction itself or of the direction at the length of its angle.
#include "gigaray/adapters/lens.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <unsupported/Eigen/AutoDiff>

#include "files/text.h"
#include "gigaray/core/arguments.h"
#include "gigaray/core/error.h"

namespace gigaray {
namespace {

using Eigen::Vector2d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Model {
  const char* name;
  int num_focals;  // 1: one for both axes
  int num_distortion;
  bool fisheye;
  int num_params() const { return num_focals + 2 + num_distortion; }
};

// In the order of COLMAP's numbers.
constexpr std::array<Model, 17> kModels{{{"SIMPLE_PINHOLE", 1, 0, false},
                                         {"PINHOLE", 2, 0, false},
                                         {"SIMPLE_RADIAL", 1, 1, false},
                                         {"RADIAL", 1, 2, false},
                                         {"OPENCV", 2, 4, false},
                                         {"OPENCV_FISHEYE", 2, 4, true},
                                         {"FULL_OPENCV", 2, 8, false},
                                         {"FOV", 2, 1, false},
                                         {"SIMPLE_RADIAL_FISHEYE", 1, 1, true},
                                         {"RADIAL_FISHEYE", 1, 2, true},
                                         {"THIN_PRISM_FISHEYE", 2, 8, true},
                                         {"RAD_TAN_THIN_PRISM_FISHEYE", 2, 12, true},
                                         {"SIMPLE_DIVISION", 1, 1, false},
                                         {"DIVISION", 2, 1, false},
                                         {"SIMPLE_FISHEYE", 1, 0, true},
                                         {"FISHEYE", 2, 0, true},
                                         {"EUCM", 2, 2, false}}};
/// COLMAP's number 17, and what a branch of it calls the same.
constexpr std::array<const char*, 2> kPanoramas{"EQUIRECTANGULAR", "SPHERICAL"};

const Model* find_model(const std::string& name) {
  const auto found = std::find_if(kModels.begin(), kModels.end(),
                                  [&](const Model& model) { return name == model.name; });
  return found == kModels.end() ? nullptr : &*found;
}

const Model& model_of(const Lens& lens) {
  const Model* model = find_model(lens.model);
  require_argument(model && int(lens.params.size()) == model->num_params(),
                   "lens: is of no known model, or has another number of parameters");
  return *model;
}

// Coefficients of a polynomial, lowest power first.
using Polynomial = Eigen::VectorXd;

Polynomial product(const Polynomial& a, const Polynomial& b) {
  Polynomial result = Polynomial::Zero(a.size() + b.size() - 1);
  for (Eigen::Index i = 0; i < a.size(); ++i) result.segment(i, b.size()) += a[i] * b;
  return result;
}

// t · p'(t)
Polynomial slope_times_t(const Polynomial& p) {
  return p.cwiseProduct(Polynomial::LinSpaced(p.size(), 0, double(p.size() - 1)));
}

// Infinity when there is none.
double smallest_positive_root(const Polynomial& p) {
  Eigen::Index degree = p.size() - 1;
  while (degree > 0 && p[degree] == 0) --degree;
  if (degree == 0) return kInfinity;
  Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(degree, degree);
  companion.diagonal(-1).setOnes();
  companion.col(degree - 1) = -p.head(degree) / p[degree];
  const Eigen::VectorXcd roots = companion.eigenvalues();
  double smallest = kInfinity;
  for (const auto& root : roots)
    if (root.real() > 0 && std::abs(root.imag()) < 1e-9 * std::abs(root.real()))
      smallest = std::min(smallest, root.real());
  return smallest;
}

// Σ coefficients[i] t^(i+1)
template <class T, std::size_t N>
T series(const std::array<double, N>& coefficients, const T& t) {
  T sum = t * coefficients[N - 1];
  for (std::size_t i = N - 1; i-- > 0;) sum = (sum + coefficients[i]) * t;
  return sum;
}

}  // namespace

const std::vector<std::string>& lens_models() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Model& model : kModels) all.emplace_back(model.name);
    return all;
  }();
  return names;
}

int num_lens_params(const std::string& model) {
  const Model* found = find_model(model);
  return found ? found->num_params() : 0;
}

void check(const Lens& lens, const std::string& where) {
  const auto bad = [&](const std::string& what) {
    throw Error(ErrorCode::kBadInput, where + ": " + what);
  };
  if (std::find(kPanoramas.begin(), kPanoramas.end(), lens.model) != kPanoramas.end())
    bad("the camera model " + lens.model +
        " is that of a panorama, which no pinhole camera can show; cut the panoramas into pictures "
        "before COLMAP finds the cameras");
  const Model* model = find_model(lens.model);
  if (!model)
    bad("the camera model " + in_quotes(lens.model) +
        " is unknown; those of COLMAP 3.8 to 4 are known. `colmap image_undistorter` makes a model "
        "with pinhole cameras");
  if (int(lens.params.size()) != model->num_params())
    bad("the camera model " + lens.model + " has " + std::to_string(model->num_params()) +
        " parameters, here are " + std::to_string(lens.params.size()));
  constexpr int kMaxSize = 1 << 20;  // px
  if (lens.width < 1 || lens.height < 1 || lens.width > kMaxSize || lens.height > kMaxSize)
    bad("a picture of " + std::to_string(lens.width) + "×" + std::to_string(lens.height) +
        " px is none");
  if (!std::all_of(lens.params.begin(), lens.params.end(),
                   [](double x) { return std::isfinite(x); }))
    bad("a parameter of the camera is not a finite number");
  // Half a degree of view to nearly 180 degrees.
  constexpr double kLeast = 0.01, kMost = 100;
  const double longer = std::max(lens.width, lens.height);
  for (int i = 0; i < model->num_focals; ++i)
    if (!(lens.params[i] >= kLeast * longer && lens.params[i] <= kMost * longer))
      bad("a focal length of " + std::to_string(lens.params[i]) + " px for a picture of " +
          std::to_string(lens.width) + "×" + std::to_string(lens.height) + " px is absurd");
  for (int i = model->num_focals; i < model->num_focals + 2; ++i)
    if (std::abs(lens.params[i]) > 10 * longer)
      bad("a principal point at " + std::to_string(lens.params[i]) + " px is absurd");
  if (lens.model == "FOV" && std::abs(lens.params[4]) >= std::numbers::pi)
    bad("a field of view of 180 degrees or more is absurd");
  if (lens.model == "EUCM" && !(lens.params[4] >= 0 && lens.params[4] <= 1 && lens.params[5] > 0))
    bad("EUCM has an alpha from 0 to 1 and a beta above 0, here are " +
        std::to_string(lens.params[4]) + " and " + std::to_string(lens.params[5]));
}

Lens centred_pinhole(int width, int height, double focal) {
  return {"SIMPLE_PINHOLE", width, height, {focal, width / 2.0, height / 2.0}};
}

Lens pinhole_lens(const Camera& camera) {
  constexpr double kCorner = 0.5;  // Lens has pixel corners at integers
  return {"PINHOLE",
          camera.width,
          camera.height,
          {camera.focal_u, camera.focal_v, camera.centre_u + kCorner, camera.centre_v + kCorner}};
}

bool is_pinhole(const Lens& lens) {
  const Model& model = model_of(lens);
  if (lens.model == "EUCM") return lens.params[4] == 0;
  return !model.fisheye && std::all_of(lens.params.end() - model.num_distortion, lens.params.end(),
                                       [](double x) { return x == 0; });
}

std::optional<Vector2d> distort(const Lens& lens, const Vector2d& direction) {
  return LensMap(lens).distort(direction);
}

std::optional<Vector2d> undistort(const Lens& lens, const Vector2d& pixel) {
  return LensMap(lens).undistort(pixel);
}

LensMap::LensMap(const Lens& lens) : LensMap(lens, lens.width, lens.height) {}

LensMap::LensMap(const Lens& lens, int width, int height) {
  const Model& model = model_of(lens);
  require_argument(lens.width > 0 && lens.height > 0 && width > 0 && height > 0,
                   "lens: width and height must be above 0");
  const auto* params = lens.params.data();
  const Vector2d scale(double(width) / lens.width, double(height) / lens.height);
  focal_ = scale.cwiseProduct(Vector2d(params[0], params[model.num_focals - 1]));
  const Vector2d centre(params[model.num_focals], params[model.num_focals + 1]);
  centre_ = scale.cwiseProduct(centre) - Vector2d(0.5, 0.5);
  projection_ = model.fisheye ? Projection::kFisheye : Projection::kPerspective;
  set_distortion(lens);
  find_limit();
}

void LensMap::set_distortion(const Lens& lens) {
  const Model& model = model_of(lens);
  const double* k = lens.params.data() + model.num_focals + 2;
  const std::string& name = lens.model;
  if (name == "FOV") {
    field_of_view_ = std::abs(k[0]);
    // Below, the formula is a pinhole to the last digit, but divides by nothing.
    if (field_of_view_ > 1e-8) projection_ = Projection::kFieldOfView;
  } else if (name == "SIMPLE_DIVISION" || name == "DIVISION") {
    projection_ = Projection::kDivision;
    division_ = k[0];
  } else if (name == "EUCM") {
    projection_ = Projection::kUnified;
    alpha_ = k[0];
    beta_ = k[1];
  } else if (name == "OPENCV" || name == "FULL_OPENCV" || name == "THIN_PRISM_FISHEYE") {
    above_ = {k[0], k[1]};
    p1_ = k[2];
    p2_ = k[3];
    if (name == "FULL_OPENCV") {
      above_[2] = k[4];
      below_ = {k[5], k[6], k[7]};
    } else if (name == "THIN_PRISM_FISHEYE") {
      above_[2] = k[4];
      above_[3] = k[5];
      prism_ = {k[6], 0, k[7], 0};
    }
  } else if (name == "RAD_TAN_THIN_PRISM_FISHEYE") {
    std::copy_n(k, 6, above_.begin());
    p2_ = k[6];  // Aria's p0 is along u
    p1_ = k[7];
    std::copy_n(k + 8, 4, prism_.begin());
    radial_comes_first_ = true;
  } else {
    std::copy_n(k, model.num_distortion, above_.begin());
  }
}

// With t = r², r·A(t)/B(t) rises as long as A·B + 2t(A'·B − A·B') is positive; it is 1 at 0.
void LensMap::find_limit() {
  Polynomial above(1 + above_.size()), below(1 + below_.size());
  above << 1, Eigen::Map<const Eigen::VectorXd>(above_.data(), Eigen::Index(above_.size()));
  below << 1, Eigen::Map<const Eigen::VectorXd>(below_.data(), Eigen::Index(below_.size()));
  const Polynomial slope = product(above, below) + 2 * product(slope_times_t(above), below) -
                           2 * product(above, slope_times_t(below));
  limit_ = std::sqrt(std::min(smallest_positive_root(slope), smallest_positive_root(below)));
}

double LensMap::radial(double r) const {
  const double t = r * r;
  return r * (1 + series(above_, t)) / (1 + series(below_, t));
}

template <class T>
void LensMap::bend(const T& x, const T& y, T& u, T& v) const {
  T t = x * x + y * y;
  const T above = series(above_, t), below = series(below_, t);
  const T factor = (above + 1.0) / (below + 1.0);
  u = x * factor;
  v = y * factor;
  const T a = radial_comes_first_ ? u : x, b = radial_comes_first_ ? v : y;
  t = a * a + b * b;
  u += 2 * p1_ * a * b + p2_ * (t + 2 * a * a) + (prism_[0] + prism_[1] * t) * t;
  v += 2 * p2_ * a * b + p1_ * (t + 2 * b * b) + (prism_[2] + prism_[3] * t) * t;
}

std::optional<Vector2d> LensMap::distort(const Vector2d& direction) const {
  const double r = direction.norm();
  if (!std::isfinite(r)) return std::nullopt;
  Vector2d seen = direction;
  if (projection_ == Projection::kFieldOfView) {
    if (r > 0) seen *= std::atan(2 * r * std::tan(field_of_view_ / 2)) / (r * field_of_view_);
  } else if (projection_ == Projection::kDivision) {
    const double square = 1 - 4 * division_ * r * r;
    if (!(square > 0)) return std::nullopt;
    seen *= 2 / (1 + std::sqrt(square));
  } else if (projection_ == Projection::kUnified) {
    seen /= alpha_ * std::sqrt(beta_ * r * r + 1) + 1 - alpha_;
  } else {
    const double length = projection_ == Projection::kFisheye ? std::atan(r) : r;
    if (length >= limit_) return std::nullopt;
    const Vector2d at = r > 0 ? Vector2d(direction * (length / r)) : direction;
    bend(at.x(), at.y(), seen.x(), seen.y());
  }
  return Vector2d(focal_.cwiseProduct(seen) + centre_);
}

std::optional<Vector2d> LensMap::undistort(const Vector2d& pixel) const {
  const Vector2d seen = (pixel - centre_).cwiseQuotient(focal_);
  const double r = seen.norm();
  if (!std::isfinite(r)) return std::nullopt;
  constexpr double kRightAngle = std::numbers::pi / 2;
  if (projection_ == Projection::kFieldOfView) {
    const double angle = r * field_of_view_;
    if (angle >= kRightAngle) return std::nullopt;
    const double length = std::tan(angle) / (2 * std::tan(field_of_view_ / 2));
    return r > 0 ? Vector2d(seen * (length / r)) : seen;
  }
  if (projection_ == Projection::kDivision || projection_ == Projection::kUnified) {
    const double ahead =
        projection_ == Projection::kDivision ? ahead_of_divided(r * r) : ahead_of_unified(r * r);
    return ahead > 0 ? std::optional<Vector2d>(seen / ahead) : std::nullopt;
  }
  std::optional<Vector2d> at = unbend(seen);
  if (!at || projection_ == Projection::kPerspective) return at;
  const double angle = at->norm();
  if (angle >= kRightAngle) return std::nullopt;
  return angle > 0 ? Vector2d(*at * (std::tan(angle) / angle)) : at;
}

// Where the picture is bent inwards it folds back at the root of 1 / division_.
double LensMap::ahead_of_divided(double square) const {
  return division_ * square < 1 ? 1 + division_ * square : 0;
}

double LensMap::ahead_of_unified(double square) const {
  const double bent = beta_ * square, root = 1 - (2 * alpha_ - 1) * bent;
  if (!(root >= 0)) return 0;
  return (1 - alpha_ * alpha_ * bent) / (alpha_ * std::sqrt(root) + 1 - alpha_);
}

// The radial part is inverted by bisection, which always finds it; Newton's iteration on the whole
// goes on from there.
std::optional<Vector2d> LensMap::unbend(const Vector2d& seen) const {
  constexpr int kHalvings = 60, kIterations = 50;
  constexpr double kPrecision = 1e-12;
  const double wanted = seen.norm();
  double low = 0, high = std::min(limit_, std::max(1.0, 2 * wanted));
  while (radial(high) < wanted && high < limit_ && high < 1e6) high = std::min(limit_, 2 * high);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (low + high) / 2;
    (radial(middle) < wanted ? low : high) = middle;
  }
  Vector2d at = wanted > 0 ? Vector2d(seen * (low / wanted)) : seen;

  using Dual = Eigen::AutoDiffScalar<Vector2d>;
  for (int i = 0; i < kIterations; ++i) {
    Dual u, v;
    bend(Dual(at.x(), 2, 0), Dual(at.y(), 2, 1), u, v);
    const Vector2d residual(u.value() - seen.x(), v.value() - seen.y());
    Eigen::Matrix2d slope;
    slope << u.derivatives().transpose(), v.derivatives().transpose();
    // Mirrored: the picture folds back here.
    if (!(slope.determinant() > 0) || at.norm() >= limit_) return std::nullopt;
    if (residual.norm() <= kPrecision * (1 + wanted)) return at;
    Vector2d step = slope.inverse() * residual;
    if (!step.allFinite()) return std::nullopt;
    while ((at - step).norm() >= limit_ && step.norm() > kPrecision) step /= 2;
    at -= step;
  }
  return std::nullopt;
}

}  // namespace gigaray
