// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "table_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace palpable::bench {
namespace {

// Of the bodies the table is the first, the board the second.
constexpr std::size_t kBoard = 1;

constexpr double kFar = 1e9;

// The part of a ray inside a body so far: begin at `normal`, end.
struct Inside {
  double begin = -kFar, end = kFar;
  Vec3 normal;

  void enter(double t, Vec3 n) {
    if (t > begin) begin = t, normal = n;
  }
};

void clip(Inside& inside, const HalfSpace& side, Vec3 origin, Vec3 direction) {
  const double across = dot(side.normal, direction), gap = side.offset_m - dot(side.normal, origin);
  if (across < 0)
    inside.enter(gap / across, side.normal);
  else if (across > 0)
    inside.end = std::min(inside.end, gap / across);
  else if (gap < 0)
    inside.end = -kFar;
}

void clip_round(Inside& inside, const Body& body, Vec3 origin, Vec3 direction) {
  const auto flat = [&](Vec3 v) { return body.round == Body::Round::cylinder ? Vec3{v.x, v.y, 0} : v; };
  const Vec3 o = flat(origin - body.centre_m), d = flat(direction);
  const double a = squared_norm(d), b = dot(o, d), c = squared_norm(o) - body.radius_m * body.radius_m;
  const double root = b * b - a * c;
  if (root <= 0 || a <= 0) {
    inside.end = -kFar;
    return;
  }
  const double near = (-b - std::sqrt(root)) / a;
  inside.enter(near, unit(o + near * d));
  inside.end = std::min(inside.end, (-b + std::sqrt(root)) / a);
}

Body prism(std::vector<HalfSpace> sides, Vec3 centre, double bound, const Texture& texture) {
  Body body;
  body.sides = std::move(sides);
  body.bound_centre_m = body.centre_m = centre;
  body.bound_radius_m = bound;
  body.texture = texture;
  return body;
}

struct Place {
  double x = 0, y = 0, cosine = 1, sine = 0;
  // A half-space of the body's own axes, placed.
  HalfSpace side(Vec3 n, double offset) const {
    const Vec3 normal{cosine * n.x - sine * n.y, sine * n.x + cosine * n.y, n.z};
    return {normal, offset + normal.x * x + normal.y * y};
  }
};

std::vector<HalfSpace> box_sides(const Place& at, double half_x, double half_y, double height) {
  return {at.side({1, 0, 0}, half_x),  at.side({-1, 0, 0}, half_x), at.side({0, 1, 0}, half_y),
          at.side({0, -1, 0}, half_y), at.side({0, 0, 1}, height),  at.side({0, 0, -1}, 0.001)};
}

Texture any_texture(Random& random, double richness) {
  constexpr std::array kPatterns{Pattern::rough, Pattern::tiles, Pattern::text, Pattern::rough};
  Texture out;
  out.pattern =
      random.unit() < richness ? kPatterns[static_cast<std::size_t>(random.count(0, 3))] : Pattern::plain;
  out.colour = {random.between(0.25, 0.75), random.between(0.25, 0.75), random.between(0.25, 0.75)};
  out.contrast = random.between(0.25, 0.6) * (out.pattern == Pattern::plain ? 0.4 : 1.0);
  out.scale_px = random.between(20, 60);
  out.seed = random.next();
  return out;
}

Body any_body(Random& random, double x, double y, double reach, double richness) {
  const double angle = random.between(0, std::numbers::pi);
  const Place at{x, y, std::cos(angle), std::sin(angle)};
  const double half_x = random.between(0.45, 0.7) * reach, half_y = random.between(0.35, 0.7) * reach;
  const double height = random.between(0.4, 1.6) * reach;
  const double bound = std::hypot(std::hypot(half_x, half_y), 2 * height);
  const Texture texture = any_texture(random, richness);
  const Vec3 centre{x, y, 0};
  switch (random.count(0, 4)) {
    case 0:
      return prism(box_sides(at, half_x, half_y, height), centre, bound, texture);
    case 1: {  // A gabled house.
      auto sides = box_sides(at, half_x, half_y, 2 * height);
      const double slope = random.between(0.5, 1.2);
      for (const double sign : {-1.0, 1.0}) {
        const Vec3 n = unit(Vec3{0, sign * slope, 1});
        sides.push_back(at.side(n, n.z * (height + 0.6 * slope * half_y)));
      }
      return prism(std::move(sides), centre, bound, texture);
    }
    case 2: {  // A cylinder.
      Body body = prism({{{0, 0, 1}, height}, {{0, 0, -1}, 0.001}}, centre, bound, texture);
      body.round = Body::Round::cylinder, body.radius_m = half_y;
      return body;
    }
    case 3: {  // A pyramid, cut off.
      auto sides = box_sides(at, half_x, half_y, 0.8 * height);
      for (const Vec3 n : {Vec3{1, 0, 0.5}, Vec3{-1, 0, 0.5}, Vec3{0, 1, 0.5}, Vec3{0, -1, 0.5}})
        sides.push_back(
            at.side(unit(n), unit(n).x != 0 ? half_x * std::abs(unit(n).x) : half_y * std::abs(unit(n).y)));
      return prism(std::move(sides), centre, bound, texture);
    }
    default: {  // A dome.
      Body body = prism({{{0, 0, -1}, 0.001}}, centre, half_y, texture);
      body.round = Body::Round::ball, body.radius_m = half_y;
      return body;
    }
  }
}

}  // namespace

std::optional<ModelHit> TableModel::first_hit(Vec3 origin, Vec3 direction) const {
  std::optional<ModelHit> out;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Body& body = bodies[i];
    const Vec3 to = body.bound_centre_m - origin;
    const double along = dot(to, direction);
    if (squared_norm(to) - along * along > body.bound_radius_m * body.bound_radius_m) continue;
    Inside inside;
    if (body.round != Body::Round::none) clip_round(inside, body, origin, direction);
    for (const HalfSpace& side : body.sides) clip(inside, side, origin, direction);
    if (inside.begin > 0 && inside.begin < inside.end && (!out || inside.begin < out->distance_m))
      out = ModelHit{inside.begin, inside.normal, i};
  }
  return out;
}

Colour TableModel::colour_at(const ModelHit& hit, Vec3 place) const {
  constexpr double kUnit = 1e4;
  const Vec3 p = kUnit * place, n = hit.normal;
  // Projected along the axis that the surface faces most.
  const bool up = std::abs(n.z) >= std::abs(n.x) && std::abs(n.z) >= std::abs(n.y);
  const double u = up ? p.x : std::abs(n.x) > std::abs(n.y) ? p.y : p.x, v = up ? p.y : p.z;
  Colour colour = bodies[hit.body].texture.at(u, v);
  if (marker && hit.body == kBoard && up) colour = marker->at(place).value_or(colour);
  const double light = 0.55 + 0.45 * std::max(0.0, dot(n, sun));
  for (double& c : colour) c *= light;
  return colour;
}

std::optional<Colour> ModelMarker::at(Vec3 place) const {
  const double cell = side_m / cells.width();
  const double x = (place.x - centre_m.x + side_m / 2) / cell, y = (centre_m.y + side_m / 2 - place.y) / cell;
  if (x < -1 || y < -1 || x >= cells.width() + 1 || y >= cells.height() + 1) return std::nullopt;
  const bool inside = x >= 0 && y >= 0 && x < cells.width() && y < cells.height();
  const bool white = !inside || cells(static_cast<int>(x), static_cast<int>(y)) != 0;
  return white ? Colour{0.92, 0.92, 0.92} : Colour{0.06, 0.06, 0.06};
}

void lay_marker(TableModel& model, Raster<std::uint8_t> cells, double side_m) {
  double most_x = 0.0, most_y = 0.0;
  for (const HalfSpace& side : model.bodies[kBoard].sides) {
    if (side.normal.x > 0.9) most_x = side.offset_m;
    if (side.normal.y > 0.9) most_y = side.offset_m;
  }
  const double inset = side_m * (0.5 + 1.2 / cells.width());
  Vec3 best;
  double farthest = -1.0;
  for (const double x : {-1.0, 1.0})
    for (const double y : {-1.0, 1.0}) {
      const Vec3 corner{x * (most_x - inset), y * (most_y - inset), 0};
      double nearest = 10.0;
      for (std::size_t i = kBoard + 1; i < model.bodies.size(); ++i)
        nearest =
            std::min(nearest, norm(model.bodies[i].bound_centre_m - corner) - model.bodies[i].bound_radius_m);
      if (nearest > farthest) farthest = nearest, best = corner;
    }
  model.marker = ModelMarker{std::move(cells), best, side_m};
}

TableModel table_model(Random& random, double texture) {
  TableModel model;
  const double azimuth = random.between(0, 2 * std::numbers::pi), height = random.between(0.5, 1.2);
  model.sun = unit(Vec3{std::cos(azimuth), std::sin(azimuth), height});
  // The table, and the board on it.
  const Place middle{};
  const double half_x = random.between(0.18, 0.26), half_y = random.between(0.15, 0.22);
  model.bodies.push_back(prism({{{0, 0, 1}, -0.012}}, {}, kFar, any_texture(random, texture)));
  auto board = box_sides(middle, half_x, half_y, 0.0);
  board.back().offset_m = 0.012;
  model.bodies.push_back(prism(std::move(board), {}, 0.5, any_texture(random, std::max(texture, 0.7))));
  const int wanted = random.count(3, 9);
  const double reach = 0.75 * std::sqrt(half_x * half_y / wanted);
  std::vector<Vec3> taken;
  for (int tries = 0; tries < 400 && static_cast<int>(taken.size()) < wanted; ++tries) {
    const Vec3 at{random.between(-1, 1) * (half_x - reach), random.between(-1, 1) * (half_y - reach), 0};
    if (std::any_of(taken.begin(), taken.end(), [&](Vec3 other) { return norm(other - at) < 1.7 * reach; }))
      continue;
    taken.push_back(at);
    model.bodies.push_back(any_body(random, at.x, at.y, reach, texture));
  }
  return model;
}

}  // namespace palpable::bench
