// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/scene/field_pieces.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace palpable::formats {
namespace {

using models::CompactQuadratic;
using models::LeafHead;

/// The quantisation step of the middle, in halves of the leaf's side.
double middle_step(int level) { return 2.0 / (LeafHead::kValuesPerCell * (1 << level)); }

std::int32_t held(double v) { return static_cast<std::int32_t>(std::clamp(v, -1e9, 1e9)); }

/// The quadratic of the leaf at `from`, extrapolated to the leaf at `to`.
QuadraticValues continued(const QuadraticValues& piece, const LeafPosition& from, const LeafPosition& to) {
  const double scale = to.half() / from.half();
  const auto offset = [&](std::size_t axis) {
    return (to.corner[axis] + to.half() - from.corner[axis] - from.half()) / from.half();
  };
  const double x = offset(0), y = offset(1), z = offset(2);
  const auto [lx, ly, lz, xx, yy, zz, xy, xz, yz] = piece.numbers;
  const double middle =
      piece.middle + x * (lx + xx * x + xy * y + xz * z) + y * (ly + yy * y + yz * z) + z * (lz + zz * z);
  return {middle / scale,
          {lx + 2 * xx * x + xy * y + xz * z, ly + 2 * yy * y + xy * x + yz * z,
           lz + 2 * zz * z + xz * x + yz * y, scale * xx, scale * yy, scale * zz, scale * xy, scale * xz,
           scale * yz}};
}

}  // namespace

LeafPosition LeafPosition::child(unsigned k) const {
  const int side = 1 << (level - 1);
  return {{corner[0] + (k & 1U ? side : 0), corner[1] + (k & 2U ? side : 0), corner[2] + (k & 4U ? side : 0)},
          level - 1};
}

LeafPosition root_position(const models::FieldGrid& grid, std::size_t index) {
  const auto i = static_cast<int>(index);
  return {{i % grid.roots[0] << grid.levels, i / grid.roots[0] % grid.roots[1] << grid.levels,
           i / (grid.roots[0] * grid.roots[1]) << grid.levels},
          grid.levels};
}

std::optional<Curved> steps_of(const std::uint32_t* words, int level) {
  const double middle = models::detail::f64(words[0]) / middle_step(level);
  if (!(std::abs(middle) < 1e9) || middle != std::round(middle)) return std::nullopt;
  if (words[5] >> 16U != 0 || (middle == 0.0 && words[0] != 0)) return std::nullopt;
  Curved curved;
  curved.middle = static_cast<std::int32_t>(middle);
  for (std::size_t k = 0; k < Curved::kNumbers; ++k)
    curved.numbers[k] = static_cast<std::int16_t>(words[1 + k / 2] >> (k % 2 == 0 ? 0U : 16U) & 0xFFFFU);
  return curved;
}
void set_words(const Curved& curved, int level, std::vector<std::uint32_t>& words) {
  words.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(curved.middle * middle_step(level))));
  for (std::size_t k = 0; k < Curved::kNumbers; k += 2) {
    const auto low = static_cast<std::uint32_t>(curved.numbers[k]) & 0xFFFFU;
    const auto high =
        k + 1 < Curved::kNumbers ? static_cast<std::uint32_t>(curved.numbers[k + 1]) & 0xFFFFU : 0U;
    words.push_back(low | high << 16U);
  }
}

QuadraticValues values_of(const Curved& curved, int level) {
  QuadraticValues values;
  values.middle = curved.middle * middle_step(level);
  for (std::size_t k = 0; k < Curved::kNumbers; ++k) values.numbers[k] = LeafHead::kStep * curved.numbers[k];
  return values;
}
QuadraticValues values_of(const CompactQuadratic& compact) {
  QuadraticValues values;
  values.middle = CompactQuadratic::kMiddleStep * compact.middle;
  for (std::size_t k = 0; k < Curved::kNumbers; ++k)
    values.numbers[k] = CompactQuadratic::step_of(k) * compact.numbers[k];
  return values;
}

Curved rounded_curved(const QuadraticValues& values, int level) {
  Curved curved;
  curved.middle = held(std::round(values.middle / middle_step(level)));
  const int multiple = LeafHead::multiple(level);
  for (std::size_t k = 0; k < Curved::kNumbers; ++k)
    curved.numbers[k] = std::clamp(
        multiple * held(std::round(values.numbers[k] / (multiple * LeafHead::kStep))), -32768, 32767);
  return curved;
}
CompactQuadratic rounded_compact(const QuadraticValues& values) {
  CompactQuadratic compact;
  compact.middle = held(std::round(values.middle / CompactQuadratic::kMiddleStep));
  for (std::size_t k = 0; k < Curved::kNumbers; ++k)
    compact.numbers[k] = held(std::round(values.numbers[k] / CompactQuadratic::step_of(k)));
  return compact;
}

void RecentPieces::add(const QuadraticValues& piece, const LeafPosition& place) {
  std::rotate(pieces_.begin(), pieces_.end() - 1, pieces_.end());
  pieces_.front() = {piece, place};
  count_ = std::min(count_ + 1, kMost);
}

QuadraticValues RecentPieces::predict(std::size_t k, const LeafPosition& place) const {
  return continued(pieces_[k].first, pieces_[k].second, place);
}

std::uint32_t RecentPlanes::rank(const Plane& plane) {
  const auto at = std::find(planes_.begin(), planes_.end(), plane);
  const auto rank = at == planes_.end() ? 0U : static_cast<std::uint32_t>(at - planes_.begin()) + 1U;
  if (rank == 0) {
    add(plane);
  } else {
    std::rotate(planes_.begin(), at, at + 1);
  }
  return rank;
}

std::optional<Plane> RecentPlanes::take(std::uint32_t rank) {
  if (rank == 0 || rank > planes_.size()) return std::nullopt;
  const auto at = planes_.begin() + static_cast<std::ptrdiff_t>(rank) - 1;
  std::rotate(planes_.begin(), at, at + 1);
  return planes_.front();
}

void RecentPlanes::add(const Plane& plane) {
  if (planes_.size() == kMost) planes_.pop_back();
  planes_.insert(planes_.begin(), plane);
}

}  // namespace palpable::formats
