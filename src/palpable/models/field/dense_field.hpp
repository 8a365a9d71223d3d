// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/models/field/distance_surface.hpp"
#include "palpable/models/field/field_errors.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace palpable::models {

/// Places in a box, the same distance apart along x, y and z.
struct Lattice {
  /// Of the place (0, 0, 0).
  Vec3 origin_m;
  /// 1e-6 ... 1 m.
  double spacing_m = 0.0;
  /// Along x, y and z, each 2 ... 2^20; at most 2^31 in all.
  std::array<int, 3> counts{};

  std::size_t places() const noexcept {
    return static_cast<std::size_t>(counts[0]) * static_cast<std::size_t>(counts[1]) *
           static_cast<std::size_t>(counts[2]);
  }
  /// x fastest, then y, then z.
  std::size_t index(int x, int y, int z) const noexcept {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(counts[1]) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(counts[0]) +
           static_cast<std::size_t>(x);
  }
  Vec3 place_m(int x, int y, int z) const noexcept {
    return origin_m + spacing_m * Vec3{1.0 * x, 1.0 * y, 1.0 * z};
  }
  Vec3 size_m() const noexcept { return spacing_m * Vec3{counts[0] - 1.0, counts[1] - 1.0, counts[2] - 1.0}; }
};

/// What stands at a lattice's place.
enum class DenseContent {
  /// The signed distance: 4 bytes. The gradient is the exact derivative of its trilinear interpolation.
  distance,
  /// Distance and direction of the force, four floats: 16 bytes, as Moustakas et al. 2007 store D and F. Both
  /// are interpolated, the gradient is the interpolated F.
  distance_and_force
};

/// Floats at each place.
constexpr std::size_t floats_of(DenseContent content) noexcept {
  return content == DenseContent::distance ? 1U : 4U;
}

/// A distance field at every place of a lattice, trilinear in between: what the adaptive DistanceField is
/// compared with, and what Moustakas et al. 2007 began with. Its distance is continuous. With distances alone
/// the gradient jumps at every face between cells, which the hand feels; with a force of its own it is
/// continuous, and not the derivative of the distance: going round a loop makes energy. Immutable; any
/// thread.
class DenseField {
 public:
  /// floats_of(content) values for each place of the lattice. Errors: invalid_input for a lattice out of its
  /// range, another number of values, or one that is not finite.
  static Result<DenseField> from(const Lattice& lattice, DenseContent content, std::vector<float> values,
                                 const FieldErrors& errors);

  /// At any finite place. Outside the lattice: the distance at its nearest place plus the way there. Tick
  /// path.
  FieldSample sample(Vec3 place_m) const noexcept;

  bool contains(Vec3 place_m) const noexcept;
  const Lattice& lattice() const noexcept { return lattice_; }
  DenseContent content() const noexcept { return content_; }
  const std::vector<float>& values() const noexcept { return values_; }
  const FieldErrors& errors() const noexcept { return errors_; }
  double cell_m() const noexcept { return lattice_.spacing_m; }
  /// Of the box of places, as DistanceField has them.
  Vec3 origin_m() const noexcept { return lattice_.origin_m; }
  Vec3 size_m() const noexcept { return lattice_.size_m(); }
  /// What was measured of it, by who made it and has not given it away yet.
  void tell(const FieldErrors& errors) noexcept { errors_ = errors; }
  std::size_t memory_bytes() const noexcept { return sizeof(*this) + sizeof(float) * values_.size(); }

 private:
  DenseField() = default;
  FieldSample inside(Vec3 cells) const noexcept;

  Lattice lattice_;
  DenseContent content_ = DenseContent::distance;
  std::vector<float> values_;
  FieldErrors errors_;
};

}  // namespace palpable::models
