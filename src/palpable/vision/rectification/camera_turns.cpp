// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/camera_turns.hpp"

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

cv::Matx33d turned(double about_x, double about_y, double about_z) {
  cv::Matx33d r;
  cv::Rodrigues(cv::Vec3d(about_x, about_y, about_z), r);
  return r;
}

cv::Matx33d matrix_of(const Eye& eye, double focal_px) {
  return {focal_px, 0, eye.cx, 0, focal_px, eye.cy, 0, 0, 1};
}

cv::Point2d mapped(const cv::Matx33d& h, double x, double y) {
  const cv::Vec3d p = h * cv::Vec3d(x, y, 1.0);
  return {p[0] / p[2], p[1] / p[2]};
}

double squares_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v * v;
  return sum;
}

/// Levenberg-Marquardt from `at` with differences for derivatives: a handful of angles does not need more.
/// `residuals` gives as many values for every argument.
template <int Count, class Residuals>
cv::Vec<double, Count> least_squares(const Residuals& residuals, cv::Vec<double, Count> at) {
  using Unknowns = cv::Vec<double, Count>;
  constexpr double kStep = 1e-6;
  std::vector<double> now = residuals(at);
  double damping = 1e-3;
  for (int i = 0; i < 60 && damping < 1e9; ++i) {
    std::vector<Unknowns> rows(now.size());
    for (int k = 0; k < Count; ++k) {
      Unknowns stepped = at;
      stepped[k] += kStep;
      const std::vector<double> then = residuals(stepped);
      for (std::size_t r = 0; r < now.size(); ++r) rows[r][k] = (then[r] - now[r]) / kStep;
    }
    cv::Matx<double, Count, Count> normal = cv::Matx<double, Count, Count>::zeros();
    Unknowns right = Unknowns::all(0.0);
    for (std::size_t r = 0; r < now.size(); ++r) {
      normal += rows[r] * rows[r].t();
      right -= now[r] * rows[r];
    }
    for (int k = 0; k < Count; ++k) normal(k, k) *= 1.0 + damping;
    const Unknowns candidate = at + Unknowns(normal.solve(right, cv::DECOMP_SVD));
    std::vector<double> then = residuals(candidate);
    const double gain = squares_of(now) - squares_of(then);
    damping = gain > 0.0 ? std::max(1e-9, damping / 4.0) : damping * 8.0;
    if (!(gain > 0.0)) continue;
    at = candidate;
    now = std::move(then);
    if (gain < 1e-6 * squares_of(now)) break;
  }
  return at;
}

/// Left about y and z, right about x, y and z (radians), the logarithm of the focal length over the eye's,
/// and the lenses' bend at a distance of cx from the middle.
constexpr int kUnknowns = 7;
using Turns = cv::Vec<double, kUnknowns>;
constexpr int kBend = 6;
/// A weak wish for small turns, a usual focal length and a straight lens decides where the matches do not:
/// pixels for a turn of 1. It is stronger for the left picture, which is the reference, and for turns about
/// the upright axis, which move things out of the picture.
const Turns kWishes_px(100.0, 30.0, 3.0, 30.0, 3.0, 3.0, 3.0);

Straightening straightening_of(const Turns& turns, const Eye& eye) {
  const cv::Matx33d camera = matrix_of(eye, eye.known ? eye.focal_px : std::exp(turns[5]) * eye.focal_px);
  const cv::Matx33d back = camera.inv();
  return {camera * turned(0, turns[0], turns[1]) * back, camera * turned(turns[2], turns[3], turns[4]) * back,
          turns[kBend] / (eye.cx * eye.cx), eye.cx, eye.cy};
}

/// How far below its right match a left match lies once straightened.
double rise_px(const Straightening& by, const FeatureMatch& m) {
  return straightened(by, by.left, {m.left_x, m.left_y}).y -
         straightened(by, by.right, {m.right_x, m.right_y}).y;
}

bool same_place(const FeatureMatch& a, const FeatureMatch& b) {
  return a.left_x == b.left_x && a.left_y == b.left_y;
}

/// Calls `visit` once for every place of the left picture: with that of its matches whose rise is least, and
/// the rise, in pixels.
template <class Visit>
void visit_places(const std::vector<FeatureMatch>& matches, const Straightening& by, const Visit& visit) {
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

/// How two pictures may differ, simplest first: the right one is moved up or down and turned in its plane;
/// both cameras are turned; their lenses bend straight lines too.
enum class Freedom { plane, space, lens };

/// For small turns and a small bend y_left - y_right is linear in them: the row of their factors, in the
/// order of Turns; the focal length has none.
Turns factors_of(const FeatureMatch& m, const Eye& eye) {
  const double f = eye.focal_px, xl = m.left_x - eye.cx, yl = m.left_y - eye.cy, xr = m.right_x - eye.cx,
               yr = m.right_y - eye.cy, far_left = (xl * xl + yl * yl) / (eye.cx * eye.cx),
               far_right = (xr * xr + yr * yr) / (eye.cx * eye.cx);
  return {xl * yl / f, xl, f + yr * yr / f, -xr * yr / f, -xr, 0.0, far_right * yr - far_left * yl};
}

/// The smallest of the turns that bring these matches about to common scanlines.
Turns small_turns(std::span<const FeatureMatch> matches, const Eye& eye, Freedom freedom) {
  using Matrix = cv::Matx<double, kUnknowns, kUnknowns>;
  Matrix normal = Matrix::zeros();
  for (int i = 0; i < kUnknowns; ++i) normal(i, i) = kWishes_px[i] * kWishes_px[i];
  Turns right = Turns::all(0.0);
  for (const FeatureMatch& m : matches) {
    Turns row = factors_of(m, eye);
    if (freedom != Freedom::lens) row[kBend] = 0.0;
    normal += row * row.t();
    right -= (m.left_y - m.right_y) * row;
  }
  return normal.solve(right, cv::DECOMP_CHOLESKY);
}

/// How badly a turn explains the matches: squared rises, each place's at most the tolerance's.
double truncated_squares(const std::vector<FeatureMatch>& matches, const Straightening& by,
                         double tolerance_px) {
  double sum = 0.0;
  visit_places(matches, by, [&](const FeatureMatch&, double rise) {
    sum += std::min(rise * rise, tolerance_px * tolerance_px);
  });
  return sum;
}

struct Start {
  Turns turns;
  double cost;
};

/// Where the search begins: of random samples of matches those whose turns explain the others best, best
/// first. Half of the samples are of three matches, which turn the right camera alone.
std::vector<Start> starts_of(const std::vector<FeatureMatch>& matches, const Eye& eye, Freedom freedom,
                             double tolerance_px, std::uint64_t seed) {
  constexpr int kTrials = 1000;
  constexpr std::size_t kStarts = 6;
  constexpr double kMostTurn = 0.35;
  // So many tell which turns most agree with.
  constexpr std::size_t kAsked = 400;
  std::mt19937_64 random(seed);
  std::vector<FeatureMatch> asked = matches;
  std::shuffle(asked.begin(), asked.end(), random);
  asked.resize(std::min(asked.size(), kAsked));
  std::sort(asked.begin(), asked.end(), [](const FeatureMatch& a, const FeatureMatch& b) {
    return std::tie(a.left_x, a.left_y, a.right_x) < std::tie(b.left_x, b.left_y, b.right_x);
  });
  std::vector<Start> best;
  const auto consider = [&](const Turns& turns) {
    const double cost = truncated_squares(asked, straightening_of(turns, eye), tolerance_px);
    if (best.size() == kStarts && cost >= best.back().cost) return;
    const auto place =
        std::upper_bound(best.begin(), best.end(), cost, [](double c, const Start& s) { return c < s.cost; });
    best.insert(place, {turns, cost});
    if (best.size() > kStarts) best.pop_back();
  };
  // The first question is whether they are aligned as they are.
  consider(Turns::all(0.0));
  // A match for each of the unknowns that it has.
  const std::size_t large = freedom == Freedom::lens ? 6 : 5;
  std::array<FeatureMatch, 6> sample{};
  for (int trial = 0; trial < kTrials; ++trial) {
    for (FeatureMatch& m : sample) m = matches[random() % matches.size()];
    const Turns turns = small_turns(std::span(sample).first(trial % 2 == 0 ? 3 : large), eye, freedom);
    if (cv::norm(turns, cv::NORM_INF) <= kMostTurn) consider(turns);
  }
  return best;
}

/// The turns that bring `matches` nearest to common scanlines.
Turns refined(const Turns& from, const std::vector<FeatureMatch>& matches, const Eye& eye,
              const Turns& wishes_px) {
  const auto residuals = [&](const Turns& turns) {
    const Straightening by = straightening_of(turns, eye);
    std::vector<double> out;
    out.reserve(matches.size() + kUnknowns);
    for (const FeatureMatch& m : matches) out.push_back(rise_px(by, m));
    for (int i = 0; i < kUnknowns; ++i) out.push_back(wishes_px[i] * turns[i]);
    return out;
  };
  return least_squares<kUnknowns>(residuals, from);
}

TurnedCameras settled(const std::vector<FeatureMatch>& matches, Eye eye, Freedom freedom, double tolerance_px,
                      std::uint64_t seed) {
  constexpr std::size_t kLeast = 8;
  constexpr double kFixed = 1e6;
  Turns wishes_px = kWishes_px;
  if (freedom != Freedom::lens) wishes_px[kBend] = kFixed;
  if (freedom == Freedom::plane) {
    // Seen from very far a tilt only moves the picture.
    eye.focal_px *= 1000.0;
    for (const int other : {0, 1, 3, 5}) wishes_px[other] = kFixed;
  }
  // The first look allows for the lens and for turns that are not small.
  TurnedCameras out;
  double least = std::numeric_limits<double>::infinity();
  for (const Start& start : starts_of(matches, eye, freedom, 2.0 * tolerance_px, seed)) {
    Turns turns = start.turns;
    std::vector<FeatureMatch> agreeing;
    for (const double loosened : {2.5, 1.5, 1.0, 1.0}) {
      agreeing = within(matches, straightening_of(turns, eye), loosened * tolerance_px);
      if (agreeing.size() < kLeast) break;
      turns = refined(turns, agreeing, eye, wishes_px);
    }
    const Straightening how = straightening_of(turns, eye);
    const double cost = truncated_squares(matches, how, tolerance_px);
    agreeing = within(matches, how, tolerance_px);
    if (agreeing.size() < kLeast || cost >= least) continue;
    least = cost;
    out = {how, std::move(agreeing)};
  }
  return out;
}

/// Whether a simpler explanation is as good: nearly as many matches agree, nearly as well.
bool as_good(const TurnedCameras& simple, const TurnedCameras& rich, double enough_px) {
  constexpr double kNearly = 0.95, kHardlyWorse = 1.05;
  const double simple_px = vertical_rms_px(moved(simple.matches, simple.how)),
               rich_px = vertical_rms_px(moved(rich.matches, rich.how));
  return static_cast<double>(simple.matches.size()) >= kNearly * static_cast<double>(rich.matches.size()) &&
         !simple.matches.empty() && simple_px <= std::max(enough_px, kHardlyWorse * rich_px);
}

}  // namespace

Eye unknown_eye(int width, int height) {
  return {static_cast<double>(width + height), (width - 1) / 2.0, (height - 1) / 2.0, false};
}

cv::Point2d straightened(const Straightening& by, const cv::Matx33d& homography, cv::Point2d place) {
  if (by.bend != 0.0) {
    const double x = place.x - by.cx, y = place.y - by.cy, scale = 1.0 / (1.0 + by.bend * (x * x + y * y));
    place = {by.cx + scale * x, by.cy + scale * y};
  }
  return mapped(homography, place.x, place.y);
}

cv::Point2d bent_back(const Straightening& by, const cv::Matx33d& inverse_homography, cv::Point2d place) {
  const cv::Point2d u = mapped(inverse_homography, place.x, place.y);
  const double x = u.x - by.cx, y = u.y - by.cy, squared = x * x + y * y;
  if (by.bend == 0.0 || squared == 0.0) return u;
  // r = (1 - √(1 - 4 bend u²)) / (2 bend u) solves u = r / (1 + bend r²); past the root there is no such
  // place.
  const double root = std::sqrt(std::max(0.0, 1.0 - 4.0 * by.bend * squared));
  const double scale = 2.0 / (1.0 + root);
  return {by.cx + scale * x, by.cy + scale * y};
}

TurnedCameras turns_to_scanlines(const std::vector<FeatureMatch>& matches, const Eye& eye,
                                 double tolerance_px, std::uint64_t seed) {
  constexpr std::size_t kEnoughToBend = 60;
  constexpr double kEnough = 0.2;
  if (matches.size() < 8) return {};
  TurnedCameras space = settled(matches, eye, Freedom::space, tolerance_px, seed);
  // A known camera's turns are wanted as they are; and its lens is straight.
  if (eye.known) return space;
  if (space.matches.size() >= kEnoughToBend) {
    TurnedCameras lens = settled(matches, eye, Freedom::lens, tolerance_px, seed);
    if (!as_good(space, lens, kEnough * tolerance_px)) return lens;
  }
  TurnedCameras plane = settled(matches, eye, Freedom::plane, tolerance_px, seed);
  return as_good(plane, space, kEnough * tolerance_px) ? plane : space;
}

TurnedCameras rough_turns(const std::vector<FeatureMatch>& matches, const Eye& eye, double tolerance_px,
                          std::uint64_t seed) {
  constexpr double kRoughly = 4.0;
  if (matches.size() < 8) return {};
  return settled(matches, eye, Freedom::plane, kRoughly * tolerance_px, seed);
}

std::vector<FeatureMatch> within(const std::vector<FeatureMatch>& matches, const Straightening& by,
                                 double tolerance_px) {
  std::vector<FeatureMatch> out;
  visit_places(matches, by, [&](const FeatureMatch& m, double rise) {
    if (rise <= tolerance_px) out.push_back(m);
  });
  return out;
}

std::vector<FeatureMatch> one_a_place(const std::vector<FeatureMatch>& matches, const Straightening& by) {
  return within(matches, by, std::numeric_limits<double>::infinity());
}

std::vector<FeatureMatch> moved(const std::vector<FeatureMatch>& matches, const Straightening& by) {
  std::vector<FeatureMatch> out;
  out.reserve(matches.size());
  for (const FeatureMatch& m : matches) {
    const cv::Point2d left = straightened(by, by.left, {m.left_x, m.left_y}),
                      right = straightened(by, by.right, {m.right_x, m.right_y});
    out.push_back({left.x, left.y, right.x, right.y});
  }
  return out;
}

double parallax_rms_px(const std::vector<FeatureMatch>& matches, const Eye& eye) {
  if (matches.empty()) return std::numeric_limits<double>::quiet_NaN();
  // Two shifts in pixels (angles times the focal length), an angle, and the logarithm of the true focal
  // length over the eye's: an assumed one may be far off.
  const auto residuals = [&](const cv::Vec4d& turn) {
    const double focal_px = std::exp(turn[3]) * eye.focal_px;
    const cv::Matx33d camera = matrix_of(eye, focal_px);
    const cv::Matx33d h = camera * turned(turn[0] / focal_px, turn[1] / focal_px, turn[2]) * camera.inv();
    std::vector<double> out;
    out.reserve(2 * matches.size());
    for (const FeatureMatch& m : matches) {
      const cv::Point2d right = mapped(h, m.right_x, m.right_y);
      out.push_back(m.left_x - right.x);
      out.push_back(m.left_y - right.y);
    }
    return out;
  };
  return std::sqrt(squares_of(residuals(least_squares<4>(residuals, cv::Vec4d(0, 0, 0, 0)))) /
                   static_cast<double>(matches.size()));
}

}  // namespace palpable::vision
