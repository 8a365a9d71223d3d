// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/predicted_solid.hpp"

#include "palpable/recipes/solid/surface_distances.hpp"
#include "palpable/sculpt/correction/shapes_surface.hpp"
#include "palpable/sculpt/solid/superquadric_source.hpp"
#include "palpable/sculpt/superquadric/point_parts.hpp"
#include "palpable/sculpt/triangles/dual_contour.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace palpable::recipes {
namespace {

using sculpt::DistanceSource;

double longest_side_m(const sculpt::Box& box) {
  const Vec3 size = box.size_m();
  return std::max({size.x, size.y, size.z});
}

constexpr int kMostShapes = 256;

/// The middles of cubes that fill a box, with sides of about `side_m`.
std::vector<Vec3> lattice_in(const sculpt::Box& box, double side_m) {
  const Vec3 size = box.size_m();
  const auto count = [side_m](double length_m) {
    return std::max(1, static_cast<int>(std::lround(length_m / side_m)));
  };
  const int nx = count(size.x), ny = count(size.y), nz = count(size.z);
  std::vector<Vec3> places;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        places.push_back(box.least_m +
                         Vec3{size.x * (x + 0.5) / nx, size.y * (y + 0.5) / ny, size.z * (z + 0.5) / nz});
  return places;
}

/// Places on the surface of a solid: those nearest to a lattice in its box.
std::vector<Vec3> places_on(const DistanceSource& solid, const sculpt::Box& box) {
  constexpr double kAlongSide = 24.0;
  std::vector<Vec3> places = lattice_in(box, longest_side_m(box) / kAlongSide);
  DistanceSource::Hint hint;
  for (Vec3& at : places) {
    const models::DistanceSample sample = solid.at(at, hint);
    at -= sample.distance_m * sample.gradient;
  }
  return places;
}

/// Evenly chosen places, at most `most`.
std::vector<Vec3> some_of(const std::vector<Vec3>& places, int most) {
  std::vector<Vec3> some;
  for (const std::uint32_t i : sculpt::thinned(places, static_cast<std::size_t>(most)))
    some.push_back(places[i]);
  return some;
}

class Predictor {
 public:
  Predictor(const PredictionOptions& options, double extent_m, Mesh measured, const Work& work)
      : options_(options),
        extent_m_(extent_m),
        spacing_m_(extent_m / options.samples),
        measured_(std::move(measured)),
        evidence_(some_of(measured_.vertices_m, options.error_points)),
        work_(work) {}

  /// Shapes of all points, and of those that are far from these.
  Result<void> fit() {
    auto set = sculpt::fit_superquadrics(measured_.vertices_m, {}, std::nullopt, options_.shapes, work_);
    if (!set) return set.error();
    for (const auto& fit : set->shapes) out_.shapes.push_back(fit.shape);
    const std::vector<Vec3> points = some_of(measured_.vertices_m, options_.shapes.used_points);
    auto distances = distances_from(points, out_.shapes, work_);
    if (!distances) return distances.error();
    std::vector<Vec3> rest;
    for (std::size_t i = 0; i < points.size(); ++i)
      if ((*distances)[i] > options_.rest_share * extent_m_) rest.push_back(points[i]);
    if (static_cast<double>(rest.size()) < options_.least_rest * static_cast<double>(points.size()))
      return {};
    set = sculpt::fit_superquadrics(rest, {}, std::nullopt, options_.shapes, work_);
    // Scattered points may fit nothing.
    if (!set) return set.error().code == ErrorCode::interrupted ? set.error() : Result<void>();
    for (const auto& fit : set->shapes) out_.shapes.push_back(fit.shape);
    return {};
  }

  /// Balls where no shape is within the solid, the largest first.
  Result<void> fill(const DistanceSource& solid) {
    const auto shapes = sculpt::distance_of(out_.shapes);
    if (!shapes) return shapes.error();
    struct Place {
      Vec3 at_m;
      double deep_m = 0.0, apart_m = 0.0;
    };
    std::vector<Place> hollow;
    const double least_m = options_.least_inner * extent_m_;
    DistanceSource::Hint of_solid, of_shapes;
    for (const Vec3 at : lattice_in(solid.bounds(), extent_m_ / options_.inner_places)) {
      const double deep_m = -solid.at(at, of_solid).distance_m;
      if (deep_m < least_m) continue;
      const double apart_m = (*shapes)->at(at, of_shapes).distance_m;
      if (apart_m > least_m) hollow.push_back({at, deep_m, apart_m});
    }
    while (!hollow.empty() && out_.shapes.size() < static_cast<std::size_t>(kMostShapes)) {
      const Place deepest = *std::max_element(
          hollow.begin(), hollow.end(), [](const Place& a, const Place& b) { return a.deep_m < b.deep_m; });
      models::Superquadric ball;
      ball.size_m = deepest.deep_m * Vec3{1, 1, 1};
      ball.scene_from_shape.translation_m = deepest.at_m;
      out_.shapes.push_back(ball);
      for (Place& p : hollow) p.apart_m = std::min(p.apart_m, norm(p.at_m - deepest.at_m) - deepest.deep_m);
      std::erase_if(hollow, [least_m](const Place& p) { return p.apart_m <= least_m; });
    }
    return {};
  }

  Result<void> correct() {
    auto distances = distances_from(evidence_, out_.shapes, work_);
    if (!distances) return distances.error();
    out_.predicted_error_m = out_.corrected_error_m = mean_distance(*distances, extent_m_);
    if (options_.passes == 0) return {};
    auto samples =
        sculpt::closed_surface_of_shapes(out_.shapes, spacing_m_, options_.least_thickness_spacings, work_);
    if (!samples) return samples.error();
    Mesh surface = std::move(samples->mesh);
    double error_m = error_of(surface);
    for (int pass = 0; pass < options_.passes; ++pass) {
      work_.report(static_cast<double>(pass) / options_.passes, "correcting the surface");
      auto next = corrected(surface, samples->spacing_m);
      if (!next) return next.error();
      const double next_error_m = error_of(*next);
      if (!(next_error_m < error_m)) break;
      const bool little = next_error_m > (1.0 - options_.least_gain) * error_m;
      surface = *std::move(next), error_m = next_error_m;
      if (little) break;
    }
    if (!(error_m < out_.predicted_error_m)) return {};
    out_.surface = std::move(surface), out_.corrected_error_m = error_m;
    out_.spacing_m = samples->spacing_m;
    return {};
  }

  PredictedSolid take() { return std::move(out_); }

 private:
  /// The next pass starts from this one's result, whose normals are better, so it reaches what this did not.
  Result<Mesh> corrected(const Mesh& surface, double spacing_m) const {
    auto samples = sculpt::predicted_surface(surface);
    if (!samples) return samples.error();
    sculpt::CorrectionOptions correction = options_.correction;
    set_reach(options_.reach, distances_from(evidence_, surface, work_), spacing_m, extent_m_, correction);
    auto after = sculpt::correct_surface(*std::move(samples), measured_, correction, work_);
    if (!after) return after.error();
    return after->adapted();
  }
  double error_of(const Mesh& surface) const {
    return mean_distance(distances_from(evidence_, surface, work_), extent_m_);
  }

  const PredictionOptions& options_;
  double extent_m_, spacing_m_;
  Mesh measured_;
  std::vector<Vec3> evidence_;
  const Work& work_;
  PredictedSolid out_;
};

}  // namespace

Result<Mesh> sampled_surface(const DistanceSource& solid, int samples, const Work& work) {
  constexpr double kMarginSpacings = 3.0;
  const sculpt::Box box = solid.bounds();
  const double spacing_m = longest_side_m(box) / samples;
  const Vec3 margin = kMarginSpacings * spacing_m * Vec3{1, 1, 1};
  work.report(0.0, "sampling the surface");
  auto surface = sculpt::dual_contour(
      [&](Vec3 p) {
        DistanceSource::Hint hint;
        return solid.at(p, hint);
      },
      {box.least_m - margin, box.most_m + margin}, places_on(solid, box), {spacing_m}, work);
  if (surface && surface->triangles.empty()) return invalid_input("is too thin for samples of its surface");
  return surface;
}

std::vector<Parameter> parameters_of(PredictionOptions& o) {
  std::vector<Parameter> parameters{
      {"samples", &o.samples, {32, 1024}, "", "samples along the longest side"},
      {"error_points", &o.error_points, {100, 1e6}, "", "points that errors are measured at, at most"},
      {"rest_share",
       &o.rest_share,
       {0.001, 0.5},
       "",
       "distance of points to which further shapes are fitted, share of the longest side"},
      {"least_rest", &o.least_rest, {0, 1}, "", "least share of such points"},
      {"inner_places", &o.inner_places, {4, 64}, "", "places along the longest side that must be covered"},
      {"least_inner",
       &o.least_inner,
       {0.001, 0.5},
       "",
       "their distance from the surface and from shapes, share of the longest side"},
      {"passes", &o.passes, {0, 20}, "", "most passes of the correction"},
      {"least_gain", &o.least_gain, {0, 1}, "", "gain of a pass below which it is the last"},
      {"least_thickness_spacings",
       &o.least_thickness_spacings,
       {1, 10},
       "",
       "least thickness of shapes whose surface is sampled, spacings of samples"}};
  const auto reach = parameters_of(o.reach);
  parameters.insert(parameters.end(), reach.begin(), reach.end());
  append_parameters(parameters, "correction", without_reach(sculpt::parameters_of(o.correction)));
  append_parameters(parameters, "shapes", sculpt::parameters_of(o.shapes));
  return parameters;
}

Result<PredictedSolid> predicted_solid(const DistanceSource& solid, const PredictionOptions& options,
                                       const Work& work) {
  PredictionOptions checked = options;
  if (const auto valid = check_ranges(checked); !valid) return valid.error();
  auto measured = sampled_surface(solid, options.samples, work);
  if (!measured) return measured.error();
  Predictor predictor(checked, longest_side_m(solid.bounds()), *std::move(measured), work);
  if (auto done = predictor.fit(); !done) return done.error();
  if (auto done = predictor.fill(solid); !done) return done.error();
  if (auto done = predictor.correct(); !done) return done.error();
  return predictor.take();
}

}  // namespace palpable::recipes
