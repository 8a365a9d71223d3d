// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangle_tree.hpp"

#include "palpable/core/check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace palpable::sculpt {
namespace {

constexpr std::uint32_t kLeafTriangles = 4;
/// Deeper than any tree over 2^32 triangles that halves them.
constexpr std::size_t kStack = 80;

Vec3 smaller(Vec3 a, Vec3 b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3 larger(Vec3 a, Vec3 b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

double squared_distance(Vec3 p, Vec3 low, Vec3 high) {
  const double x = std::max({low.x - p.x, 0.0, p.x - high.x});
  const double y = std::max({low.y - p.y, 0.0, p.y - high.y});
  const double z = std::max({low.z - p.z, 0.0, p.z - high.z});
  return x * x + y * y + z * z;
}

/// The solid angle of a triangle seen from p (van Oosterom & Strackee 1983).
double solid_angle(Vec3 p, const std::array<Vec3, 3>& t) {
  const Vec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
  const double la = norm(a), lb = norm(b), lc = norm(c);
  const double volume = dot(a, cross(b, c));
  const double sum = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return 2.0 * std::atan2(volume, sum);
}

bool meets(Vec3 p, Vec3 direction, const std::array<Vec3, 3>& t) {
  // Moller & Trumbore 1997.
  const Vec3 e1 = t[1] - t[0], e2 = t[2] - t[0];
  const Vec3 h = cross(direction, e2);
  const double det = dot(e1, h);
  if (det == 0.0) return false;
  const Vec3 s = p - t[0];
  const double u = dot(s, h) / det;
  if (u < 0.0 || u > 1.0) return false;
  const Vec3 q = cross(s, e1);
  const double v = dot(direction, q) / det;
  return v >= 0.0 && u + v <= 1.0 && dot(e2, q) / det > 0.0;
}

bool meets_box(Vec3 p, Vec3 inverse, Vec3 low, Vec3 high) {
  double from = 0.0;
  double to = std::numeric_limits<double>::infinity();
  const auto cut = [&](double at, double inv, double lo, double hi) {
    const double a = (lo - at) * inv, b = (hi - at) * inv;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  };
  cut(p.x, inverse.x, low.x, high.x);
  cut(p.y, inverse.y, low.y, high.y);
  cut(p.z, inverse.z, low.z, high.z);
  return from <= to;
}

}  // namespace

NearestTriangle nearest_on_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  using enum TrianglePart;
  const auto found = [&](Vec3 q, TrianglePart part) {
    return NearestTriangle{q, squared_norm(p - q), 0, part};
  };
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return found(a, corner_0);
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return found(b, corner_1);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return found(a + (d1 / (d1 - d3)) * ab, edge_01);
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return found(c, corner_2);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return found(a + (d2 / (d2 - d6)) * ac, edge_20);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
    return found(b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b), edge_12);
  const double inverse = 1.0 / (va + vb + vc);
  return found(a + (vb * inverse) * ab + (vc * inverse) * ac, face);
}

TriangleTree::TriangleTree(const Mesh& mesh) {
  PALPABLE_CHECK(!mesh.triangles.empty());
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  corners_.reserve(count);
  std::vector<Vec3> centres;
  centres.reserve(count);
  for (const auto& t : mesh.triangles) {
    corners_.push_back({mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]});
    const Corners& c = corners_.back();
    centres.push_back((smaller(c[0], smaller(c[1], c[2])) + larger(c[0], larger(c[1], c[2]))) / 2.0);
  }
  order_.resize(count);
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.reserve(count);
  build(0, count, centres);
  std::vector<Corners> sorted(count);
  place_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    sorted[i] = corners_[order_[i]];
    place_[order_[i]] = i;
  }
  corners_ = std::move(sorted);
  dipoles_.resize(nodes_.size());
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    dipoles_[i] = dipole_of(i);
    add_slab(nodes_[i], dipoles_[i]);
  }
}

void TriangleTree::add_slab(Node& node, const Dipole& dipole) const {
  node.normal = unit(dipole.area_m2);
  node.slab_low = std::numeric_limits<double>::infinity();
  node.slab_high = -node.slab_low;
  for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
    for (const Vec3 corner : corners_[i]) {
      const double along = dot(node.normal, corner);
      node.slab_low = std::min(node.slab_low, along);
      node.slab_high = std::max(node.slab_high, along);
    }
}

double TriangleTree::squared_distance(Vec3 p, const Node& node) {
  const double along = dot(node.normal, p);
  const double beyond = std::max({node.slab_low - along, along - node.slab_high, 0.0});
  return std::max(beyond * beyond, palpable::sculpt::squared_distance(p, node.low, node.high));
}

std::uint32_t TriangleTree::build(std::uint32_t first, std::uint32_t count,
                                  const std::vector<Vec3>& centres) {
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  Node node;
  node.first = first;
  node.count = count;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  node.low = {kFar, kFar, kFar};
  node.high = {-kFar, -kFar, -kFar};
  Vec3 low = node.low, high = node.high;
  for (std::uint32_t i = first; i < first + count; ++i) {
    for (const Vec3 corner : corners_[order_[i]]) {
      node.low = smaller(node.low, corner);
      node.high = larger(node.high, corner);
    }
    low = smaller(low, centres[order_[i]]);
    high = larger(high, centres[order_[i]]);
  }
  nodes_.push_back(node);
  if (count <= kLeafTriangles) return at;
  const Vec3 size = high - low;
  const auto key = [&](std::uint32_t t) {
    const Vec3 c = centres[t];
    return size.x >= size.y && size.x >= size.z ? c.x : size.y >= size.z ? c.y : c.z;
  };
  const std::uint32_t half = count / 2;
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + half, begin + count,
                   [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  build(first, half, centres);
  nodes_[at].right = build(first + half, count - half, centres);
  return at;
}

TriangleTree::Dipole TriangleTree::dipole_of(std::uint32_t node) const {
  Dipole dipole;
  double area_m2 = 0.0;
  const Node& n = nodes_[node];
  for (std::uint32_t i = n.first; i < n.first + n.count; ++i) {
    const Corners& c = corners_[i];
    const Vec3 area = 0.5 * cross(c[1] - c[0], c[2] - c[0]);
    const double size = norm(area);
    dipole.area_m2 += area;
    dipole.centre_m += (size / 3.0) * (c[0] + c[1] + c[2]);
    area_m2 += size;
  }
  dipole.centre_m = area_m2 > 0.0 ? dipole.centre_m / area_m2 : (n.low + n.high) / 2.0;
  dipole.radius_m = norm(larger(n.high - dipole.centre_m, dipole.centre_m - n.low));
  return dipole;
}

NearestTriangle TriangleTree::nearest(Vec3 p, std::uint32_t guess) const {
  const auto measure = [&](std::uint32_t i) {
    NearestTriangle found = nearest_on_triangle(p, corners_[i][0], corners_[i][1], corners_[i][2]);
    found.triangle = order_[i];
    return found;
  };
  NearestTriangle best = measure(place_[guess]);
  constexpr double kShare = (1.0 - kNearestSlack) * (1.0 - kNearestSlack);
  struct Entry {
    std::uint32_t node;
    double squared;
  };
  std::array<Entry, kStack> stack;
  std::size_t size = 0;
  stack[size++] = {0, squared_distance(p, nodes_[0])};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.squared >= kShare * best.squared_distance_m2) continue;
    const Node& node = nodes_[entry.node];
    if (node.right == 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        const NearestTriangle found = measure(i);
        if (found.squared_distance_m2 < best.squared_distance_m2) best = found;
      }
      continue;
    }
    Entry near{entry.node + 1, squared_distance(p, nodes_[entry.node + 1])};
    Entry far{node.right, squared_distance(p, nodes_[node.right])};
    if (far.squared < near.squared) std::swap(near, far);
    if (far.squared < kShare * best.squared_distance_m2) stack[size++] = far;
    if (near.squared < kShare * best.squared_distance_m2) stack[size++] = near;
  }
  return best;
}

bool TriangleTree::any_within(Vec3 p, double radius_m, std::uint32_t except) const {
  const double radius2 = radius_m * radius_m;
  std::array<std::uint32_t, kStack> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t at = stack[--size];
    const Node& node = nodes_[at];
    if (squared_distance(p, node) > radius2) continue;
    if (node.right != 0) {
      stack[size++] = at + 1;
      stack[size++] = node.right;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (order_[i] == except) continue;
      const Corners& c = corners_[i];
      if (nearest_on_triangle(p, c[0], c[1], c[2]).squared_distance_m2 <= radius2) return true;
    }
  }
  return false;
}

bool TriangleTree::reaches(std::uint32_t triangle, Vec3 p, double radius_m) const {
  const Corners& c = corners_[place_[triangle]];
  return nearest_on_triangle(p, c[0], c[1], c[2]).squared_distance_m2 <= radius_m * radius_m;
}

double TriangleTree::winding(Vec3 p) const {
  constexpr double kFarRadii = 2.5;
  double sum = 0.0;
  std::array<std::uint32_t, kStack> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t at = stack[--size];
    const Dipole& dipole = dipoles_[at];
    const Vec3 way = dipole.centre_m - p;
    const double distance2 = squared_norm(way);
    if (distance2 > kFarRadii * kFarRadii * dipole.radius_m * dipole.radius_m) {
      sum += dot(dipole.area_m2, way) / (distance2 * std::sqrt(distance2));
      continue;
    }
    const Node& node = nodes_[at];
    if (node.right == 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) sum += solid_angle(p, corners_[i]);
    } else {
      stack[size++] = at + 1;
      stack[size++] = node.right;
    }
  }
  return sum / (4.0 * std::numbers::pi);
}

int TriangleTree::crossings(Vec3 p, Vec3 direction) const {
  const Vec3 inverse{1.0 / direction.x, 1.0 / direction.y, 1.0 / direction.z};
  int count = 0;
  std::array<std::uint32_t, kStack> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t at = stack[--size];
    const Node& node = nodes_[at];
    if (!meets_box(p, inverse, node.low, node.high)) continue;
    if (node.right == 0) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        count += meets(p, direction, corners_[i]) ? 1 : 0;
    } else {
      stack[size++] = at + 1;
      stack[size++] = node.right;
    }
  }
  return count;
}

}  // namespace palpable::sculpt
