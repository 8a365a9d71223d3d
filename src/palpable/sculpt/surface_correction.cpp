// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/surface_correction.hpp"

#include "palpable/sculpt/point_index.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <queue>
#include <utility>

namespace palpable::sculpt {
namespace {

/// Normals and neighbours of a closed mesh's vertices.
struct Samples {
  std::vector<Vec3> normals;
  std::vector<std::vector<std::uint32_t>> neighbours;
};

Samples samples_of(const Mesh& mesh) {
  Samples s;
  s.normals.resize(mesh.vertices_m.size());
  s.neighbours.resize(mesh.vertices_m.size());
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_m[t[0]];
    const Vec3 twice = cross(mesh.vertices_m[t[1]] - a, mesh.vertices_m[t[2]] - a);
    for (std::size_t k = 0; k < 3; ++k) {
      s.normals[t[k]] += twice;
      // Each edge of a closed mesh runs once in each direction.
      s.neighbours[t[k]].push_back(t[(k + 1) % 3]);
    }
  }
  for (Vec3& n : s.normals) n = unit(n);
  return s;
}

/// Where the line p + t d meets a triangle (Moller & Trumbore 1997), its borders included.
std::optional<double> meets(Vec3 p, Vec3 d, Vec3 a, Vec3 b, Vec3 c) {
  constexpr double kBorder = 1e-9;
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 h = cross(d, ac);
  const double volume = dot(ab, h);
  if (volume == 0.0) return std::nullopt;
  const Vec3 ap = p - a;
  const double u = dot(ap, h) / volume;
  const Vec3 q = cross(ap, ab);
  const double v = dot(d, q) / volume;
  if (u < -kBorder || v < -kBorder || u + v > 1.0 + kBorder) return std::nullopt;
  return dot(ac, q) / volume;
}

/// For each sample the shortest way along its normal to the measured surface, if there is one.
std::vector<std::optional<double>> ways_to(const Mesh& measured, const Mesh& predicted,
                                           const Samples& samples, double reach_m) {
  std::vector<std::optional<double>> ways(predicted.vertices_m.size());
  const PointIndex index(predicted.vertices_m, reach_m);
  const Vec3 beyond{reach_m, reach_m, reach_m};
  for (const auto& t : measured.triangles) {
    const Vec3 a = measured.vertices_m[t[0]];
    const Vec3 b = measured.vertices_m[t[1]];
    const Vec3 c = measured.vertices_m[t[2]];
    const Vec3 least{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})};
    const Vec3 most{std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})};
    index.in_box(least - beyond, most + beyond, [&](std::uint32_t i) {
      const auto way = meets(predicted.vertices_m[i], samples.normals[i], a, b, c);
      if (!way || std::abs(*way) > reach_m) return;
      if (!ways[i] || std::abs(*way) < std::abs(*ways[i])) ways[i] = way;
    });
  }
  return ways;
}

/// Samples within a geodesic distance of one, by a walk over the mesh's edges that ends there. Edges zigzag,
/// so the walk only tells who is connected; the distance itself is the arc over the chord that both normals
/// say, exact on a sphere.
class Geodesic {
 public:
  Geodesic(const Mesh& mesh, const Samples& samples)
      : mesh_(mesh), samples_(samples), walked_(mesh.vertices_m.size(), kFar) {}

  template <class Visit>
  void around(std::uint32_t from, double radius_m, Visit&& visit) {
    constexpr double kZigzag = 1.25;
    using Step = std::pair<double, std::uint32_t>;
    std::priority_queue<Step, std::vector<Step>, std::greater<>> open;
    std::vector<std::uint32_t> seen;
    const auto reach = [&](std::uint32_t i, double walked) {
      if (walked >= walked_[i] || walked > kZigzag * radius_m) return;
      if (walked_[i] == kFar) seen.push_back(i);
      walked_[i] = walked;
      open.push({walked, i});
    };
    reach(from, 0.0);
    while (!open.empty()) {
      const auto [walked, i] = open.top();
      open.pop();
      if (walked > walked_[i]) continue;
      for (const std::uint32_t next : samples_.neighbours[i])
        reach(next, walked + norm(mesh_.vertices_m[next] - mesh_.vertices_m[i]));
    }
    for (const std::uint32_t i : seen) {
      const double distance = arc(from, i);
      if (distance < radius_m) visit(i, distance);
      walked_[i] = kFar;
    }
  }

 private:
  double arc(std::uint32_t a, std::uint32_t b) const {
    const double chord = norm(mesh_.vertices_m[a] - mesh_.vertices_m[b]);
    const double half_sine = 0.5 * norm(samples_.normals[a] - samples_.normals[b]);
    return half_sine > 1e-6 ? chord * std::asin(std::min(half_sine, 1.0)) / half_sine : chord;
  }

  static constexpr double kFar = std::numeric_limits<double>::infinity();
  const Mesh& mesh_;
  const Samples& samples_;
  std::vector<double> walked_;
};

Result<void> check(const Mesh& measured, const CorrectionOptions& options) {
  if (!(options.reach_m > 0.0) || !(options.transition_m > 0.0) || !std::isfinite(options.reach_m) ||
      !std::isfinite(options.transition_m))
    return Error{ErrorCode::usage, "a correction's reach and transition must be above 0", {}};
  if (!std::all_of(measured.vertices_m.begin(), measured.vertices_m.end(),
                   [](Vec3 v) { return is_finite(v); }))
    return invalid_input("a vertex of the measured surface is not a finite number");
  for (const auto& t : measured.triangles)
    if (std::max({t[0], t[1], t[2]}) >= measured.vertices_m.size())
      return invalid_input("a triangle of the measured surface names a vertex that does not exist");
  return {};
}

/// Eq. 2 at one sample outside W.
Vec3 transition(std::uint32_t y, const CorrectedSurface& s, Geodesic& geodesic, double delta_m) {
  Vec3 sum;
  double weights = 0.0;
  double nearest = delta_m;
  geodesic.around(y, delta_m, [&](std::uint32_t x, double distance_m) {
    if (!s.measured[x]) return;
    const double w = (delta_m - distance_m) / (delta_m * distance_m);
    sum += w * w * s.translations_m[x];
    weights += w * w;
    nearest = std::min(nearest, distance_m);
  });
  if (weights == 0.0) return {};
  const double u = nearest / delta_m;
  return (1.0 - u * u * (3.0 - 2.0 * u)) / weights * sum;
}

}  // namespace

Mesh CorrectedSurface::adapted() const {
  Mesh mesh = predicted;
  for (std::size_t i = 0; i < translations_m.size(); ++i) mesh.vertices_m[i] += translations_m[i];
  return mesh;
}

Mesh CorrectedSurface::changed() const {
  std::vector<bool> is_moved(predicted.vertices_m.size());
  for (const Moved& m : moved) is_moved[m.sample] = true;
  Mesh now;
  std::vector<std::uint32_t> place(predicted.vertices_m.size(), std::numeric_limits<std::uint32_t>::max());
  for (auto t : predicted.triangles) {
    if (std::none_of(t.begin(), t.end(), [&](std::uint32_t i) { return is_moved[i]; })) continue;
    for (std::uint32_t& i : t) {
      if (place[i] == std::numeric_limits<std::uint32_t>::max()) {
        place[i] = static_cast<std::uint32_t>(now.vertices_m.size());
        now.vertices_m.push_back(predicted.vertices_m[i] + translations_m[i]);
      }
      i = place[i];
    }
    now.triangles.push_back(t);
  }
  // The same triangles once more, with what moved at its place before.
  const auto vertices = static_cast<std::uint32_t>(now.vertices_m.size());
  const std::size_t triangles = now.triangles.size();
  now.vertices_m.resize(2 * std::size_t{vertices});
  std::copy_n(now.vertices_m.begin(), vertices, now.vertices_m.begin() + vertices);
  for (const Moved& m : moved)
    if (place[m.sample] < vertices)
      now.vertices_m[vertices + place[m.sample]] = predicted.vertices_m[m.sample] + m.before_m;
  for (std::size_t k = 0; k < triangles; ++k) {
    const auto t = now.triangles[k];
    now.triangles.push_back({t[0] + vertices, t[1] + vertices, t[2] + vertices});
  }
  return now;
}

Result<CorrectedSurface> predicted_surface(Mesh mesh) {
  if (!is_watertight(mesh)) return invalid_input("a predicted surface must be closed");
  CorrectedSurface s;
  s.translations_m.resize(mesh.vertices_m.size());
  s.measured.resize(mesh.vertices_m.size());
  s.predicted = std::move(mesh);
  return s;
}

Result<CorrectedSurface> correct_surface(CorrectedSurface s, const Mesh& measured,
                                         const CorrectionOptions& options, const Work& work) {
  if (auto sound = check(measured, options); !sound) return std::move(sound).error();
  s.moved.clear();
  const Samples samples = samples_of(s.predicted);
  work.report(0.1, "meeting the measured surface");
  const auto ways = ways_to(measured, s.predicted, samples, options.reach_m);
  const auto move_to = [&](std::size_t i, Vec3 translation) {
    if (s.translations_m[i] == translation) return;
    s.moved.push_back({static_cast<std::uint32_t>(i), s.translations_m[i]});
    s.translations_m[i] = translation;
  };
  std::vector<std::uint32_t> pulled;
  for (std::uint32_t i = 0; i < ways.size(); ++i) {
    if (!ways[i]) continue;
    s.measured[i] = true;
    move_to(i, *ways[i] * samples.normals[i]);
    pulled.push_back(i);
  }
  if (work.cancelled()) return Work::interrupted();
  work.report(0.5, "following around it");
  Geodesic geodesic(s.predicted, samples);
  std::vector<bool> follows(s.measured.size());
  // What follows is reached from what was pulled across its border: samples with a neighbour that was not.
  const auto at_border = [&](std::uint32_t i) {
    const auto& around = samples.neighbours[i];
    return std::any_of(around.begin(), around.end(), [&](std::uint32_t n) { return !ways[n]; });
  };
  std::erase_if(pulled, [&](std::uint32_t i) { return !at_border(i); });
  for (const std::uint32_t i : pulled)
    geodesic.around(i, options.transition_m, [&](std::uint32_t y, double) {
      if (!s.measured[y]) follows[y] = true;
    });
  for (std::uint32_t y = 0; y < follows.size(); ++y)
    if (follows[y]) move_to(y, transition(y, s, geodesic, options.transition_m));
  if (work.cancelled()) return Work::interrupted();
  return s;
}

}  // namespace palpable::sculpt
