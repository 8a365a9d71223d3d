// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/lines/centre_lines.hpp"

#include "palpable/core/geometry/segment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>

#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

/// The neighbours clockwise from above.
constexpr std::array<Pixel, 8> kNeighbours{
    {{0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}}};

/// A mask with a border of two unset pixels, and the positions of its set pixels.
struct Thinned {
  cv::Mat mask;
  std::vector<cv::Point> pixels;
};

unsigned neighbours_of(const cv::Mat& mask, cv::Point p) {
  unsigned bits = 0;
  for (unsigned k = 0; k < 8; ++k)
    if (mask.at<std::uint8_t>(p.y + kNeighbours[k].y, p.x + kNeighbours[k].x) != 0) bits |= 1U << k;
  return bits;
}

unsigned bit(unsigned bits, unsigned k) { return (bits >> (k & 7U)) & 1U; }

/// Number of changes from unset to set around a pixel.
int steps_around(unsigned bits) {
  int steps = 0;
  for (unsigned k = 0; k < 8; ++k) steps += bit(bits, k) == 0 && bit(bits, k + 1) == 1 ? 1 : 0;
  return steps;
}

/// For each neighbourhood, whether Zhang & Suen's half step 0 or 1 removes the pixel.
std::array<std::array<bool, 256>, 2> removal_table() {
  std::array<std::array<bool, 256>, 2> table{};
  for (unsigned bits = 0; bits < 256; ++bits) {
    const int set = __builtin_popcount(bits);
    if (set < 2 || set > 6 || steps_around(bits) != 1) continue;
    const bool up = bit(bits, 0), right = bit(bits, 2), down = bit(bits, 4), left = bit(bits, 6);
    table[0][bits] = !(up && right && down) && !(right && down && left);
    table[1][bits] = !(up && right && left) && !(up && down && left);
  }
  return table;
}

/// Whether a pixel of a thinned line is the corner of a staircase, which can go without breaking the line.
bool is_corner(unsigned bits) {
  if (steps_around(bits) > 2) return false;
  for (unsigned k = 0; k < 8; k += 2)
    if (bit(bits, k) && bit(bits, k + 2) && !bit(bits, k + 5) && !bit(bits, k + 4) && !bit(bits, k + 6))
      return true;
  return false;
}

Thinned thinned(const Raster<std::uint8_t>& mask, const ThinningGuide& guide) {
  Thinned out;
  out.mask = cv::Mat::zeros(mask.height() + 4, mask.width() + 4, CV_8U);
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x)
      if (mask(x, y) != 0 && (guide.outside.count() == 0 || guide.outside(x, y) == 0)) {
        out.mask.at<std::uint8_t>(y + 2, x + 2) = 1;
        out.pixels.emplace_back(x + 2, y + 2);
      }
  static const auto table = removal_table();
  const auto is_kept = [&guide](cv::Point p) {
    return guide.kept.count() != 0 && guide.kept(p.x - 2, p.y - 2) != 0;
  };
  const auto clear_those = [&out](std::vector<cv::Point>& gone) {
    for (const cv::Point p : gone) out.mask.at<std::uint8_t>(p) = 0;
    if (!gone.empty())
      std::erase_if(out.pixels, [&out](cv::Point p) { return out.mask.at<std::uint8_t>(p) == 0; });
  };
  std::vector<cv::Point> gone;
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& removes : table) {
      gone.clear();
      for (const cv::Point p : out.pixels)
        if (!is_kept(p) && removes[neighbours_of(out.mask, p)]) gone.push_back(p);
      changed = changed || !gone.empty();
      clear_those(gone);
    }
  }
  for (const cv::Point p : out.pixels)
    if (is_corner(neighbours_of(out.mask, p))) out.mask.at<std::uint8_t>(p) = 0;
  std::erase_if(out.pixels, [&out](cv::Point p) { return out.mask.at<std::uint8_t>(p) == 0; });
  return out;
}

MapPoint to_map(cv::Point p) { return {p.x - 2.0, p.y - 2.0}; }

/// Splits thinned lines into nodes and lines.
class Tracer {
 public:
  explicit Tracer(const Thinned& thin) : mask_(thin.mask), node_(thin.mask.size(), CV_32S, cv::Scalar(-1)) {
    for (const cv::Point p : thin.pixels)
      if (neighbours(p) != 2 && node_.at<int>(p) < 0) add_node(p);
    for (const cv::Point p : thin.pixels)
      if (node_.at<int>(p) >= 0) trace_from(p);
    for (const cv::Point p : thin.pixels)
      if (node_.at<int>(p) < 0 && mask_.at<std::uint8_t>(p) == 1) trace_ring(p);
  }
  CentreLines take() { return std::move(graph_); }

 private:
  int neighbours(cv::Point p) const { return __builtin_popcount(neighbours_of(mask_, p)); }

  /// An end, a lone pixel, or a group of touching pixels with three or more neighbours each.
  void add_node(cv::Point start) {
    const int number = static_cast<int>(graph_.nodes.size());
    std::vector<cv::Point> group{start};
    node_.at<int>(start) = number;
    if (neighbours(start) > 2)
      for (std::size_t i = 0; i < group.size(); ++i)
        for (const Pixel d : kNeighbours) {
          const cv::Point q(group[i].x + d.x, group[i].y + d.y);
          if (mask_.at<std::uint8_t>(q) == 0 || node_.at<int>(q) >= 0 || neighbours(q) < 3) continue;
          node_.at<int>(q) = number;
          group.push_back(q);
        }
    MapPoint sum;
    for (const cv::Point p : group) sum = {sum.x + to_map(p).x, sum.y + to_map(p).y};
    const auto n = static_cast<double>(group.size());
    graph_.nodes.push_back({sum.x / n, sum.y / n});
  }

  void trace_from(cv::Point start) {
    const int first = node_.at<int>(start);
    for (const Pixel d : kNeighbours) {
      const cv::Point next(start.x + d.x, start.y + d.y);
      if (mask_.at<std::uint8_t>(next) != 1) continue;
      const int other = node_.at<int>(next);
      if (other == first) continue;
      if (other >= 0) {
        if (other > first) add_line(first, other, {});
        continue;
      }
      follow(first, start, next);
    }
  }

  void follow(int first, cv::Point before, cv::Point at) {
    std::vector<MapPoint> points;
    int last = -1;
    for (;;) {
      points.push_back(to_map(at));
      mask_.at<std::uint8_t>(at) = 2;
      cv::Point next(-1, -1);
      for (const Pixel d : kNeighbours) {
        const cv::Point q(at.x + d.x, at.y + d.y);
        if (mask_.at<std::uint8_t>(q) == 0 || q == before) continue;
        if (node_.at<int>(q) >= 0 && (node_.at<int>(q) != first || points.size() > 2))
          last = node_.at<int>(q);
        if (node_.at<int>(q) < 0 && mask_.at<std::uint8_t>(q) == 1) next = q;
      }
      if (last >= 0 || next.x < 0) break;
      before = at;
      at = next;
    }
    if (last < 0) {
      last = static_cast<int>(graph_.nodes.size());
      graph_.nodes.push_back(points.back());
    }
    add_line(first, last, std::move(points));
  }

  void trace_ring(cv::Point start) {
    const int number = static_cast<int>(graph_.nodes.size());
    graph_.nodes.push_back(to_map(start));
    node_.at<int>(start) = number;
    for (const Pixel d : kNeighbours) {
      const cv::Point next(start.x + d.x, start.y + d.y);
      if (mask_.at<std::uint8_t>(next) != 1 || node_.at<int>(next) >= 0) continue;
      follow(number, start, next);
      return;
    }
  }

  void add_line(int first, int last, std::vector<MapPoint> points) {
    points.insert(points.begin(), graph_.nodes[static_cast<std::size_t>(first)]);
    points.push_back(graph_.nodes[static_cast<std::size_t>(last)]);
    graph_.lines.push_back({std::move(points), first, last});
  }

  cv::Mat mask_;
  cv::Mat node_;
  CentreLines graph_;
};

void measure_radii(CentreLines& graph, const cv::Mat& distance, const CentreLineOptions& options) {
  for (CentreLine& line : graph.lines) {
    double sum = 0.0;
    double squares = 0.0;
    int n = 0;
    // The ends lie in junctions or caps, where the mask is wider or narrower.
    const std::size_t all = line.points.size();
    const std::size_t skip = all > static_cast<std::size_t>(options.least_points)
                                 ? static_cast<std::size_t>(options.end_part * static_cast<double>(all))
                                 : 0;
    for (std::size_t i = skip; i + skip < line.points.size(); ++i) {
      const int x = std::clamp(static_cast<int>(std::lround(line.points[i].x)), 0, distance.cols - 1);
      const int y = std::clamp(static_cast<int>(std::lround(line.points[i].y)), 0, distance.rows - 1);
      const double r = distance.at<float>(y, x);
      sum += r;
      squares += r * r;
      ++n;
    }
    line.radius_px = sum / n;
    line.radius_spread_px = std::sqrt(std::max(0.0, squares / n - line.radius_px * line.radius_px));
  }
}

}  // namespace

double length_px(const std::vector<MapPoint>& points) {
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i)
    sum += std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y);
  return sum;
}

std::vector<int> degrees_of(const CentreLines& graph) {
  std::vector<int> degree(graph.nodes.size(), 0);
  for (const CentreLine& line : graph.lines) {
    ++degree[static_cast<std::size_t>(line.first)];
    ++degree[static_cast<std::size_t>(line.last)];
  }
  return degree;
}

void join_lines(CentreLines& graph) {
  std::vector<std::vector<std::size_t>> at(graph.nodes.size());
  for (std::size_t i = 0; i < graph.lines.size(); ++i) {
    at[static_cast<std::size_t>(graph.lines[i].first)].push_back(i);
    at[static_cast<std::size_t>(graph.lines[i].last)].push_back(i);
  }
  std::vector<bool> gone(graph.lines.size(), false);
  for (std::size_t node = 0; node < at.size(); ++node) {
    if (at[node].size() != 2 || at[node][0] == at[node][1]) continue;
    const int here = static_cast<int>(node);
    const std::size_t kept = at[node][0], added = at[node][1];
    if (graph.lines[kept].kind != graph.lines[added].kind) continue;
    CentreLine& a = graph.lines[kept];
    CentreLine b = graph.lines[added];
    if (a.last != here) {
      std::reverse(a.points.begin(), a.points.end());
      std::swap(a.first, a.last);
    }
    if (b.first != here) {
      std::reverse(b.points.begin(), b.points.end());
      std::swap(b.first, b.last);
    }
    const auto n = static_cast<double>(a.points.size());
    const auto m = static_cast<double>(b.points.size());
    const double mean = (n * a.radius_px + m * b.radius_px) / (n + m);
    const auto square = [mean](const CentreLine& l) {
      return l.radius_spread_px * l.radius_spread_px + (l.radius_px - mean) * (l.radius_px - mean);
    };
    a.radius_spread_px = std::sqrt((n * square(a) + m * square(b)) / (n + m));
    a.radius_px = mean;
    a.points.insert(a.points.end(), b.points.begin() + 1, b.points.end());
    a.last = b.last;
    gone[added] = true;
    for (std::size_t& other : at[static_cast<std::size_t>(b.last)])
      if (other == added) other = kept;
    at[node].clear();
  }
  std::size_t next = 0;
  for (std::size_t i = 0; i < graph.lines.size(); ++i)
    if (!gone[i]) {
      if (next != i) graph.lines[next] = std::move(graph.lines[i]);
      ++next;
    }
  graph.lines.resize(next);
}

void remove_short_networks(CentreLines& graph, double least_px, double least_radii) {
  std::vector<int> group(graph.nodes.size());
  std::iota(group.begin(), group.end(), 0);
  const auto root = [&group](int n) {
    while (group[static_cast<std::size_t>(n)] != n) n = group[static_cast<std::size_t>(n)];
    return static_cast<std::size_t>(n);
  };
  for (const CentreLine& line : graph.lines) group[root(line.first)] = static_cast<int>(root(line.last));
  std::vector<double> length(graph.nodes.size(), 0.0);
  for (const CentreLine& line : graph.lines) length[root(line.first)] += length_px(line.points);
  std::erase_if(graph.lines, [&](const CentreLine& line) {
    const double all = length[root(line.first)];
    return all < least_px || all < least_radii * line.radius_px;
  });
}

void remove_spurs(CentreLines& graph, double radii, double more_px) {
  for (bool changed = true; changed;) {
    const std::vector<int> degree = degrees_of(graph);
    const auto is_spur = [&](const CentreLine& line) {
      const int a = degree[static_cast<std::size_t>(line.first)];
      const int b = degree[static_cast<std::size_t>(line.last)];
      return (a == 1) != (b == 1) && std::max(a, b) > 2 &&
             length_px(line.points) < radii * line.radius_px + more_px;
    };
    changed = std::erase_if(graph.lines, is_spur) > 0;
    join_lines(graph);
  }
}

CentreLines centre_lines_of(const Raster<std::uint8_t>& mask, const ThinningGuide& guide,
                            const CentreLineOptions& options) {
  const cv::Mat view(mask.height(), mask.width(), CV_8U, const_cast<std::uint8_t*>(mask.data()));
  CentreLines graph = Tracer(thinned(mask, guide)).take();
  cv::Mat distance;
  cv::distanceTransform(view, distance, cv::DIST_L2, 5);
  measure_radii(graph, distance, options);
  remove_spurs(graph, options.spur_radii, options.spur_px);
  measure_radii(graph, distance, options);
  return graph;
}

int split_line(CentreLines& graph, std::size_t number, std::size_t at) {
  CentreLine& line = graph.lines[number];
  if (at == 0) return line.first;
  if (at + 1 == line.points.size()) return line.last;
  const int middle = static_cast<int>(graph.nodes.size());
  graph.nodes.push_back(line.points[at]);
  CentreLine rest = line;
  rest.points.assign(line.points.begin() + static_cast<std::ptrdiff_t>(at), line.points.end());
  rest.first = middle;
  line.points.resize(at + 1);
  line.last = middle;
  graph.lines.push_back(std::move(rest));
  return middle;
}

void connect_nodes(CentreLines& graph, int a, int b, double radius_px) {
  const MapPoint from = graph.nodes[static_cast<std::size_t>(a)];
  const MapPoint to = graph.nodes[static_cast<std::size_t>(b)];
  const int steps = std::max(1, static_cast<int>(std::hypot(to.x - from.x, to.y - from.y)));
  CentreLine line{{}, a, b, radius_px, 0.0};
  for (int i = 0; i <= steps; ++i) {
    const double part = static_cast<double>(i) / steps;
    line.points.push_back({from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)});
  }
  graph.lines.push_back(std::move(line));
}

std::vector<MapPoint> smoothed(const std::vector<MapPoint>& points, int reach) {
  std::vector<MapPoint> out = points;
  const int n = static_cast<int>(points.size());
  for (int i = 1; i + 1 < n; ++i) {
    const int r = std::min({reach, i, n - 1 - i});
    MapPoint sum;
    for (int k = i - r; k <= i + r; ++k) {
      sum.x += points[static_cast<std::size_t>(k)].x;
      sum.y += points[static_cast<std::size_t>(k)].y;
    }
    out[static_cast<std::size_t>(i)] = {sum.x / (2 * r + 1), sum.y / (2 * r + 1)};
  }
  return out;
}

std::vector<MapPoint> simplified(const std::vector<MapPoint>& points, double most_px) {
  if (points.size() < 3) return points;
  std::vector<bool> kept(points.size(), false);
  kept.front() = kept.back() = true;
  std::vector<std::array<std::size_t, 2>> open{{0, points.size() - 1}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    double worst = most_px;
    std::size_t at = 0;
    for (std::size_t i = a + 1; i < b; ++i)
      if (const double d = distance_to_segment(points[i], points[a], points[b]); d > worst) {
        worst = d;
        at = i;
      }
    if (at == 0) continue;
    kept[at] = true;
    open.push_back({a, at});
    open.push_back({at, b});
  }
  std::vector<MapPoint> out;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (kept[i]) out.push_back(points[i]);
  return out;
}

}  // namespace palpable::vision
