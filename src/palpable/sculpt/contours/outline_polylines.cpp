// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/contours/outline_polylines.hpp"

#include "palpable/core/check.hpp"
#include "palpable/core/geometry/segment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

namespace palpable::sculpt {
namespace {

/// The four direct neighbours first, then the diagonal ones.
constexpr std::array<Pixel, 8> kStepsToNeighbours{
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

bool touching(Pixel a, Pixel b) { return std::abs(a.x - b.x) <= 1 && std::abs(a.y - b.y) <= 1; }

/// Follows lines pixel by pixel and marks the visited pixels.
class Tracer {
 public:
  explicit Tracer(const Raster<float>& line) : line_(line), visited_(line.width(), line.height()) {}

  bool is_open(Pixel p) const { return is_line(p) && visited_(p.x, p.y) == 0; }

  /// Neighbours in the line that are not neighbours of each other: 1 at an end, 2 along a line.
  int branches(Pixel p) const {
    // Around the pixel in order; runs of line pixels are one branch.
    constexpr std::array<Pixel, 8> kRing{
        {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
    int runs = 0;
    for (std::size_t k = 0; k < kRing.size(); ++k) {
      const Pixel before = kRing[(k + kRing.size() - 1) % kRing.size()];
      runs +=
          is_line({p.x + kRing[k].x, p.y + kRing[k].y}) && !is_line({p.x + before.x, p.y + before.y}) ? 1 : 0;
    }
    return runs;
  }

  /// The line that begins at `first`: its connected unvisited pixels, and the visited pixel at its end, if
  /// any.
  std::vector<Pixel> follow(Pixel first) {
    std::vector<Pixel> line_pixels;
    for (std::optional<Pixel> at = first; at; at = next(*at)) {
      visited_(at->x, at->y) = 1;
      line_pixels.push_back(*at);
    }
    if (const auto joint = visited_neighbour(line_pixels)) line_pixels.push_back(*joint);
    return line_pixels;
  }

 private:
  bool is_line(Pixel p) const { return line_.contains(p.x, p.y) && line_(p.x, p.y) > 0.0F; }
  std::optional<Pixel> next(Pixel p) const {
    for (const Pixel step : kStepsToNeighbours)
      if (const Pixel q{p.x + step.x, p.y + step.y}; is_open(q)) return q;
    return std::nullopt;
  }
  /// A visited pixel beside the line's end that is not one of the line's own last pixels.
  std::optional<Pixel> visited_neighbour(const std::vector<Pixel>& line_pixels) const {
    const Pixel end = line_pixels.back();
    for (const Pixel step : kStepsToNeighbours) {
      const Pixel q{end.x + step.x, end.y + step.y};
      const std::size_t own = std::min<std::size_t>(line_pixels.size(), 3);
      const bool is_own = std::any_of(line_pixels.end() - static_cast<std::ptrdiff_t>(own), line_pixels.end(),
                                      [&](Pixel p) { return p.x == q.x && p.y == q.y; });
      if (is_line(q) && !is_own) return q;
    }
    return std::nullopt;
  }

  const Raster<float>& line_;
  Raster<std::uint8_t> visited_;
};

/// Marks the points between `first` and `last` that the simplified line keeps (Douglas & Peucker 1973).
void keep_needed(const std::vector<Vec3>& points, std::size_t first, std::size_t last, double tolerance_m,
                 std::vector<bool>& kept) {
  std::size_t farthest = first;
  double most = tolerance_m;
  for (std::size_t i = first + 1; i < last; ++i)
    if (const double off = distance_to_segment(points[i], points[first], points[last]); off > most)
      most = off, farthest = i;
  if (farthest == first) return;
  kept[farthest] = true;
  keep_needed(points, first, farthest, tolerance_m, kept);
  keep_needed(points, farthest, last, tolerance_m, kept);
}

std::vector<Vec3> simplified(const std::vector<Vec3>& points, double tolerance_m) {
  if (points.size() < 3) return points;
  std::vector<bool> kept(points.size());
  kept.front() = kept.back() = true;
  // A closed line has no ends: it is cut where it is farthest from its start.
  std::size_t cut = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    if (norm(points[i] - points[0]) > norm(points[cut] - points[0])) cut = i;
  kept[cut] = true;
  keep_needed(points, 0, cut, tolerance_m, kept);
  keep_needed(points, cut, points.size() - 1, tolerance_m, kept);
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (kept[i]) out.push_back(points[i]);
  return out;
}

/// Averages each point with its neighbours: pixels lie up to half a pixel beside their line.
std::vector<Vec3> smoothed(const std::vector<Vec3>& points, bool closed) {
  std::vector<Vec3> out = points;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (!closed && (i == 0 || i + 1 == n)) continue;
    out[i] = 0.25 * points[(i + n - 1) % n] + 0.5 * points[i] + 0.25 * points[(i + 1) % n];
  }
  return out;
}

}  // namespace

std::vector<Parameter> parameters_of(OutlineOptions& o) {
  return {{"least_length_m", &o.least_length_m, {0, 0.1}, "m", "shortest line"},
          {"tolerance_m", &o.tolerance_m, {0, 0.01}, "m", "tolerance of the simplification"}};
}

std::vector<Polyline> outline_polylines(const Raster<float>& line, double pixel_m,
                                        const OutlineOptions& options) {
  PALPABLE_CHECK(check_ranges(options));
  Tracer tracer(line);
  std::vector<Polyline> out;
  const auto trace = [&](Pixel first) {
    const std::vector<Pixel> line_pixels = tracer.follow(first);
    Polyline found;
    found.closed = line_pixels.size() > 3 && touching(line_pixels.front(), line_pixels.back());
    for (const Pixel p : line_pixels)
      found.points.push_back(
          {(p.x - 0.5 * (line.width() - 1)) * pixel_m, (0.5 * (line.height() - 1) - p.y) * pixel_m, 0.0});
    found.points = simplified(smoothed(found.points, found.closed), options.tolerance_m);
    if (found.points.size() > 1 && length_of(found) >= options.least_length_m)
      out.push_back(std::move(found));
  };
  // Open lines first, from their ends, so that each is followed as a whole. The pixels that remain form
  // closed lines.
  for (const bool at_ends : {true, false})
    for (int y = 0; y < line.height(); ++y)
      for (int x = 0; x < line.width(); ++x)
        if (tracer.is_open({x, y}) && (!at_ends || tracer.branches({x, y}) == 1)) trace({x, y});
  return out;
}

}  // namespace palpable::sculpt
