// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Random scenes of closed bodies, bodies with holes, and open sheets, whose truth is known: both sides of a
// sheet are air, bodies are solid. For tests.

#include "palpable/sculpt/solid/mesh_solid.hpp"
#include "palpable/sculpt/solid/test_solids.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace palpable::sculpt {

inline constexpr double kCell_m = 0.0002;
/// No sheet is ground.
inline constexpr WallOptions kTwoCellWalls{.least_cells = 2.0, .ground_facing = 1.0};

/// Triangles over a grid of places; `place_m(u, v)` with u and v from 0 to 1.
template <class Place>
Mesh grid_sheet(std::uint32_t columns, std::uint32_t rows, const Place& place_m) {
  Mesh sheet;
  for (std::uint32_t j = 0; j <= rows; ++j)
    for (std::uint32_t i = 0; i <= columns; ++i)
      sheet.vertices_m.push_back(place_m(static_cast<double>(i) / columns, static_cast<double>(j) / rows));
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = j * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
      sheet.triangles.push_back({a, b, d});
      sheet.triangles.push_back({a, d, c});
    }
  return sheet;
}

/// What the scenes consist of. Bodies know their distance; beside it the mesh may be wrong by `facets_m`.
struct SheetScene {
  Mesh mesh;
  Mesh sheets;
  std::vector<std::function<double(Vec3)>> bodies;
  double facets_m = 1e-6;
  std::string words;

  void add_sheet(const Mesh& sheet) {
    sheets = together(std::move(sheets), sheet);
    mesh = together(std::move(mesh), sheet);
  }
  double body_distance(Vec3 p) const {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& body : bodies) least = std::min(least, body(p));
    return least;
  }
  double sheet_distance(Vec3 p) const {
    double least2 = std::numeric_limits<double>::infinity();
    for (const auto& t : sheets.triangles)
      least2 = std::min(least2, nearest_on_triangle(p, sheets.vertices_m[t[0]], sheets.vertices_m[t[1]],
                                                    sheets.vertices_m[t[2]])
                                    .squared_distance_m2);
    return std::sqrt(least2);
  }
};

class SceneMaker {
 public:
  explicit SceneMaker(std::uint64_t seed) : random_(seed) {}

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

  double between(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random_);
  }
  int whole(int least, int most) { return std::uniform_int_distribution<int>(least, most)(random_); }
  double mm(int least, int most) { return 1e-3 * whole(least, most); }

  /// Without `with_bowls` openings are small: two-sided bowls, and boxes with several holes, may be sheets.
  void add_body(SheetScene& scene, bool with_bowls = true) {
    const Vec3 at{mm(-30, 30), mm(-30, 30), mm(-5, 30)};
    int kind = whole(0, 4);
    if (kind == 2 && !with_bowls) kind = 3;
    if (kind <= 1) {
      const Vec3 half{mm(4, 15), mm(4, 15), mm(4, 15)};
      const Vec3 low = at - half, high = at + half;
      scene.mesh = together(std::move(scene.mesh),
                            kind == 0 ? box_mesh(low, high) : holed_box(low, high, with_bowls ? 3 : 1));
      scene.bodies.emplace_back([=](Vec3 p) { return box_distance(p, low, high); });
      scene.words += kind == 0 ? "box, " : "box with holes, ";
      return;
    }
    const double radius_m = mm(6, 15);
    constexpr std::uint32_t kAround = 48, kAlong = 24;
    // The facets of a ball of 48 x 24.
    scene.facets_m = std::max(scene.facets_m, 0.012 * radius_m);
    if (kind == 2) {
      // A bowl that is open at the top: a ball below 80 to 110 degrees from its lowest point.
      const double rim = between(80.0, 110.0) * std::numbers::pi / 180.0, top_m = -radius_m * std::cos(rim);
      scene.mesh = together(std::move(scene.mesh), ball(kAround, kAlong, at, radius_m, 0.0, rim, 0));
      scene.bodies.emplace_back(
          [=](Vec3 p) { return std::max(norm(p - at) - radius_m, p.z - at.z - top_m); });
      scene.words += "bowl, ";
      return;
    }
    scene.mesh = together(std::move(scene.mesh),
                          ball(kAround, kAlong, at, radius_m, 0.0, std::numbers::pi, kind == 3 ? 0 : 4));
    scene.bodies.emplace_back([=](Vec3 p) { return norm(p - at) - radius_m; });
    scene.words += kind == 3 ? "ball, " : "ball with holes, ";
  }

  /// Triangles of a ball, `missing` of them left out; angles from its lowest point.
  Mesh ball(std::uint32_t around, std::uint32_t along, Vec3 at, double radius_m, double from, double to,
            int missing) {
    Mesh mesh = grid_sheet(around, along, [&](double u, double v) {
      // Exactly the same place at both ends.
      const double turn = u == 1.0 ? 0.0 : 2.0 * std::numbers::pi * u, tilt = from + v * (to - from);
      const double out = v == 0.0 || (v == 1.0 && to == std::numbers::pi) ? 0.0 : std::sin(tilt);
      return at + radius_m * Vec3{out * std::cos(turn), out * std::sin(turn), -std::cos(tilt)};
    });
    for (int k = 0; k < missing; ++k)
      mesh.triangles.erase(mesh.triangles.begin() + whole(0, static_cast<int>(mesh.triangles.size()) - 1));
    return mesh;
  }

  /// A box of small squares, of which one or more are missing.
  Mesh holed_box(Vec3 low, Vec3 high, int most_missing) {
    const Vec3 size = high - low;
    Mesh mesh;
    constexpr std::uint32_t kSquares = 6;
    for (int axis = 0; axis < 3; ++axis)
      for (const bool far : {false, true}) {
        Mesh face = grid_sheet(kSquares, kSquares, [&](double u, double v) {
          const double w = far ? 1.0 : 0.0;
          const Vec3 share = axis == 0 ? Vec3{w, u, v} : axis == 1 ? Vec3{v, w, u} : Vec3{u, v, w};
          return Vec3{low.x + share.x * size.x, low.y + share.y * size.y, low.z + share.z * size.z};
        });
        if (!far)
          for (auto& t : face.triangles) std::swap(t[1], t[2]);
        mesh = together(std::move(mesh), face);
      }
    const int missing = whole(1, most_missing);
    for (int k = 0; k < missing; ++k) {
      // The two triangles of a square.
      const auto first =
          mesh.triangles.begin() + 2 * whole(0, static_cast<int>(mesh.triangles.size()) / 2 - 1);
      mesh.triangles.erase(first, first + 2);
    }
    return mesh;
  }

  /// Sheets that share edges or are curved, in a random direction.
  void add_sheets(SheetScene& scene) {
    const Vec3 at{mm(-30, 30), mm(-30, 30), mm(-10, 30)};
    const double wide_m = mm(15, 80), deep_m = mm(15, 80), high_m = mm(10, 50);
    const auto fine = static_cast<std::uint32_t>(whole(1, 4));
    Mesh sheet;
    const auto quad = [&](Vec3 corner, Vec3 u, Vec3 v) {
      return grid_sheet(fine, fine, [&](double a, double b) { return corner + a * u + b * v; });
    };
    const Vec3 x{wide_m, 0.0, 0.0}, y{0.0, deep_m, 0.0}, z{0.0, 0.0, high_m};
    switch (whole(0, 7)) {
      case 0:
        scene.words += "floor and wall, ";
        sheet = together(quad({}, x, y), quad({}, x, z));
        break;
      case 1:
        scene.words += "floor and two walls, ";
        sheet = together(together(quad({}, x, y), quad({}, x, z)), quad({}, y, z));
        break;
      case 2: {
        const double lean_m = between(0.2, 1.0) * high_m;
        scene.words += "tent, ";
        sheet = together(quad({}, x, {0.0, lean_m, high_m}),
                         quad({0.0, 2.0 * lean_m, 0.0}, x, {0.0, -lean_m, high_m}));
        break;
      }
      case 3: {
        // From a slightly bent screen to a bit more than half a tube.
        const double angle = between(0.3, 3.5), radius_m = deep_m / angle;
        scene.words += "curved screen, ";
        sheet = grid_sheet(fine, 16, [&](double u, double v) {
          return Vec3{u * wide_m, radius_m * std::cos(v * angle), radius_m * std::sin(v * angle)};
        });
        break;
      }
      case 4: {
        const double rise_m = between(0.02, 0.15) * deep_m, phase = between(0.0, 3.0);
        scene.words += "wavy sheet, ";
        sheet = grid_sheet(12, 12, [&](double u, double v) {
          return Vec3{u * wide_m, v * deep_m, rise_m * std::sin(9.0 * u + phase) * std::sin(7.0 * v)};
        });
        break;
      }
      case 5:
        scene.words += "crossing walls with a common edge, ";
        sheet = together(together(quad({}, x, z), quad({}, y, z)),
                         together(quad({}, -1.0 * x, z), quad({}, -1.0 * y, z)));
        break;
      case 6:
        scene.words += "wall on the middle of a floor, ";
        sheet = together(together(quad({}, x, y), quad({}, x, -1.0 * y)), quad({}, x, z));
        break;
      default:
        scene.words += "channel, ";
        sheet = together(together(quad({}, x, y), quad({}, x, z)), quad(y, x, z));
    }
    const Vec3 axis = unit({between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)});
    const double angle = whole(0, 1) == 0 ? 0.0 : between(0.0, 6.0);
    const Vec3 middle = 0.5 * (bounds_of(sheet).least_m + bounds_of(sheet).most_m);
    for (Vec3& v : sheet.vertices_m) {
      const Vec3 p = v - middle;
      v = at + std::cos(angle) * p + std::sin(angle) * cross(axis, p) +
          ((1.0 - std::cos(angle)) * dot(axis, p)) * axis;
    }
    for (auto& t : sheet.triangles)
      if (whole(0, 1) == 1) std::swap(t[1], t[2]);
    scene.add_sheet(sheet);
  }

  std::mt19937_64 random_;
};

struct WorstPlace {
  double error_m = 0.0;
  Vec3 place_m;
  bool is_solid = false;
};

/// The greatest error of the solid at random places and beside its sheets.
inline WorstPlace worst_place(const SheetScene& scene, const MeshSolid& solid, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Vec3> places;
  const Box box = bounds_of(scene.mesh);
  const Vec3 size = box.size_m() + Vec3{0.01, 0.01, 0.01}, low = box.least_m - Vec3{0.005, 0.005, 0.005};
  for (int k = 0; k < 4000; ++k)
    places.push_back(low +
                     Vec3{size.x * uniform(random), size.y * uniform(random), size.z * uniform(random)});
  for (const auto& t : scene.sheets.triangles) {
    const Vec3 a = scene.sheets.vertices_m[t[0]], b = scene.sheets.vertices_m[t[1]],
               c = scene.sheets.vertices_m[t[2]];
    const Vec3 normal = unit(cross(b - a, c - a)), middle = (a + b + c) / 3.0;
    for (const double by_m : {-0.003, -0.0006, 0.0, 0.0006, 0.003}) places.push_back(middle + by_m * normal);
  }
  WorstPlace worst;
  DistanceSource::Hint hint;
  for (const Vec3 p : places) {
    const double body_m = scene.body_distance(p), sheet_m = scene.sheet_distance(p) - kCell_m;
    const bool is_solid = solid.distance->at(p, hint).distance_m < 0.0;
    // Where a sheet leaves a body, its parts are found to within a cell.
    const double in_sheet_m = body_m > kCell_m ? -sheet_m - 0.1 * kCell_m : 0.0;
    const double error_m = is_solid ? std::min(body_m - scene.facets_m, sheet_m)
                                    : std::max(-body_m - scene.facets_m, in_sheet_m);
    if (error_m > worst.error_m) worst = {error_m, p, is_solid};
  }
  return worst;
}

}  // namespace palpable::sculpt
