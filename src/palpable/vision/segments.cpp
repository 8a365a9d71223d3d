// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segments.hpp"

#include "palpable/vision/colour_segments.hpp"
#include "palpable/vision/consistency.hpp"
#include "palpable/vision/cross_window.hpp"
#include "palpable/vision/median.hpp"
#include "palpable/vision/plane_search.hpp"
#include "palpable/vision/scanline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/imgproc/detail/gcgraph.hpp>

// Hong & Chen 2004 as Gomez 2012 describes it (chapter 8), with the corrections of docs/stereo.md: mean-shift
// segments, a plane in disparity for each, and planes given to segments by graph cuts.
namespace palpable::vision {
namespace {

constexpr CrossOptions kWindow{.row_reach_px = 3, .column_reach_px = 3, .sure_reach_px = 1};
constexpr float kDataLimit = 60.0F;
constexpr std::size_t kMostPlanes = 300;
/// Smoothness for each pixel of a border between segments of different planes, in units of the matching cost.
constexpr double kBorder = 18.0;
constexpr double kBorderLevels = 12.0;

/// d = at_middle + slope_x (x - x0) + slope_y (y - y0)
struct Plane {
  double x0 = 0.0, y0 = 0.0;
  double at_middle = 0.0;
  double slope_x = 0.0, slope_y = 0.0;
  int support = 0;
  double at(int x, int y) const { return at_middle + slope_x * (x - x0) + slope_y * (y - y0); }
};

struct Pixel {
  int x, y;
};
using PixelLists = std::vector<std::vector<Pixel>>;

double median_of(const Raster<float>& disparity_px, const std::vector<Pixel>& pixels) {
  std::vector<float> values;
  values.reserve(pixels.size());
  for (const Pixel p : pixels) values.push_back(disparity_px(p.x, p.y));
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return static_cast<double>(*middle);
}

/// One reweighted least-squares step; pixels more than `reach_px` from the plane do not count.
Plane refitted(const Plane& plane, const Raster<float>& disparity_px, const std::vector<Pixel>& pixels,
               double reach_px) {
  cv::Matx33d normal = cv::Matx33d::zeros();
  cv::Vec3d right{0.0, 0.0, 0.0};
  Plane out = plane;
  out.support = 0;
  for (const Pixel p : pixels) {
    const double residual = static_cast<double>(disparity_px(p.x, p.y)) - plane.at(p.x, p.y);
    const double r = residual / reach_px;
    if (std::abs(r) >= 1.0) continue;
    const double weight = (1.0 - r * r) * (1.0 - r * r);  // Tukey's
    const cv::Vec3d v{1.0, p.x - plane.x0, p.y - plane.y0};
    normal += weight * v * v.t();
    right += weight * residual * v;
    if (std::abs(residual) <= 1.0) ++out.support;
  }
  // A little stiffness keeps the slopes of thin segments from running away.
  constexpr double kStiffness = 50.0;
  normal(0, 0) += 1e-6;
  normal(1, 1) += kStiffness;
  normal(2, 2) += kStiffness;
  right[1] -= kStiffness * plane.slope_x;
  right[2] -= kStiffness * plane.slope_y;
  const cv::Vec3d step = normal.solve(right, cv::DECOMP_CHOLESKY);
  constexpr double kSteepest = 0.7;
  out.at_middle += step[0];
  out.slope_x = std::clamp(plane.slope_x + step[1], -kSteepest, kSteepest);
  out.slope_y = std::clamp(plane.slope_y + step[2], -kSteepest, kSteepest);
  return out;
}

Plane fit_plane(const Raster<float>& disparity_px, const std::vector<Pixel>& pixels) {
  Plane plane;
  for (const Pixel p : pixels) {
    plane.x0 += p.x / static_cast<double>(pixels.size());
    plane.y0 += p.y / static_cast<double>(pixels.size());
  }
  plane.at_middle = median_of(disparity_px, pixels);
  for (const double reach_px : {6.0, 4.0, 3.0, 2.0, 1.5, 1.5})
    plane = refitted(plane, disparity_px, pixels, reach_px);
  return plane;
}

/// Planes that a plane of more support says already are left out: those that differ by less than half a pixel
/// at the middle and in its surroundings.
std::vector<Plane> distinct(std::vector<Plane> planes) {
  std::stable_sort(planes.begin(), planes.end(),
                   [](const Plane& a, const Plane& b) { return a.support > b.support; });
  std::vector<Plane> out;
  for (const Plane& plane : planes) {
    constexpr double kAround_px = 20.0;
    const bool known = std::any_of(out.begin(), out.end(), [&](const Plane& other) {
      const double there =
          other.at_middle + other.slope_x * (plane.x0 - other.x0) + other.slope_y * (plane.y0 - other.y0);
      return std::abs(there - plane.at_middle) + kAround_px * std::abs(other.slope_x - plane.slope_x) +
                 kAround_px * std::abs(other.slope_y - plane.slope_y) <
             0.5;
    });
    if (!known) out.push_back(plane);
    if (out.size() == kMostPlanes) break;
  }
  return out;
}

/// The segments, what borders on what, and what each plane costs each segment.
struct SegmentGraph {
  PixelLists all;
  PixelLists trusted;
  /// Smoothness between neighbouring segments, first < second.
  std::map<std::pair<int, int>, double> borders;
};

SegmentGraph make_graph(const MatchInput& input, const ColourSegments& segments,
                        const Raster<std::uint8_t>& trusted) {
  SegmentGraph graph;
  const auto count = static_cast<std::size_t>(segments.count);
  graph.all.resize(count);
  graph.trusted.resize(count);
  const auto border = [&](int x, int y, int u, int v) {
    const int a = segments.of_pixel(x, y);
    const int b = segments.of_pixel(u, v);
    if (a == b) return;
    const Rgb8 p = input.left(x, y);
    const Rgb8 q = input.left(u, v);
    const double levels = (std::abs(p.r - q.r) + std::abs(p.g - q.g) + std::abs(p.b - q.b)) / 3.0;
    graph.borders[std::minmax(a, b)] += kBorder * (0.2 + 0.8 * std::exp(-levels / kBorderLevels));
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
  return graph;
}

/// costs[segment * planes + plane]: C(S, P) = sum of c over the segment's pixels times e^(1 - s/n), where s
/// of its n trusted pixels lie within a pixel of the plane.
std::vector<double> plane_costs(const MatchInput& input, const std::vector<std::uint8_t>& volume,
                                const SegmentGraph& graph, const Raster<float>& disparity_px,
                                const std::vector<Plane>& planes, const Work& work) {
  std::vector<double> out(graph.all.size() * planes.size());
  const int last = input.disparities - 1;
  const auto cost_at = [&](Pixel p, double d) {
    const std::uint8_t* costs =
        volume.data() + (static_cast<std::size_t>(p.y) * static_cast<std::size_t>(input.left.width()) +
                         static_cast<std::size_t>(p.x)) *
                            static_cast<std::size_t>(input.disparities);
    if (d < -0.5 || d > last + 0.5) return static_cast<double>(kDataLimit) * 2.0;
    const double inside = std::clamp(d, 0.0, static_cast<double>(last));
    const int below = std::min(static_cast<int>(inside), last - 1);
    const double t = inside - below;
    return (1.0 - t) * costs[below] + t * costs[below + 1];
  };
  parallel_for(work, static_cast<int>(graph.all.size()), 8, [&](int begin, int end) {
    for (auto s = static_cast<std::size_t>(begin); s < static_cast<std::size_t>(end) && !work.cancelled();
         ++s) {
      for (std::size_t k = 0; k < planes.size(); ++k) {
        const Plane& plane = planes[k];
        double sum = 0.0;
        for (const Pixel p : graph.all[s]) sum += cost_at(p, plane.at(p.x, p.y));
        int support = 0;
        for (const Pixel p : graph.trusted[s])
          support += std::abs(static_cast<double>(disparity_px(p.x, p.y)) - plane.at(p.x, p.y)) < 1.0 ? 1 : 0;
        const auto n = std::max<std::size_t>(1, graph.trusted[s].size());
        out[s * planes.size() + k] = sum * std::exp(1.0 - support / static_cast<double>(n));
      }
    }
  });
  return out;
}

/// Expansion moves over the segments (Boykov, Veksler & Zabih 2001) with a Potts term.
void expand_planes(const SegmentGraph& graph, const std::vector<double>& costs, std::size_t planes,
                   std::vector<std::size_t>& plane_of, const Work& work) {
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    bool changed = false;
    for (std::size_t alpha = 0; alpha < planes && !work.cancelled(); ++alpha) {
      cv::detail::GCGraph<double> cut(static_cast<unsigned>(plane_of.size()),
                                      static_cast<unsigned>(graph.borders.size()));
      for (std::size_t s = 0; s < plane_of.size(); ++s) {
        cut.addVtx();
        // With the source, a segment keeps its plane; with the sink, it takes alpha.
        cut.addTermWeights(static_cast<int>(s), costs[s * planes + alpha], costs[s * planes + plane_of[s]]);
      }
      for (const auto& [pair, weight] : graph.borders) {
        const auto [i, j] = pair;
        const std::size_t a = plane_of[static_cast<std::size_t>(i)];
        const std::size_t b = plane_of[static_cast<std::size_t>(j)];
        const double none = a == b ? 0.0 : weight;
        const double second = a == alpha ? 0.0 : weight;
        const double first = b == alpha ? 0.0 : weight;
        cut.addTermWeights(i, first, none);
        cut.addTermWeights(j, 0.0, first);
        cut.addEdges(i, j, std::max(0.0, second + first - none), 0.0);
      }
      cut.maxFlow();
      for (std::size_t s = 0; s < plane_of.size(); ++s) {
        if (cut.inSourceSegment(static_cast<int>(s)) || plane_of[s] == alpha) continue;
        plane_of[s] = alpha;
        changed = true;
      }
    }
    if (!changed) break;
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

/// Every plane fitted again to the trusted pixels of all segments that chose it: neighbours that share a
/// surface settle it together.
std::vector<Plane> regrouped(const SegmentGraph& graph, const Raster<float>& disparity_px,
                             const std::vector<Plane>& planes, const std::vector<std::size_t>& plane_of) {
  PixelLists members(planes.size());
  for (std::size_t s = 0; s < plane_of.size(); ++s) {
    auto& of_plane = members[plane_of[s]];
    of_plane.insert(of_plane.end(), graph.trusted[s].begin(), graph.trusted[s].end());
  }
  std::vector<Plane> out = planes;
  for (std::size_t k = 0; k < planes.size(); ++k)
    if (members[k].size() >= 40)
      for (int i = 0; i < 3; ++i) out[k] = refitted(out[k], disparity_px, members[k], 1.5);
  return out;
}

/// The planes that the segments around a pixel have, near ones first.
void propose_segment_planes(const Raster<int>& segment_of, const std::vector<Plane>& planes,
                            const std::vector<std::size_t>& plane_of, PlaneCandidates& out,
                            const Work& work) {
  constexpr std::array<std::array<int, 2>, PlaneCandidates::kCount> kAround{{{0, 0},
                                                                             {-3, 0},
                                                                             {3, 0},
                                                                             {0, -3},
                                                                             {0, 3},
                                                                             {-3, -3},
                                                                             {3, 3},
                                                                             {-3, 3},
                                                                             {3, -3},
                                                                             {-8, 0},
                                                                             {8, 0},
                                                                             {0, -8},
                                                                             {0, 8},
                                                                             {-16, 0},
                                                                             {16, 0},
                                                                             {0, 16}}};
  parallel_for(work, out.height, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < out.width; ++x) {
        std::size_t k = out.at(x, y);
        for (const auto [dx, dy] : kAround) {
          const int u = std::clamp(x + dx, 0, out.width - 1);
          const int v = std::clamp(y + dy, 0, out.height - 1);
          const Plane& plane = planes[plane_of[static_cast<std::size_t>(segment_of(u, v))]];
          out.disparity[k] = static_cast<float>(plane.at(x, y));
          out.slope_x[k] = static_cast<float>(plane.slope_x);
          out.slope_y[k] = static_cast<float>(plane.slope_y);
          ++k;
        }
      }
  });
}

/// The right picture's disparities as the left one's say: the nearest surface in front; what none reaches
/// lies behind.
Raster<float> seen_from_right(const Raster<float>& left_px) {
  Raster<float> right_px(left_px.width(), left_px.height(), -1.0F);
  Raster<std::uint8_t> reached(left_px.width(), left_px.height());
  for (int y = 0; y < left_px.height(); ++y)
    for (int x = 0; x < left_px.width(); ++x) {
      const int to = static_cast<int>(std::lround(static_cast<float>(x) - left_px(x, y)));
      if (!right_px.contains(to, y)) continue;
      right_px(to, y) = std::max(right_px(to, y), left_px(x, y));
      reached(to, y) = 1;
    }
  fill_from_behind(reached, right_px);
  return right_px;
}

/// Colour segments end where the colour does, surfaces often beside it: each pixel chooses once more among
/// the planes of the segments around it, knowing what the right picture can see.
PlaneMap settle_borders(const MatchInput& input, const ColourSegments& segments,
                        const std::vector<Plane>& planes, const std::vector<std::size_t>& plane_of,
                        Raster<float> start, const Work& work) {
  constexpr int kRounds = 2;
  const MatchView left = match_view(input.left, input.left_grey, work);
  const MatchView right = match_view(input.right, input.right_grey, work);
  const int w = input.left.width();
  const int h = input.left.height();
  CostVolume costs(w, h, input.disparities);
  {
    CostVolume scratch(w, h, input.disparities);
    pixel_costs(left, right, costs, work);
    average_over_crosses(left.colour, costs, scratch, work);
  }
  PlaneCandidates candidates(w, h);
  propose_segment_planes(segments.of_pixel, planes, plane_of, candidates, work);
  PlaneMap map(w, h);
  map.disparity = std::move(start);
  for (int round = 0; round < kRounds && !work.cancelled(); ++round) {
    const Raster<float> seen = seen_from_right(map.disparity);
    plane_costs(costs, {&seen, 0.0F}, candidates, work);
    choose_planes(left.colour, candidates, map, work);
  }
  return map;
}

}  // namespace

Result<MatchOutput> match_segments(const MatchInput& input, const StereoOptions&, const Work& work) {
  constexpr std::size_t kLeastTrusted = 20;
  const ScanlineMap map = scanline_map(input, work);
  if (work.cancelled()) return Work::interrupted();
  work.report(0.3, "cutting the picture into segments");
  const Result<ColourSegments> segments = segment_by_colour(input.left, SegmentOptions{});
  if (!segments) return segments.error();
  const SegmentGraph graph = make_graph(input, *segments, map.trusted);
  const std::vector<std::uint8_t> volume = aggregated_costs(input, kWindow, kDataLimit, work);
  if (work.cancelled()) return Work::interrupted();

  std::vector<Plane> planes;
  for (const auto& pixels : graph.trusted)
    if (pixels.size() >= kLeastTrusted) planes.push_back(fit_plane(map.disparity_px, pixels));
  if (planes.empty()) planes.push_back({});  // nothing to go by: all lies at infinity
  planes = distinct(std::move(planes));

  std::vector<std::size_t> plane_of;
  for (const double done : {0.5, 0.75}) {
    work.report(done, "giving planes to segments");
    const std::vector<double> costs = plane_costs(input, volume, graph, map.disparity_px, planes, work);
    plane_of = cheapest_planes(costs, graph.all.size(), planes.size());
    expand_planes(graph, costs, planes.size(), plane_of, work);
    if (work.cancelled()) return Work::interrupted();
    planes = regrouped(graph, map.disparity_px, planes, plane_of);
  }
  Raster<float> of_segments(input.left.width(), input.left.height());
  for (std::size_t s = 0; s < graph.all.size(); ++s)
    for (const Pixel p : graph.all[s])
      of_segments(p.x, p.y) = static_cast<float>(planes[plane_of[s]].at(p.x, p.y));
  work.report(0.85, "settling borders");
  PlaneMap settled = settle_borders(input, *segments, planes, plane_of, std::move(of_segments), work);
  if (work.cancelled()) return Work::interrupted();
  const auto last = static_cast<float>(input.disparities - 1);
  for (float& d : settled.disparity.values()) d = std::clamp(d, 0.0F, last);
  return MatchOutput{median_3x3(settled.disparity, work), {}};
}

}  // namespace palpable::vision
