// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/models/field/distance_surface.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace palpable::models {

// What a leaf of a distance field holds: one to three smooth pieces, and how they meet. A piece is a plane
// (exact for flat faces) or a quadratic polynomial; two pieces meet in an exact edge, convex or concave, or
// in a medial sheet; three in a corner. Kept as 32-bit words: a head, the meetings, the pieces.

/// How two pieces a and b meet. The solid is where both are negative (convex), or where one is (concave).
enum class Meeting : std::uint8_t { convex, concave };

/// The cosine between the gradients of two pieces, as both halves of the angle.
struct HalfAngle {
  float cosine = 1.0F;
  float sine = 0.0F;
};

/// Distance to the intersection of two half-spaces with distances a and b (gradients at twice `half`):
/// exactly max(a, b) over the faces, and the distance to the edge in the fan between them. The kink in the
/// middle, where the nearest face changes, is rounded within `round_m` on both sides, by at most round_m / 2;
/// beyond it nothing changes. Continuous with its gradient everywhere. `da`, `db`: derivatives by a and b.
inline double convex_meeting(double a, double b, HalfAngle half, double round_m, double& da,
                             double& db) noexcept {
  const auto cosine = static_cast<double>(half.cosine);
  const auto sine = static_cast<double>(half.sine);
  // Along the outward bisector, mean = u cosine; across it, |a - b| / 2 = v sine.
  const double mean = 0.5 * (a + b);
  const double across = 0.5 * (a - b) / sine;
  double v = std::abs(across);
  double dv = across < 0.0 ? -1.0 : 1.0;
  if (v < round_m) {
    dv = across / round_m;
    v = 0.5 * (across * dv + round_m);
  }
  double by_mean = 1.0;
  double by_across = sine * dv;
  double distance = mean + v * sine;
  // Faces back to back have no edge, and no fan over it.
  constexpr double kLeastCosine = 1e-6;
  if (mean > 0.0 && cosine > kLeastCosine && v * cosine * cosine < mean * sine) {
    const double u = mean / cosine;
    distance = std::sqrt(u * u + v * v);
    by_mean = u / (distance * cosine);
    by_across = v / distance * dv;
  }
  da = 0.5 * (by_mean + by_across / sine);
  db = 0.5 * (by_mean - by_across / sine);
  return distance;
}

/// Two samples joined.
inline FieldSample joined(const FieldSample& a, const FieldSample& b, Meeting meeting, HalfAngle half,
                          double round_m) noexcept {
  const double sign = meeting == Meeting::convex ? 1.0 : -1.0;
  double da = 0.0;
  double db = 0.0;
  const double distance =
      sign * convex_meeting(sign * a.distance_m, sign * b.distance_m, half, round_m, da, db);
  return {distance, da * a.gradient + db * b.gradient};
}

/// The head of a leaf: pieces - 1 (2 bits), for each piece whether it is curved (3 bits), the two meetings
/// (2 bits; set = concave).
struct LeafHead {
  std::uint32_t bits = 0;
  int pieces() const noexcept { return static_cast<int>(bits & 3U) + 1; }
  bool curved(int piece) const noexcept { return (bits >> (2 + piece) & 1U) != 0; }
  /// Whether all pieces are planes: then the leaf says the same wherever it stands.
  bool flat() const noexcept { return (bits & 0x1CU) == 0; }
  Meeting meeting(int which) const noexcept {
    return (bits >> (5 + which) & 1U) != 0 ? Meeting::concave : Meeting::convex;
  }
  std::size_t words() const noexcept {
    std::size_t count = 1 + 2 * static_cast<std::size_t>(pieces() - 1);
    for (int i = 0; i < pieces(); ++i) count += curved(i) ? kCurvedWords : kPlaneWords;
    return count;
  }
  static constexpr std::size_t kPlaneWords = 4;
  static constexpr std::size_t kCurvedWords = 6;
  /// One step of a curved piece's 16-bit numbers.
  static constexpr double kStep = 1.0 / 16384.0;
  /// A small leaf needs fewer of them than a large one: its numbers are multiples of this many steps.
  /// `level`: its side is 2^level finest cells.
  static constexpr int multiple(int level) noexcept {
    return level <= 2 ? 8 : level == 3 ? 4 : level == 4 ? 2 : 1;
  }
  /// A curved piece's value in the middle is a multiple of a finest cell's side over this.
  static constexpr double kValuesPerCell = 2048.0;
};

namespace detail {

inline double f64(std::uint32_t word) noexcept { return static_cast<double>(std::bit_cast<float>(word)); }

/// A plane n·x + d, x from the field's origin: nx, ny, nz, d as floats.
inline FieldSample plane_at(const std::uint32_t* words, Vec3 x) noexcept {
  const Vec3 n{f64(words[0]), f64(words[1]), f64(words[2])};
  return {dot(n, x) + f64(words[3]), n};
}

/// half (c + l·u + u·Qu), u from the leaf's centre in halves of its side: c as a float, then l and Q (xx, yy,
/// zz, xy, xz, yz) in steps of kStep.
inline FieldSample curved_at(const std::uint32_t* words, Vec3 u, double half_m) noexcept {
  const auto low = [&](int i) { return LeafHead::kStep * static_cast<std::int16_t>(words[1 + i] & 0xFFFFU); };
  const auto high = [&](int i) { return LeafHead::kStep * static_cast<std::int16_t>(words[1 + i] >> 16U); };
  const double lx = low(0), ly = high(0), lz = low(1), xx = high(1), yy = low(2), zz = high(2), xy = low(3),
               xz = high(3), yz = low(4);
  const Vec3 q{xx * u.x + xy * u.y + xz * u.z, yy * u.y + yz * u.z, zz * u.z};
  return {half_m * (f64(words[0]) + u.x * (lx + q.x) + u.y * (ly + q.y) + u.z * (lz + q.z)),
          {lx + 2.0 * xx * u.x + xy * u.y + xz * u.z, ly + 2.0 * yy * u.y + xy * u.x + yz * u.z,
           lz + 2.0 * zz * u.z + xz * u.x + yz * u.y}};
}

}  // namespace detail

/// Which way a piece rises, in its leaf's middle.
inline Vec3 rise_of(const std::uint32_t* piece, bool curved) noexcept {
  if (!curved) return {detail::f64(piece[0]), detail::f64(piece[1]), detail::f64(piece[2])};
  return detail::curved_at(piece, {}, 1.0).gradient;
}

inline HalfAngle half_angle_between(Vec3 a, Vec3 b) noexcept {
  const double raw = dot(unit(a), unit(b));
  const double cosine = raw < -1.0 ? -1.0 : raw > 1.0 ? 1.0 : raw;
  return {static_cast<float>(std::sqrt(0.5 * (1.0 + cosine))),
          static_cast<float>(std::sqrt(0.5 * (1.0 - cosine)))};
}

/// Sets a leaf's meetings from its pieces, which they follow from: between the first two, and between both of
/// these and the third.
inline void set_half_angles(std::uint32_t* words) noexcept {
  const LeafHead head{words[0]};
  const std::uint32_t* piece = words + 1 + 2 * (head.pieces() - 1);
  Vec3 rise;
  for (int i = 0; i < head.pieces(); ++i) {
    const Vec3 next = rise_of(piece, head.curved(i));
    if (i > 0) {
      const HalfAngle half = half_angle_between(rise, next);
      words[2 * i - 1] = std::bit_cast<std::uint32_t>(half.cosine);
      words[2 * i] = std::bit_cast<std::uint32_t>(half.sine);
    }
    rise += next;
    piece += head.curved(i) ? LeafHead::kCurvedWords : LeafHead::kPlaneWords;
  }
}

/// Calls visit(i, sample) with what piece i of a leaf says by itself. `x`: from the field's origin; `u`: from
/// the leaf's centre in halves of its side, half_m. Tick path.
template <class Visit>
void visit_pieces(const std::uint32_t* words, Vec3 x, Vec3 u, double half_m, const Visit& visit) noexcept {
  const LeafHead head{words[0]};
  const int pieces = head.pieces();
  const std::uint32_t* at = words + 1 + 2 * (pieces - 1);
  for (int i = 0; i < pieces; ++i) {
    const bool curved = head.curved(i);
    visit(i, curved ? detail::curved_at(at, u, half_m) : detail::plane_at(at, x));
    at += curved ? LeafHead::kCurvedWords : LeafHead::kPlaneWords;
  }
}

/// The first i pieces of a leaf, joined, with piece i.
inline FieldSample joined_by(const std::uint32_t* words, int i, const FieldSample& before,
                             const FieldSample& piece, double round_m) noexcept {
  const HalfAngle half{std::bit_cast<float>(words[2 * i - 1]), std::bit_cast<float>(words[2 * i])};
  return joined(before, piece, LeafHead{words[0]}.meeting(i - 1), half, round_m);
}

/// A leaf's distance and gradient; arguments as visit_pieces(). Tick path.
inline FieldSample leaf_at(const std::uint32_t* words, Vec3 x, Vec3 u, double half_m,
                           double round_m) noexcept {
  FieldSample sample;
  visit_pieces(words, x, u, half_m, [&](int i, const FieldSample& piece) {
    sample = i == 0 ? piece : joined_by(words, i, sample, piece, round_m);
  });
  return sample;
}

}  // namespace palpable::models
