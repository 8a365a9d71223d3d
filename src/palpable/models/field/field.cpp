// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/field/field.hpp"

#include "palpable/core/work.hpp"
#include "palpable/models/field/solid_view.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::models {
namespace {

/// The height of the zero crossing between a height outside and one inside, by bisection.
template <DistanceSurface Distance>
double crossing_m(const Distance& field, double x_m, double y_m, double outside_m, double inside_m) {
  // Ten halvings of at most a quarter of a cell: accurate to 1/4000 of a cell.
  constexpr int kHalvings = 10;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle_m = 0.5 * (outside_m + inside_m);
    (field.sample({{x_m, y_m, middle_m}}).distance_m > 0.0 ? outside_m : inside_m) = middle_m;
  }
  return 0.5 * (outside_m + inside_m);
}

/// Whether a vertical line at this position passes through the grid. Beside the grid the distance is only an
/// upper bound and no safe step.
template <DistanceSurface Distance>
bool passes_through(const Distance& field, double x_m, double y_m) {
  const Vec3 size = field.size_m();
  const double x = x_m - field.origin_m().x, y = y_m - field.origin_m().y;
  return x >= 0.0 && y >= 0.0 && x <= size.x && y <= size.y;
}

/// Sphere tracing downwards from the top of the grid. The top may be outside the grid by a rounding error,
/// where sample() is as exact as inside.
template <DistanceSurface Distance>
double height_m(const Distance& field, double x_m, double y_m, double lowest_m) {
  if (!passes_through(field, x_m, y_m)) return lowest_m;
  double outside_m = field.origin_m().z + field.size_m().z;
  constexpr double kShare = 0.95;
  const double shortest_m = 0.25 * field.cell_m();
  for (double z_m = outside_m; z_m > lowest_m;) {
    const double distance_m = field.sample({{x_m, y_m, z_m}}).distance_m;
    if (distance_m <= 0.0) return crossing_m(field, x_m, y_m, outside_m, z_m);
    outside_m = z_m;
    z_m -= std::max(kShare * distance_m, shortest_m);
  }
  return lowest_m;
}

template <DistanceSurface Distance>
Result<SolidField<Distance>> seen_from_above(Distance distance, Vec3 least_m, Vec3 most_m) {
  const Vec3 size = most_m - least_m;
  if (!is_finite(least_m) || !is_finite(most_m) || !(size.x >= 0.0 && size.y >= 0.0 && size.z >= 0.0))
    return invalid_input("contains a field with an invalid box");
  constexpr double kPixels = 256.0;
  const double half_x = std::max({std::abs(least_m.x), std::abs(most_m.x), distance.cell_m()});
  const double half_y = std::max({std::abs(least_m.y), std::abs(most_m.y), distance.cell_m()});
  const double pixel_m = std::clamp(2.0 * std::max(half_x, half_y) / kPixels, 1e-6, 1.0);
  const auto count = [&](double half) {
    return std::clamp(static_cast<int>(std::ceil(2.0 * half / pixel_m)), 2, 4096);
  };
  Raster<float> heights(count(half_x), count(half_y));
  constexpr int kRows = 8;
  parallel_for({}, heights.height(), kRows, [&](int begin, int end) {
    for (int j = begin; j < end; ++j)
      for (int i = 0; i < heights.width(); ++i)
        heights(i, j) =
            static_cast<float>(height_m(distance, (i - 0.5 * (heights.width() - 1)) * pixel_m,
                                        -(j - 0.5 * (heights.height() - 1)) * pixel_m, least_m.z));
  });
  auto relief = Relief::from_samples(std::move(heights), pixel_m);
  if (!relief) return std::move(relief).error();
  return SolidField<Distance>{
      std::move(distance), least_m, most_m, std::make_shared<const Relief>(std::move(*relief)), {}};
}

/// The greatest height at which a disc around a vertical line may meet the solid: above it there is nothing.
template <DistanceSurface Distance>
double clear_above_m(const Distance& field, double x_m, double y_m, double radius_m, double lowest_m) {
  constexpr double kShare = 0.95;
  for (double z_m = field.origin_m().z + field.size_m().z; z_m > lowest_m;) {
    const double clear_m = kShare * field.sample({{x_m, y_m, z_m}}).distance_m;
    // Of a clear ball, the part within the disc's cylinder.
    const double down_m = clear_m > radius_m ? std::sqrt(clear_m * clear_m - radius_m * radius_m) : 0.0;
    if (down_m < field.cell_m()) return z_m;
    z_m -= down_m;
  }
  return lowest_m;
}

/// The surface's height on a vertical line, from a height that is outside; interpolated between the last two
/// samples.
template <DistanceSurface Distance>
double height_below_m(const Distance& field, double x_m, double y_m, double from_m, double lowest_m) {
  constexpr double kShare = 0.95;
  const double shortest_m = 0.25 * field.cell_m();
  double above_m = from_m, above_distance_m = 0.0;
  for (double z_m = from_m; z_m > lowest_m;) {
    const double distance_m = field.sample({{x_m, y_m, z_m}}).distance_m;
    if (distance_m <= 0.0) {
      const double rise_m = above_distance_m - distance_m;
      return rise_m > 0.0 ? z_m + (above_m - z_m) * (-distance_m / rise_m) : z_m;
    }
    above_m = z_m;
    above_distance_m = distance_m;
    z_m -= std::max(kShare * distance_m, shortest_m);
  }
  return lowest_m;
}

template <DistanceSurface Distance>
Relief view_over_box(const SolidField<Distance>& solid, double pixel_m) {
  const Vec3 size = solid.most_m - solid.least_m, middle = 0.5 * (solid.most_m + solid.least_m);
  constexpr int kTile = 8, kMostPixels = 4096;
  const auto count = [&](double extent_m) {
    return std::clamp(static_cast<int>(std::ceil(extent_m / pixel_m - 1e-6)), 2, kMostPixels);
  };
  Raster<float> heights(count(size.x), count(size.y));
  const int columns = heights.width(), rows = heights.height();
  const auto x_of = [&](double i) { return middle.x + (i - 0.5 * (columns - 1)) * pixel_m; };
  const auto y_of = [&](double j) { return middle.y - (j - 0.5 * (rows - 1)) * pixel_m; };
  // From a tile's centre to its farthest pixel centre.
  const double radius_m = 0.5 * (kTile - 1) * std::sqrt(2.0) * pixel_m;
  parallel_for({}, (rows + kTile - 1) / kTile, 1, [&](int begin, int end) {
    for (int v = begin; v < end; ++v)
      for (int u = 0; u < columns; u += kTile) {
        constexpr double kHalf = 0.5 * (kTile - 1);
        const double from_m = clear_above_m(solid.distance, x_of(u + kHalf), y_of(v * kTile + kHalf),
                                            radius_m, solid.least_m.z);
        for (int j = v * kTile; j < std::min(rows, (v + 1) * kTile); ++j)
          for (int i = u; i < std::min(columns, u + kTile); ++i)
            heights(i, j) = static_cast<float>(
                passes_through(solid.distance, x_of(i), y_of(j))
                    ? height_below_m(solid.distance, x_of(i), y_of(j), from_m, solid.least_m.z)
                    : solid.least_m.z);
      }
  });
  return *Relief::from_samples(std::move(heights), pixel_m);
}

}  // namespace

Result<Field> field_of(DistanceField distance, Vec3 least_m, Vec3 most_m) {
  return seen_from_above(std::move(distance), least_m, most_m);
}

Result<FieldOnLattice> field_of(DenseField distance, Vec3 least_m, Vec3 most_m) {
  return seen_from_above(std::move(distance), least_m, most_m);
}

Relief solid_view(const Field& solid, double pixel_m) { return view_over_box(solid, pixel_m); }
Relief solid_view(const FieldOnLattice& solid, double pixel_m) { return view_over_box(solid, pixel_m); }

}  // namespace palpable::models
