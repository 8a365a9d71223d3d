// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/scene_hash.hpp"

#include "palpable/core/files/fnv1a.hpp"
#include "palpable/formats/scene/field_streams.hpp"

#include <bit>
#include <cmath>
#include <string_view>

namespace palpable::session {
namespace {

template <class T>
void add_raster(Fnv1a& hash, const Raster<T>& raster) {
  hash.add(static_cast<std::uint32_t>(raster.width()));
  hash.add(static_cast<std::uint32_t>(raster.height()));
  for (const T value : raster.values()) hash.add(value);
}

void add_model(Fnv1a& hash, const std::shared_ptr<const models::Relief>& relief) {
  hash.add(relief->pixel_m());
  add_raster(hash, relief->samples_m());
}

void add_model(Fnv1a& hash, const std::shared_ptr<const models::Contours>& contours) {
  hash.add(contours->boundaries.pixel_m());
  hash.add(contours->boundaries.radius_px());
  for (const models::BoundaryPixel& p : contours->boundaries.edges().values()) {
    hash.add(p.c2);
    hash.add(p.s2);
  }
  add_model(hash, contours->grooves);
}

void add_model(Fnv1a& hash, const std::shared_ptr<const models::Field>& field) {
  const models::FieldGrid& grid = field->distance.grid();
  for (const double v : {grid.origin_m.x, grid.origin_m.y, grid.origin_m.z, grid.cell_m}) hash.add(v);
  // The order of nodes in memory depends on how the tree was built. A scene file gives them an order of its
  // own, so the same field has one hash before it is saved and after.
  const auto stored = formats::tree_from(grid, formats::streams_of(grid, field->distance.tree()));
  const models::FieldTree& tree = stored ? *stored : field->distance.tree();
  for (const auto* part : {&tree.roots, &tree.nodes, &tree.words})
    for (const std::uint32_t word : *part) hash.add(word);
}

void add_model(Fnv1a& hash, const std::shared_ptr<const models::FieldOnLattice>& field) {
  const models::Lattice& lattice = field->distance.lattice();
  for (const double v : {lattice.origin_m.x, lattice.origin_m.y, lattice.origin_m.z, lattice.spacing_m})
    hash.add(v);
  for (const int count : lattice.counts) hash.add(static_cast<std::uint32_t>(count));
  for (const float value : field->distance.values()) hash.add(std::bit_cast<std::uint32_t>(value));
}

void add_model(Fnv1a& hash, const std::shared_ptr<const models::Grid>& grid) {
  const models::Occupancy o = grid->occupancy.occupancy();
  for (const double v : {o.origin_m.x, o.origin_m.y, o.origin_m.z, o.spacing_m}) hash.add(v);
  for (const std::uint8_t on : o.occupied) hash.add(std::uint32_t{on});
}

/// Without a texture nothing is added, so that hashes from before textures stay valid.
void add_texture(Fnv1a& hash, const models::TouchTexture& texture) {
  if (texture.kind == models::TouchTexture::Kind::none) return;
  hash.add(models::name_of(texture.kind));
  for (const double v : {texture.pitch_m, texture.height_m, texture.angle_rad}) hash.add(v);
  if (texture.kind != models::TouchTexture::Kind::picture) return;
  // A scene file keeps fifteen bits of each value.
  for (const float v : texture.tile)
    hash.add(static_cast<std::uint32_t>(std::lround(32767.0 * static_cast<double>(v)) + 32768));
}

}  // namespace

namespace {

/// The beginning that both hashes have in common: kind and model.
Fnv1a model_hash(const models::Scene& scene) {
  Fnv1a hash;
  hash.add(std::string_view(models::kind_of(scene.model)));
  std::visit([&](const auto& model) { add_model(hash, model); }, scene.model);
  return hash;
}

std::string scene_hash_from(Fnv1a hash, const models::Scene& scene) {
  for (const auto& material : scene.materials) {
    hash.add(material.stiffness_N_per_m);
    hash.add(material.damping_Ns_per_m);
    hash.add(material.static_friction);
    hash.add(material.dynamic_friction);
    add_texture(hash, material.texture);
  }
  add_raster(hash, scene.labels);
  if (scene.guide != nullptr) {
    for (const auto& place : scene.guide->line_m)
      for (const double v : place) hash.add(v);
    for (const double v : {scene.guide->force_N, scene.guide->reach_m, scene.guide->ahead_m}) hash.add(v);
  }
  return hash.digits();
}

std::string shape_hash_from(Fnv1a hash, const models::Scene& scene) {
  add_raster(hash, scene.labels);
  return hash.digits();
}

}  // namespace

std::string scene_hash(const models::Scene& scene) { return scene_hash_from(model_hash(scene), scene); }

std::string shape_hash(const models::Scene& scene) { return shape_hash_from(model_hash(scene), scene); }

SceneHash SceneHashes::of(const std::shared_ptr<const models::Scene>& scene) {
  if (scene_ != scene) {
    const Fnv1a model = model_hash(*scene);
    hash_ = {scene_hash_from(model, *scene), shape_hash_from(model, *scene)};
    scene_ = scene;
  }
  return hash_;
}

}  // namespace palpable::session
