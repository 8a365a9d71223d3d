// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/models/field/distance_sample.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace palpable::models {

// The content of a leaf of a distance field: one to three smooth pieces and how they meet. A piece is a plane
// (exact for flat faces) or a quadratic polynomial. Two pieces meet in an exact edge, convex or concave, or
// in a medial sheet; three meet in a corner. Stored as 32-bit words: a head, the meetings, the pieces. Most
// leaves of a scanned mesh are small and hold one quadratic; these have a compact form of four words.

/// How two pieces a and b meet. The solid is where both are negative (convex), or where one is (concave).
enum class Meeting : std::uint8_t { convex, concave };

/// Cosine and sine of half the angle between the gradients of two pieces.
struct HalfAngle {
  float cosine = 1.0F;
  float sine = 0.0F;
};

/// Distance to the intersection of two half-spaces with distances a and b; `half` is half the angle between
/// their gradients. It is max(a, b) over the faces, and the distance to the edge in the wedge between their
/// normals. The kink where the nearest face changes is rounded within `round_m` on both sides, by at most
/// round_m / 2. Continuous with its gradient everywhere. `da`, `db`: derivatives by a and b.
inline double convex_meeting(double a, double b, HalfAngle half, double round_m, double& da,
                             double& db) noexcept {
  const auto cosine = static_cast<double>(half.cosine);
  const auto sine = static_cast<double>(half.sine);
  // Along the outward bisector, mean = u cosine; across it, |a - b| / 2 = v sine.
  const double mean = 0.5 * (a + b);
  const double across = 0.5 * (a - b) / sine;
  // Chosen by number: whether a place is near the kink cannot be predicted.
  const bool is_rounded = std::abs(across) < round_m;
  const double steep = across < 0.0 ? -1.0 : 1.0;
  const double in_round = across / round_m;
  const double dv = is_rounded ? in_round : steep;
  const double v = is_rounded ? 0.5 * (across * in_round + round_m) : std::abs(across);
  double by_mean = 1.0;
  double by_across = sine * dv;
  double distance = mean + v * sine;
  // Opposite faces have no edge.
  constexpr double kLeastCosine = 1e-6;
  const bool is_wedge = static_cast<int>(mean > 0.0) & static_cast<int>(cosine > kLeastCosine) &
                        static_cast<int>(v * cosine * cosine < mean * sine);
  if (is_wedge) {
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
inline DistanceSample joined(const DistanceSample& a, const DistanceSample& b, Meeting meeting,
                             HalfAngle half, double round_m) noexcept {
  const double sign = meeting == Meeting::convex ? 1.0 : -1.0;
  double da = 0.0;
  double db = 0.0;
  const double distance =
      sign * convex_meeting(sign * a.distance_m, sign * b.distance_m, half, round_m, da, db);
  return {distance, da * a.gradient + db * b.gradient};
}

/// The head of a leaf: pieces - 1 (2 bits), for each piece whether it is curved (3 bits), the two meetings (2
/// bits; set = concave), and whether the leaf is compact (1 bit). The other 24 bits belong to the compact
/// form (CompactQuadratic).
struct LeafHead {
  std::uint32_t bits = 0;
  int pieces() const noexcept { return static_cast<int>(bits & 3U) + 1; }
  bool curved(int piece) const noexcept { return (bits >> (2 + piece) & 1U) != 0; }
  /// Whether all pieces are planes: then the leaf does not depend on its position.
  bool flat() const noexcept { return (bits & 0x1CU) == 0; }
  Meeting meeting(int which) const noexcept {
    return (bits >> (5 + which) & 1U) != 0 ? Meeting::concave : Meeting::convex;
  }
  bool compact() const noexcept { return (bits & kCompact) != 0; }
  std::size_t words() const noexcept {
    if (compact()) return kCompactWords;
    std::size_t count = 1 + 2 * static_cast<std::size_t>(pieces() - 1);
    for (int i = 0; i < pieces(); ++i) count += curved(i) ? kCurvedWords : kPlaneWords;
    return count;
  }
  static constexpr std::size_t kPlaneWords = 4;
  static constexpr std::size_t kCurvedWords = 6;
  static constexpr std::uint32_t kCompact = 0x80U;
  static constexpr std::size_t kCompactWords = 4;
  /// One step of a curved piece's 16-bit numbers.
  static constexpr double kStep = 1.0 / 16384.0;
  /// Small leaves need less resolution: their values are multiples of this many steps. `level`: the side is
  /// 2^level finest cells.
  static constexpr int multiple(int level) noexcept {
    return level <= 2 ? 8 : level == 3 ? 4 : level == 4 ? 2 : 1;
  }
  /// A curved piece's value in the middle is a multiple of the finest cell's side divided by this.
  static constexpr double kValuesPerCell = 2048.0;
};

/// One quadratic in four words, head included, for leaves up to four finest cells long, whose error bound is
/// far above these steps. The value is half (c + l·u + u·Qu), as in a curved piece.
struct CompactQuadratic {
  /// Largest leaf: a side of 2^kMostLevel finest cells.
  static constexpr int kMostLevel = 2;
  /// Steps of c, of l and of Q, and the bits of each.
  static constexpr double kMiddleStep = 1.0 / 512.0, kSlopeStep = 1.0 / 1024.0, kBendStep = 1.0 / 256.0;
  static constexpr unsigned kMiddleBits = 24, kSlopeBits = 12, kBendBits = 10;
  /// c; l (x, y, z) and Q (xx, yy, zz, xy, xz, yz) in steps.
  std::int32_t middle = 0;
  std::array<std::int32_t, 9> numbers{};

  static constexpr unsigned bits_of(std::size_t number) noexcept {
    return number < 3 ? kSlopeBits : kBendBits;
  }
  static constexpr double step_of(std::size_t number) noexcept { return number < 3 ? kSlopeStep : kBendStep; }
  /// Whether every number fits into its bits.
  bool fits() const noexcept {
    const auto within = [](std::int32_t value, unsigned bits) {
      const std::int32_t end = std::int32_t{1} << (bits - 1);
      return value >= -end && value < end;
    };
    bool all = within(middle, kMiddleBits);
    for (std::size_t k = 0; k < numbers.size(); ++k) all = all && within(numbers[k], bits_of(k));
    return all;
  }
};

namespace detail {

inline double f64(std::uint32_t word) noexcept { return static_cast<double>(std::bit_cast<float>(word)); }

/// A plane n·x + d, x from the field's origin: nx, ny, nz, d as floats.
inline DistanceSample plane_at(const std::uint32_t* words, Vec3 x) noexcept {
  const Vec3 n{f64(words[0]), f64(words[1]), f64(words[2])};
  return {dot(n, x) + f64(words[3]), n};
}

/// half (c + l·u + u·Qu), u from the leaf's centre in halves of its side: c as a float, then l and Q (xx, yy,
/// zz, xy, xz, yz) in steps of kStep.
inline DistanceSample curved_at(const std::uint32_t* words, Vec3 u, double half_m) noexcept {
  const auto low = [&](int i) { return LeafHead::kStep * static_cast<std::int16_t>(words[1 + i] & 0xFFFFU); };
  const auto high = [&](int i) { return LeafHead::kStep * static_cast<std::int16_t>(words[1 + i] >> 16U); };
  const double lx = low(0), ly = high(0), lz = low(1), xx = high(1), yy = low(2), zz = high(2), xy = low(3),
               xz = high(3), yz = low(4);
  const Vec3 q{xx * u.x + xy * u.y + xz * u.z, yy * u.y + yz * u.z, zz * u.z};
  return {half_m * (f64(words[0]) + u.x * (lx + q.x) + u.y * (ly + q.y) + u.z * (lz + q.z)),
          {lx + 2.0 * xx * u.x + xy * u.y + xz * u.z, ly + 2.0 * yy * u.y + xy * u.x + yz * u.z,
           lz + 2.0 * zz * u.z + xz * u.x + yz * u.y}};
}

/// Word k + 1 of a compact leaf: l along axis k (12 bits), Q's diagonal (10), and Q's yz, xz or xy (10).
inline std::int32_t signed_bits(std::uint32_t word, unsigned from, unsigned bits) noexcept {
  return static_cast<std::int32_t>(word << (32U - from - bits)) >> (32U - bits);
}

using FourInts [[gnu::vector_size(16)]] = std::int32_t;
using TwoInts [[gnu::vector_size(8)]] = std::int32_t;
using Pair [[gnu::vector_size(16)]] = double;
inline FourInts four_words(const std::uint32_t* words) noexcept {
  FourInts four;
  std::memcpy(&four, words, sizeof four);
  return four;
}
/// Two numbers of one vector, or the same of two.
template <int I, int J>
inline Pair pair_of(FourInts a, FourInts b) noexcept {
  const TwoInts two = __builtin_shufflevector(a, b, I, J);
  return __builtin_convertvector(two, Pair);
}

}  // namespace detail

/// Encodes and decodes a compact leaf, for which fits() holds.
inline std::array<std::uint32_t, LeafHead::kCompactWords> words_of(const CompactQuadratic& q) noexcept {
  const auto field = [](std::int32_t value, unsigned from, unsigned bits) {
    return (static_cast<std::uint32_t>(value) & ((1U << bits) - 1U)) << from;
  };
  const auto row = [&](std::size_t axis) {
    return field(q.numbers[axis], 0, 12) | field(q.numbers[3 + axis], 12, 10) |
           field(q.numbers[8 - axis], 22, 10);
  };
  constexpr std::uint32_t kOneCurvedPiece = 4U;
  return {kOneCurvedPiece | LeafHead::kCompact | field(q.middle, 8, 24), row(0), row(1), row(2)};
}
inline CompactQuadratic compact_of(const std::uint32_t* words) noexcept {
  CompactQuadratic q;
  q.middle = detail::signed_bits(words[0], 8, 24);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    q.numbers[axis] = detail::signed_bits(words[1 + axis], 0, 12);
    q.numbers[3 + axis] = detail::signed_bits(words[1 + axis], 12, 10);
    q.numbers[8 - axis] = detail::signed_bits(words[1 + axis], 22, 10);
  }
  return q;
}

/// A compact leaf's distance and gradient; u from the leaf's centre in halves of its side.
inline DistanceSample compact_at(const std::uint32_t* words, Vec3 u, double half_m) noexcept {
  // All numbers are whole multiples of the smallest step, so every product and sum is that of the numbers
  // themselves, to the last bit. Computed in pairs: a processor with vectors of two doubles takes a third of
  // the instructions.
  using detail::FourInts, detail::Pair, detail::pair_of;
  constexpr double kStep = CompactQuadratic::kSlopeStep;
  constexpr int kQ = static_cast<int>(CompactQuadratic::kBendStep / kStep),
                kC = static_cast<int>(CompactQuadratic::kMiddleStep / kStep);
  const FourInts w = detail::four_words(words);
  const FourInts l = (w << 20) >> 20, bend = kQ * ((w << 10) >> 22), mixed = kQ * (w >> 22);
  const Pair l_yz = pair_of<2, 3>(l, l), bend_yz = pair_of<2, 3>(bend, bend), u_yz{u.y, u.z};
  const double yz = mixed[1];
  const Pair xy_xz = pair_of<3, 2>(mixed, mixed);
  // u.Qu and its gradient share Qu.
  const Pair cross_x = xy_xz * u_yz;
  const double q_x = bend[1] * u.x + 0.5 * (cross_x[0] + cross_x[1]);
  const Pair q_yz = bend_yz * u_yz + 0.5 * (xy_xz * u.x + yz * Pair{u.z, u.y});
  const double l_x = l[1];
  const Pair part_yz = u_yz * (l_yz + q_yz);
  const double value = kC * (w[0] >> 8) + u.x * (l_x + q_x) + part_yz[0] + part_yz[1];
  const Pair slope_yz = kStep * (l_yz + 2.0 * q_yz);
  return {(kStep * half_m) * value, {kStep * (l_x + 2.0 * q_x), slope_yz[0], slope_yz[1]}};
}

/// A piece's gradient in its leaf's middle.
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

/// Computes a leaf's half angles from its pieces: between the first two, and between the sum of these and the
/// third.
inline void set_half_angles(std::uint32_t* words) noexcept {
  const LeafHead head{words[0]};
  if (head.compact()) return;
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

/// Calls visit(i, sample) with the value of each piece i of a leaf. `x`: from the field's origin; `u`: from
/// the leaf's centre in halves of its side, half_m. Tick path.
template <class Visit>
void visit_pieces(const std::uint32_t* words, Vec3 x, Vec3 u, double half_m, const Visit& visit) noexcept {
  const LeafHead head{words[0]};
  if (head.compact()) return visit(0, compact_at(words, u, half_m));
  const int pieces = head.pieces();
  const std::uint32_t* at = words + 1 + 2 * (pieces - 1);
  for (int i = 0; i < pieces; ++i) {
    const bool curved = head.curved(i);
    visit(i, curved ? detail::curved_at(at, u, half_m) : detail::plane_at(at, x));
    at += curved ? LeafHead::kCurvedWords : LeafHead::kPlaneWords;
  }
}

/// The first i pieces of a leaf, joined, with piece i.
inline DistanceSample joined_by(const std::uint32_t* words, int i, const DistanceSample& before,
                                const DistanceSample& piece, double round_m) noexcept {
  const HalfAngle half{std::bit_cast<float>(words[2 * i - 1]), std::bit_cast<float>(words[2 * i])};
  return joined(before, piece, LeafHead{words[0]}.meeting(i - 1), half, round_m);
}

/// A leaf's distance and gradient; arguments as visit_pieces(). Tick path.
inline DistanceSample leaf_at(const std::uint32_t* words, Vec3 x, Vec3 u, double half_m,
                              double round_m) noexcept {
  const LeafHead head{words[0]};
  if (head.compact()) return compact_at(words, u, half_m);
  const int pieces = head.pieces();
  const std::uint32_t* at = words + 1 + 2 * (pieces - 1);
  const auto next_piece = [&](int i) {
    const bool curved = head.curved(i);
    const std::uint32_t* const piece = at;
    at += curved ? LeafHead::kCurvedWords : LeafHead::kPlaneWords;
    return curved ? detail::curved_at(piece, u, half_m) : detail::plane_at(piece, x);
  };
  const DistanceSample first = next_piece(0);
  if (pieces == 1) return first;
  const DistanceSample two = joined_by(words, 1, first, next_piece(1), round_m);
  if (pieces == 2) return two;
  return joined_by(words, 2, two, next_piece(2), round_m);
}

}  // namespace palpable::models
