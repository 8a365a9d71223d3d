// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/part_fit.hpp"

#include "palpable/models/field/superquadric_distance.hpp"
#include "palpable/sculpt/triangles/box.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace palpable::sculpt {
namespace {

using models::Superquadric;
using models::SuperquadricDistance;

/// Whether it stands for a box, whose edges are sharper than the least exponents'.
bool is_box(const Superquadric& shape) {
  constexpr double kNearlyLeast = 1.1 * models::kLeastExponent;
  return !shape.deformed() && shape.e1 < kNearlyLeast && shape.e2 < kNearlyLeast;
}

/// Distance from the surface of the box with a shape's half axes, along the ray from its centre.
double distance_to_box_m(Vec3 in_shape_m, Vec3 half_m) {
  const double factor = std::max({std::abs(in_shape_m.x) / half_m.x, std::abs(in_shape_m.y) / half_m.y,
                                  std::abs(in_shape_m.z) / half_m.z});
  return factor > 0.0 ? norm(in_shape_m) * std::abs(1.0 - 1.0 / factor) : norm(half_m);
}

}  // namespace

std::vector<Vec3> PartFitter::places_of(const Members& members, int most) const {
  std::vector<Vec3> places;
  const std::size_t count = std::min(static_cast<std::size_t>(most), members.size());
  places.reserve(count);
  for (std::size_t k = 0; k < count; ++k)
    places.push_back(scene_.points_m[members[k * members.size() / count]]);
  return places;
}

double PartFitter::observations(std::size_t members) const {
  const double most = options_.most_observations;
  return static_cast<double>(members) * std::min(1.0, most / static_cast<double>(scene_.points_m.size()));
}

double PartFitter::cost_of_parameters(int count) const {
  return 0.5 * count * std::log(std::max(observations(scene_.points_m.size()), 2.0));
}

double PartFitter::cost(const ShapePart& part) const {
  const double resolution_m = options_.resolution_share * scene_.tolerance_m;
  const double deviation_m = std::min(part.deviation_m, options_.most_tolerances * scene_.tolerance_m);
  return observations(part.members.size()) * std::log(std::hypot(deviation_m, resolution_m) / resolution_m) +
         cost_of_parameters(part.parameters);
}

double PartFitter::good_cost() const { return 2.0 * cost_of_parameters(kPlainParameters); }

double PartFitter::deviation_at(double cost, std::size_t members, int parameters) const {
  const double exponent = (cost - cost_of_parameters(parameters)) / observations(members);
  const double resolution_m = options_.resolution_share * scene_.tolerance_m;
  return exponent > 0.0 ? resolution_m * std::sqrt(std::expm1(2.0 * exponent)) : 0.0;
}

PartFitter::Distances PartFitter::distances_of(const Superquadric& shape, const Members& members,
                                               bool flat) const {
  const auto distance = SuperquadricDistance::from(shape);
  const std::vector<Vec3> places = places_of(members, options_.measured_points);
  if (!distance || places.empty()) return {};
  const double most_m = options_.most_tolerances * scene_.tolerance_m;
  std::vector<double> distances_m;
  for (const Vec3 p : places) {
    const double to_surface_m = distance->distance_m({p});
    // A plane's points may lie anywhere in its slab.
    distances_m.push_back(std::min(flat ? std::max(to_surface_m, 0.0) : std::abs(to_surface_m), most_m));
  }
  if (flat) {
    // slab_of() leaves out up to 2 % on each side, and its corners are round.
    constexpr std::size_t kOneOf = 20;
    std::sort(distances_m.begin(), distances_m.end());
    distances_m.resize(distances_m.size() - distances_m.size() / kOneOf);
  }
  double sum = 0.0, squares = 0.0;
  for (const double d : distances_m) sum += d;
  // Edges that are rounder than the points' for want of smaller exponents are no reason for more shapes.
  if (!flat && is_box(shape)) {
    const auto shape_from_scene = shape.scene_from_shape.inverse();
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Vec3 p = (shape_from_scene * Point<SceneFrame>{places[k]}).v;
      distances_m[k] = std::min(distances_m[k], distance_to_box_m(p, shape.size_m));
    }
  }
  for (const double d : distances_m) squares += d * d;
  const auto count = static_cast<double>(distances_m.size());
  return {sum / count, std::sqrt(squares / count)};
}

void PartFitter::measure(ShapePart& part) const {
  const Distances distances = distances_of(part.fit.shape, part.members, part.flat);
  part.error_m = distances.mean_m, part.deviation_m = distances.deviation_m;
}

bool PartFitter::take(ShapePart& part, const FittedSuperquadric& fit, std::span<const Vec3> places,
                      int parameters, double most_cost) const {
  ShapePart other{part.members, part.label, fit};
  other.parameters = parameters;
  other.flat = part.flat;
  measure(other);
  // Trimming makes a shape no cheaper.
  if (!(cost(other) < most_cost) || reaches_beyond(fit.shape, places)) return false;
  const auto within = trimmed(scene_.free, fit.shape, options_.most_beyond);
  if (!within) return false;
  other.fit.shape = *within;
  measure(other);
  if (!(cost(other) < most_cost)) return false;
  part = std::move(other);
  return true;
}

std::optional<FittedSuperquadric> PartFitter::fitted(const ShapePart& part, std::span<const Vec3> places,
                                                     FitDeformation deformation, double most_cost,
                                                     const std::optional<Superquadric>& start) const {
  const double most_m = deviation_at(most_cost, part.members.size(), parameter_count(deformation));
  if (!(most_m > 0.0)) return std::nullopt;
  std::optional<FitView> view;
  if (scene_.eye) view = FitView{*scene_.eye, {}};
  const double reach_m = options_.free_reach * norm(bounds_of(places).size_m());
  const auto free =
      scene_.free.places_around(places, reach_m, static_cast<std::size_t>(options_.free_places), scene_.seed);
  FitOptions fit = options_.fit;
  fit.deformation = deformation;
  auto found = fit_superquadric(places, view, fit, free,
                                {start, most_m, options_.most_tolerances * scene_.tolerance_m});
  if (!found) return std::nullopt;
  return *std::move(found);
}

double PartFitter::without_shape(ShapePart& part, double most_cost) const {
  part.fit = {};
  part.error_m = part.deviation_m = std::numeric_limits<double>::infinity();
  part.parameters = 0;
  return std::min(most_cost, cost(part));
}

void PartFitter::fit(ShapePart& part, double most_cost) const {
  most_cost = without_shape(part, most_cost);
  const auto places = places_of(part.members, options_.fitted_points);
  if (places.size() < kFewestPartPoints) return;
  const double thick_m = thickness_m(places);
  part.flat = thick_m < options_.resolution_share * scene_.tolerance_m;
  if (!part.flat)
    if (const auto found = fitted(part, places, FitDeformation::none, most_cost)) {
      if (take(part, *found, places, kPlainParameters, most_cost)) return;
      part.plain = found->shape;
    }
  if (thick_m < scene_.tolerance_m)
    take(part, {slab_of(places, scene_.eye, options_.slab), 0.0, 1.0, 0.0}, places, kPlainParameters,
         most_cost);
}

void PartFitter::fit_near(ShapePart& part, const ShapePart& like, double most_cost) const {
  most_cost = without_shape(part, most_cost);
  const auto places = places_of(part.members, options_.fitted_points);
  const auto deformation = deformation_of(like.parameters);
  const auto found = fitted(part, places, deformation, most_cost, like.fit.shape);
  if (!found || take(part, *found, places, like.parameters, most_cost)) return;
  if (deformation == FitDeformation::none) part.plain = found->shape;
}

void PartFitter::deform(ShapePart& part, double most_cost) const {
  const auto places = places_of(part.members, options_.fitted_points);
  if (part.flat || places.size() < kFewestPartPoints) return;
  std::optional<Superquadric> plain = part.plain;
  if (part.parameters == kPlainParameters) plain = part.fit.shape;
  for (const FitDeformation deformation : {FitDeformation::taper, FitDeformation::taper_and_bend}) {
    if (static_cast<int>(deformation) > static_cast<int>(options_.fit.deformation)) return;
    const int parameters = parameter_count(deformation);
    if (parameters <= part.parameters) continue;
    most_cost = std::min(most_cost, cost(part));
    if (const auto found = fitted(part, places, deformation, most_cost, plain))
      take(part, *found, places, parameters, most_cost);
  }
}

/// Whether a shape is much longer than its points along an axis (ShapeSetOptions::most_length), except for
/// its hidden side.
bool PartFitter::reaches_beyond(const Superquadric& shape, std::span<const Vec3> places) const {
  Vec3 middle;
  for (const Vec3 p : places) middle += p / static_cast<double>(places.size());
  const Vec3 away = scene_.eye ? unit(middle - scene_.eye->v) : Vec3{};
  double across_m = 0.0;
  for (const Vec3 p : places) across_m = std::max(across_m, norm(p - middle - dot(p - middle, away) * away));
  const auto& r = shape.scene_from_shape.rotation;
  const std::array<double, 3> half_m{shape.size_m.x, shape.size_m.y, shape.size_m.z};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 axis{r[k], r[3 + k], r[6 + k]};
    double least_m = std::numeric_limits<double>::infinity(), most_m = -least_m;
    for (const Vec3 p : places) {
      least_m = std::min(least_m, dot(p, axis));
      most_m = std::max(most_m, dot(p, axis));
    }
    const double hidden_m = options_.most_hidden_length * across_m * std::abs(dot(axis, away));
    if (2.0 * half_m[k] > options_.most_length * (most_m - least_m) + hidden_m + 2.0 * scene_.tolerance_m)
      return true;
  }
  return false;
}

}  // namespace palpable::sculpt
