// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sculpt/solid/sheet_scene.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>

namespace palpable::sculpt {

/// Adds random bodies and open sheets to scenes. For tests.
class SceneParts {
 public:
  explicit SceneParts(std::uint64_t seed) : random_(seed) {}

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

 protected:
  std::mt19937_64 random_;
};

}  // namespace palpable::sculpt
