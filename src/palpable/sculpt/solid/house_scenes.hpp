// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Random models of houses whose walls have no floor and no ceiling of their own: they stand on or in plates
// and under roofs. All of their parts are solid. For tests.

#include "palpable/sculpt/solid/sheet_scenes.hpp"
#include "palpable/sculpt/solid/test_solids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace palpable::sculpt {

/// A convex solid as the half-spaces that it lies in.
struct ConvexHull {
  struct Face {
    Vec3 normal;
    double offset_m = 0.0;
  };
  std::vector<Face> faces;

  void add_face(Vec3 normal, Vec3 place) { faces.push_back({unit(normal), dot(unit(normal), place)}); }
  /// Exact inside; outside at most the distance.
  double distance(Vec3 p) const {
    double most_m = -std::numeric_limits<double>::infinity();
    for (const Face& face : faces) most_m = std::max(most_m, dot(face.normal, p) - face.offset_m);
    return most_m;
  }
};

struct HouseScene {
  Mesh mesh;
  /// Nothing is solid outside of them, and all is within them, but for niches of this depth.
  std::vector<ConvexHull> hulls;
  double niches_m = 0.0;
  std::string words;

  double hull_distance(Vec3 p) const {
    double least_m = std::numeric_limits<double>::infinity();
    for (const ConvexHull& hull : hulls) least_m = std::min(least_m, hull.distance(p));
    return least_m;
  }
};

class HouseMaker {
 public:
  explicit HouseMaker(std::uint64_t seed) : random_(seed) {}

  HouseScene scene() {
    HouseScene scene;
    const int houses = whole(1, 2);
    for (int k = 0; k < houses; ++k) add_house(scene, {0.06 * k, 0.0, 0.0});
    // Files of games often have walls that face inwards.
    const int turned = whole(0, 3);
    for (auto& t : scene.mesh.triangles)
      if (turned == 0 || (turned == 1 && whole(0, 9) == 0)) std::swap(t[1], t[2]);
    return scene;
  }

 private:
  using Outline = std::vector<Vec3>;

  double between(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random_);
  }
  int whole(int least, int most) { return std::uniform_int_distribution<int>(least, most)(random_); }
  double mm(int least, int most) { return 1e-3 * whole(least, most); }

  /// Places that are the same but for rounding become the same.
  static void add(HouseScene& scene, Mesh mesh) {
    constexpr double kSame_m = 1e-9;
    for (std::size_t k = 0; k < mesh.vertices_m.size(); ++k) {
      Vec3& v = mesh.vertices_m[k];
      const auto is_here = [&](Vec3 other) { return squared_norm(other - v) < kSame_m * kSame_m; };
      const auto own_end = mesh.vertices_m.begin() + static_cast<std::ptrdiff_t>(k);
      const auto own = std::find_if(mesh.vertices_m.begin(), own_end, is_here);
      const auto given = std::find_if(scene.mesh.vertices_m.begin(), scene.mesh.vertices_m.end(), is_here);
      if (given != scene.mesh.vertices_m.end())
        v = *given;
      else if (own != own_end)
        v = *own;
    }
    scene.mesh = together(std::move(scene.mesh), mesh);
  }

  static Mesh quad(Vec3 corner, Vec3 u, Vec3 v, std::uint32_t columns = 1, std::uint32_t rows = 1) {
    return grid_sheet(columns, rows, [&](double a, double b) { return corner + a * u + b * v; });
  }

  /// A rectangle, or a regular polygon; counter-clockwise, at height 0.
  Outline outline(Vec3 at) {
    Outline corners;
    if (whole(0, 2) > 0) {
      const double x = mm(6, 20), y = mm(6, 20);
      corners = {at + Vec3{-x, -y, 0}, at + Vec3{x, -y, 0}, at + Vec3{x, y, 0}, at + Vec3{-x, y, 0}};
      return corners;
    }
    const int count = whole(3, 8);
    const double radius_m = mm(8, 20), turn = between(0.0, 6.0);
    for (int k = 0; k < count; ++k) {
      const double angle = turn + 2.0 * std::numbers::pi * k / count;
      corners.push_back(at + radius_m * Vec3{std::cos(angle), std::sin(angle), 0.0});
    }
    return corners;
  }

  static ConvexHull prism_hull(const Outline& corners, double low_m, double high_m) {
    ConvexHull hull;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3 way = corners[(k + 1) % corners.size()] - corners[k];
      hull.add_face({way.y, -way.x, 0.0}, corners[k]);
    }
    hull.add_face({0, 0, 1}, {0, 0, high_m});
    hull.add_face({0, 0, -1}, {0, 0, low_m});
    return hull;
  }

  void add_box(HouseScene& scene, Vec3 low, Vec3 high) {
    add(scene, box_mesh(low, high));
    scene.hulls.push_back(
        prism_hull({low, {high.x, low.y, 0}, {high.x, high.y, 0}, {low.x, high.y, 0}}, low.z, high.z));
  }

  /// How the rim meets another part: it touches it, sinks into it, or hovers by less than a cell.
  double sunk_m(std::string& words) {
    switch (whole(0, 2)) {
      case 0:
        words += "touching ";
        return 0.0;
      case 1:
        words += "sunk ";
        return between(0.1e-3, 1.5e-3);
      default:
        words += "hovering ";
        return -between(0.02, 0.8) * kCell_m;
    }
  }

  /// A plate or roof of the outline's box, as large or larger, from `low_m` to `high_m`.
  void add_slab(HouseScene& scene, const Outline& corners, double low_m, double high_m) {
    const Box box = bounds_of(std::span<const Vec3>(corners));
    const double beyond_m = whole(0, 2) == 0 ? 0.0 : mm(1, 5);
    const Vec3 low{box.least_m.x - beyond_m, box.least_m.y - beyond_m, low_m},
        high{box.most_m.x + beyond_m, box.most_m.y + beyond_m, high_m};
    scene.words += beyond_m == 0.0 ? "flush slab, " : "slab, ";
    add_box(scene, low, high);
  }

  /// A pyramid on a slab of 2 mm, as large as the outline's box or larger.
  void add_pyramid(HouseScene& scene, const Outline& corners, double low_m, double high_m) {
    constexpr double kEaves_m = 2e-3;
    const Box box = bounds_of(std::span<const Vec3>(corners));
    const double beyond_m = mm(0, 4);
    const Vec3 least{box.least_m.x - beyond_m, box.least_m.y - beyond_m, low_m},
        most{box.most_m.x + beyond_m, box.most_m.y + beyond_m, low_m + kEaves_m};
    const Vec3 middle = 0.5 * (least + most), top{middle.x, middle.y, high_m + kEaves_m};
    Mesh mesh = box_mesh(least, most);
    // Its upper face is replaced by four that rise to the top.
    std::erase_if(mesh.triangles, [&](const auto& t) {
      return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return mesh.vertices_m[v].z == most.z; });
    });
    mesh.vertices_m.push_back(top);
    for (const auto& t : {std::array{4U, 5U, 8U}, {5U, 7U, 8U}, {7U, 6U, 8U}, {6U, 4U, 8U}})
      mesh.triangles.push_back(t);
    ConvexHull hull =
        prism_hull({least, {most.x, least.y, 0}, {most.x, most.y, 0}, {least.x, most.y, 0}}, least.z, top.z);
    for (std::size_t k = mesh.triangles.size() - 4; k < mesh.triangles.size(); ++k) {
      const auto& t = mesh.triangles[k];
      const Vec3 a = mesh.vertices_m[t[0]];
      hull.add_face(cross(mesh.vertices_m[t[1]] - a, mesh.vertices_m[t[2]] - a), a);
    }
    add(scene, std::move(mesh));
    scene.hulls.push_back(std::move(hull));
    scene.words += "pyramid, ";
  }

  /// A niche in a wall's cell: its sides and its back.
  static Mesh niche(Vec3 corner, Vec3 u, Vec3 v, Vec3 inwards) {
    Mesh mesh = quad(corner + inwards, u, v);
    for (const auto& [from, along] :
         {std::pair{corner, u}, {corner + u, v}, {corner + u + v, -u}, {corner + v, -v}})
      mesh = together(std::move(mesh), quad(from, along, inwards));
    return mesh;
  }

  /// A box before a wall without the face towards it.
  void add_bay(HouseScene& scene, Vec3 corner, Vec3 u, Vec3 v, Vec3 outwards) {
    Mesh mesh = quad(corner + outwards, u, v);
    for (const auto& [from, along] :
         {std::pair{corner, u}, {corner + u, v}, {corner + u + v, -u}, {corner + v, -v}})
      mesh = together(std::move(mesh), quad(from, outwards, along));
    add(scene, mesh);
    ConvexHull hull;
    hull.add_face(outwards, corner + outwards);
    hull.add_face(-outwards, corner);
    hull.add_face(u, corner + u);
    hull.add_face(-u, corner);
    hull.add_face(v, corner + v);
    hull.add_face(-v, corner);
    scene.hulls.push_back(std::move(hull));
    scene.words += "bay, ";
  }

  /// The walls over an outline, without a floor or a ceiling, with niches. Neighbouring walls may be divided
  /// differently.
  void add_walls(HouseScene& scene, const Outline& corners, double low_m, double high_m) {
    const auto rows = static_cast<std::uint32_t>(whole(1, 3));
    const bool has_slits = whole(0, 3) == 0, has_niches = whole(0, 1) == 0;
    const Vec3 up{0, 0, high_m - low_m};
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3 from = corners[k] + Vec3{0, 0, low_m}, way = corners[(k + 1) % corners.size()] - corners[k];
      const auto columns = static_cast<std::uint32_t>(whole(1, 4)),
                 own_rows = has_slits ? static_cast<std::uint32_t>(whole(1, 3)) : rows;
      const Vec3 u = way / columns, v = up / own_rows, out = unit({way.y, -way.x, 0.0});
      Mesh wall = quad(from, way, up, columns, own_rows);
      const bool is_inner = columns >= 3 && own_rows == 3 && has_niches;
      if (is_inner) {
        // The middle row's second cell.
        const std::size_t first = 2 * (static_cast<std::size_t>(columns) + 1);
        wall.triangles.erase(wall.triangles.begin() + static_cast<std::ptrdiff_t>(first),
                             wall.triangles.begin() + static_cast<std::ptrdiff_t>(first) + 2);
        constexpr double kDepth_m = 1.2e-3;
        wall = together(std::move(wall), niche(from + u + v, u, v, -kDepth_m * out));
        scene.niches_m = std::max(scene.niches_m, kDepth_m);
        scene.words += "niche, ";
      } else if (whole(0, 3) == 0) {
        add_bay(scene, from + 0.2 * way + 0.3 * up, 0.5 * way, 0.4 * up, mm(1, 2) * out);
      }
      add(scene, wall);
    }
    scene.words += std::to_string(corners.size()) + (has_slits ? " walls with slits, " : " walls, ");
    scene.hulls.push_back(prism_hull(corners, low_m, high_m));
  }

  void add_house(HouseScene& scene, Vec3 at) {
    const Outline corners = outline(at);
    const double plate_m = mm(2, 4), sunk_below_m = sunk_m(scene.words);
    add_slab(scene, corners, 0.0, plate_m);
    double low_m = plate_m - sunk_below_m;
    const int storeys = whole(1, 2);
    for (int storey = 0; storey < storeys; ++storey) {
      const double high_m = low_m + mm(5, 20);
      add_walls(scene, corners, low_m, high_m);
      // A floor inside, that nobody sees.
      if (whole(0, 3) == 0 && corners.size() == 4) {
        const Vec3 inner = corners[0] + Vec3{0, 0, 0.5 * (low_m + high_m)};
        add(scene, quad(inner, corners[1] - corners[0], corners[3] - corners[0]));
        scene.words += "floor inside, ";
      }
      low_m = high_m;
    }
    const double roof_m = low_m - sunk_m(scene.words);
    if (whole(0, 1) == 0)
      add_slab(scene, corners, roof_m, roof_m + mm(2, 5));
    else
      add_pyramid(scene, corners, roof_m, roof_m + mm(4, 12));
  }

  std::mt19937_64 random_;
};

}  // namespace palpable::sculpt
