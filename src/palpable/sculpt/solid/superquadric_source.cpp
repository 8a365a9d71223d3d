// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/solid/superquadric_source.hpp"

#include "palpable/models/field/superquadric_distance.hpp"
#include "palpable/models/field/superquadric_mesh.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace palpable::sculpt {
namespace {

class SuperquadricUnion final : public DistanceSource {
 public:
  SuperquadricUnion(std::vector<models::SuperquadricDistance> shapes, const Box& bounds)
      : shapes_(std::move(shapes)), bounds_(bounds) {}

  models::DistanceSample at(Vec3 p, Hint& /*hint*/) const override {
    const models::ClosestPoint near = models::closest_point(shapes_, {p});
    const Vec3 way = p - near.surface.v;
    const double length = norm(way);
    // On the surface itself the direction to the nearest point is undefined.
    constexpr double kTouching_m = 1e-9;
    if (length < kTouching_m) return {near.distance_m, near.normal.v};
    return {near.distance_m, (near.distance_m < 0.0 ? -1.0 / length : 1.0 / length) * way};
  }
  Box bounds() const override { return bounds_; }

 private:
  std::vector<models::SuperquadricDistance> shapes_;
  Box bounds_;
};

}  // namespace

Result<std::unique_ptr<DistanceSource>> distance_of(std::span<const models::Superquadric> shapes) {
  if (shapes.empty()) return invalid_input("there is no superquadric");
  std::vector<models::SuperquadricDistance> distances;
  Box bounds;
  for (const models::Superquadric& shape : shapes) {
    auto distance = models::SuperquadricDistance::from(shape);
    if (!distance) return distance.error();
    // Its mesh touches the surface from inside, so the box is a little too small.
    const double spacing_m = 0.02 * std::max({shape.size_m.x, shape.size_m.y, shape.size_m.z});
    Box box = bounds_of(models::mesh_of(shape, spacing_m));
    box.grow(box.least_m - 0.1 * Vec3{spacing_m, spacing_m, spacing_m});
    box.grow(box.most_m + 0.1 * Vec3{spacing_m, spacing_m, spacing_m});
    if (distances.empty()) bounds = box;
    bounds.grow(box.least_m);
    bounds.grow(box.most_m);
    distances.push_back(std::move(*distance));
  }
  return std::unique_ptr<DistanceSource>(std::make_unique<SuperquadricUnion>(std::move(distances), bounds));
}

}  // namespace palpable::sculpt
