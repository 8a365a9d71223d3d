// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/field/field_surface.hpp"

#include "palpable/sculpt/triangles/dual_contour.hpp"

#include <cmath>
#include <vector>

namespace palpable::sculpt {
namespace {

/// A point on the surface in every block that may contain some: from its centre along the gradient.
template <models::DistanceSurface Distance>
std::vector<Vec3> seeds_of(const Distance& field, double block_m) {
  const Vec3 size = field.size_m();
  const auto count = [&](double extent) { return static_cast<int>(std::ceil(extent / block_m)); };
  std::vector<Vec3> seeds;
  for (int z = 0; z < count(size.z); ++z)
    for (int y = 0; y < count(size.y); ++y)
      for (int x = 0; x < count(size.x); ++x) {
        Vec3 p = field.origin_m() + block_m * Vec3{x + 0.5, y + 0.5, z + 0.5};
        models::FieldSample s = field.sample({p});
        // Half a cube's diagonal.
        if (std::abs(s.distance_m) > 0.87 * block_m) continue;
        constexpr int kSteps = 4;
        for (int step = 0; step < kSteps; ++step) {
          p -= s.distance_m * unit(s.gradient.v);
          s = field.sample({p});
        }
        seeds.push_back(p);
      }
  return seeds;
}

template <models::DistanceSurface Distance>
Result<Mesh> surface_of(const Distance& field, double spacing_m, const Work& work) {
  const auto seeds = seeds_of(field, 3.0 * spacing_m);
  const auto solid = [&](Vec3 p) {
    const models::FieldSample s = field.sample({p});
    return models::DistanceSample{s.distance_m, s.gradient.v};
  };
  auto mesh =
      dual_contour(solid, {field.origin_m(), field.origin_m() + field.size_m()}, seeds, {spacing_m}, work);
  if (mesh && mesh->triangles.empty())
    return Error{ErrorCode::failed, "the field has no surface inside its box", {}};
  return mesh;
}

}  // namespace

Result<Mesh> surface_of_field(const models::DistanceField& field, double spacing_m, const Work& work) {
  return surface_of(field, spacing_m, work);
}

Result<Mesh> surface_of_field(const models::DenseField& field, double spacing_m, const Work& work) {
  return surface_of(field, spacing_m, work);
}

}  // namespace palpable::sculpt
