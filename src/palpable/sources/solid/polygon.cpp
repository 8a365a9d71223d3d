// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/solid/polygon.hpp"

#include <algorithm>

namespace palpable::sources {
namespace {

/// Twice the face's area along its normal (Newell).
Vec3 area_vector(std::span<const Vec3> vertices, std::span<const std::uint32_t> corners) {
  Vec3 sum{};
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    sum = sum +
          cross(vertices[corners[k]] - vertices[corners[0]], vertices[corners[k + 1]] - vertices[corners[0]]);
  return sum;
}

/// Positive if a, b, c turn in the same direction as the face.
double turn(const Vec3& normal, const Vec3& a, const Vec3& b, const Vec3& c) {
  return dot(normal, cross(b - a, c - b));
}

bool is_ear(std::span<const Vec3> vertices, const std::vector<std::uint32_t>& ring, std::size_t at,
            const Vec3& normal) {
  const std::size_t n = ring.size();
  const std::uint32_t before = ring[(at + n - 1) % n], tip = ring[at], after = ring[(at + 1) % n];
  const Vec3 &a = vertices[before], &b = vertices[tip], &c = vertices[after];
  if (turn(normal, a, b, c) <= 0.0) return false;
  return std::none_of(ring.begin(), ring.end(), [&](std::uint32_t other) {
    if (other == before || other == tip || other == after) return false;
    const Vec3& p = vertices[other];
    return turn(normal, a, b, p) >= 0.0 && turn(normal, b, c, p) >= 0.0 && turn(normal, c, a, p) >= 0.0;
  });
}

bool is_convex(std::span<const Vec3> vertices, std::span<const std::uint32_t> corners, const Vec3& normal) {
  const std::size_t n = corners.size();
  for (std::size_t k = 0; k < n; ++k)
    if (turn(normal, vertices[corners[k]], vertices[corners[(k + 1) % n]], vertices[corners[(k + 2) % n]]) <
        0.0)
      return false;
  return true;
}

/// The corner at which a quadrilateral is split: its reflex one, else the first.
std::size_t cut_of(std::span<const Vec3> vertices, std::span<const std::uint32_t> corners) {
  const Vec3 normal = area_vector(vertices, corners);
  for (std::size_t k = 0; k < 4; ++k)
    if (turn(normal, vertices[corners[(k + 3) % 4]], vertices[corners[k]], vertices[corners[(k + 1) % 4]]) <
        0.0)
      return k;
  return 0;
}

}  // namespace

void append_triangles(std::span<const Vec3> vertices, std::span<const std::uint32_t> corners,
                      std::vector<std::array<std::uint32_t, 3>>& triangles) {
  if (corners.size() == 3) {
    triangles.push_back({corners[0], corners[1], corners[2]});
    return;
  }
  if (corners.size() == 4) {
    const std::size_t k = cut_of(vertices, corners);
    const auto at = [&](std::size_t i) { return corners[(k + i) % 4]; };
    triangles.push_back({at(0), at(1), at(2)});
    triangles.push_back({at(0), at(2), at(3)});
    return;
  }
  const Vec3 normal = area_vector(vertices, corners);
  if (is_convex(vertices, corners, normal)) {
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
      triangles.push_back({corners[0], corners[k], corners[k + 1]});
    return;
  }
  std::vector<std::uint32_t> ring(corners.begin(), corners.end());
  while (ring.size() > 3) {
    const std::size_t n = ring.size();
    std::size_t ear = 0;
    // A self-intersecting face may have no ear: then its first corner is cut, so that no corner is lost.
    for (std::size_t k = 0; k < n; ++k)
      if (is_ear(vertices, ring, k, normal)) {
        ear = k;
        break;
      }
    triangles.push_back({ring[(ear + n - 1) % n], ring[ear], ring[(ear + 1) % n]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  triangles.push_back({ring[0], ring[1], ring[2]});
}

}  // namespace palpable::sources
