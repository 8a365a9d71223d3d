// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/solid.hpp"

#include "palpable/core/system/memory.hpp"
#include "palpable/core/text/figure.hpp"
#include "palpable/recipes/solid/mesh_surface_check.hpp"
#include "palpable/recipes/solid/placement_notes.hpp"
#include "palpable/sculpt/solid/mesh_solid.hpp"
#include "palpable/sculpt/solid/superquadric_source.hpp"
#include "palpable/sculpt/triangles/mesh_orientation.hpp"
#include "palpable/sculpt/triangles/visible_places.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace palpable::recipes {
namespace {

/// The bounding box of the finite vertices of triangles.
Result<sculpt::Box> box_of(const Mesh& mesh) {
  std::optional<sculpt::Box> box;
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t index : t) {
      if (index >= mesh.vertices_m.size() || !is_finite(mesh.vertices_m[index])) continue;
      if (!box) box = {mesh.vertices_m[index], mesh.vertices_m[index]};
      box->grow(mesh.vertices_m[index]);
    }
  if (!box) return invalid_input("is a mesh without a finite triangle");
  return *box;
}

struct Placed {
  SceneFromInput scene_from_input;
  models::SolidPose pose = models::SolidPose::upright;
  std::vector<Note> notes;
};

models::SolidPose pose_of(const sculpt::Placement& placement) {
  return placement.lay == sculpt::Lay::flat ? models::SolidPose::flat : models::SolidPose::upright;
}

/// Transforms a mesh into the scene.
Result<Placed> place_mesh(Mesh& mesh, const sculpt::PlacementOptions& options) {
  const auto box = box_of(mesh);
  if (!box) return box.error();
  if (auto has_surface = check_surface(mesh); !has_surface) return std::move(has_surface).error();
  const AxisDirection up = options.up.value_or(options.convention.up);
  const auto placement = sculpt::placement_of(*box, options, sculpt::level_share(mesh, up));
  if (!placement) return placement.error();
  const SceneFromInput& transform = placement->scene_from_input;
  const double step = coordinate_step(mesh);
  if (placement->fitted)
    for (Vec3& v : mesh.vertices_m) v = (transform * Point<models::InputFrame>{v}).v;
  auto notes = placement_notes(*placement, *box, options);
  for (Note& note : rounding_notes(*box, step)) notes.push_back(std::move(note));
  return Placed{transform, pose_of(*placement), std::move(notes)};
}

/// Refuses a field that is too large by its extent alone, before any other work.
Result<void> check_size(const sculpt::Box& box, const FieldRecipe& recipe) {
  if (recipe.storage == FieldStorage::adaptive) return {};
  const auto lattice = sculpt::lattice_around(box, dense_options(recipe));
  if (!lattice) return lattice.error();
  return {};
}

/// What is seen only through gaps narrower than four cells is not counted.
std::vector<Vec3> visible_places_of(const Mesh& mesh, double cell_m, const Work& work) {
  std::size_t omitted = 0;
  const Mesh clean = sculpt::welded(mesh, omitted);
  if (clean.triangles.empty()) return {};
  constexpr double kBesideCells = 2.0;
  return sculpt::visible_places(sculpt::TriangleTree(clean), {.beside_m = kBesideCells * cell_m}, work.seed);
}

/// Refuses shapes of which none would be felt, and adds a note on single ones: between the corners of cells a
/// field knows nothing of them.
Result<void> check_thickness(const std::vector<models::Superquadric>& shapes, double cell_m,
                             std::vector<Note>& notes) {
  const double least_m = 0.5 * cell_m;
  const auto thin = std::count_if(shapes.begin(), shapes.end(), [least_m](const models::Superquadric& shape) {
    return 2.0 * std::min({shape.size_m.x, shape.size_m.y, shape.size_m.z}) < least_m;
  });
  if (thin == 0) return {};
  const std::string why =
      fmt::format("thinner than half a cell of the field, {} mm", figure(1000.0 * least_m));
  if (thin == std::ssize(shapes))
    return invalid_input("holds only shapes that are " + why + ": none of them would be felt");
  notes.emplace_back(fmt::format("{} of {} shapes are {}, and may not be felt. More cells hold them.", thin,
                                 shapes.size(), why));
  return {};
}

/// States the greatest error too: in a badly repaired mesh a few places may be far off although 99 % are
/// not.
std::string note_on(const models::FieldErrors& errors) {
  return fmt::format(
      "The field's measured error near the surface is at most {:.0f} um; 99 % of it is below {:.1f} um.",
      1e6 * errors.max_m, 1e6 * errors.p99_m);
}

/// How far the input's visible places are from a field's surface.
struct InputErrors {
  std::size_t places = 0;
  double p99_m = 0.0, max_m = 0.0;
  /// Places more than two cells outside and inside the field's solid, and the farthest of each.
  std::size_t lost = 0, closed = 0;
  double lost_m = 0.0, closed_m = 0.0;
};

template <class Distance>
InputErrors input_errors(const Distance& field, const std::vector<Vec3>& visible_m) {
  InputErrors errors;
  errors.places = visible_m.size();
  if (visible_m.empty()) return errors;
  // Thickened walls reach one cell beyond sheets, and a field rounds edges within half of one.
  constexpr double kFarCells = 2.0;
  const double far_m = kFarCells * field.cell_m();
  std::vector<double> distances_m;
  for (const Vec3 place : visible_m) {
    const double felt_m = field.sample({place}).distance_m;
    distances_m.push_back(std::abs(felt_m));
    if (felt_m > far_m) ++errors.lost, errors.lost_m = std::max(errors.lost_m, felt_m);
    if (felt_m < -far_m) ++errors.closed, errors.closed_m = std::max(errors.closed_m, -felt_m);
  }
  std::sort(distances_m.begin(), distances_m.end());
  errors.p99_m = distances_m[distances_m.size() * 99 / 100];
  errors.max_m = distances_m.back();
  return errors;
}

/// For the scene's description; empty if the input is no mesh.
std::string method_on(const InputErrors& errors) {
  if (errors.places == 0) return {};
  return fmt::format(", the input's visible surface within {:.0f} um (99 %), {:.0f} um at most",
                     1e6 * errors.p99_m, 1e6 * errors.max_m);
}

std::vector<Note> notes_on(const InputErrors& errors) {
  std::vector<Note> notes;
  if (errors.places == 0) return notes;
  notes.emplace_back(
      fmt::format("Of {} places of the input that are visible from outside, 99 % are within {:.0f} um of the "
                  "field's surface; the farthest is {:.0f} um from it.",
                  errors.places, 1e6 * errors.p99_m, 1e6 * errors.max_m));
  const auto percent = [&](std::size_t count) {
    return 100.0 * static_cast<double>(count) / static_cast<double>(errors.places);
  };
  if (errors.lost > 0)
    notes.emplace_back(fmt::format(
        "Part of the input's surface was lost: {:.2g} % of its visible places lie outside the solid, up to "
        "{:.2g} mm from its surface.",
        percent(errors.lost), 1e3 * errors.lost_m));
  if (errors.closed > 0)
    notes.emplace_back(fmt::format(
        "Openings of the input were closed: {:.2g} % of its visible places lie inside the solid, up to "
        "{:.2g} mm below its surface.",
        percent(errors.closed), 1e3 * errors.closed_m));
  return notes;
}

template <class Distance>
Result<models::Model> model_of(Distance distance, const Solid& solid) {
  const sculpt::Box surface = solid.distance->bounds();
  auto field = models::field_of(std::move(distance), surface.least_m, surface.most_m);
  if (!field) return field.error();
  field->primitives = solid.primitives;
  return models::Model(std::make_shared<const models::SolidField<Distance>>(*std::move(field)));
}

Result<StoredField> stored_densely(const Solid& solid, const FieldRecipe& recipe, const Work& work) {
  auto distance = sculpt::dense_field_from_source(*solid.distance, dense_options(recipe), work);
  if (!distance) return distance.error();
  const InputErrors of_input = input_errors(*distance, solid.visible_m);
  auto model = model_of(*std::move(distance), solid);
  if (!model) return model.error();
  const bool paper = recipe.storage == FieldStorage::paper;
  return StoredField{*std::move(model),
                     fmt::format("{} cells, dense{}{}", recipe.field.resolution,
                                 paper ? ", distance and force by fast marching" : "", method_on(of_input)),
                     notes_on(of_input)};
}

}  // namespace

models::Superquadric placed_in_scene(models::Superquadric shape, const SceneFromInput& transform) {
  auto& scene_from_shape = shape.scene_from_shape;
  const Transform<SceneFrame, SceneFrame> turned{transform.rotation, {}, 1.0};
  const Vec3 at_m = (transform * Point<models::InputFrame>{scene_from_shape.translation_m}).v;
  scene_from_shape = turned * scene_from_shape;
  scene_from_shape.translation_m = at_m;
  shape.size_m *= transform.scale;
  shape.bend_per_m /= transform.scale;
  return shape;
}

sculpt::DenseFieldOptions dense_options(const FieldRecipe& recipe) {
  sculpt::DenseFieldOptions dense;
  if (recipe.storage == FieldStorage::paper) dense.content = models::DenseContent::distance_and_force;
  dense.resolution = recipe.field.resolution;
  dense.margin_m = recipe.field.margin_m;
  // With its packed members and the file's bytes it takes 1.9 to 2.5 times its size.
  constexpr std::size_t kWhileMaking = 3;
  if (const auto free_bytes = available_memory_bytes())
    dense.most_bytes = std::min(dense.most_bytes, *free_bytes / kWhileMaking);
  return dense;
}

Result<void> enclose(Solid& solid, const Mesh& mesh, double cell_m, const FieldRecipe& recipe,
                     const Work& work) {
  // Dense fields, which are for comparison, keep the triangles unchanged.
  sculpt::FacetOptions facets;
  sculpt::WallOptions walls = sculpt::kWallsAsTheyAre;
  if (recipe.storage == FieldStorage::adaptive) {
    facets.rounding_m = sculpt::facet_rounding_m(*box_of(mesh), recipe.field);
    walls = recipe.walls;
  }
  walls.up = solid.pose == models::SolidPose::flat ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
  auto made = sculpt::solid_from_mesh(mesh, cell_m, work, facets, walls, recipe.sheets);
  if (!made) return made.error();
  solid.distance = std::move(made->distance);
  const auto notes = made->repair.notes();
  solid.notes.insert(solid.notes.end(), notes.begin(), notes.end());
  return {};
}

Result<Solid> solid_of(Mesh mesh, const FieldRecipe& recipe, const Work& work) {
  auto place = place_mesh(mesh, recipe.placement);
  if (!place) return place.error();
  Solid solid;
  solid.scene_from_input = place->scene_from_input;
  solid.pose = place->pose;
  solid.notes = std::move(place->notes);
  const auto box = box_of(mesh);
  if (!box) return box.error();
  if (const auto fits = check_size(*box, recipe); !fits) return fits.error();
  const auto cell_m = sculpt::finest_cell_m(*box, recipe.field);
  if (!cell_m) return cell_m.error();
  if (const auto free_bytes = available_memory_bytes())
    if (auto refused = sculpt::mesh_too_large(mesh.triangles.size(), *free_bytes)) return *std::move(refused);
  solid.visible_m = visible_places_of(mesh, *cell_m, work);
  if (auto done = enclose(solid, mesh, *cell_m, recipe, work); !done) return std::move(done).error();
  return solid;
}

Result<Solid> solid_of(std::vector<models::Superquadric> shapes, const FieldRecipe& recipe) {
  auto distance = sculpt::distance_of(shapes);
  if (!distance) return distance.error();
  Solid solid;
  const sculpt::Box box = (*distance)->bounds();
  const auto placement = sculpt::placement_of(box, recipe.placement);
  if (!placement) return placement.error();
  solid.notes = placement_notes(*placement, box, recipe.placement);
  solid.pose = pose_of(*placement);
  if (placement->fitted) {
    solid.scene_from_input = placement->scene_from_input;
    for (models::Superquadric& shape : shapes) shape = placed_in_scene(shape, solid.scene_from_input);
    distance = sculpt::distance_of(shapes);
    if (!distance) return distance.error();
  }
  const auto cell_m = sculpt::finest_cell_m((*distance)->bounds(), recipe.field);
  if (!cell_m) return cell_m.error();
  if (auto felt = check_thickness(shapes, *cell_m, solid.notes); !felt) return std::move(felt).error();
  solid.distance = std::move(*distance);
  solid.primitives = std::move(shapes);
  return solid;
}

Result<Solid> solid_of_contour(Mesh surface, double exact_to_m, const FieldRecipe& recipe) {
  auto place = place_mesh(surface, recipe.placement);
  if (!place) return place.error();
  const auto box = box_of(surface);
  if (!box) return box.error();
  if (const auto fits = check_size(*box, recipe); !fits) return fits.error();
  auto distance = sculpt::solid_from_contour(surface);
  if (!distance) return distance.error();
  Solid solid;
  solid.distance = std::move(*distance);
  solid.exact_to_m = place->scene_from_input.scale * exact_to_m;
  solid.scene_from_input = place->scene_from_input;
  solid.pose = place->pose;
  solid.notes = std::move(place->notes);
  return solid;
}

Result<StoredField> stored_field(const Solid& solid, const FieldRecipe& recipe, const Work& work) {
  if (recipe.storage != FieldStorage::adaptive) return stored_densely(solid, recipe, work);
  sculpt::FieldOptions field_options = recipe.field;
  if (field_options.max_error_m == 0.0 && solid.exact_to_m > 0.0)
    field_options.max_error_m = solid.exact_to_m;
  // Parts, tree and the hash table of leaves exist at the same time.
  constexpr std::size_t kWhileBuilding = 4;
  if (const auto free_bytes = available_memory_bytes())
    field_options.most_bytes = std::min(field_options.most_bytes, *free_bytes / kWhileBuilding);
  auto distance = sculpt::field_from_source(*solid.distance, field_options, work);
  if (!distance) return distance.error();
  const models::FieldErrors errors = distance->errors();
  const InputErrors of_input = input_errors(*distance, solid.visible_m);
  auto model = model_of(*std::move(distance), solid);
  if (!model) return model.error();
  std::vector<Note> notes{note_on(errors)};
  for (Note& note : notes_on(of_input)) notes.push_back(std::move(note));
  return StoredField{*std::move(model),
                     fmt::format("{} cells, error bound {:.1f} um{}", field_options.resolution,
                                 1e6 * errors.bound_m, method_on(of_input)),
                     std::move(notes)};
}

}  // namespace palpable::recipes
