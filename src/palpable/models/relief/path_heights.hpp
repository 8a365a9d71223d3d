// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace palpable::models {

/// A part of a straight path, as shares of its length.
struct PathPart {
  double from;
  double to;
};

/// The part in which a path enters a surface: above it at `from` (or below it by no more than what may be
/// missed), below it at `to`, with its height there.
struct PathEntry {
  bool is_found = false;
  PathPart part{0.0, 1.0};
  double above_m = 0.0;
  double below_m = 0.0;
};

/// The height of a straight path above the surface within one cell of a cubic spline: a polynomial of degree
/// 6 of the share of the path, by its Bernstein coefficients, metres. It lies between the least and the
/// greatest of them, and begins and ends at the first and the last.
class PathHeights {
 public:
  static constexpr std::size_t kCount = 7;

  PathHeights() = default;
  /// The coefficients, the last one twice.
  explicit PathHeights(const std::array<float, kCount + 1>& coefficients) noexcept : at_(coefficients) {}

  const std::array<float, kCount + 1>& coefficients() const noexcept { return at_; }
  float first() const noexcept { return at_[0]; }
  float last() const noexcept { return at_[kCount]; }
  PathHeights times(float factor) const noexcept {
    PathHeights scaled = *this;
    for (float& height : scaled.at_) height *= factor;
    return scaled;
  }
  float lowest() const noexcept {
    Float4 low;
    Float4 high;
    std::memcpy(&low, at_.data(), sizeof(low));
    std::memcpy(&high, at_.data() + 4, sizeof(high));
    low = low < high ? low : high;
    high = __builtin_shufflevector(low, low, 2, 3, 0, 1);
    low = low < high ? low : high;
    return std::min(low[0], low[1]);
  }

  /// The first place where the path, above the surface at its beginning, is below it: as the part of the
  /// path around it. Cuts that are nowhere deeper than `ignored_m` >= 0 may be missed, also at the path's
  /// end. At most kMostSplits splits. Tick path.
  PathEntry entry(float ignored_m) const noexcept {
    if (lowest() >= -ignored_m) return {};
    return search(ignored_m);
  }

  /// The two halves, by de Casteljau's algorithm.
  void split(PathHeights& left, PathHeights& right) const noexcept {
    std::array<float, kCount + 1> row = at_;
    for (std::size_t k = 0; k < kCount; ++k) {
      left.at_[k] = row[0];
      right.at_[kCount - 1 - k] = row[kCount - 1 - k];
      for (std::size_t i = 0; i + 1 < kCount - k; ++i) row[i] = 0.5F * (row[i] + row[i + 1]);
    }
    left.at_[kCount] = left.at_[kCount - 1];
    right.at_[kCount] = right.at_[kCount - 1];
  }

 private:
  using Float4 = float __attribute__((vector_size(16)));
  /// Halvings until a piece is too small to hide a cut: the coefficients' distance from the polynomial falls
  /// by four with each.
  static constexpr std::size_t kDeepest = 12;
  static constexpr double kSmallest = 1.0 / (1 << kDeepest);
  static constexpr int kMostSplits = 64;

  /// Whether it crosses zero once: its coefficients change their sign once (Descartes' rule).
  bool falls_once() const noexcept {
    int changes = 0;
    for (std::size_t k = 1; k + 1 < kCount; ++k) changes += (at_[k] < 0.0F) != (at_[k + 1] < 0.0F) ? 1 : 0;
    return changes + (at_[1] < 0.0F ? 1 : 0) <= 1;
  }

  [[gnu::noinline]] PathEntry search(float ignored_m) const noexcept {
    struct Piece {
      PathHeights heights;
      PathPart part;
    };
    std::array<Piece, kDeepest + 2> waiting;
    waiting[0] = {*this, {0.0, 1.0}};
    std::size_t count = 1;
    for (int splits = 0; count > 0; ++splits) {
      const auto [heights, part] = waiting[--count];
      if (heights.lowest() >= -ignored_m) continue;
      const bool is_small = splits >= kMostSplits || part.to - part.from <= kSmallest;
      if (heights.last() < 0.0F && (is_small || heights.falls_once()))
        return {true, part, double{heights.first()}, double{heights.last()}};
      if (is_small) continue;
      const double middle = 0.5 * (part.from + part.to);
      Piece& right = waiting[count++];
      Piece& left = waiting[count++];
      right.part = {middle, part.to};
      left.part = {part.from, middle};
      heights.split(left.heights, right.heights);
    }
    return {};
  }

  std::array<float, kCount + 1> at_;
};

/// Steps along a straight path from cell to cell of a grid (Amanatides & Woo 1987).
class CellWalk {
 public:
  /// The path's beginning and extent, in cells; any finite values.
  CellWalk(double x, double y, double way_x, double way_y) noexcept
      : per_x_(per_cell(way_x)),
        per_y_(per_cell(way_y)),
        next_x_(to_border(x, way_x) * per_x_),
        next_y_(to_border(y, way_y) * per_y_) {}

  /// The share of the path at which its next cell ends; 1 at the end.
  double next() noexcept {
    const double share = std::min({next_x_, next_y_, 1.0});
    if (next_x_ <= share) next_x_ += per_x_;
    if (next_y_ <= share) next_y_ += per_y_;
    return share;
  }

 private:
  static constexpr double kNever = 2.0;
  static double per_cell(double way) noexcept { return way != 0.0 ? 1.0 / std::abs(way) : kNever; }
  /// The distance from a place to the next border between cells in the direction of the way, 0 < d <= 1.
  static double to_border(double place, double way) noexcept {
    constexpr double kMost = 1e9;
    if (way == 0.0) return 1.0;
    // Not std::floor, which is a call on machines without SSE4.1.
    const double held = std::max(-kMost, std::min(place, kMost));
    const double cut = held - static_cast<double>(static_cast<std::int32_t>(held));
    const double fraction = cut < 0.0 ? cut + 1.0 : cut;
    if (way > 0.0) return 1.0 - fraction;
    return fraction > 0.0 ? fraction : 1.0;
  }

  double per_x_;
  double per_y_;
  double next_x_;
  double next_y_;
};

}  // namespace palpable::models
