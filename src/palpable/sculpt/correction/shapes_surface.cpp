// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/correction/shapes_surface.hpp"

#include "palpable/models/field/superquadric_mesh.hpp"
#include "palpable/sculpt/correction/surface_correction.hpp"
#include "palpable/sculpt/solid/superquadric_source.hpp"
#include "palpable/sculpt/triangles/dual_contour.hpp"

#include <algorithm>
#include <utility>

namespace palpable::sculpt {

Result<Mesh> surface_of_shapes(const std::vector<models::Superquadric>& shapes, double spacing_m,
                               double least_thickness_spacings, const Work& work) {
  std::vector<models::Superquadric> thick = shapes;
  const double least_m = 0.5 * least_thickness_spacings * spacing_m;
  for (models::Superquadric& shape : thick)
    for (double* half : {&shape.size_m.x, &shape.size_m.y, &shape.size_m.z}) *half = std::max(*half, least_m);
  const auto source = distance_of(thick);
  if (!source) return source.error();
  constexpr double kMarginSpacings = 3.0, kSeedSpacings = 4.0;
  Box box = (*source)->bounds();
  const Vec3 margin = kMarginSpacings * spacing_m * Vec3{1, 1, 1};
  box = {box.least_m - margin, box.most_m + margin};
  std::vector<Vec3> seeds;
  for (const models::Superquadric& shape : thick)
    for (const Vec3& v : models::mesh_of(shape, kSeedSpacings * spacing_m).vertices_m) seeds.push_back(v);
  const auto solid = [&](Vec3 p) {
    DistanceSource::Hint hint;
    return (*source)->at(p, hint);
  };
  return dual_contour(solid, box, seeds, {spacing_m}, work);
}

Result<ShapesSurface> closed_surface_of_shapes(const std::vector<models::Superquadric>& shapes,
                                               double spacing_m, double least_thickness_spacings,
                                               const Work& work) {
  constexpr int kTries = 4;
  constexpr double kCoarser = 1.07;
  for (int i = 0;; ++i) {
    auto mesh = surface_of_shapes(shapes, spacing_m, least_thickness_spacings, work);
    if (!mesh) return mesh.error();
    auto surface = predicted_surface(*std::move(mesh));
    if (surface) return ShapesSurface{std::move(surface->predicted), spacing_m};
    if (i == kTries) return surface.error();
    spacing_m *= kCoarser;
  }
}

}  // namespace palpable::sculpt
