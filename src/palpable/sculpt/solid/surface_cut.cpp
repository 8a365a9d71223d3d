// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/solid/surface_cut.hpp"

#include "palpable/sculpt/solid/distance_source.hpp"
#include "palpable/sculpt/triangles/mesh_orientation.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace palpable::sculpt {
namespace {

using Corners = std::array<Vec3, 3>;
/// Convex, in one triangle's plane, with the triangle's orientation.
using Polygon = std::vector<Vec3>;

/// The sides of a piece of surface on which the solid lies.
enum class Sides { surface, turned, inner, mixed };

Corners corners_of(const Mesh& mesh, std::size_t triangle) {
  const auto& t = mesh.triangles[triangle];
  return {mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]};
}
Vec3 normal_of(const Corners& c) { return unit(cross(c[1] - c[0], c[2] - c[0])); }

/// Tests whether the solid is on either side of a point of the surface.
class SideTester {
 public:
  SideTester(const TriangleTree& tree, double size_m) : tree_(tree), lift_m_(0.5 * kThinnestSolid * size_m) {}
  Sides sides_at(Vec3 place, Vec3 normal) const {
    const bool front = tree_.winding(place + lift_m_ * normal) > 0.5;
    const bool back = tree_.winding(place - lift_m_ * normal) > 0.5;
    if (front == back) return Sides::inner;
    return back ? Sides::surface : Sides::turned;
  }
  /// The same at a point of one of the tree's triangles, with its normal. If no other triangle is near, the
  /// winding number rises by 1 from front to back, so one value is sufficient.
  Sides sides_of(std::uint32_t triangle, Vec3 place, Vec3 normal) const {
    if (tree_.any_within(place, 2.0 * lift_m_, triangle)) return sides_at(place, normal);
    const double front = tree_.winding(place + lift_m_ * normal);
    return front > -0.5 && front <= 0.5 ? Sides::surface : Sides::inner;
  }

 private:
  const TriangleTree& tree_;
  double lift_m_;
};

double size_of(const Mesh& mesh) {
  const Box box = bounds_of(mesh);
  return norm(box.most_m - box.least_m);
}

struct Segment {
  Vec3 from, to;
};

/// The intersection of another triangle with the plane through `origin` with `normal`: nothing, a segment,
/// or, if it lies in the plane, its three edges.
void add_crossing(const Corners& other, Vec3 origin, Vec3 normal, double touching_m,
                  std::vector<Segment>& segments) {
  std::array<double, 3> height{};
  int above = 0, below = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    height[k] = dot(normal, other[k] - origin);
    if (std::abs(height[k]) <= touching_m)
      height[k] = 0.0;
    else
      ++(height[k] > 0.0 ? above : below);
  }
  if (above == 3 || below == 3) return;
  if (above + below == 0) {
    for (std::size_t k = 0; k < 3; ++k) segments.push_back({other[k], other[(k + 1) % 3]});
    return;
  }
  std::array<Vec3, 3> met;
  std::size_t count = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    if (height[k] == 0.0) met[count++] = other[k];
    if ((height[k] > 0.0 && height[next] < 0.0) || (height[k] < 0.0 && height[next] > 0.0))
      met[count++] = other[k] + (height[k] / (height[k] - height[next])) * (other[next] - other[k]);
  }
  if (count == 2) segments.push_back({met[0], met[1]});
}

/// The length of the segment's part inside the polygon.
double length_inside(const Segment& s, const Polygon& polygon, Vec3 normal) {
  double from = 0.0, to = 1.0;
  const Vec3 way = s.to - s.from;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 inwards = cross(normal, polygon[(k + 1) % polygon.size()] - polygon[k]);
    const double at = dot(inwards, s.from - polygon[k]);
    const double rate = dot(inwards, way);
    if (rate > 0.0)
      from = std::max(from, -at / rate);
    else if (rate < 0.0)
      to = std::min(to, -at / rate);
    else if (at < 0.0)
      return 0.0;
  }
  return std::max(0.0, to - from) * norm(way);
}

/// The two parts of a polygon cut by a plane; nullopt if one of them would be thinner than `thinnest_m`.
std::optional<std::pair<Polygon, Polygon>> split(const Polygon& polygon, Vec3 origin, Vec3 across,
                                                 double thinnest_m) {
  std::vector<double> height;
  height.reserve(polygon.size());
  bool above = false, below = false;
  for (const Vec3 corner : polygon) {
    height.push_back(dot(across, corner - origin));
    if (std::abs(height.back()) <= thinnest_m) height.back() = 0.0;
    above = above || height.back() > 0.0;
    below = below || height.back() < 0.0;
  }
  if (!above || !below) return std::nullopt;
  std::pair<Polygon, Polygon> parts;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const std::size_t next = (k + 1) % polygon.size();
    if (height[k] >= 0.0) parts.first.push_back(polygon[k]);
    if (height[k] <= 0.0) parts.second.push_back(polygon[k]);
    if (height[k] * height[next] < 0.0) {
      const Vec3 met = polygon[k] + (height[k] / (height[k] - height[next])) * (polygon[next] - polygon[k]);
      parts.first.push_back(met);
      parts.second.push_back(met);
    }
  }
  return parts;
}

/// Cuts one triangle along the lines where others cross it, and keeps the pieces that are surface.
class Cutter {
 public:
  Cutter(const Mesh& mesh, const TriangleTree& tree, double finest_m, double size_m)
      : mesh_(mesh),
        tree_(tree),
        side_tester_(tree, size_m),
        finest_m_(finest_m),
        touching_m_(2e-7 * size_m) {}

  struct Sorted {
    std::vector<Corners> surface;
    std::size_t inner = 0;
  };

  void sort(std::uint32_t triangle, Sorted& sorted) {
    const Corners c = corners_of(mesh_, triangle);
    normal_ = normal_of(c);
    const Box box = bounds_of(std::span(c));
    const Vec3 beyond{touching_m_, touching_m_, touching_m_};
    std::vector<Segment> crossings;
    tree_.visit_box(box.least_m - beyond, box.most_m + beyond, [&](std::uint32_t other) {
      if (other != triangle) add_crossing(corners_of(mesh_, other), c[0], normal_, touching_m_, crossings);
    });
    const Polygon whole(c.begin(), c.end());
    std::vector<Corners> pieces;
    const Sides sides = cut(whole, crossings, pieces);
    if (sides == Sides::inner) ++sorted.inner;
    if (sides != Sides::mixed) keep(whole, sides, pieces);
    sorted.surface.insert(sorted.surface.end(), pieces.begin(), pieces.end());
  }

 private:
  /// Classifies the whole polygon; if it is mixed, its surface parts are added to `pieces`.
  Sides cut(const Polygon& polygon, const std::vector<Segment>& crossings,
            std::vector<Corners>& pieces) const {
    std::vector<Segment> inside;
    Segment longest;
    double length = touching_m_;
    for (const Segment& s : crossings) {
      const double here = length_inside(s, polygon, normal_);
      if (here <= touching_m_) continue;
      const Vec3 across = unit(cross(normal_, s.to - s.from));
      const bool at_rim = !split(polygon, s.from, across, touching_m_);
      if (at_rim) continue;
      inside.push_back(s);
      if (here > length) longest = s, length = here;
    }
    const Vec3 span = extent(polygon);
    const double widest_m = std::max({span.x, span.y, span.z});
    // A small piece with few crossing lines is cut along them: a decision by its centre would lose a strip
    // of it.
    constexpr std::size_t kFew = 8, kMany = 48;
    const bool is_small = widest_m <= finest_m_;
    if (inside.empty() || (is_small && inside.size() > kFew))
      return side_tester_.sides_at(middle(polygon), normal_);
    std::optional<std::pair<Polygon, Polygon>> parts;
    // Many lines are first divided by position, so that each is tested against few pieces.
    if (inside.size() > kMany) {
      const Vec3 axis = span.x == widest_m   ? Vec3{1.0, 0.0, 0.0}
                        : span.y == widest_m ? Vec3{0.0, 1.0, 0.0}
                                             : Vec3{0.0, 0.0, 1.0};
      parts = split(polygon, middle(polygon), axis, touching_m_);
    }
    if (!parts)
      parts = split(polygon, longest.from, unit(cross(normal_, longest.to - longest.from)), touching_m_);
    const Sides first = cut(parts->first, inside, pieces);
    const Sides second = cut(parts->second, inside, pieces);
    if (first == second) return first;
    if (first != Sides::mixed) keep(parts->first, first, pieces);
    if (second != Sides::mixed) keep(parts->second, second, pieces);
    return Sides::mixed;
  }

  static void keep(const Polygon& polygon, Sides sides, std::vector<Corners>& pieces) {
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
      if (sides == Sides::surface) pieces.push_back({polygon[0], polygon[k], polygon[k + 1]});
      if (sides == Sides::turned) pieces.push_back({polygon[0], polygon[k + 1], polygon[k]});
    }
  }

  static Vec3 middle(const Polygon& polygon) {
    Vec3 sum;
    for (const Vec3 corner : polygon) sum += corner;
    return sum / static_cast<double>(polygon.size());
  }
  static Vec3 extent(const Polygon& polygon) {
    const Box box = bounds_of(std::span(polygon));
    return box.most_m - box.least_m;
  }

  const Mesh& mesh_;
  const TriangleTree& tree_;
  SideTester side_tester_;
  double finest_m_;
  double touching_m_;
  Vec3 normal_;
};

Mesh mesh_of(const std::vector<Corners>& triangles) {
  Mesh soup;
  soup.vertices_m.reserve(3 * triangles.size());
  soup.triangles.reserve(triangles.size());
  for (const Corners& t : triangles) {
    const auto first = static_cast<std::uint32_t>(soup.vertices_m.size());
    soup.vertices_m.insert(soup.vertices_m.end(), t.begin(), t.end());
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  std::size_t ignored = 0;
  return welded(soup, ignored);
}

}  // namespace

bool is_own_surface(const Mesh& mesh, const TriangleTree& tree, std::size_t first_added, const Work& work) {
  const SideTester side_tester(tree, size_of(mesh));
  const std::size_t count = mesh.triangles.size();
  // Added triangles may cross existing ones: both are tested at more points.
  std::vector<char> is_suspect(count);
  for (std::size_t i = first_added; i < count; ++i) {
    const Corners corners = corners_of(mesh, i);
    const Box box = bounds_of(std::span(corners));
    tree.visit_box(box.least_m, box.most_m, [&](std::uint32_t other) { is_suspect[other] = 1; });
  }
  std::atomic<bool> is_own{true};
  constexpr int kGrain = 256;
  parallel_for(work, static_cast<int>(count), kGrain, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      if (!is_own.load(std::memory_order_relaxed) || work.cancelled()) return;
      const Corners c = corners_of(mesh, i);
      const Vec3 normal = normal_of(c), middle = (c[0] + c[1] + c[2]) / 3.0;
      bool fits = side_tester.sides_of(static_cast<std::uint32_t>(i), middle, normal) == Sides::surface;
      constexpr double kOutwards = 0.9;
      for (std::size_t k = 0; is_suspect[i] != 0 && fits && k < 3; ++k)
        for (const Vec3 border : {c[k], 0.5 * (c[k] + c[(k + 1) % 3])})
          fits =
              fits && side_tester.sides_at(middle + kOutwards * (border - middle), normal) == Sides::surface;
      if (!fits) is_own = false;
    }
  });
  return is_own;
}

SolidSurface surface_of(const Mesh& mesh, const TriangleTree& tree, double finest_m, const Work& work) {
  const double size_m = size_of(mesh);
  const auto count = static_cast<int>(mesh.triangles.size());
  constexpr int kChunk = 8;
  std::vector<Cutter::Sorted> parts(static_cast<std::size_t>((count + kChunk - 1) / kChunk));
  // The work differs between triangles, so each thread takes the next few when it is ready.
  std::atomic<int> next{0};
  parallel_for(work, static_cast<int>(work.thread_count()), 1, [&](int begin, int end) {
    if (begin == end) return;
    Cutter cutter(mesh, tree, finest_m, size_m);
    for (int part = next++; part < static_cast<int>(parts.size()) && !work.cancelled(); part = next++)
      for (int t = part * kChunk; t < std::min(count, (part + 1) * kChunk); ++t)
        cutter.sort(static_cast<std::uint32_t>(t), parts[static_cast<std::size_t>(part)]);
  });
  SolidSurface surface;
  std::vector<Corners> all;
  for (const auto& part : parts) {
    all.insert(all.end(), part.surface.begin(), part.surface.end());
    surface.inner += part.inner;
  }
  surface.mesh = mesh_of(all);
  return surface;
}

}  // namespace palpable::sculpt
