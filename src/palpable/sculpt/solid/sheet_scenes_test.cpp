// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Random scenes of closed bodies, bodies with holes, and open sheets of many shapes: both sides of a sheet
// are air, bodies are solid. `--gtest_random_seed=N` makes other scenes.
#include "palpable/sculpt/solid/mesh_solid.hpp"
#include "palpable/sculpt/solid/test_solids.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

constexpr double kCell_m = 0.0002;
/// No sheet is ground.
constexpr WallOptions kTwoCellWalls{.least_cells = 2.0, .ground_facing = 1.0};

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

 private:
  double between(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random_);
  }
  int whole(int least, int most) { return std::uniform_int_distribution<int>(least, most)(random_); }
  double mm(int least, int most) { return 1e-3 * whole(least, most); }

  void add_body(SheetScene& scene) {
    const Vec3 at{mm(-30, 30), mm(-30, 30), mm(-5, 30)};
    const int kind = whole(0, 4);
    if (kind <= 1) {
      const Vec3 half{mm(4, 15), mm(4, 15), mm(4, 15)};
      const Vec3 low = at - half, high = at + half;
      scene.mesh = together(std::move(scene.mesh), kind == 0 ? box_mesh(low, high) : holed_box(low, high));
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

  /// A box of small squares, of which one to three are missing.
  Mesh holed_box(Vec3 low, Vec3 high) {
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
    const int missing = whole(1, 3);
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
WorstPlace worst_place(const SheetScene& scene, const MeshSolid& solid, std::mt19937_64& random) {
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

TEST(SheetScenes, HaveAirOnBothSidesOfSheetsAndSolidBodies) {
  const auto seed = 20261122U + 1000U * static_cast<unsigned>(GTEST_FLAG_GET(random_seed));
  std::mt19937_64 random(seed);
  constexpr unsigned kScenes = 50;
  for (unsigned k = 0; k < kScenes; ++k) {
    SheetScene scene = SceneMaker(seed + k).scene();
    // Files store single precision.
    if (k % 2 == 1)
      for (Vec3& v : scene.mesh.vertices_m)
        v = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    const auto solid = solid_from_mesh(scene.mesh, kCell_m, {}, {}, kTwoCellWalls);
    ASSERT_TRUE(solid) << seed + k << ": " << scene.words;
    const WorstPlace worst = worst_place(scene, *solid, random);
    EXPECT_LT(worst.error_m, 2e-6) << seed + k << ": " << scene.words << (worst.is_solid ? "solid" : "air")
                                   << " at " << worst.place_m.x << " " << worst.place_m.y << " "
                                   << worst.place_m.z;
  }
}

TEST(SheetScenes, SayWhatBecameOfSheets) {
  // A floor and a wall that share an edge, and a cube on them.
  const Mesh stage = together(grid_sheet(1, 1,
                                         [](double u, double v) {
                                           return Vec3{0.08 * u - 0.04, 0.08 * v - 0.04, 0.0};
                                         }),
                              grid_sheet(1, 1, [](double u, double v) {
                                return Vec3{0.08 * u - 0.04, 0.04, 0.06 * v};
                              }));
  const Mesh cube = box_mesh({-0.01, -0.01, 0.001}, {0.01, 0.01, 0.021});
  const auto solid = solid_from_mesh(together(cube, stage), kCell_m, {}, {}, kTwoCellWalls);
  ASSERT_TRUE(solid);
  EXPECT_EQ(solid->repair.open_sheets, 1U);
  EXPECT_EQ(solid->repair.closed_holes, 0U);
  EXPECT_EQ(solid->repair.turned_parts, 0U);
  const std::vector<std::string> notes = solid->repair.notes();
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0], "One open sheet, with air on both sides, was given a thickness of 0.4 mm.");
  DistanceSource::Hint hint;
  // 32 mm from everything.
  EXPECT_NEAR(solid->distance->at({0.0, -0.005, 0.055}, hint).distance_m, std::hypot(0.0, 0.034), 1e-4);
  EXPECT_NEAR(solid->distance->at({0.0, 0.0, 0.011}, hint).distance_m, -0.01, 1e-6);
  // Sheets alone are a solid too, but have no volume without a thickness.
  EXPECT_TRUE(solid_from_mesh(stage, kCell_m, {}, {}, kTwoCellWalls));
  EXPECT_FALSE(solid_from_mesh(stage, kCell_m, {}));
}

TEST(SheetScenes, FillAMouldingWhoseRimLiesOnAWall) {
  // A ledge in front of a box and around its sides, open at the back.
  const Vec3 low{-0.02, -0.015, 0.0}, high{0.02, 0.015, 0.04};
  const Mesh ledge_box = box_mesh({-0.023, -0.018, 0.02}, {0.023, -0.005, 0.026});
  Mesh ledge = ledge_box;
  std::erase_if(ledge.triangles, [&](const auto& t) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return ledge.vertices_m[v].y == -0.005; });
  });
  // Half a tube on the box, its curved ends on two posts.
  const Mesh tube = grid_sheet(1, 16, [](double u, double v) {
    return Vec3{0.03 * u - 0.015, -0.006 * std::cos(v * std::numbers::pi),
                0.04 + 0.006 * std::sin(v * std::numbers::pi)};
  });
  Mesh mesh = together(together(box_mesh(low, high), ledge), tube);
  const Mesh posts = together(box_mesh({-0.018, -0.008, 0.035}, {-0.015, 0.008, 0.05}),
                              box_mesh({0.015, -0.008, 0.035}, {0.018, 0.008, 0.05}));
  const auto open_ends = solid_from_mesh(mesh, kCell_m, {}, {}, kTwoCellWalls);
  ASSERT_TRUE(open_ends);
  EXPECT_EQ(open_ends->repair.open_sheets, 1U);
  const auto solid = solid_from_mesh(together(mesh, posts), kCell_m, {}, {}, kTwoCellWalls);
  ASSERT_TRUE(solid);
  EXPECT_EQ(solid->repair.open_sheets, 0U);
  DistanceSource::Hint hint;
  EXPECT_LT(solid->distance->at({0.0, 0.0, 0.043}, hint).distance_m, -0.0029);
  DistanceSource::Hint other;
  EXPECT_GT(open_ends->distance->at({0.0, 0.0, 0.043}, other).distance_m, 0.0);
  EXPECT_LT(solid->distance->at({0.0, -0.0165, 0.023}, hint).distance_m, -0.0014);
}

TEST(SheetScenes, KeepHousesWithoutAFloorAndMapsWithABaseClosed) {
  // Five faces of a hall of 100 x 50 x 10 mm.
  const Vec3 low{-0.05, -0.025, 0.0}, high{0.05, 0.025, 0.01};
  Mesh hall = box_mesh(low, high);
  std::erase_if(hall.triangles, [&](const auto& t) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return hall.vertices_m[v].z == low.z; });
  });
  // A hilly map with a rim down to a base, which is missing.
  Mesh map = grid_sheet(20, 20, [](double u, double v) {
    const bool at_rim = u == 0.0 || v == 0.0 || u == 1.0 || v == 1.0;
    const auto inside = [](double a) { return std::clamp((a - 0.05) / 0.9, 0.0, 1.0); };
    return Vec3{0.1 * inside(u) - 0.05, 0.1 * inside(v) - 0.05,
                at_rim ? 0.0 : 0.004 + 0.003 * std::sin(12.0 * u) * std::sin(9.0 * v)};
  });
  for (const Mesh& mesh : {hall, map}) {
    const auto solid = solid_from_mesh(mesh, kCell_m, {}, {}, kTwoCellWalls);
    ASSERT_TRUE(solid);
    EXPECT_EQ(solid->repair.open_sheets, 0U);
    EXPECT_EQ(solid->repair.closed_holes, 1U);
    DistanceSource::Hint hint;
    EXPECT_LT(solid->distance->at({0.002, 0.003, 0.0005}, hint).distance_m, -0.0004);
  }
}

}  // namespace
}  // namespace palpable::sculpt
