// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/methods/segment_planes.hpp"

#include "palpable/core/numbers/median.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include <opencv2/core.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

namespace palpable::vision {
namespace {

using PixelLists = std::vector<std::vector<Pixel>>;

double median_disparity(const Raster<float>& disparity_px, const std::vector<Pixel>& pixels) {
  std::vector<float> values;
  values.reserve(pixels.size());
  for (const Pixel p : pixels) values.push_back(disparity_px(p.x, p.y));
  return static_cast<double>(median_of(std::move(values)));
}

/// One reweighted least-squares step; pixels more than `reach_px` from the plane do not count.
SegmentPlane refitted(const SegmentPlane& plane, const Raster<float>& disparity_px,
                      const std::vector<Pixel>& pixels, double reach_px, const SegmentPlaneOptions& options) {
  cv::Matx33d normal = cv::Matx33d::zeros();
  cv::Vec3d right{0.0, 0.0, 0.0};
  SegmentPlane out = plane;
  out.support = 0;
  for (const Pixel p : pixels) {
    const double residual = static_cast<double>(disparity_px(p.x, p.y)) - plane.at(p.x, p.y);
    const double r = residual / reach_px;
    if (std::abs(r) >= 1.0) continue;
    const double weight = (1.0 - r * r) * (1.0 - r * r);  // Tukey's
    const cv::Vec3d v{1.0, p.x - plane.x0, p.y - plane.y0};
    normal += weight * v * v.t();
    right += weight * residual * v;
    if (std::abs(residual) <= options.support_px) ++out.support;
  }
  normal(0, 0) += 1e-6;
  normal(1, 1) += options.slope_ridge;
  normal(2, 2) += options.slope_ridge;
  right[1] -= options.slope_ridge * plane.slope_x;
  right[2] -= options.slope_ridge * plane.slope_y;
  const cv::Vec3d step = normal.solve(right, cv::DECOMP_CHOLESKY);
  out.at_middle += step[0];
  out.slope_x = std::clamp(plane.slope_x + step[1], -options.steepest, options.steepest);
  out.slope_y = std::clamp(plane.slope_y + step[2], -options.steepest, options.steepest);
  return out;
}

SegmentPlane fit_plane(const Raster<float>& disparity_px, const std::vector<Pixel>& pixels,
                       const SegmentPlaneOptions& options) {
  SegmentPlane plane;
  for (const Pixel p : pixels) {
    plane.x0 += p.x / static_cast<double>(pixels.size());
    plane.y0 += p.y / static_cast<double>(pixels.size());
  }
  plane.at_middle = median_disparity(disparity_px, pixels);
  for (const double reach_px : options.fit_reach_px)
    plane = refitted(plane, disparity_px, pixels, reach_px, options);
  return plane;
}

/// Removes planes that hardly differ from one with more support.
std::vector<SegmentPlane> distinct(std::vector<SegmentPlane> planes, const SegmentPlaneOptions& options) {
  std::stable_sort(planes.begin(), planes.end(),
                   [](const SegmentPlane& a, const SegmentPlane& b) { return a.support > b.support; });
  std::vector<SegmentPlane> out;
  for (const SegmentPlane& plane : planes) {
    const bool known = std::any_of(out.begin(), out.end(), [&](const SegmentPlane& other) {
      const double there =
          other.at_middle + other.slope_x * (plane.x0 - other.x0) + other.slope_y * (plane.y0 - other.y0);
      return std::abs(there - plane.at_middle) +
                 options.same_radius_px * std::abs(other.slope_x - plane.slope_x) +
                 options.same_radius_px * std::abs(other.slope_y - plane.slope_y) <
             options.same_px;
    });
    if (!known) out.push_back(plane);
    if (out.size() == static_cast<std::size_t>(options.most_planes)) break;
  }
  return out;
}

/// The segments' pixels, and their adjacency.
struct SegmentGraph {
  struct Border {
    std::size_t to;
    /// Smoothness between the two.
    double weight;
  };
  PixelLists all;
  PixelLists trusted;
  std::vector<std::vector<Border>> borders;
  /// Sum of the weights of each segment's borders.
  std::vector<double> ties;
};

SegmentGraph make_graph(const MatchInput& input, const ColourSegments& segments,
                        const Raster<std::uint8_t>& trusted, const SegmentPlaneOptions& options) {
  SegmentGraph graph;
  const auto count = static_cast<std::size_t>(segments.count);
  graph.all.resize(count);
  graph.trusted.resize(count);
  std::map<std::pair<int, int>, double> borders;
  const auto border = [&](int x, int y, int u, int v) {
    const int a = segments.of_pixel(x, y);
    const int b = segments.of_pixel(u, v);
    if (a == b) return;
    const Rgb8 p = input.left(x, y);
    const Rgb8 q = input.left(u, v);
    const double levels = (std::abs(p.r - q.r) + std::abs(p.g - q.g) + std::abs(p.b - q.b)) / 3.0;
    borders[std::minmax(a, b)] +=
        options.border_cost *
        (options.least_border + (1.0 - options.least_border) * std::exp(-levels / options.border_levels));
  };
  for (int y = 0; y < input.left.height(); ++y) {
    for (int x = 0; x < input.left.width(); ++x) {
      const auto segment = static_cast<std::size_t>(segments.of_pixel(x, y));
      graph.all[segment].push_back({x, y});
      if (trusted(x, y) != 0) graph.trusted[segment].push_back({x, y});
      if (input.left.contains(x + 1, y)) border(x, y, x + 1, y);
      if (input.left.contains(x, y + 1)) border(x, y, x, y + 1);
    }
  }
  graph.borders.resize(count);
  graph.ties.resize(count);
  for (const auto& [pair, weight] : borders) {
    const auto a = static_cast<std::size_t>(pair.first);
    const auto b = static_cast<std::size_t>(pair.second);
    graph.borders[a].push_back({b, weight});
    graph.borders[b].push_back({a, weight});
    graph.ties[a] += weight;
    graph.ties[b] += weight;
  }
  return graph;
}

/// The interpolated matching cost; beyond the volume's ends twice the limit.
double cost_at(const std::uint8_t* costs, int disparities, double limit, double d) {
  const int last = disparities - 1;
  if (d < -0.5 || d > last + 0.5) return limit * 2.0;
  const double inside = std::clamp(d, 0.0, static_cast<double>(last));
  const int below = std::min(static_cast<int>(inside), last - 1);
  const double t = inside - below;
  return (1.0 - t) * costs[below] + t * costs[below + 1];
}

/// costs[segment * planes + plane]: C(S, P) = sum of c over the segment's pixels times e^(1 - s/n), where s
/// of its n trusted pixels support the plane. A sum stops early once the plane can no longer be chosen.
std::vector<double> plane_costs(const MatchInput& input, const std::vector<std::uint8_t>& volume,
                                const SegmentGraph& graph, const Raster<float>& disparity_px,
                                const std::vector<SegmentPlane>& planes, const SegmentPlaneOptions& options,
                                const Work& work) {
  const auto limit = static_cast<double>(options.data.limit);
  std::vector<double> out(graph.all.size() * planes.size());
  const auto disparities = static_cast<std::size_t>(input.disparities);
  const auto width = static_cast<std::size_t>(input.left.width());
  const auto cost_of = [&](std::size_t s, const SegmentPlane& plane, double most) {
    double sum = 0.0;
    for (const Pixel p : graph.all[s]) {
      const std::size_t at = static_cast<std::size_t>(p.y) * width + static_cast<std::size_t>(p.x);
      sum += cost_at(volume.data() + at * disparities, input.disparities, limit, plane.at(p.x, p.y));
      if (sum >= most) return sum;
    }
    int support = 0;
    for (const Pixel p : graph.trusted[s])
      support +=
          std::abs(static_cast<double>(disparity_px(p.x, p.y)) - plane.at(p.x, p.y)) < options.support_px ? 1
                                                                                                          : 0;
    const auto n = std::max<std::size_t>(1, graph.trusted[s].size());
    return sum * std::exp(1.0 - support / static_cast<double>(n));
  };
  parallel_for(work, static_cast<int>(graph.all.size()), 8, [&](int begin, int end) {
    for (auto s = static_cast<std::size_t>(begin); s < static_cast<std::size_t>(end) && !work.cancelled();
         ++s) {
      double least = std::numeric_limits<double>::max();
      for (std::size_t k = 0; k < planes.size(); ++k) {
        const double cost = cost_of(s, planes[k], least + 2.0 * graph.ties[s]);
        out[s * planes.size() + k] = cost;
        least = std::min(least, cost);
      }
    }
  });
  return out;
}

/// One expansion move: the cut among the segments that may take the plane `alpha`. A segment keeps its plane
/// if that is cheaper by more than the weight of all its borders. Returns whether any segment has changed.
bool expand_plane(const SegmentGraph& graph, const std::vector<double>& costs, std::size_t planes,
                  std::size_t alpha, std::vector<std::size_t>& plane_of) {
  std::vector<int> place(plane_of.size(), -1);
  std::vector<std::size_t> open;
  for (std::size_t s = 0; s < plane_of.size(); ++s) {
    const double now = costs[s * planes + plane_of[s]];
    if (plane_of[s] == alpha || costs[s * planes + alpha] >= now + graph.ties[s]) continue;
    place[s] = static_cast<int>(open.size());
    open.push_back(s);
  }
  if (open.empty()) return false;
  const auto count = static_cast<int>(open.size());
  cv::detail::GCGraph<double> cut(static_cast<unsigned>(count + 2), static_cast<unsigned>(count * 4));
  for (int i = 0; i < count + 2; ++i) cut.addVtx();
  cut.addEdges(count, count + 1, 0.0, 0.0);  // OpenCV's graph must have an edge
  for (const std::size_t s : open) {
    const int i = place[s];
    // On the source's side a segment keeps its plane; on the sink's side it takes alpha.
    cut.addTermWeights(i, costs[s * planes + alpha], costs[s * planes + plane_of[s]]);
    for (const auto [t, weight] : graph.borders[s]) {
      const int j = place[t];
      const double as_it_is = plane_of[s] == plane_of[t] ? 0.0 : weight;
      if (j < 0) {
        cut.addTermWeights(i, plane_of[t] == alpha ? 0.0 : weight, as_it_is);
      } else if (i < j) {
        cut.addTermWeights(i, weight, as_it_is);
        cut.addTermWeights(j, 0.0, weight);
        cut.addEdges(i, j, 2.0 * weight - as_it_is, 0.0);
      }
    }
  }
  cut.maxFlow();
  bool changed = false;
  for (const std::size_t s : open) {
    if (cut.inSourceSegment(place[s])) continue;
    plane_of[s] = alpha;
    changed = true;
  }
  return changed;
}

/// Expansion moves over the segments (Boykov, Veksler & Zabih 2001) with a Potts term.
void expand_planes(const SegmentGraph& graph, const std::vector<double>& costs, std::size_t planes,
                   int rounds, std::vector<std::size_t>& plane_of, const Work& work) {
  bool changed = true;
  for (int round = 0; round < rounds && changed; ++round) {
    changed = false;
    for (std::size_t alpha = 0; alpha < planes && !work.cancelled(); ++alpha)
      changed = expand_plane(graph, costs, planes, alpha, plane_of) || changed;
  }
}

std::vector<std::size_t> cheapest_planes(const std::vector<double>& costs, std::size_t segments,
                                         std::size_t planes) {
  std::vector<std::size_t> out(segments);
  for (std::size_t s = 0; s < segments; ++s) {
    const auto first = costs.begin() + static_cast<std::ptrdiff_t>(s * planes);
    out[s] = static_cast<std::size_t>(std::min_element(first, first + static_cast<std::ptrdiff_t>(planes)) -
                                      first);
  }
  return out;
}

/// Refits every plane to the trusted pixels of all segments assigned to it, so that segments on one surface
/// share the fit.
std::vector<SegmentPlane> regrouped(const SegmentGraph& graph, const Raster<float>& disparity_px,
                                    const std::vector<SegmentPlane>& planes,
                                    const std::vector<std::size_t>& plane_of,
                                    const SegmentPlaneOptions& options) {
  PixelLists members(planes.size());
  for (std::size_t s = 0; s < plane_of.size(); ++s) {
    auto& of_plane = members[plane_of[s]];
    of_plane.insert(of_plane.end(), graph.trusted[s].begin(), graph.trusted[s].end());
  }
  std::vector<SegmentPlane> out = planes;
  for (std::size_t k = 0; k < planes.size(); ++k)
    if (members[k].size() >= static_cast<std::size_t>(options.refit_pixels))
      for (int i = 0; i < options.refit_steps; ++i)
        out[k] = refitted(out[k], disparity_px, members[k], options.refit_reach_px, options);
  return out;
}

}  // namespace

std::vector<Parameter> parameters_of(SegmentPlaneOptions& o) {
  std::vector<Parameter> all{
      {"least_trusted", &o.least_trusted, {3, 100000}, "px", "Least trusted pixels of a plane"},
      {"support_px", &o.support_px, {0.1, 10}, "px", "A pixel within this supports a plane"},
      {"slope_ridge", &o.slope_ridge, {0, 1e6}, "", "Ridge of the slopes' regression"},
      {"steepest", &o.steepest, {0, 4}, "px/px", "The steepest slope"},
      {"same_px", &o.same_px, {0, 10}, "px", "Planes that differ by less are one"},
      {"same_radius_px", &o.same_radius_px, {0, 1000}, "px", "Where they are compared"},
      {"most_planes", &o.most_planes, {1, 10000}, "", "Planes that are kept"},
      {"border_cost", &o.border_cost, {0, 1000}, "cost", "Smoothness for each pixel of a border"},
      {"border_levels", &o.border_levels, {0.1, 255}, "levels", "Colour difference at which it falls by e"},
      {"least_border", &o.least_border, {0, 1}, "", "Its least share"},
      {"expansion_rounds", &o.expansion_rounds, {1, 20}, "", "Rounds of expansion moves"},
      {"assignments", &o.assignments, {1, 20}, "", "How often planes are assigned"},
      {"refit_pixels", &o.refit_pixels, {3, 1e6}, "px", "Trusted pixels that a plane is fitted again to"},
      {"refit_steps", &o.refit_steps, {0, 20}, "", "Steps of that fit"},
      {"refit_reach_px", &o.refit_reach_px, {0.1, 100}, "px", "Pixels farther away do not count in it"},
      {"segments.radius_px", &o.segments.radius_px, {1, 50}, "px", "The mean shift's window"},
      {"segments.colour_levels",
       &o.segments.colour_levels,
       {1, 100},
       "levels",
       "The mean shift's window in colour"},
      {"segments.same_levels",
       &o.segments.same_levels,
       {1, 255},
       "levels",
       "Shifted colours that differ by less join"},
      {"segments.least_pixels",
       &o.segments.least_pixels,
       {1, 100000},
       "px",
       "Smaller segments join a neighbour"}};
  for (std::size_t i = 0; i < o.fit_reach_px.size(); ++i)
    all.push_back({"fit_reach_px." + std::to_string(i),
                   &o.fit_reach_px[i],
                   {0.1, 100},
                   "px",
                   "Pixels farther from the plane do not count in this step of a fit"});
  append_parameters(all, "scanlines", parameters_of(o.scanlines));
  append_parameters(all, "data", parameters_of(o.data));
  return all;
}

Result<SegmentPlanes> find_segment_planes(const MatchInput& input, const SegmentPlaneOptions& options,
                                          const Work& work) {
  const ScanlineMap map = scanline_map(input, options.scanlines, work);
  if (work.cancelled()) return Work::interrupted();
  Result<ColourSegments> segments = segment_by_colour(input.left, options.segments);
  if (!segments) return segments.error();
  const SegmentGraph graph = make_graph(input, *segments, map.trusted, options);
  const std::vector<std::uint8_t> volume = aggregated_costs(input, options.data, work);

  std::vector<SegmentPlane> planes;
  for (const auto& pixels : graph.trusted)
    if (pixels.size() >= static_cast<std::size_t>(options.least_trusted))
      planes.push_back(fit_plane(map.disparity_px, pixels, options));
  if (planes.empty()) planes.push_back({});  // without any trusted pixel everything is at infinity
  planes = distinct(std::move(planes), options);

  std::vector<std::size_t> plane_of;
  for (int time = 0; time < options.assignments; ++time) {
    if (work.cancelled()) return Work::interrupted();
    const std::vector<double> costs =
        plane_costs(input, volume, graph, map.disparity_px, planes, options, work);
    if (work.cancelled()) return Work::interrupted();
    plane_of = cheapest_planes(costs, graph.all.size(), planes.size());
    expand_planes(graph, costs, planes.size(), options.expansion_rounds, plane_of, work);
    planes = regrouped(graph, map.disparity_px, planes, plane_of, options);
  }
  if (work.cancelled()) return Work::interrupted();
  return SegmentPlanes{std::move(*segments), std::move(planes), std::move(plane_of)};
}

}  // namespace palpable::vision
