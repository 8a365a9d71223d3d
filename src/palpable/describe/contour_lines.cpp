// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/contour_lines.hpp"

#include "palpable/core/check.hpp"
#include "palpable/describe/skeleton.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace palpable::describe {
namespace {

constexpr int kLongestLineSide = 512;
// Largest distance of a centre line from the pixels of its stroke.
constexpr double kHalfWidth_px = 24.0;

double strength_of(const models::BoundaryPixel& pixel) {
  return std::hypot(double{pixel.c2}, double{pixel.s2});
}

/// Mask of the lines with a border of one unset pixel; one mask pixel covers `step` x `step` pixels of the
/// map.
Mask mask_of(const models::BoundaryMap& map, int step) {
  const auto& edges = map.edges();
  Mask mask((edges.width() + step - 1) / step + 2, (edges.height() + step - 1) / step + 2, 0);
  for (int y = 0; y < edges.height(); ++y)
    for (int x = 0; x < edges.width(); ++x)
      if (strength_of(edges(x, y)) >= map.origin().threshold) mask(x / step + 1, y / step + 1) = 1;
  return mask;
}

/// Calls `visit` with the pixels of each area enclosed by lines.
template <class Visit>
void for_enclosed_areas(const Mask& mask, const Visit& visit) {
  Raster<int> areas(mask.width(), mask.height(), 0);
  flood(mask, {0, 0}, 1, areas, Connected::over_sides);
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x)
      if (mask(x, y) == 0 && areas(x, y) == 0) visit(flood(mask, {x, y}, 1, areas, Connected::over_sides));
}

void fill_small_areas(Mask& mask, std::size_t least_pixels) {
  std::vector<Pixel> small;
  for_enclosed_areas(mask, [&](const std::vector<Pixel>& area) {
    if (area.size() < least_pixels) small.insert(small.end(), area.begin(), area.end());
  });
  for (const Pixel p : small) mask(p.x, p.y) = 1;
}

/// Whether any pixel (`any`), or every one, within `radius` of a pixel is set; outside the mask counts as
/// neither.
bool is_set_around(const Mask& mask, Pixel at, int radius, bool any) {
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx) {
      const int x = at.x + dx, y = at.y + dy;
      if (dx * dx + dy * dy > radius * radius || x < 0 || y < 0 || x >= mask.width() || y >= mask.height())
        continue;
      if ((mask(x, y) != 0) == any) return any;
    }
  return !any;
}

/// Morphological closing: the two edges of a drawn stroke become one line. The border stays unset.
void close_slits(Mask& mask, int radius) {
  const Mask lines = mask;
  Mask wide(mask.width(), mask.height(), 0);
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x) wide(x, y) = is_set_around(lines, {x, y}, radius, true) ? 1 : 0;
  for (int y = 1; y + 1 < mask.height(); ++y)
    for (int x = 1; x + 1 < mask.width(); ++x)
      mask(x, y) = is_set_around(wide, {x, y}, radius, false) ? 1 : 0;
}

using PlacePx = std::array<double, 2>;

double distance_px(PlacePx a, PlacePx b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }
PlacePx centre_of(Pixel p) { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }

/// One end of a path at a node.
struct PathEnd {
  std::size_t path = 0;
  bool at_last = false;
};

/// The paths of a skeleton without short side branches, and their connections at the nodes.
class PathGraph {
 public:
  PathGraph(Skeleton skeleton, double least_branch_px)
      : paths_(std::move(skeleton.paths)), nodes_(std::move(skeleton.nodes)) {
    for (SkeletonPath& path : paths_) lengths_.push_back(length_px(path));
    drop_branches(least_branch_px);
    join_near_nodes(least_branch_px);
  }

  const SkeletonPath& path(std::size_t k) const { return paths_[k]; }
  std::size_t paths() const { return paths_.size(); }
  bool is_dropped(std::size_t k) const { return lengths_[k] < 0.0; }
  PlacePx node(int k) const { return nodes_[static_cast<std::size_t>(k)]; }

  /// The ends of paths at each node.
  std::vector<std::vector<PathEnd>> ends_at_nodes() const {
    std::vector<std::vector<PathEnd>> ends(nodes_.size());
    for (std::size_t k = 0; k < paths_.size(); ++k) {
      if (is_dropped(k)) continue;
      if (paths_[k].first >= 0) ends[static_cast<std::size_t>(paths_[k].first)].push_back({k, false});
      if (paths_[k].last >= 0) ends[static_cast<std::size_t>(paths_[k].last)].push_back({k, true});
    }
    return ends;
  }

  /// Unit vector along which a path leaves its node.
  PlacePx direction(PathEnd end) const {
    // Long compared with a pixel and with the width of the node.
    constexpr std::size_t kReach_px = 12;
    const auto& pixels = paths_[end.path].pixels;
    const std::size_t reach = std::min(kReach_px, pixels.size() - 1);
    const PlacePx far = centre_of(end.at_last ? pixels[pixels.size() - 1 - reach] : pixels[reach]);
    const PlacePx from = node(end.at_last ? paths_[end.path].last : paths_[end.path].first);
    const double length = std::max(distance_px(far, from), 1e-9);
    return {(far[0] - from[0]) / length, (far[1] - from[1]) / length};
  }

 private:
  double length_px(const SkeletonPath& path) const {
    double length = 0.0;
    for (std::size_t k = 1; k < path.pixels.size(); ++k)
      length += distance_px(centre_of(path.pixels[k - 1]), centre_of(path.pixels[k]));
    for (const auto& [node_index, at] :
         {std::pair{path.first, path.pixels.front()}, {path.last, path.pixels.back()}})
      if (node_index >= 0) length += distance_px(node(node_index), centre_of(at));
    return length;
  }

  void drop_branches(double least_px) {
    for (std::size_t k = 0; k < paths_.size(); ++k) {
      const bool one_free = (paths_[k].first < 0) != (paths_[k].last < 0);
      if (one_free && lengths_[k] < least_px) lengths_[k] = -1.0;
    }
  }

  /// Merges nodes that are joined by a short path into one junction.
  void join_near_nodes(double least_px) {
    std::vector<std::size_t> group(nodes_.size());
    std::iota(group.begin(), group.end(), std::size_t{0});
    const auto root = [&](std::size_t node) {
      while (group[node] != node) node = group[node];
      return node;
    };
    for (std::size_t k = 0; k < paths_.size(); ++k) {
      if (is_dropped(k) || lengths_[k] >= least_px || paths_[k].first < 0 || paths_[k].last < 0) continue;
      group[root(static_cast<std::size_t>(paths_[k].first))] = root(static_cast<std::size_t>(paths_[k].last));
      lengths_[k] = -1.0;
    }
    std::vector<PlacePx> sums(nodes_.size(), PlacePx{});
    std::vector<int> counts(nodes_.size(), 0);
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      sums[root(n)][0] += nodes_[n][0];
      sums[root(n)][1] += nodes_[n][1];
      ++counts[root(n)];
    }
    for (std::size_t n = 0; n < nodes_.size(); ++n)
      if (counts[n] > 0) nodes_[n] = {sums[n][0] / counts[n], sums[n][1] / counts[n]};
    for (SkeletonPath& path : paths_)
      for (int* const end : {&path.first, &path.last})
        if (*end >= 0) *end = static_cast<int>(root(static_cast<std::size_t>(*end)));
  }

  std::vector<SkeletonPath> paths_;
  std::vector<PlacePx> nodes_;
  /// Negative: dropped.
  std::vector<double> lengths_;
};

/// For each path end, the path end where the line continues; the end itself if the line ends there. Index:
/// twice the path, plus one for its last end.
using Continuations = std::vector<std::size_t>;
std::size_t index_of(PathEnd end) { return 2 * end.path + (end.at_last ? 1 : 0); }

/// Pairs the ends at each node greedily, the straightest pair first, while the turn is at most
/// `greatest_turn_rad`. If only two paths meet at a node, they are one line whatever the turn.
Continuations continuations_of(const PathGraph& graph, double greatest_turn_rad) {
  Continuations next(2 * graph.paths());
  std::iota(next.begin(), next.end(), std::size_t{0});
  for (const auto& ends : graph.ends_at_nodes()) {
    std::vector<bool> taken(ends.size(), false);
    const double most = ends.size() == 2 ? 1.0 : -std::cos(greatest_turn_rad);
    while (true) {
      double best = most;
      std::pair<std::size_t, std::size_t> pair{0, 0};
      for (std::size_t a = 0; a < ends.size(); ++a)
        for (std::size_t b = a + 1; b < ends.size(); ++b) {
          if (taken[a] || taken[b]) continue;
          const PlacePx u = graph.direction(ends[a]), v = graph.direction(ends[b]);
          const double cosine = u[0] * v[0] + u[1] * v[1];
          if (cosine <= best) best = cosine, pair = {a, b};
        }
      if (pair.first == pair.second) break;
      taken[pair.first] = taken[pair.second] = true;
      next[index_of(ends[pair.first])] = index_of(ends[pair.second]);
      next[index_of(ends[pair.second])] = index_of(ends[pair.first]);
    }
  }
  return next;
}

/// A line as a sequence of points, in pixels.
struct Chain {
  std::vector<PlacePx> places;
  bool closed = false;
};

/// Follows a path from one of its ends, and its continuations, until the line ends or is closed.
Chain chain_from(const PathGraph& graph, const Continuations& next, std::size_t start,
                 std::vector<bool>& seen) {
  Chain chain;
  for (std::size_t end = start;;) {
    const SkeletonPath& path = graph.path(end / 2);
    const bool backwards = end % 2 == 1;
    seen[end / 2] = true;
    const int from = backwards ? path.last : path.first, to = backwards ? path.first : path.last;
    if (from >= 0) chain.places.push_back(graph.node(from));
    std::vector<Pixel> pixels = path.pixels;
    if (backwards) std::reverse(pixels.begin(), pixels.end());
    for (const Pixel p : pixels) chain.places.push_back(centre_of(p));
    if (to >= 0) chain.places.push_back(graph.node(to));
    const std::size_t leaves_by = end ^ 1U;
    if (next[leaves_by] == start) chain.closed = true;
    if (next[leaves_by] == leaves_by || seen[next[leaves_by] / 2]) {
      chain.closed = chain.closed || path.closed;
      return chain;
    }
    end = next[leaves_by];
  }
}

std::vector<Chain> chains_of(const PathGraph& graph, const Continuations& next) {
  std::vector<Chain> chains;
  std::vector<bool> seen(graph.paths(), false);
  // Free ends first, so that no line starts in its middle; then the closed lines.
  for (const bool loose : {true, false})
    for (std::size_t end = 0; end < next.size(); ++end) {
      if (seen[end / 2] || graph.is_dropped(end / 2) || (loose && next[end] != end)) continue;
      chains.push_back(chain_from(graph, next, end, seen));
    }
  return chains;
}

/// Moving average along the line: the staircase of pixels would make a slanted line too long.
std::vector<PlacePx> smoothed(const Chain& chain) {
  constexpr std::ptrdiff_t kHalf = 3;
  const auto count = static_cast<std::ptrdiff_t>(chain.places.size());
  std::vector<PlacePx> smooth;
  smooth.reserve(chain.places.size());
  for (std::ptrdiff_t k = 0; k < count; ++k) {
    // Fewer points near the ends of an open line, so that the ends do not move.
    const std::ptrdiff_t half =
        chain.closed ? std::min(kHalf, (count - 1) / 2) : std::min({kHalf, k, count - 1 - k});
    PlacePx sum{};
    for (std::ptrdiff_t d = -half; d <= half; ++d) {
      const PlacePx& p = chain.places[static_cast<std::size_t>((k + d + count) % count)];
      sum[0] += p[0], sum[1] += p[1];
    }
    const auto taken = static_cast<double>(2 * half + 1);
    smooth.push_back({sum[0] / taken, sum[1] / taken});
  }
  return smooth;
}

double strength_at(const Raster<models::BoundaryPixel>& edges, double u, double v) {
  const int i = std::clamp(static_cast<int>(std::floor(u)), 0, edges.width() - 2);
  const int j = std::clamp(static_cast<int>(std::floor(v)), 0, edges.height() - 2);
  const double a = std::clamp(u - i, 0.0, 1.0), b = std::clamp(v - j, 0.0, 1.0);
  return (1.0 - b) * ((1.0 - a) * strength_of(edges(i, j)) + a * strength_of(edges(i + 1, j))) +
         b * ((1.0 - a) * strength_of(edges(i, j + 1)) + a * strength_of(edges(i + 1, j + 1)));
}

/// Offset of the maximal strength across the line from a pixel, in pixels along the normal; nullopt if the
/// pixel is not on the ridge. If the strength is constant across the line, the middle of the line.
std::optional<double> ridge_offset(const Raster<models::BoundaryPixel>& edges, int x, int y, PlacePx normal) {
  constexpr double kSame = 1e-3, kStep_px = 0.5;
  const double here = strength_of(edges(x, y));
  const auto across = [&](double t) { return strength_at(edges, x + t * normal[0], y + t * normal[1]); };
  const double before = across(-1.0), after = across(1.0);
  if (std::max(before, after) > (1.0 + kSame) * here) return std::nullopt;
  // Vertex of the parabola through the three values.
  if (std::max(before, after) < (1.0 - kSame) * here)
    return 0.5 * (before - after) / (before - 2.0 * here + after);
  std::array<double, 2> ends{};
  for (const double side : {-1.0, 1.0}) {
    double t = kStep_px;
    while (t < kHalfWidth_px && across(side * t) >= (1.0 - kSame) * here) t += kStep_px;
    if (across(side * t) > (1.0 + kSame) * here) return std::nullopt;
    ends[side < 0.0 ? 0 : 1] = side * t;
  }
  return 0.5 * (ends[0] + ends[1]);
}

}  // namespace

std::vector<Parameter> parameters_of(ContourLineOptions& o) {
  return {{"least_length", &o.least_length, {0.0, 1.0}, "", "shortest line, as a share of the longer side"},
          {"least_branch",
           &o.least_branch,
           {0.0, 0.1},
           "",
           "shortest side branch, as a share of the longer side"},
          {"greatest_turn_degrees",
           &o.greatest_turn_degrees,
           {0.0, 90.0},
           "degrees",
           "greatest turn of a line that goes straight ahead through a junction"},
          {"least_area", &o.least_area, {0.0, 0.1}, "", "smallest enclosed area, as a share of the map's"},
          {"closing",
           &o.closing,
           {0.0, 0.02},
           "",
           "half the slit that is closed, as a share of the longer side"}};
}

ContourDrawing find_contour_lines(const models::BoundaryMap& map, const ContourLineOptions& options) {
  PALPABLE_CHECK(check_ranges(options));
  const auto& edges = map.edges();
  const int step = (std::max(edges.width(), edges.height()) + kLongestLineSide - 1) / kLongestLineSide;
  Mask mask = mask_of(map, step);
  close_slits(mask, static_cast<int>(std::lround(options.closing * std::max(mask.width(), mask.height()))));
  fill_small_areas(mask, static_cast<std::size_t>(options.least_area * static_cast<double>(mask.count())));
  thin_to_lines(mask);
  const double pixel_m = step * map.pixel_m();
  // The border pixel does not belong to the map.
  const auto place_of = [&](PlacePx p) {
    return Place{(p[0] - 0.5) * pixel_m - 0.5 * map.size_x_m(),
                 0.5 * map.size_y_m() - (p[1] - 0.5) * pixel_m};
  };
  const double side_px = std::max(map.size_x_m(), map.size_y_m()) / pixel_m;
  const PathGraph graph(paths_of(mask), options.least_branch * side_px);
  const auto next = continuations_of(graph, options.greatest_turn_degrees * std::numbers::pi / 180.0);
  ContourDrawing drawing;
  for (const Chain& chain : chains_of(graph, next)) {
    const auto places = smoothed(chain);
    ContourLine line;
    line.closed = chain.closed;
    line.first = line.least = line.most = place_of(places.front());
    line.last = place_of(chain.closed ? places.front() : places.back());
    for (std::size_t k = 0; k < places.size(); ++k) {
      if (k > 0) line.length_m += pixel_m * distance_px(places[k - 1], places[k]);
      const Place p = place_of(places[k]);
      line.points.push_back(p);
      line.least = {std::min(line.least.x_m, p.x_m), std::min(line.least.y_m, p.y_m)};
      line.most = {std::max(line.most.x_m, p.x_m), std::max(line.most.y_m, p.y_m)};
    }
    if (chain.closed) line.length_m += pixel_m * distance_px(places.back(), places.front());
    if (line.length_m >= options.least_length * side_px * pixel_m) drawing.lines.push_back(std::move(line));
  }
  std::stable_sort(drawing.lines.begin(), drawing.lines.end(),
                   [](const ContourLine& a, const ContourLine& b) { return a.length_m > b.length_m; });
  const auto ends = graph.ends_at_nodes();
  for (std::size_t n = 0; n < ends.size(); ++n)
    if (ends[n].size() >= 3) drawing.junctions.push_back(place_of(graph.node(static_cast<int>(n))));
  for_enclosed_areas(mask, [&](const std::vector<Pixel>&) { ++drawing.enclosed_areas; });
  return drawing;
}

std::optional<NearestLine> nearest_line(const models::BoundaryMap& map, Place place, double reach_m) {
  const auto& edges = map.edges();
  const double pixel_m = map.pixel_m();
  const double column = (place.x_m + 0.5 * map.size_x_m()) / pixel_m - 0.5,
               row = (0.5 * map.size_y_m() - place.y_m) / pixel_m - 0.5;
  const auto first = [](double centre, double reach) {
    return std::max(0, static_cast<int>(std::ceil(centre - reach)));
  };
  const auto last = [](double centre, double reach, int count) {
    return std::min(count - 1, static_cast<int>(std::floor(centre + reach)));
  };
  const double reach = std::min(reach_m / pixel_m, 1e6);
  const double pixels = reach + kHalfWidth_px;
  double nearest = reach;
  std::optional<NearestLine> found;
  for (int y = first(row, pixels); y <= last(row, pixels, edges.height()); ++y)
    for (int x = first(column, pixels); x <= last(column, pixels, edges.width()); ++x) {
      if (std::hypot(x - column, y - row) > nearest + kHalfWidth_px) continue;
      if (strength_of(edges(x, y)) < map.origin().threshold) continue;
      const double doubled = std::atan2(double{edges(x, y).s2}, double{edges(x, y).c2});
      const double angle = 0.5 * (doubled < 0.0 ? doubled + 2.0 * std::numbers::pi : doubled);
      // Rows grow downwards.
      const PlacePx normal{std::sin(angle), std::cos(angle)};
      const auto offset = ridge_offset(edges, x, y, normal);
      if (!offset) continue;
      const double dx = x + *offset * normal[0] - column, dy = y + *offset * normal[1] - row;
      if (std::hypot(dx, dy) > nearest) continue;
      nearest = std::hypot(dx, dy);
      found = NearestLine{dx * pixel_m, -dy * pixel_m, angle};
    }
  return found;
}

}  // namespace palpable::describe
