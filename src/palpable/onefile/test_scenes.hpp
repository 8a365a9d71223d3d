// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/models/field/field_leaf.hpp"
#include "palpable/models/scene/scene.hpp"
#include "palpable/models/scene/test_grid.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace palpable::onefile {

/// 24 x 18 mm with hills of up to 4 mm.
inline models::Relief hills() {
  Raster<float> heights(48, 36);
  for (int j = 0; j < heights.height(); ++j)
    for (int i = 0; i < heights.width(); ++i)
      heights(i, j) =
          0.002F * (1.0F + std::sin(0.3F * static_cast<float>(i)) * std::cos(0.2F * static_cast<float>(j)));
  return *models::Relief::from_samples(std::move(heights), 0.0005);
}

/// With two materials, one of them textured, words and a picture.
inline models::Scene hills_scene() {
  models::Scene scene;
  scene.model = std::make_shared<const models::Relief>(hills());
  scene.texture = Raster<Rgb8>(48, 36, Rgb8{90, 120, 150});
  scene.materials.resize(2);
  scene.materials[1].name = "stone <wall>";
  scene.materials[1].stiffness_N_per_m = 800.0;
  scene.materials[1].texture.kind = models::TouchTexture::Kind::picture;
  for (int i = 0; i < models::kTextureSide * models::kTextureSide; ++i)
    scene.materials[1].texture.tile.push_back(std::sin(0.1F * static_cast<float>(i)));
  scene.labels = Raster<std::uint8_t>(6, 4);
  scene.labels(1, 2) = 1;
  scene.scene_from_input.scale = 0.25;
  scene.source = {{"left.png", "right.png"}, "best", "palpable test", {}, {}};
  scene.title = "Hills & <dales>";
  scene.description = "Two rows of hills. They are of stone.";
  scene.warnings = {"The left rim is not trusted."};
  scene.names = {{"Tor & <Turm>",
                  "Im Westen.",
                  {0.01, -0.01},
                  models::PlaceName::Extent::line,
                  {{0.0, 0.0}, {0.01, 0.0}}}};
  return scene;
}

inline models::Scene contours_scene() {
  Raster<models::BoundaryPixel> edges(48, 36);
  for (int x = 0; x < 48; ++x) edges(x, 17) = {0.9F, 0.005F * static_cast<float>(x)};
  models::Scene scene = hills_scene();
  scene.model = std::make_shared<const models::Contours>(
      models::Contours{*models::BoundaryMap::from_edges(edges, 0.0005, 2.5, {0.3, 0.125}, Work{}),
                       std::make_shared<const models::Relief>(hills())});
  return scene;
}

/// A ball of 5 mm in a box of 16 mm, as distances on a lattice.
inline models::Scene dense_scene() {
  const models::Lattice lattice{{-0.008, -0.008, -0.008}, 0.001, {17, 17, 17}};
  std::vector<float> values;
  for (int z = 0; z < 17; ++z)
    for (int y = 0; y < 17; ++y)
      for (int x = 0; x < 17; ++x)
        values.push_back(static_cast<float>(norm(lattice.place_m(x, y, z)) - 0.005));
  models::Scene scene = hills_scene();
  scene.pose = models::SolidPose::flat;
  auto field = *models::field_of(*models::DenseField::from(lattice, models::DenseContent::distance,
                                                           std::move(values), {0.0, 2e-5, 3e-5}),
                                 {-0.005, -0.005, -0.005}, {0.005, 0.005, 0.005});
  field.primitives.emplace_back();
  scene.model = std::make_shared<const models::FieldOnLattice>(std::move(field));
  return scene;
}

/// A floor at z = 4 mm: one root cell that is a plane.
inline models::Scene field_scene() {
  const auto word = [](float value) { return std::bit_cast<std::uint32_t>(value); };
  models::FieldTree tree;
  tree.words = {0U, word(0.0F), word(0.0F), word(1.0F), word(-0.004F)};
  tree.roots = {models::FieldTree::kLeaf};
  models::Scene scene = hills_scene();
  scene.model = std::make_shared<const models::Field>(
      *models::field_of(*models::DistanceField::from_tree({{-0.004, -0.004, 0.0}, 0.001, 3, {1, 1, 1}}, tree,
                                                          {1e-5, 2e-5, 3e-5}),
                        {-0.003, -0.003, 0.001}, {0.003, 0.003, 0.004}));
  return scene;
}

inline models::Scene map_scene() {
  StreetMap map;
  map.width_px = 300;
  map.height_px = 200;
  map.metres_per_px = 0.5;
  map.streets = {
      {"Große Straße", 12.5, {{1.25, 2.5}, {100, 50}, {200.75, 60}}, true, MapStreet::Kind::steps}};
  map.junctions = {{{100, 50}, 4, true}};
  map.areas = {{MapArea::Kind::water, {{0, 0}, {10, 0}, {10, 10}}}};
  map.labels = {{"Große Straße", 0.93, -12.5, {{1, 2}, {50, 2}, {50, 12}, {1, 12}}, true}};
  map.places = {{MapPlace::Kind::church, "St Mary", {3, 4}, {{0, 0}, {6, 0}, {6, 8}}, true, false}};
  models::Scene scene = hills_scene();
  scene.map = std::make_shared<const StreetMap>(std::move(map));
  return scene;
}

/// One scene of each kind.
inline std::vector<models::Scene> scenes_of_all_kinds() {
  return {hills_scene(), contours_scene(),
          dense_scene(), field_scene(),
          map_scene(),   models::grid_scene({21, 21, 8}, 0.003F, [](int z) { return z <= 4; })};
}

}  // namespace palpable::onefile
