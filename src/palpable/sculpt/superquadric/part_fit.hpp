// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sculpt/superquadric/free_space.hpp"
#include "palpable/sculpt/superquadric/point_parts.hpp"
#include "palpable/sculpt/superquadric/superquadric_set.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace palpable::sculpt {

/// Points that a part needs for a shape.
inline constexpr std::size_t kFewestPartPoints = 12;

/// A part of the points with its shape.
struct ShapePart {
  Members members;
  std::uint8_t label = 0;
  FittedSuperquadric fit;
  /// Mean and root mean square distance of the members, each at most options.most_tolerances tolerances;
  /// infinite without a shape.
  double error_m = std::numeric_limits<double>::infinity();
  double deviation_m = std::numeric_limits<double>::infinity();
  /// The plain shape that fit() found for the members, also where it was not taken.
  std::optional<models::Superquadric> plain = {};
  /// Numbers that describe the shape.
  int parameters = 0;
  /// The members lie on a plane: the shape is a slab in which they may lie.
  bool flat = false;

  bool has_shape() const { return error_m < std::numeric_limits<double>::infinity(); }
};

/// Fits shapes to parts of one set of points, and tells what they cost by the Bayesian information criterion
/// (Schwarz 1978). The points, their eye and free space, and the options must outlive it. Immutable; any
/// thread.
class PartFitter {
 public:
  struct Scene {
    std::span<const Vec3> points_m;
    const std::optional<Point<SceneFrame>>& eye;
    const FreeSpace& free;
    double tolerance_m;
    std::uint64_t seed;
  };
  PartFitter(const Scene& scene, const ShapeSetOptions& options) : scene_(scene), options_(options) {}

  /// Fits a slab if the members are flat or nothing else is possible, else a superquadric. A shape that
  /// reaches into free space is trimmed. The part has no shape if none costs less than `most_cost` and than
  /// none.
  void fit(ShapePart& part, double most_cost = std::numeric_limits<double>::infinity()) const;
  /// The same by the shapes near that of `like`, a part with most of the members, in less time.
  void fit_near(ShapePart& part, const ShapePart& like,
                double most_cost = std::numeric_limits<double>::infinity()) const;
  /// Tapers and bends a part's shape where that costs less, and less than `most_cost`.
  void deform(ShapePart& part, double most_cost = std::numeric_limits<double>::infinity()) const;

  /// Half the criterion, in nats: what the members' distances and the shape's parameters cost. Distances
  /// below options.resolution_share of the tolerance do not count. A part without a shape has no parameters,
  /// and all distances are the greatest.
  double cost(const ShapePart& part) const;
  /// Whether two exact shapes for the part would cost more than its shape, and what they would cost.
  bool good(const ShapePart& part) const { return part.has_shape() && cost(part) <= good_cost(); }
  double good_cost() const;

  /// Measures the distances of the members to the part's shape.
  void measure(ShapePart& part) const;

  /// At most `most` members, evenly chosen.
  std::vector<Vec3> places_of(const Members& members, int most) const;

 private:
  double observations(std::size_t members) const;
  double cost_of_parameters(int count) const;
  /// The deviation at which as many points cost this much with a shape of so many parameters; 0 if none does.
  double deviation_at(double cost, std::size_t members, int parameters) const;
  bool reaches_beyond(const models::Superquadric& shape, std::span<const Vec3> places) const;
  std::optional<FittedSuperquadric> fitted(const ShapePart& part, std::span<const Vec3> places,
                                           FitDeformation deformation, double most_cost,
                                           const std::optional<models::Superquadric>& start = {}) const;
  /// Takes the shape away. What a new one must cost less than: `most_cost`, and none.
  double without_shape(ShapePart& part, double most_cost) const;
  /// Gives the part this shape, trimmed, if it is possible and costs less than `most_cost`.
  bool take(ShapePart& part, const FittedSuperquadric& fit, std::span<const Vec3> places, int parameters,
            double most_cost) const;
  struct Distances {
    double mean_m = std::numeric_limits<double>::infinity();
    double deviation_m = std::numeric_limits<double>::infinity();
  };
  Distances distances_of(const models::Superquadric& shape, const Members& members, bool flat) const;

  Scene scene_;
  const ShapeSetOptions& options_;
};

}  // namespace palpable::sculpt
