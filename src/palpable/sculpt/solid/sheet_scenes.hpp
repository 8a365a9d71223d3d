// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Random scenes of closed bodies, bodies with holes, and open sheets, whose truth is known: both sides of a
// sheet are air, bodies are solid. For tests.

#include "palpable/sculpt/solid/scene_parts.hpp"
#include "palpable/sculpt/solid/sheet_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace palpable::sculpt {

class SceneMaker : private SceneParts {
 public:
  explicit SceneMaker(std::uint64_t seed) : SceneParts(seed) {}

  SheetScene scene() {
    SheetScene scene;
    const int bodies = whole(0, 2), sheets = bodies == 0 ? whole(1, 2) : whole(0, 2);
    for (int k = 0; k < bodies; ++k) add_body(scene);
    for (int k = 0; k < sheets; ++k) add_sheets(scene);
    return scene;
  }

  /// The same with triangles that occur with both orientations, more than once, or wrongly oriented, with
  /// tori, cups, rooms, cavities, and boxes and fins that share vertices with sheets.
  SheetScene double_sided_scene() {
    SheetScene scene;
    // Rays that decide about a cavity must cross nothing else.
    if (whole(0, 9) == 0) {
      add_shell(scene, true);
      return scene;
    }
    const int pieces = whole(1, 3);
    for (int k = 0; k < pieces; ++k) {
      switch (whole(0, 7)) {
        case 0: {
          SheetScene piece;
          add_sheets(piece);
          add_piece(scene, std::move(piece), whole(0, 1) == 0 ? Sides::one : Sides::both);
          break;
        }
        case 1:
          add_torus(scene);
          break;
        case 2:
          add_bowl_or_cup(scene);
          break;
        case 3:
          add_shell(scene, false);
          break;
        case 4:
          add_welded(scene);
          break;
        default: {
          SheetScene piece;
          add_body(piece, false);
          add_piece(scene, std::move(piece), any_sides());
        }
      }
    }
    return scene;
  }

 private:
  /// How the triangles of a piece are given.
  enum class Sides { one, both, some_both, mixed, repeated };
  Sides any_sides() { return static_cast<Sides>(whole(0, 4)); }

  static void reverse(std::array<std::uint32_t, 3>& t) { std::swap(t[1], t[2]); }
  void present(Mesh& mesh, Sides sides) {
    const std::size_t count = mesh.triangles.size();
    for (std::size_t i = 0; i < count; ++i) {
      auto t = mesh.triangles[i];
      const bool is_doubled = sides == Sides::both || (sides == Sides::some_both && whole(0, 2) == 0);
      if (is_doubled) {
        reverse(t);
        mesh.triangles.push_back(t);
      }
      if (sides == Sides::mixed && whole(0, 1) == 0) reverse(mesh.triangles[i]);
      if (sides == Sides::repeated && whole(0, 1) == 0) mesh.triangles.push_back(t);
    }
    if (whole(0, 1) == 0) std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random_);
  }
  void add_piece(SheetScene& scene, SheetScene piece, Sides sides) {
    constexpr std::array kNames{"one-sided ", "two-sided ", "partly two-sided ", "mixed ", "repeated "};
    present(piece.mesh, sides);
    scene.mesh = together(std::move(scene.mesh), piece.mesh);
    if (!piece.sheets.triangles.empty()) scene.sheets = together(std::move(scene.sheets), piece.sheets);
    scene.bodies.insert(scene.bodies.end(), piece.bodies.begin(), piece.bodies.end());
    scene.facets_m = std::max(scene.facets_m, piece.facets_m);
    scene.words += kNames[static_cast<std::size_t>(sides)] + piece.words;
  }

  void add_torus(SheetScene& scene) {
    const Vec3 at{mm(-30, 30), mm(-30, 30), mm(-5, 30)};
    const double ring_m = mm(12, 25), tube_m = mm(3, 8);
    SheetScene piece;
    constexpr std::uint32_t kAround = 64, kAlong = 24;
    piece.mesh = grid_sheet(kAround, kAlong, [&](double u, double v) {
      const double turn = u == 1.0 ? 0.0 : 2.0 * std::numbers::pi * u,
                   tilt = v == 1.0 ? 0.0 : 2.0 * std::numbers::pi * v;
      const double out_m = ring_m + tube_m * std::cos(tilt);
      return at + Vec3{out_m * std::cos(turn), out_m * std::sin(turn), tube_m * std::sin(tilt)};
    });
    piece.bodies.emplace_back([=](Vec3 p) {
      const Vec3 v = p - at;
      return std::hypot(std::hypot(v.x, v.y) - ring_m, v.z) - tube_m;
    });
    piece.facets_m = 0.012 * tube_m + 0.002 * (ring_m + tube_m);
    piece.words = "torus, ";
    add_piece(scene, std::move(piece), any_sides());
  }

  /// A bowl without thickness, seen from both sides, or a cup with a thick wall.
  void add_bowl_or_cup(SheetScene& scene) {
    const Vec3 at{mm(-30, 30), mm(-30, 30), mm(-5, 30)};
    const double radius_m = mm(10, 20);
    constexpr std::uint32_t kAround = 48, kAlong = 24;
    SheetScene piece;
    if (whole(0, 1) == 0) {
      const double rim = between(80.0, 110.0) * std::numbers::pi / 180.0;
      piece.add_sheet(ball(kAround, kAlong, at, radius_m, 0.0, rim, 0));
      piece.words = "bowl without thickness, ";
      add_piece(scene, std::move(piece), Sides::both);
      return;
    }
    const double height_m = mm(15, 35), wall_m = mm(2, 4);
    // Floor from below, outside, rim, inside, floor from above.
    const std::array<std::array<double, 2>, 6> profile{{{0.0, 0.0},
                                                        {radius_m, 0.0},
                                                        {radius_m, height_m},
                                                        {radius_m - wall_m, height_m},
                                                        {radius_m - wall_m, wall_m},
                                                        {0.0, wall_m}}};
    piece.mesh = grid_sheet(kAround, 5, [&](double u, double v) {
      const double turn = u == 1.0 ? 0.0 : 2.0 * std::numbers::pi * u;
      const auto [out_m, up_m] = profile[static_cast<std::size_t>(std::lround(5.0 * v))];
      return at + Vec3{out_m * std::cos(turn), out_m * std::sin(turn), up_m};
    });
    piece.bodies.emplace_back([=](Vec3 p) {
      const Vec3 v = p - at;
      const double out_m = std::hypot(v.x, v.y);
      const double outer = std::max({out_m - radius_m, -v.z, v.z - height_m}),
                   inner = std::max(out_m - (radius_m - wall_m), wall_m - v.z);
      return std::max(outer, -inner);
    });
    piece.facets_m = 0.003 * radius_m;
    piece.words = "cup, ";
    add_piece(scene, std::move(piece), any_sides());
  }

  /// A box with a box inside it: a cavity if the inner one is one-sided and faces inwards, as a room with
  /// walls; else filled. Or a room of five sheets.
  void add_shell(SheetScene& scene, bool is_cavity) {
    const Vec3 at{mm(-30, 30), mm(-30, 30), mm(-5, 30)};
    const Vec3 half{mm(8, 20), mm(8, 20), mm(8, 20)}, wall{mm(2, 4), mm(2, 4), mm(2, 4)};
    const Vec3 low = at - half, high = at + half, inner_low = low + wall, inner_high = high - wall;
    SheetScene outer, inner;
    if (!is_cavity && whole(0, 2) == 0) {
      Mesh room = box_mesh(low, high);
      std::erase_if(room.triangles, [&](const auto& t) {
        return std::all_of(t.begin(), t.end(),
                           [&](std::uint32_t v) { return room.vertices_m[v].z == high.z; });
      });
      outer.add_sheet(room);
      outer.words = "room without a ceiling, ";
      add_piece(scene, std::move(outer), Sides::both);
      return;
    }
    outer.mesh = box_mesh(low, high);
    inner.mesh = box_mesh(inner_low, inner_high);
    if (is_cavity)
      for (auto& t : inner.mesh.triangles) reverse(t);
    outer.bodies.emplace_back([=](Vec3 p) {
      const double d = box_distance(p, low, high);
      return is_cavity ? std::max(d, -box_distance(p, inner_low, inner_high)) : d;
    });
    outer.words = is_cavity ? "box with a cavity, " : "box with a filled shell, ";
    add_piece(scene, std::move(outer), any_sides());
    // Of few triangles, most may face inwards by chance.
    const Sides sides = any_sides();
    add_piece(scene, std::move(inner), is_cavity || sides == Sides::mixed ? Sides::one : sides);
  }

  /// A box that shares the vertices of a floor and a wall, with or without its faces on them, or of a fin.
  void add_welded(SheetScene& scene) {
    const double g = mm(3, 6);
    const Vec3 origin{mm(-30, 10), mm(-30, 10), mm(-5, 20)};
    const auto cells = static_cast<std::uint32_t>(whole(1, 3));
    const int first = whole(0, 3);
    // Sides of so many steps, each in `divisions` parts.
    const auto grid = [&](Vec3 from, Vec3 u, Vec3 v, double columns, double rows, std::uint32_t divisions) {
      return grid_sheet(divisions, divisions, [&](double a, double b) {
        return origin + g * (from + (a * columns) * u + (b * rows) * v);
      });
    };
    const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    const double n = cells, at = first;
    const Vec3 corner = at * x;
    SheetScene box, stage;
    const bool has_back = whole(0, 2) == 0, is_fin = whole(0, 2) == 0;
    // Where the box has other divisions than the stage, their edges touch without common vertices.
    const std::uint32_t divisions = whole(0, 1) == 0 ? cells : static_cast<std::uint32_t>(whole(1, 4));
    for (const auto& [from, u, v] : {std::array{n * z, x, y}, {Vec3{}, z, y}, {n * x, y, z}, {n * y, z, x}})
      box.mesh = together(std::move(box.mesh), grid(corner + from, u, v, n, n, divisions));
    if (has_back || is_fin) {
      box.mesh = together(std::move(box.mesh), grid(corner, y, x, n, n, divisions));
      box.mesh = together(std::move(box.mesh), grid(corner, x, z, n, n, divisions));
    }
    const Vec3 low = origin + g * corner, high = low + (g * n) * Vec3{1, 1, 1};
    box.bodies.emplace_back([=](Vec3 p) { return box_distance(p, low, high); });
    if (is_fin) {
      box.words = "box with a fin, ";
      stage.add_sheet(grid(corner + n * x + n * y, x + y, z, n, n, cells));
    } else {
      box.words = has_back ? "box welded to floor and wall, " : "box without two faces in a corner, ";
      stage.add_sheet(grid({}, x, y, 8, 8, 8));
      stage.add_sheet(grid({}, x, z, 8, 8, 8));
    }
    const Sides sides = whole(0, 1) == 0 ? Sides::one : Sides::mixed;
    add_piece(scene, std::move(box), is_fin || has_back ? any_sides() : sides);
    add_piece(scene, std::move(stage), whole(0, 1) == 0 ? Sides::both : sides);
  }
};

}  // namespace palpable::sculpt
