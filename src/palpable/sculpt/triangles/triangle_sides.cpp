// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Tests on which side of a TriangleTree's triangles a point is.
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

namespace palpable::sculpt {
namespace {

/// The cosine and the sine of half the solid angle of a triangle seen from p, both times the same length
/// (van Oosterom & Strackee 1983).
struct HalfSolidAngle {
  double cosine_m3 = 0.0, sine_m3 = 0.0;
};
HalfSolidAngle half_solid_angle(Vec3 p, const std::array<Vec3, 3>& t) {
  const Vec3 a = t[0] - p, b = t[1] - p, c = t[2] - p;
  const double la = norm(a), lb = norm(b), lc = norm(c);
  return {la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb, dot(a, cross(b, c))};
}

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Where the ray meets the triangle, in lengths of `direction` (Moller & Trumbore 1997).
double hit(Vec3 p, Vec3 direction, const std::array<Vec3, 3>& t) {
  const Vec3 e1 = t[1] - t[0], e2 = t[2] - t[0];
  const Vec3 h = cross(direction, e2);
  const double det = dot(e1, h);
  if (det == 0.0) return kNever;
  const Vec3 s = p - t[0];
  const double u = dot(s, h) / det;
  if (u < 0.0 || u > 1.0) return kNever;
  const Vec3 q = cross(s, e1);
  const double v = dot(direction, q) / det;
  const double at = dot(e2, q) / det;
  return v >= 0.0 && u + v <= 1.0 && at > 0.0 ? at : kNever;
}

/// Whether the ray meets the box before `to`.
bool meets_box(Vec3 p, Vec3 inverse, Vec3 low, Vec3 high, double to = kNever) {
  double from = 0.0;
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

/// From the root: calls leaf(node) for the leaves below each node that opens() selects.
template <std::size_t kMost, class Nodes, class Opens, class Leaf>
void descend(const Nodes& nodes, const Opens& opens, const Leaf& leaf) {
  std::array<std::uint32_t, kMost> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const std::uint32_t at = stack[--size];
    if (!opens(at)) continue;
    const auto& node = nodes[at];
    if (node.right == 0) {
      leaf(node);
    } else {
      stack[size++] = at + 1;
      stack[size++] = node.right;
    }
  }
}

}  // namespace

double TriangleTree::solid_angle(Vec3 p, const Node& leaf) const {
  // Angles are added by multiplying complex numbers, as long as the sum is within half a turn.
  double angle = 0.0, cosine = 1.0, sine = 0.0;
  for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
    const HalfSolidAngle half = half_solid_angle(p, corners_[i]);
    if (cosine > 0.0 && half.cosine_m3 > 0.0) {
      const double both = cosine * half.cosine_m3 - sine * half.sine_m3;
      sine = cosine * half.sine_m3 + sine * half.cosine_m3;
      cosine = both;
    } else {
      angle += std::atan2(sine, cosine);
      cosine = half.cosine_m3;
      sine = half.sine_m3;
    }
  }
  return 2.0 * (angle + std::atan2(sine, cosine));
}

double TriangleTree::winding(Vec3 p) const {
  const std::array<float, 3> place = from_origin(p);
  double sum = 0.0;
  std::array<std::uint32_t, FourBoxes::kCount * kStack> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Four& four = fours_[stack[--size]];
    const FourDipoles::Seen seen = four.dipoles.seen_from(place);
    sum += static_cast<double>(seen.far_angle);
    for (unsigned near = seen.near; near != 0; near &= near - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(near));
      if (four.below[lane] == kNone)
        sum += solid_angle(p, nodes_[four.node[lane]]);
      else
        stack[size++] = four.below[lane];
    }
  }
  return sum / (4.0 * std::numbers::pi);
}

int TriangleTree::crossings(Vec3 p, Vec3 direction) const {
  const Vec3 inverse{1.0 / direction.x, 1.0 / direction.y, 1.0 / direction.z};
  int count = 0;
  const auto opens = [&](std::uint32_t at) { return meets_box(p, inverse, nodes_[at].low, nodes_[at].high); };
  descend<kStack>(nodes_, opens, [&](const Node& node) {
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      count += hit(p, direction, corners_[i]) < kNever ? 1 : 0;
  });
  return count;
}

double TriangleTree::first_hit(Vec3 p, Vec3 direction) const {
  const Vec3 inverse{1.0 / direction.x, 1.0 / direction.y, 1.0 / direction.z};
  double first = kNever;
  const auto opens = [&](std::uint32_t at) {
    return meets_box(p, inverse, nodes_[at].low, nodes_[at].high, first);
  };
  descend<kStack>(nodes_, opens, [&](const Node& node) {
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      first = std::min(first, hit(p, direction, corners_[i]));
  });
  return first;
}

}  // namespace palpable::sculpt
