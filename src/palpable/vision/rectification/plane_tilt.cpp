// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/plane_tilt.hpp"

#include "palpable/vision/image/opencv_image.hpp"
#include "palpable/vision/rectification/half_diagonals.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <unordered_map>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

constexpr double kRadian = std::numbers::pi / 180;

// A straight edge, in half diagonals from the picture's middle.
struct Edge {
  cv::Vec2d from, to;
  double length() const { return cv::norm(to - from); }
  cv::Vec2d direction() const { return (to - from) / length(); }
};

// Two edges that meet.
struct Corner {
  std::size_t first, second;
};

std::vector<Edge> edges_of(const Image& picture, const PlaneTiltOptions& options) {
  std::vector<cv::Vec4f> found;
  cv::createLineSegmentDetector(cv::LSD_REFINE_ADV)->detect(grey8_of(picture), found);
  const cv::Matx33d n = half_diagonals_from_pixels(picture);
  const auto place = [&](float x, float y) {
    const cv::Vec3d p = n * cv::Vec3d(x, y, 1);
    return cv::Vec2d(p[0], p[1]);
  };
  std::vector<Edge> edges;
  for (const cv::Vec4f& s : found) {
    const Edge edge{place(s[0], s[1]), place(s[2], s[3])};
    if (edge.length() > 2.0 * options.shortest_share) edges.push_back(edge);
  }
  std::stable_sort(edges.begin(), edges.end(),
                   [](const Edge& a, const Edge& b) { return a.length() > b.length(); });
  edges.resize(std::min(edges.size(), static_cast<std::size_t>(options.most_edges)));
  return edges;
}

// Ends of edges in cells of the corners' reach.
class EndsByPlace {
 public:
  EndsByPlace(const std::vector<Edge>& edges, double reach) : edges_(edges), reach_(reach) {
    for (std::size_t i = 0; i < 2 * edges.size(); ++i) cells_[cell_of(end(i), 0, 0)].push_back(i);
  }

  // The pairs of ends within the reach.
  template <class Take>
  void each_pair(const Take& take) const {
    for (std::size_t i = 0; i < 2 * edges_.size(); ++i)
      for (const int dy : {-1, 0, 1})
        for (const int dx : {-1, 0, 1}) {
          const auto cell = cells_.find(cell_of(end(i), dx, dy));
          if (cell == cells_.end()) continue;
          for (const std::size_t j : cell->second)
            if (i < j && i / 2 != j / 2 && cv::norm(end(i) - end(j)) < reach_) take(i / 2, j / 2);
        }
  }

 private:
  cv::Vec2d end(std::size_t i) const { return i % 2 == 0 ? edges_[i / 2].from : edges_[i / 2].to; }
  std::int64_t cell_of(const cv::Vec2d& p, int dx, int dy) const {
    constexpr std::int64_t kRow = 1 << 20;
    return (static_cast<std::int64_t>(std::floor(p[1] / reach_)) + dy) * kRow +
           static_cast<std::int64_t>(std::floor(p[0] / reach_)) + dx;
  }
  const std::vector<Edge>& edges_;
  double reach_;
  std::unordered_map<std::int64_t, std::vector<std::size_t>> cells_;
};

std::vector<Corner> corners_of(const std::vector<Edge>& edges, const PlaneTiltOptions& options) {
  const double most_cosine = std::cos(options.least_angle_deg * kRadian);
  std::vector<Corner> corners;
  EndsByPlace(edges, options.corner_reach).each_pair([&](std::size_t i, std::size_t j) {
    if (std::abs(edges[i].direction().dot(edges[j].direction())) < most_cosine) corners.push_back({i, j});
  });
  return corners;
}

// A camera's tilt: turns about its horizontal and its vertical axis, and its focal length's logarithm.
struct Tilt {
  double pitch = 0.0, yaw = 0.0, log_focal = 0.0;
};

// From the normalised picture to what the camera sees when it is turned back.
cv::Matx33d untilted(const Tilt& tilt) {
  const double cp = std::cos(tilt.pitch), sp = std::sin(tilt.pitch), cy = std::cos(tilt.yaw),
               sy = std::sin(tilt.yaw), f = std::exp(tilt.log_focal);
  const cv::Matx33d pitch(1, 0, 0, 0, cp, -sp, 0, sp, cp), yaw(cy, 0, sy, 0, 1, 0, -sy, 0, cy);
  return cv::Matx33d::diag({f, f, 1}) * pitch * yaw * cv::Matx33d::diag({1 / f, 1 / f, 1});
}

// Directions of all edges in the mapped picture, radians; NaN for those near the horizon.
std::vector<double> directions_of(const std::vector<Edge>& edges, const cv::Matx33d& h) {
  constexpr double kLeastNearness = 0.2;
  std::vector<double> out;
  out.reserve(edges.size());
  for (const Edge& e : edges) {
    const cv::Vec3d a = h * cv::Vec3d(e.from[0], e.from[1], 1), b = h * cv::Vec3d(e.to[0], e.to[1], 1);
    const bool near = a[2] > kLeastNearness * h(2, 2) && b[2] > kLeastNearness * h(2, 2);
    out.push_back(near ? std::atan2(b[1] / b[2] - a[1] / a[2], b[0] / b[2] - a[0] / a[2]) : std::nan(""));
  }
  return out;
}

// The angle from the nearest multiple of a period, -period/2 … period/2.
double from_nearest(double angle, double period) { return angle - period * std::round(angle / period); }

// The log-likelihood of the corners beside uniform angles.
double likelihood(const std::vector<Edge>& edges, const std::vector<Corner>& corners, const cv::Matx33d& h,
                  double deviation, double share) {
  const std::vector<double> directions = directions_of(edges, h);
  const double peak =
      share * 0.5 * std::numbers::pi * std::numbers::sqrt2 / (std::sqrt(std::numbers::pi) * deviation);
  double sum = 0.0;
  for (const Corner& corner : corners) {
    const double angle = directions[corner.first] - directions[corner.second];
    if (std::isnan(angle)) continue;
    const double off = from_nearest(angle - 0.5 * std::numbers::pi, std::numbers::pi) / deviation;
    sum += std::log(1 - share + peak * std::exp(-0.5 * off * off));
  }
  return sum;
}

struct Judged {
  Tilt tilt;
  double likelihood = 0.0;
};

// Steps along each axis while they help, then half steps.
template <class Likelihood>
Judged climbed(Judged best, const Likelihood& of) {
  const double least_focal = std::log(0.7), most_focal = std::log(5.0), most_turn = 50 * kRadian;
  for (double step = 0.05; step > 0.003;) {
    bool improved = false;
    for (const Tilt& way : {Tilt{1, 0, 0}, Tilt{0, 1, 0}, Tilt{0, 0, 4}})
      for (const double by : {-step, step}) {
        const Tilt t{best.tilt.pitch + by * way.pitch, best.tilt.yaw + by * way.yaw,
                     best.tilt.log_focal + by * way.log_focal};
        if (t.log_focal < least_focal || t.log_focal > most_focal ||
            std::max(std::abs(t.pitch), std::abs(t.yaw)) > most_turn)
          continue;
        if (const double l = of(t); l > best.likelihood) best = {t, l}, improved = true;
      }
    if (!improved) step /= 2;
  }
  return best;
}

// The most likely tilt, from the best ones of a coarse grid.
Judged most_likely(const std::vector<Edge>& edges, const std::vector<Corner>& corners,
                   const PlaneTiltOptions& options, const Work& work) {
  constexpr int kSteps = 6, kStarts = 4;
  constexpr double kStep = 8 * kRadian, kCoarse = 1.75;
  const double deviation = options.deviation_deg * kRadian, share = options.right_share;
  std::vector<Judged> grid;
  for (const double focal : {0.9, 1.4, 2.5})
    for (int p = -kSteps; p <= kSteps && !work.cancelled(); ++p)
      for (int y = -kSteps; y <= kSteps; ++y) {
        const Tilt tilt{p * kStep, y * kStep, std::log(focal)};
        grid.push_back({tilt, likelihood(edges, corners, untilted(tilt), kCoarse * deviation, share)});
      }
  std::stable_sort(grid.begin(), grid.end(),
                   [](const Judged& a, const Judged& b) { return a.likelihood > b.likelihood; });
  const auto fine = [&](const Tilt& t) { return likelihood(edges, corners, untilted(t), deviation, share); };
  Judged best{{}, -std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < std::min<std::size_t>(kStarts, grid.size()) && !work.cancelled(); ++i)
    if (const Judged j = climbed({grid[i].tilt, fine(grid[i].tilt)}, fine); j.likelihood > best.likelihood)
      best = j;
  return best;
}

// Turns the commonest direction of the mapped edges, or the one across it, level by the smaller turn.
cv::Matx33d levelled(const std::vector<Edge>& edges, const cv::Matx33d& h) {
  constexpr int kBins = 90;
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  std::array<double, kBins> lengths{};
  const std::vector<double> directions = directions_of(edges, h);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (std::isnan(directions[i])) continue;
    const double turn = from_nearest(directions[i], kQuarter) / kQuarter + 0.5;
    lengths[static_cast<std::size_t>(std::clamp(turn * kBins, 0.0, kBins - 1.0))] += edges[i].length();
  }
  const auto around = [&](int bin) {
    const auto at = [&](int i) { return lengths[static_cast<std::size_t>((i + kBins) % kBins)]; };
    return at(bin - 1) + 2 * at(bin) + at(bin + 1);
  };
  int best = 0;
  for (int bin = 1; bin < kBins; ++bin)
    if (around(bin) > around(best)) best = bin;
  const double turn = ((best + 0.5) / kBins - 0.5) * kQuarter, c = std::cos(turn), s = std::sin(turn);
  return cv::Matx33d(c, s, 0, -s, c, 0, 0, 0, 1) * h;
}

}  // namespace

std::vector<Parameter> parameters_of(PlaneTiltOptions& o) {
  return {{"shortest_share", &o.shortest_share, {0.001, 0.5}, "of the diagonal", "shortest edge"},
          {"most_edges", &o.most_edges, {10, 20000}, "", "edges that are used"},
          {"corner_reach", &o.corner_reach, {0.001, 0.2}, "half diagonals", "distance of ends in a corner"},
          {"least_angle_deg", &o.least_angle_deg, {1, 45}, "degrees", "least angle of a corner"},
          {"deviation_deg", &o.deviation_deg, {0.1, 20}, "degrees", "standard deviation of right angles"},
          {"right_share", &o.right_share, {0.01, 0.99}, "", "share of right angles among corners"},
          {"least_gain", &o.least_gain, {0, 10000}, "", "least gain of the log-likelihood"}};
}

Result<std::optional<PlaneTilt>> find_plane_tilt(const Image& picture, const Work& work,
                                                 const PlaneTiltOptions& options) {
  if (auto in_range = check_ranges(options); !in_range) return in_range.error();
  try {
    const std::vector<Edge> edges = edges_of(picture, options);
    const std::vector<Corner> corners = corners_of(edges, options);
    const Judged found = most_likely(edges, corners, options, work);
    if (work.cancelled()) return Work::interrupted();
    const double as_it_is =
        likelihood(edges, corners, cv::Matx33d::eye(), options.deviation_deg * kRadian, options.right_share);
    const double gain = found.likelihood - as_it_is;
    if (!(gain > options.least_gain)) return std::optional<PlaneTilt>();
    const cv::Matx33d plane = levelled(edges, untilted(found.tilt)) * half_diagonals_from_pixels(picture);
    PlaneTilt tilt{{}, gain};
    std::copy_n(plane.val, 9, tilt.plane_from_pixel.begin());
    return std::optional(tilt);
  } catch (const cv::Exception& e) {
    return Error{ErrorCode::failed, std::string("no edges could be found: ") + e.what(), {}};
  }
}

}  // namespace palpable::vision
