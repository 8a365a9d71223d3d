// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "scanned_meshes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <vector>

namespace palpable::bench {
namespace {

/// Value noise in space: trilinear interpolation between random values at lattice points, -1 ... 1.
class SpaceNoise {
 public:
  explicit SpaceNoise(std::uint32_t seed) : seed_(seed) {}
  double at(Vec3 p) const {
    const auto x = split(p.x), y = split(p.y), z = split(p.z);
    double sum = 0.0;
    for (unsigned k = 0; k < 8; ++k) {
      const auto along = [k](const Part& part, unsigned bit) {
        return (k & bit) != 0 ? part.share : 1.0 - part.share;
      };
      sum += along(x, 1) * along(y, 2) * along(z, 4) *
             value(x.cell + (k & 1 ? 1 : 0), y.cell + (k & 2 ? 1 : 0), z.cell + (k & 4 ? 1 : 0));
    }
    return sum;
  }

 private:
  struct Part {
    int cell;
    double share;
  };
  static Part split(double v) {
    const double below = std::floor(v), t = v - below;
    return {static_cast<int>(below), t * t * (3.0 - 2.0 * t)};
  }
  double value(int x, int y, int z) const {
    std::uint32_t h = seed_;
    for (const int v : {x, y, z}) {
      h = (h ^ static_cast<std::uint32_t>(v)) * 0x9E3779B1U;
      h ^= h >> 15U;
    }
    return static_cast<double>(h) / 2147483648.0 - 1.0;
  }
  std::uint32_t seed_;
};

/// The six sides of a cube from -1 to 1, each n x n squares of two triangles, with shared vertices.
Mesh cube_grid(int n) {
  Mesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> known;
  const auto vertex = [&](std::array<int, 3> p) {
    const auto [at, fresh] = known.try_emplace(p, static_cast<std::uint32_t>(mesh.vertices_m.size()));
    if (fresh) mesh.vertices_m.push_back({2.0 * p[0] / n - 1.0, 2.0 * p[1] / n - 1.0, 2.0 * p[2] / n - 1.0});
    return at->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const bool upper : {false, true})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int a, int b) {
            std::array<int, 3> p{};
            p[axis] = upper ? n : 0;
            p[(axis + 1) % 3] = i + a;
            p[(axis + 2) % 3] = j + b;
            return vertex(p);
          };
          std::array<std::uint32_t, 4> q{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
          if (!upper) std::swap(q[1], q[3]);
          mesh.triangles.push_back({q[0], q[1], q[2]});
          mesh.triangles.push_back({q[0], q[2], q[3]});
        }
  return mesh;
}

/// Projects the vertices of a cube's grid, evenly spaced in angle, onto a star-shaped surface.
Mesh star(int triangles, const std::function<double(Vec3 direction)>& radius) {
  const int n = std::max(2, static_cast<int>(std::lround(std::sqrt(triangles / 12.0))));
  Mesh mesh = cube_grid(n);
  constexpr double kQuarter = 0.7853981633974483;
  for (Vec3& v : mesh.vertices_m) {
    const Vec3 direction =
        unit(Vec3{std::tan(kQuarter * v.x), std::tan(kQuarter * v.y), std::tan(kQuarter * v.z)});
    v = radius(direction) * direction;
  }
  return mesh;
}

Mesh noisy_ball(std::uint32_t seed, int triangles) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  // Relative to a facet's side: the noise of a scanner.
  const double share = std::uniform_real_distribution<double>(0.02, 0.08)(random);
  const double side = std::sqrt(8.0 * 3.1416 / triangles);
  return star(triangles, [&](Vec3 /*direction*/) { return 1.0 + share * side * normal(random); });
}

Mesh bumpy_superquadric(std::uint32_t seed, int triangles) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal;
  const double e = 0.5 + 0.7 * uniform(random), flat = 0.6 + 0.4 * uniform(random);
  const double bumps = 12.0 + 12.0 * uniform(random), high = (0.1 + 0.1 * uniform(random)) / bumps;
  const double side = std::sqrt(8.0 * 3.1416 / triangles);
  const SpaceNoise noise(seed);
  return star(triangles, [&](Vec3 d) {
    const double sum = std::pow(std::abs(d.x), 2.0 / e) + std::pow(std::abs(d.y), 2.0 / e) +
                       std::pow(std::abs(d.z / flat), 2.0 / e);
    return std::pow(sum, -0.5 * e) * (1.0 + high * noise.at(bumps * d) + 0.01 * side * normal(random));
  });
}

/// A grid of heights with walls down to a flat base.
Mesh terrain(std::uint32_t seed, int triangles) {
  const int n = std::max(2, static_cast<int>(std::lround(std::sqrt(triangles / 2.0))));
  const SpaceNoise noise(seed);
  std::mt19937 random(seed);
  const double rough = std::uniform_real_distribution<double>(0.42, 0.55)(random);
  Mesh mesh;
  const auto index = [n](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      double height = 0.0, amplitude = 0.25;
      const double x = 2.0 * i / n - 1.0, y = 2.0 * j / n - 1.0;
      for (double frequency = 2.0; frequency < 0.5 * n; frequency *= 2.0, amplitude *= rough)
        height += amplitude * noise.at({frequency * x, frequency * y, frequency});
      mesh.vertices_m.push_back({x, y, height});
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      mesh.triangles.push_back({index(i, j), index(i + 1, j), index(i + 1, j + 1)});
      mesh.triangles.push_back({index(i, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  // Around the rim, counter-clockwise seen from above.
  std::vector<std::uint32_t> rim;
  for (int i = 0; i < n; ++i) rim.push_back(index(i, 0));
  for (int j = 0; j < n; ++j) rim.push_back(index(n, j));
  for (int i = n; i > 0; --i) rim.push_back(index(i, n));
  for (int j = n; j > 0; --j) rim.push_back(index(0, j));
  constexpr double kBase = -0.8;
  const auto base = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (const std::uint32_t v : rim)
    mesh.vertices_m.push_back({mesh.vertices_m[v].x, mesh.vertices_m[v].y, kBase});
  const auto middle = static_cast<std::uint32_t>(mesh.vertices_m.size());
  mesh.vertices_m.push_back({0.0, 0.0, kBase});
  for (std::uint32_t k = 0; k < rim.size(); ++k) {
    const auto next = static_cast<std::uint32_t>((k + 1) % rim.size());
    mesh.triangles.push_back({rim[k], base + k, base + next});
    mesh.triangles.push_back({rim[k], base + next, rim[next]});
    mesh.triangles.push_back({middle, base + next, base + k});
  }
  return mesh;
}

/// A sculpted body with three balls that sink into it, such as the eyes of a head; no noise.
Mesh overlapping_bodies(std::uint32_t seed, int triangles) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const SpaceNoise noise(seed);
  const double bumps = 2.0 + 3.0 * uniform(random), high = 0.3 / bumps;
  const auto radius = [&](Vec3 d) { return 1.0 + high * noise.at(bumps * d); };
  Mesh mesh = star(7 * triangles / 10, radius);
  for (int i = 0; i < 3; ++i) {
    const Vec3 d = unit(Vec3{uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5});
    const double size = 0.15 + 0.25 * uniform(random);
    const Mesh ball = star(triangles / 10, [&](Vec3 /*direction*/) { return size; });
    const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (const Vec3 v : ball.vertices_m) mesh.vertices_m.push_back(v + radius(d) * d);
    for (const auto& t : ball.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return mesh;
}

void scale_to(Mesh& mesh, double longest_m) {
  Vec3 least = mesh.vertices_m.front(), most = least;
  for (const Vec3 v : mesh.vertices_m) {
    least = {std::min(least.x, v.x), std::min(least.y, v.y), std::min(least.z, v.z)};
    most = {std::max(most.x, v.x), std::max(most.y, v.y), std::max(most.z, v.z)};
  }
  const Vec3 size = most - least, middle = 0.5 * (least + most);
  const double scale = longest_m / std::max({size.x, size.y, size.z});
  for (Vec3& v : mesh.vertices_m) v = scale * (v - middle);
}

}  // namespace

std::string_view name_of(ScannedKind kind) {
  switch (kind) {
    case ScannedKind::noisy_ball:
      return "noisy ball";
    case ScannedKind::bumpy_superquadric:
      return "bumpy superquadric";
    case ScannedKind::terrain:
      return "terrain";
    case ScannedKind::overlapping_bodies:
      return "overlapping bodies";
  }
  return "";
}

Mesh scanned_mesh(ScannedKind kind, std::uint32_t seed, int triangles, double longest_m) {
  Mesh mesh;
  switch (kind) {
    case ScannedKind::noisy_ball:
      mesh = noisy_ball(seed, triangles);
      break;
    case ScannedKind::bumpy_superquadric:
      mesh = bumpy_superquadric(seed, triangles);
      break;
    case ScannedKind::terrain:
      mesh = terrain(seed, triangles);
      break;
    case ScannedKind::overlapping_bodies:
      mesh = overlapping_bodies(seed, triangles);
      break;
  }
  scale_to(mesh, longest_m);
  return mesh;
}

}  // namespace palpable::bench
