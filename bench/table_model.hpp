// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/vec3.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "scene_surfaces.hpp"

// Table-top models for rendered videos: convex bodies on a board, metres, z up, the board's top at z = 0.
namespace palpable::bench {

/// One of the half-spaces dot(normal, p) <= offset_m that a body is the intersection of. `normal` has
/// length 1.
struct HalfSpace {
  Vec3 normal;
  double offset_m = 0.0;
};

/// A convex body: half-spaces, and a cylinder's or ball's round side where it has one.
struct Body {
  enum class Round { none, cylinder, ball } round = Round::none;
  std::vector<HalfSpace> sides;
  Vec3 centre_m;
  double radius_m = 0.0;
  /// Of a ball around the whole body.
  Vec3 bound_centre_m;
  double bound_radius_m = 0.0;
  /// Lengths are in tenths of millimetres.
  Texture texture;
};

/// Where a ray meets a model first.
struct ModelHit {
  double distance_m = 0.0;
  Vec3 normal;
  std::size_t body = 0;
};

/// A printed marker on the board, x to the right and y to the back: a sheet whose white margin is one cell
/// wide.
struct ModelMarker {
  /// White = 1.
  Raster<std::uint8_t> cells;
  Vec3 centre_m;
  double side_m = 0.0;

  /// The colour of the sheet at a place of the board; nothing beside it.
  std::optional<Colour> at(Vec3 place) const;
};

struct TableModel {
  std::vector<Body> bodies;
  Vec3 sun;
  std::optional<ModelMarker> marker;

  /// `direction` has length 1. Empty where the ray meets nothing.
  std::optional<ModelHit> first_hit(Vec3 origin, Vec3 direction) const;
  /// The lit colour of a place of a body, 0 … 1 a channel.
  Colour colour_at(const ModelHit& hit, Vec3 place) const;
};

/// A board and three to nine boxes, gabled houses, cylinders, pyramids and domes on it, on a table. `texture`
/// from 0 (hardly any) to 1 (rich). Deterministic.
TableModel table_model(Random& random, double texture);

/// Lays a marker on the corner of the board that is farthest from all bodies.
void lay_marker(TableModel& model, Raster<std::uint8_t> cells, double side_m);

}  // namespace palpable::bench
