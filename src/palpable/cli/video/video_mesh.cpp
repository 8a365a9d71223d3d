// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/video/video_mesh.hpp"

#include "palpable/formats/mesh/glb.hpp"
#include "palpable/recipes/video/video_texture.hpp"
#include "palpable/sculpt/field/field_surface.hpp"

#include <variant>

namespace palpable::cli {
namespace {

Result<Mesh> surface_of(const models::Scene& scene, const Work& work) {
  // One cube for two finest cells.
  constexpr double kCells = 2.0;
  if (const auto* field = std::get_if<std::shared_ptr<const models::Field>>(&scene.model))
    return sculpt::surface_of_field((*field)->distance, kCells * (*field)->distance.cell_m(), work);
  if (const auto* field = std::get_if<std::shared_ptr<const models::FieldOnLattice>>(&scene.model))
    return sculpt::surface_of_field((*field)->distance, kCells * (*field)->distance.cell_m(), work);
  return Error{ErrorCode::failed, "the scene has no surface to write", {}};
}

}  // namespace

Result<std::vector<std::byte>> video_glb(const recipes::VideoReconstruction& video,
                                         const models::Scene& scene, const Work& work) {
  const auto mesh = surface_of(scene, work);
  if (!mesh) return mesh.error();
  const recipes::TexturedMesh textured = recipes::textured(*mesh, video, {});
  return formats::encode_glb(textured.mesh, textured.picture, {}, textured.normals);
}

}  // namespace palpable::cli
