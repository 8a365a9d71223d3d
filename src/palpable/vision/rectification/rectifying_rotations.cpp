// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/rectifying_rotations.hpp"

#include "palpable/vision/rectification/least_squares.hpp"
#include "palpable/vision/stereo/problem/matrix3.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <tuple>
#include <utility>

#include <opencv2/calib3d.hpp>

namespace palpable::vision {
namespace {

cv::Matx33d rotation(double about_x, double about_y, double about_z) {
  cv::Matx33d r;
  cv::Rodrigues(cv::Vec3d(about_x, about_y, about_z), r);
  return r;
}

cv::Matx33d matrix_of(const SharedCamera& camera, double focal_px) {
  return {focal_px, 0, camera.cx, 0, focal_px, camera.cy, 0, 0, 1};
}

/// Rotations of the left camera about y and z, of the right one about x, y and z (radians), the logarithm of
/// the focal length over the camera's, and the lenses' distortion at a distance of cx from the centre.
constexpr int kUnknowns = 7;
using Unknowns = cv::Vec<double, kUnknowns>;
constexpr int kDistortion = 6;

RectifyingTransform transform_of(const Unknowns& at, const SharedCamera& camera) {
  const cv::Matx33d matrix =
      matrix_of(camera, camera.known ? camera.focal_px : std::exp(at[5]) * camera.focal_px);
  const cv::Matx33d back = matrix.inv();
  return {array_of(matrix * rotation(0, at[0], at[1]) * back),
          array_of(matrix * rotation(at[2], at[3], at[4]) * back), at[kDistortion] / (camera.cx * camera.cx),
          camera.cx, camera.cy};
}

/// Vertical distance of a match's two points after rectification.
double rise_px(const RectifyingTransform& by, const FeatureMatch& m) {
  return rectified_point(by, by.left, {m.left_x, m.left_y}).y -
         rectified_point(by, by.right, {m.right_x, m.right_y}).y;
}

bool same_place(const FeatureMatch& a, const FeatureMatch& b) {
  return a.left_x == b.left_x && a.left_y == b.left_y;
}

/// Calls `visit` once for every point of the left picture, with its match of least vertical distance and that
/// distance in pixels.
template <class Visit>
void visit_places(const std::vector<FeatureMatch>& matches, const RectifyingTransform& by,
                  const Visit& visit) {
  for (auto first = matches.begin(); first != matches.end();) {
    auto nearest = first;
    double least_px = std::abs(rise_px(by, *first));
    auto next = first + 1;
    for (; next != matches.end() && same_place(*next, *first); ++next)
      if (const double rise = std::abs(rise_px(by, *next)); rise < least_px) {
        least_px = rise;
        nearest = next;
      }
    visit(*nearest, least_px);
    first = next;
  }
}

/// The models, simplest first: the right picture is shifted vertically and rotated in its plane; both cameras
/// are rotated; in addition both lenses are distorted.
enum class Model { in_plane, rotations, distorted };

/// The input of an estimate.
struct Problem {
  const std::vector<FeatureMatch>& matches;
  SharedCamera camera;
  Model model;
  double tolerance_px;
  const RotationSearchOptions& options;
};

/// The row of the linear system for one match, in the order of Unknowns: for small rotations and distortion
/// y_left - y_right is linear in them. The focal length has no linear term.
Unknowns factors_of(const FeatureMatch& m, const SharedCamera& camera) {
  const double f = camera.focal_px, xl = m.left_x - camera.cx, yl = m.left_y - camera.cy,
               xr = m.right_x - camera.cx, yr = m.right_y - camera.cy,
               far_left = (xl * xl + yl * yl) / (camera.cx * camera.cx),
               far_right = (xr * xr + yr * yr) / (camera.cx * camera.cx);
  return {xl * yl / f, xl, f + yr * yr / f, -xr * yr / f, -xr, 0.0, far_right * yr - far_left * yl};
}

/// The linearised solution for a few matches, regularised by the prior.
Unknowns linear_solution(std::span<const FeatureMatch> matches, const Problem& problem) {
  using Matrix = cv::Matx<double, kUnknowns, kUnknowns>;
  Matrix normal = Matrix::zeros();
  for (int i = 0; i < kUnknowns; ++i) {
    const double prior = problem.options.prior_px[static_cast<std::size_t>(i)];
    normal(i, i) = prior * prior;
  }
  Unknowns right = Unknowns::all(0.0);
  for (const FeatureMatch& m : matches) {
    Unknowns row = factors_of(m, problem.camera);
    if (problem.model != Model::distorted) row[kDistortion] = 0.0;
    normal += row * row.t();
    right -= (m.left_y - m.right_y) * row;
  }
  return normal.solve(right, cv::DECOMP_CHOLESKY);
}

/// The cost of a transform: truncated squares of the vertical distances (MSAC).
double truncated_squares(const std::vector<FeatureMatch>& matches, const RectifyingTransform& by,
                         double tolerance_px) {
  double sum = 0.0;
  visit_places(matches, by, [&](const FeatureMatch&, double rise) {
    sum += std::min(rise * rise, tolerance_px * tolerance_px);
  });
  return sum;
}

struct Start {
  Unknowns at;
  double cost;
};

/// Starting points of the search: the best solutions from random samples of matches, best first. Half of the
/// samples have three matches, which rotate the right camera alone.
std::vector<Start> starts_of(const Problem& problem, std::uint64_t seed) {
  const auto starts = static_cast<std::size_t>(problem.options.refined_starts);
  // The first estimate allows for distortion and for rotations that are not small.
  const double tolerance_px = 2.0 * problem.tolerance_px;
  std::mt19937_64 random(seed);
  std::vector<FeatureMatch> scored = problem.matches;
  std::shuffle(scored.begin(), scored.end(), random);
  scored.resize(std::min(scored.size(), static_cast<std::size_t>(problem.options.scored_matches)));
  std::sort(scored.begin(), scored.end(), [](const FeatureMatch& a, const FeatureMatch& b) {
    return std::tie(a.left_x, a.left_y, a.right_x) < std::tie(b.left_x, b.left_y, b.right_x);
  });
  std::vector<Start> best;
  const auto consider = [&](const Unknowns& at) {
    const double cost = truncated_squares(scored, transform_of(at, problem.camera), tolerance_px);
    if (best.size() == starts && cost >= best.back().cost) return;
    const auto place =
        std::upper_bound(best.begin(), best.end(), cost, [](double c, const Start& s) { return c < s.cost; });
    best.insert(place, {at, cost});
    if (best.size() > starts) best.pop_back();
  };
  // The pair may be rectified already.
  consider(Unknowns::all(0.0));
  // A match for each of the model's unknowns.
  const std::size_t large = problem.model == Model::distorted ? 6 : 5;
  std::array<FeatureMatch, 6> sample{};
  for (int trial = 0; trial < problem.options.trials; ++trial) {
    for (FeatureMatch& m : sample) m = problem.matches[random() % problem.matches.size()];
    const Unknowns at = linear_solution(std::span(sample).first(trial % 2 == 0 ? 3 : large), problem);
    if (cv::norm(at, cv::NORM_INF) <= problem.options.most_rotation) consider(at);
  }
  return best;
}

/// The least-squares solution over `matches` and the prior.
Unknowns refined(const Unknowns& from, const std::vector<FeatureMatch>& matches, const SharedCamera& camera,
                 const Unknowns& prior_px) {
  const auto residuals = [&](const Unknowns& at) {
    const RectifyingTransform by = transform_of(at, camera);
    std::vector<double> out;
    out.reserve(matches.size() + kUnknowns);
    for (const FeatureMatch& m : matches) out.push_back(rise_px(by, m));
    for (int i = 0; i < kUnknowns; ++i) out.push_back(prior_px[i] * at[i]);
    return out;
  };
  return least_squares<kUnknowns>(residuals, from);
}

/// The prior of the problem's model: unknowns that it does not have are held at 0.
Unknowns prior_of(const Problem& problem) {
  constexpr double kFixed = 1e6;
  Unknowns prior_px(problem.options.prior_px.data());
  if (problem.model != Model::distorted) prior_px[kDistortion] = kFixed;
  if (problem.model == Model::in_plane)
    for (const int other : {0, 1, 3, 5}) prior_px[other] = kFixed;
  return prior_px;
}

RectifyingRotations estimate(Problem problem, std::uint64_t seed) {
  const auto least_matches = static_cast<std::size_t>(problem.options.least_matches);
  const Unknowns prior_px = prior_of(problem);
  // With a very long focal length a tilt only shifts the picture.
  if (problem.model == Model::in_plane) problem.camera.focal_px *= 1000.0;
  RectifyingRotations out;
  double least = std::numeric_limits<double>::infinity();
  for (const Start& start : starts_of(problem, seed)) {
    Unknowns at = start.at;
    std::vector<FeatureMatch> inliers;
    for (const double loosened : problem.options.round_tolerances) {
      inliers =
          inliers_of(problem.matches, transform_of(at, problem.camera), loosened * problem.tolerance_px);
      if (inliers.size() < least_matches) break;
      at = refined(at, inliers, problem.camera, prior_px);
    }
    const RectifyingTransform transform = transform_of(at, problem.camera);
    const double cost = truncated_squares(problem.matches, transform, problem.tolerance_px);
    inliers = inliers_of(problem.matches, transform, problem.tolerance_px);
    if (inliers.size() < least_matches || cost >= least) continue;
    least = cost;
    out = {transform, std::move(inliers)};
  }
  return out;
}

/// Whether a simpler model is as good: nearly as many inliers with nearly the same residual.
bool as_good(const RectifyingRotations& simple, const RectifyingRotations& rich, double tolerance_px,
             const RotationSearchOptions& options) {
  const double simple_px = vertical_rms_px(rectified_matches(simple.inliers, simple.transform)),
               rich_px = vertical_rms_px(rectified_matches(rich.inliers, rich.transform));
  return static_cast<double>(simple.inliers.size()) >=
             options.simple_matches_share * static_cast<double>(rich.inliers.size()) &&
         !simple.inliers.empty() &&
         simple_px <=
             std::max(options.simple_residual_share * tolerance_px, options.simple_residual_ratio * rich_px);
}

}  // namespace

SharedCamera unknown_camera(int width, int height) {
  return {static_cast<double>(width + height), (width - 1) / 2.0, (height - 1) / 2.0, false};
}

RectifyingRotations find_rectifying_rotations(const std::vector<FeatureMatch>& matches,
                                              const SharedCamera& camera, double tolerance_px,
                                              std::uint64_t seed, const RotationSearchOptions& options) {
  if (static_cast<int>(matches.size()) < options.least_matches) return {};
  const auto by_model = [&](Model model) {
    return estimate({matches, camera, model, tolerance_px, options}, seed);
  };
  RectifyingRotations rotations = by_model(Model::rotations);
  // A known camera is undistorted already, and its rotations are estimated without a simpler model.
  if (camera.known) return rotations;
  if (static_cast<int>(rotations.inliers.size()) >= options.least_for_distortion) {
    RectifyingRotations distorted = by_model(Model::distorted);
    if (!as_good(rotations, distorted, tolerance_px, options)) return distorted;
  }
  RectifyingRotations in_plane = by_model(Model::in_plane);
  return as_good(in_plane, rotations, tolerance_px, options) ? in_plane : rotations;
}

RectifyingRotations find_rough_rotations(const std::vector<FeatureMatch>& matches, const SharedCamera& camera,
                                         double tolerance_px, std::uint64_t seed,
                                         const RotationSearchOptions& options) {
  if (static_cast<int>(matches.size()) < options.least_matches) return {};
  return estimate({matches, camera, Model::in_plane, options.rough_tolerance * tolerance_px, options}, seed);
}

std::vector<FeatureMatch> inliers_of(const std::vector<FeatureMatch>& matches, const RectifyingTransform& by,
                                     double tolerance_px) {
  std::vector<FeatureMatch> out;
  visit_places(matches, by, [&](const FeatureMatch& m, double rise) {
    if (rise <= tolerance_px) out.push_back(m);
  });
  return out;
}

std::vector<FeatureMatch> best_alternatives(const std::vector<FeatureMatch>& matches,
                                            const RectifyingTransform& by) {
  return inliers_of(matches, by, std::numeric_limits<double>::infinity());
}

std::vector<FeatureMatch> rectified_matches(const std::vector<FeatureMatch>& matches,
                                            const RectifyingTransform& by) {
  std::vector<FeatureMatch> out;
  out.reserve(matches.size());
  for (const FeatureMatch& m : matches) {
    const PicturePoint left = rectified_point(by, by.left, {m.left_x, m.left_y}),
                       right = rectified_point(by, by.right, {m.right_x, m.right_y});
    out.push_back({left.x, left.y, right.x, right.y});
  }
  return out;
}

double parallax_rms_px(const std::vector<FeatureMatch>& matches, const SharedCamera& camera) {
  if (matches.empty()) return std::numeric_limits<double>::quiet_NaN();
  // Two shifts in pixels (angles times the focal length), an angle, and the logarithm of the true focal
  // length over the camera's: an assumed one may be far off.
  const auto residuals = [&](const cv::Vec4d& at) {
    const double focal_px = std::exp(at[3]) * camera.focal_px;
    const cv::Matx33d matrix = matrix_of(camera, focal_px);
    const Matrix3 h = array_of(matrix * rotation(at[0] / focal_px, at[1] / focal_px, at[2]) * matrix.inv());
    std::vector<double> out;
    out.reserve(2 * matches.size());
    for (const FeatureMatch& m : matches) {
      const PicturePoint right = mapped(h, {m.right_x, m.right_y});
      out.push_back(m.left_x - right.x);
      out.push_back(m.left_y - right.y);
    }
    return out;
  };
  return std::sqrt(squares_of(residuals(least_squares<4>(residuals, cv::Vec4d(0, 0, 0, 0)))) /
                   static_cast<double>(matches.size()));
}

}  // namespace palpable::vision
