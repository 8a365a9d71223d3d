// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/image/opencv_image.hpp"
#include "palpable/vision/rectification/plane_rectification.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

/// A straight edge, relative to the picture's middle.
struct Edge {
  cv::Vec2d middle;
  cv::Vec2d direction;
  double length = 0.0;
  cv::Vec3d line;
};

std::vector<Edge> edges_of(const Image& picture, double shortest_share) {
  const cv::Mat grey = grey8_of(picture);
  std::vector<cv::Vec4f> found;
  cv::createLineSegmentDetector(cv::LSD_REFINE_ADV)->detect(grey, found);
  const double half = 0.5 * std::hypot(picture.width, picture.height);
  const cv::Vec2d centre(0.5 * (picture.width - 1), 0.5 * (picture.height - 1));
  std::vector<Edge> edges;
  for (const cv::Vec4f& s : found) {
    const cv::Vec2d a = (cv::Vec2d(s[0], s[1]) - centre) / half, b = (cv::Vec2d(s[2], s[3]) - centre) / half;
    const double length = cv::norm(b - a);
    if (length < 2.0 * shortest_share) continue;
    const cv::Vec3d line = cv::Vec3d(a[0], a[1], 1.0).cross(cv::Vec3d(b[0], b[1], 1.0));
    edges.push_back({0.5 * (a + b), (b - a) / length, length, line / std::hypot(line[0], line[1])});
  }
  return edges;
}

/// Whether the edge's extension passes the vanishing point within an angle, measured at the edge's middle.
bool leads_to(const Edge& edge, const cv::Vec3d& point, double sine) {
  const cv::Vec2d to(point[0] - point[2] * edge.middle[0], point[1] - point[2] * edge.middle[1]);
  return std::abs(edge.direction[0] * to[1] - edge.direction[1] * to[0]) < sine * cv::norm(to);
}

double support_of(const cv::Vec3d& point, const std::vector<Edge>& edges, double sine) {
  double sum = 0.0;
  for (const Edge& e : edges)
    if (leads_to(e, point, sine)) sum += e.length;
  return sum;
}

/// The point nearest to the lines of all edges that support `point`, weighted by their lengths.
cv::Vec3d refined(cv::Vec3d point, const std::vector<Edge>& edges, double sine) {
  for (int i = 0; i < 3; ++i) {
    cv::Matx33d sum = cv::Matx33d::zeros();
    for (const Edge& e : edges)
      if (leads_to(e, point, sine)) sum += e.length * e.length * (e.line * e.line.t());
    cv::Vec3d values;
    cv::Matx33d vectors;
    cv::eigen(sum, values, vectors);
    point = {vectors(2, 0), vectors(2, 1), vectors(2, 2)};
  }
  return point;
}

/// The direction from the picture's centre to a point.
cv::Vec2d direction_of(const cv::Vec3d& point) {
  const double length = std::hypot(point[0], point[1]);
  return length > 0.0 ? cv::Vec2d(point[0] / length, point[1] / length) : cv::Vec2d(0, 0);
}

/// The vanishing point with most support, outside the picture and, if another is given, in a clearly
/// different direction.
std::optional<cv::Vec3d> most_led_to(const std::vector<Edge>& edges, const cv::Vec3d* other,
                                     const PlaneLineOptions& options, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  cv::Vec3d best;
  double most = options.least_support;
  for (int trial = 0; trial < options.trials; ++trial) {
    const Edge &a = edges[random() % edges.size()], &b = edges[random() % edges.size()];
    cv::Vec3d point = a.line.cross(b.line);
    const double length = cv::norm(point);
    if (length < 1e-9) continue;
    point /= length;
    if (std::hypot(point[0], point[1]) < options.least_distance * std::abs(point[2])) continue;
    if (other != nullptr && std::abs(direction_of(point).dot(direction_of(*other))) > options.most_cosine)
      continue;
    const double support = support_of(point, edges, options.aim_sine);
    if (support > most) {
      most = support;
      best = point;
    }
  }
  if (most <= options.least_support) return std::nullopt;
  return refined(best, edges, options.aim_sine);
}

/// Two lines through the picture that meet in the vanishing point.
std::array<PictureLine, 2> lines_to(const cv::Vec3d& point, const Image& picture) {
  const double half = 0.5 * std::hypot(picture.width, picture.height);
  const cv::Vec2d centre(0.5 * (picture.width - 1), 0.5 * (picture.height - 1));
  const cv::Vec2d aside(-direction_of(point)[1], direction_of(point)[0]);
  std::array<PictureLine, 2> lines;
  for (std::size_t i = 0; i < 2; ++i) {
    const cv::Vec2d from = (i == 0 ? -0.5 : 0.5) * aside;
    cv::Vec2d to(point[0] - point[2] * from[0], point[1] - point[2] * from[1]);
    to = from + to / cv::norm(to);
    const auto in_picture = [&](const cv::Vec2d& p) {
      return PicturePoint{centre[0] + half * p[0], centre[1] + half * p[1]};
    };
    lines[i] = {in_picture(from), in_picture(to)};
  }
  return lines;
}

}  // namespace

std::vector<Parameter> parameters_of(PlaneLineOptions& o) {
  return {{"shortest_share", &o.shortest_share, {0.001, 0.5}, "of the diagonal", "shortest edge"},
          {"aim_sine", &o.aim_sine, {0.001, 0.5}, "", "sine of the angle by which an edge may miss"},
          {"trials", &o.trials, {10, 100000}, "", "random pairs of edges"},
          {"least_distance", &o.least_distance, {0, 100}, "half diagonals", "nearest vanishing point"},
          {"most_cosine", &o.most_cosine, {0, 1}, "", "cosine between the two directions"},
          {"least_support", &o.least_support, {0, 100}, "half diagonals", "least length of supporting edges"},
          {"least_edges", &o.least_edges, {2, 1000}, "", "least edges of a direction"}};
}

Result<PlaneLines> find_plane_lines(const Image& picture, const Work& work, const PlaneLineOptions& options) {
  if (auto in_range = check_ranges(options); !in_range) return in_range.error();
  try {
    std::vector<Edge> edges = edges_of(picture, options.shortest_share);
    const auto least = static_cast<std::size_t>(options.least_edges);
    const Error none = invalid_input("shows too few straight edges in two directions to find its plane by",
                                     {}, Reason::needs_plane_marks);
    if (edges.size() < least) return none;
    const auto first = most_led_to(edges, nullptr, options, work.seed);
    if (!first || work.cancelled()) return work.cancelled() ? Work::interrupted() : none;
    std::erase_if(edges, [&](const Edge& e) { return leads_to(e, *first, options.aim_sine); });
    if (edges.size() < least / 2) return none;
    const auto second = most_led_to(edges, &*first, options, work.seed);
    if (!second) return none;
    PlaneLines lines;
    const bool level = std::abs(direction_of(*first)[0]) > std::abs(direction_of(*second)[0]);
    lines.along = lines_to(level ? *first : *second, picture);
    lines.across = lines_to(level ? *second : *first, picture);
    return lines;
  } catch (const cv::Exception& e) {
    return Error{ErrorCode::failed, std::string("no lines could be found: ") + e.what(), {}};
  }
}

}  // namespace palpable::vision
