// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/shapes_recipe.hpp"

#include "palpable/recipes/solid/predicted_solid.hpp"
#include "palpable/recipes/solid/solid.hpp"
#include "palpable/sculpt/triangles/box.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace palpable::recipes {

namespace {

/// Of the finite vertices' box.
double longest_side_of(const Mesh& mesh) {
  std::optional<sculpt::Box> box;
  for (const Vec3 v : mesh.vertices_m) {
    if (!is_finite(v)) continue;
    if (!box) box = {v, v};
    box->grow(v);
  }
  const Vec3 size = box ? box->size_m() : Vec3{};
  return std::max({size.x, size.y, size.z});
}

}  // namespace

Result<SeenPoints> points_of_depth(const DepthMap& depth, const std::optional<Raster<float>>& labels) {
  const auto& metres = depth.depth_m;
  if (!depth.camera)
    return invalid_input("states no camera, which is needed to compute sizes from depth", {},
                         Reason::needs_calibration);
  if (labels && (labels->width() != metres.width() || labels->height() != metres.height()))
    return invalid_input("has another size than its labels");
  const Pinhole& camera = *depth.camera;
  SeenPoints seen;
  seen.camera = Point<SceneFrame>{};
  for (int y = 0; y < metres.height(); ++y)
    for (int x = 0; x < metres.width(); ++x) {
      const auto z = static_cast<double>(metres(x, y));
      if (!std::isfinite(z) || z <= 0.0) continue;
      const float label = labels ? (*labels)(x, y) : 1.0F;
      if (!(label >= 1.0F && label <= 255.0F)) continue;
      seen.points_m.push_back({z * (x - camera.cx) / camera.fx, -z * (y - camera.cy) / camera.fy, -z});
      if (labels) seen.labels.push_back(static_cast<std::uint8_t>(label));
    }
  return seen;
}

Result<SeenPoints> points_of_mesh(Mesh mesh, const Work& work) {
  const FieldRecipe recipe;
  // Of a size that a field has: a mesh may state any unit.
  constexpr double kLongest_m = 0.1;
  const double scale = kLongest_m / longest_side_of(mesh);
  if (!std::isfinite(scale) || scale <= 0.0) return invalid_input("is a mesh without a finite extent");
  for (Vec3& v : mesh.vertices_m) v *= scale;
  const auto solid = solid_of(std::move(mesh), recipe, work);
  if (!solid) return solid.error();
  auto surface = sampled_surface(*solid->distance, recipe.prediction.samples, work);
  if (!surface) return surface.error();
  SeenPoints seen;
  seen.points_m = std::move(surface->vertices_m);
  for (Vec3& p : seen.points_m) p *= 1.0 / scale;
  return seen;
}

Result<FittedShapes> shapes_from_points(const SeenPoints& seen, const sculpt::ShapeSetOptions& options,
                                        const Work& work) {
  auto set = sculpt::fit_superquadrics(seen.points_m, seen.labels, seen.camera, options, work);
  if (!set) return set.error();
  return FittedShapes{*std::move(set), seen.points_m.size()};
}

}  // namespace palpable::recipes
