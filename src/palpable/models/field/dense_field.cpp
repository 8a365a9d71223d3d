// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/field/dense_field.hpp"

#include "palpable/models/field/outside_box.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::models {
namespace {

constexpr int kMostAlongAnAxis = 1 << 20;
constexpr double kMostPlaces = 2147483648.0;

bool is_valid(const Lattice& lattice) {
  double places = 1.0;
  for (const int count : lattice.counts) {
    if (count < 2 || count > kMostAlongAnAxis) return false;
    places *= count;
  }
  return places <= kMostPlaces && is_finite(lattice.origin_m) && norm(lattice.origin_m) < 1e6 &&
         lattice.spacing_m >= 1e-6 && lattice.spacing_m <= 1.0;
}

/// The cell that contains a coordinate along one axis, and the fraction within it.
std::pair<int, double> cell_of(double cells, int count) noexcept {
  const int cell = std::clamp(static_cast<int>(cells), 0, count - 2);
  return {cell, cells - cell};
}

}  // namespace

Result<DenseField> DenseField::from(const Lattice& lattice, DenseContent content, std::vector<float> values,
                                    const FieldErrors& errors) {
  if (!is_valid(lattice)) return invalid_input("states a dense field with an invalid lattice");
  if (values.size() != floats_of(content) * lattice.places())
    return invalid_input("holds a dense field of another size than it states");
  const auto finite = [](float v) { return std::abs(v) < 1e6F; };
  if (!std::all_of(values.begin(), values.end(), finite))
    return invalid_input("holds a dense field with a value that is not a number");
  if (!std::isfinite(errors.bound_m) || !std::isfinite(errors.p99_m) || !std::isfinite(errors.max_m))
    return invalid_input("holds a dense field whose errors are not numbers");
  DenseField field;
  field.lattice_ = lattice;
  field.content_ = content;
  field.values_ = std::move(values);
  field.errors_ = errors;
  return field;
}

bool DenseField::contains(Point<SceneFrame> place) const noexcept {
  const Vec3 p = place.v - lattice_.origin_m, size = lattice_.size_m();
  return p.x >= 0.0 && p.y >= 0.0 && p.z >= 0.0 && p.x <= size.x && p.y <= size.y && p.z <= size.z;
}

FieldSample DenseField::sample(Point<SceneFrame> place) const noexcept {
  const Vec3 p = place.v - lattice_.origin_m;
  const auto at = [this](Vec3 held_m) noexcept { return inside(held_m / lattice_.spacing_m); };
  const DistanceSample s = contains(place) ? at(p) : outside_box(p, lattice_.size_m(), at);
  return {s.distance_m, {s.gradient}};
}

DistanceSample DenseField::inside(Vec3 cells) const noexcept {
  const auto [x, u] = cell_of(cells.x, lattice_.counts[0]);
  const auto [y, v] = cell_of(cells.y, lattice_.counts[1]);
  const auto [z, w] = cell_of(cells.z, lattice_.counts[2]);
  const std::size_t floats = floats_of(content_);
  const auto row = floats * static_cast<std::size_t>(lattice_.counts[0]);
  const auto slice = row * static_cast<std::size_t>(lattice_.counts[1]);
  const float* const first = values_.data() + floats * lattice_.index(x, y, z);
  const auto at = [&](unsigned corner, std::size_t number) {
    return static_cast<double>(
        first[(corner & 1U ? floats : 0U) + (corner & 2U ? row : 0U) + (corner & 4U ? slice : 0U) + number]);
  };
  DistanceSample s;
  if (content_ == DenseContent::distance_and_force) {
    for (unsigned corner = 0; corner < 8; ++corner) {
      const double share =
          (corner & 1U ? u : 1.0 - u) * (corner & 2U ? v : 1.0 - v) * (corner & 4U ? w : 1.0 - w);
      s.distance_m += share * at(corner, 0);
      s.gradient += share * Vec3{at(corner, 1), at(corner, 2), at(corner, 3)};
    }
    return s;
  }
  const auto mix = [](double a, double b, double t) { return a + t * (b - a); };
  std::array<double, 8> d{};
  for (unsigned corner = 0; corner < 8; ++corner) d[corner] = at(corner, 0);
  // Along x on the four edges, then y, then z.
  const double low_near = mix(d[0], d[1], u), low_far = mix(d[2], d[3], u);
  const double high_near = mix(d[4], d[5], u), high_far = mix(d[6], d[7], u);
  const double low = mix(low_near, low_far, v), high = mix(high_near, high_far, v);
  s.distance_m = mix(low, high, w);
  s.gradient = Vec3{mix(mix(d[1] - d[0], d[3] - d[2], v), mix(d[5] - d[4], d[7] - d[6], v), w),
                    mix(low_far - low_near, high_far - high_near, w), high - low} /
               lattice_.spacing_m;
  return s;
}

}  // namespace palpable::models
