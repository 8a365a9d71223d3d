// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/sheet_recipe.hpp"

#include "palpable/core/text/figure.hpp"
#include "palpable/recipes/solid/mesh_surface_check.hpp"
#include "palpable/recipes/solid/placement_notes.hpp"
#include "palpable/sculpt/relief/relief_shape.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace palpable::recipes {
namespace {

using sculpt::Lay;
using SceneFromInput = Transform<SceneFrame, models::InputFrame>;

/// Ramps over less of the area are not worth a word.
constexpr double kLeastRampShare = 0.005;

/// Removes triangles with a vertex that is not finite; returns their number.
std::size_t drop_unplaced(Mesh& mesh) {
  return std::erase_if(mesh.triangles, [&](const auto& t) {
    return std::any_of(t.begin(), t.end(), [&](std::uint32_t v) {
      return v >= mesh.vertices_m.size() || !is_finite(mesh.vertices_m[v]);
    });
  });
}

/// The direction that points to the user.
AxisDirection towards_person(const Mesh& mesh, const sculpt::Placement& automatic,
                             const SheetRecipe& recipe) {
  const sculpt::PlacementOptions& options = recipe.placement;
  const AxisDirection up = options.up.value_or(options.convention.up);
  const Vec3 facing = sculpt::mean_facing(mesh);
  const bool one_way = norm(facing) > recipe.sheet.faces_one_way;
  if (options.lay == Lay::automatic && one_way) {
    const AxisDirection side = nearest_axis_direction(facing);
    // A map with reversed triangles is still seen from above.
    return dot(unit_vector(side), unit_vector(up)) != 0.0 ? up : side;
  }
  return automatic.lay == Lay::flat ? up : sculpt::front_of(up);
}

}  // namespace

Result<MadeScene> relief_from_mesh(Mesh mesh, const SheetRecipe& recipe, const Work& work) {
  const std::size_t unplaced = drop_unplaced(mesh);
  if (mesh.triangles.empty()) return invalid_input("is a mesh without a finite triangle");
  if (auto has_surface = check_surface(mesh); !has_surface) return std::move(has_surface).error();
  const sculpt::Box box = sculpt::bounds_of(mesh);
  sculpt::PlacementOptions fit = recipe.placement;
  if (!fit.size_m) fit.size_m = sculpt::kDefaultReliefSize_m;
  auto placement = sculpt::placement_of(box, fit);
  if (!placement) return placement.error();
  const AxisDirection towards = towards_person(mesh, *placement, recipe);
  placement->lay = dot(unit_vector(towards), unit_vector(placement->up)) != 0.0 ? Lay::flat : Lay::upright;
  const auto rotation = sculpt::turn_towards_person(towards, placement->up);
  const double room_m = fit.size_m->z - recipe.sheet.thickness_m;
  if (!(room_m > 0.0))
    return Error{ErrorCode::usage, "the size's depth must be more than the sheet's thickness", {}};
  const Vec3 seen = sculpt::turned(box, rotation).size_m();
  const bool own_size =
      !recipe.placement.size_m && sculpt::suits_a_hand({seen.x, seen.y, 0.0}, recipe.placement);
  // What the person sees of it fills the size; a mesh that is then too deep is flattened, as depth maps are.
  constexpr double kAnyDepth_m = std::numeric_limits<double>::infinity();
  const Vec3 face_m{fit.size_m->x, fit.size_m->y, kAnyDepth_m};
  placement->scene_from_input = sculpt::fitted(box, rotation, own_size ? seen : face_m);
  SceneFromInput& scene_from_input = placement->scene_from_input;
  const double depth_m = scene_from_input.scale * seen.z;
  const double flattening = own_size ? 1.0 : std::max(1.0, depth_m / room_m);
  for (Vec3& v : mesh.vertices_m) {
    v = (scene_from_input * Point<models::InputFrame>{v}).v;
    v.z /= flattening;
  }
  sculpt::SheetRamps ramps;
  auto relief = sculpt::relief_from_sheet(mesh, recipe.sheet, work, &ramps);
  if (!relief) return relief.error();
  scene_from_input.translation_m.z += recipe.sheet.thickness_m;
  MadeScene made;
  made.notes = placement_notes(*placement, box, recipe.placement);
  // Less is not felt, and would be said as "divided by 1".
  constexpr double kFelt = 1.05;
  if (flattening > kFelt)
    made.notes.emplace_back(
        fmt::format("The mesh is deeper than the relief may be high: its heights were divided by {}.",
                    figure(flattening, 2)));
  if (unplaced > 0)
    made.notes.emplace_back(
        fmt::format("{} of the mesh's triangles, with a vertex that is not a finite number, {} left out.",
                    unplaced, unplaced == 1 ? "was" : "were"));
  if (ramps.share > kLeastRampShare)
    warn(made,
         fmt::format("The mesh is too steep for a relief in {} % of its area: walls became ramps there, "
                     "up to {} mm higher or lower than the mesh.",
                     figure(100.0 * ramps.share, 2), figure(1e3 * ramps.most_m, 2)));
  made.scene.scene_from_input = scene_from_input;
  made.scene.source.method =
      fmt::format("relief of mesh from {}, {} samples", name_of(towards), recipe.sheet.samples_on_a_side);
  made.scene.model = std::make_shared<const models::Relief>(*std::move(relief));
  return made;
}

}  // namespace palpable::recipes
