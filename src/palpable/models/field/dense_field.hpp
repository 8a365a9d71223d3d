// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/models/field/distance_sample.hpp"
#include "palpable/models/field/distance_surface.hpp"
#include "palpable/models/field/field_errors.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace palpable::models {

/// A regular grid of points with the same spacing along x, y and z.
struct Lattice {
  /// Position of the point (0, 0, 0).
  Vec3 origin_m;
  /// 1e-6 ... 1 m.
  double spacing_m = 0.0;
  /// Number of points along x, y and z, each 2 ... 2^20; at most 2^31 in all.
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

/// What is stored at each lattice point.
enum class DenseContent {
  /// The signed distance: 4 bytes. The gradient is the exact derivative of the trilinear interpolation.
  distance,
  /// Distance and force direction, four floats (16 bytes), like D and F in Moustakas et al. 2007. Both are
  /// interpolated; the gradient is the interpolated F.
  distance_and_force
};

/// Floats per lattice point.
constexpr std::size_t floats_of(DenseContent content) noexcept {
  return content == DenseContent::distance ? 1U : 4U;
}

/// A dense distance field: values at all points of a lattice with trilinear interpolation, as in Moustakas et
/// al. 2007. It serves for comparison with the adaptive DistanceField. Its distance is continuous. With
/// distances alone, the gradient jumps at the faces between cells, which can be felt. With stored forces the
/// gradient is continuous but not the derivative of the distance, so closed paths can generate energy.
/// Immutable; any thread.
class DenseField {
 public:
  /// `values`: floats_of(content) for each lattice point. Errors: invalid_input for a lattice out of range,
  /// another number of values, or a value that is not finite.
  static Result<DenseField> from(const Lattice& lattice, DenseContent content, std::vector<float> values,
                                 const FieldErrors& errors);

  /// At any finite position; outside the lattice by outside_box(). Tick path.
  FieldSample sample(Point<SceneFrame> place) const noexcept;

  bool contains(Point<SceneFrame> place) const noexcept;
  const Lattice& lattice() const noexcept { return lattice_; }
  DenseContent content() const noexcept { return content_; }
  const std::vector<float>& values() const noexcept { return values_; }
  const FieldErrors& errors() const noexcept { return errors_; }
  double cell_m() const noexcept { return lattice_.spacing_m; }
  /// The lattice's box, as in DistanceField.
  Vec3 origin_m() const noexcept { return lattice_.origin_m; }
  Vec3 size_m() const noexcept { return lattice_.size_m(); }
  /// Sets the measured errors; for the builder, before the field is shared.
  void set_errors(const FieldErrors& errors) noexcept { errors_ = errors; }
  std::size_t memory_bytes() const noexcept { return sizeof(*this) + sizeof(float) * values_.size(); }

 private:
  DenseField() = default;
  DistanceSample inside(Vec3 cells) const noexcept;

  Lattice lattice_;
  DenseContent content_ = DenseContent::distance;
  std::vector<float> values_;
  FieldErrors errors_;
};

}  // namespace palpable::models
