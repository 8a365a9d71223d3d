// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/correction/surface_correction.hpp"

#include "palpable/sculpt/triangles/box.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace palpable::sculpt {

struct SampleNetwork {
  struct Way {
    std::uint32_t to = 0;
    double length_m = 0.0;
  };
  std::vector<Vec3> normals;
  /// Sample i's neighbours are ways[begin[i]] ... ways[begin[i + 1] - 1].
  std::vector<std::uint32_t> begin;
  std::vector<Way> ways;

  std::span<const Way> from(std::uint32_t i) const {
    return {ways.data() + begin[i], begin[i + 1] - begin[i]};
  }
};

namespace {

SampleNetwork network_of(const Mesh& mesh) {
  SampleNetwork n;
  n.normals.resize(mesh.vertices_m.size());
  n.begin.resize(mesh.vertices_m.size() + 1);
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_m[t[0]];
    const Vec3 twice = cross(mesh.vertices_m[t[1]] - a, mesh.vertices_m[t[2]] - a);
    for (const std::uint32_t i : t) {
      n.normals[i] += twice;
      // Each edge of a closed mesh runs once in each direction.
      ++n.begin[i + 1];
    }
  }
  for (Vec3& normal : n.normals) normal = unit(normal);
  for (std::size_t i = 1; i < n.begin.size(); ++i) n.begin[i] += n.begin[i - 1];
  n.ways.resize(3 * mesh.triangles.size());
  std::vector<std::uint32_t> next(n.begin.begin(), n.begin.end() - 1);
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      n.ways[next[a]++] = {b, norm(mesh.vertices_m[b] - mesh.vertices_m[a])};
    }
  return n;
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
std::vector<std::optional<double>> ways_to(const Mesh& measured, const CorrectedSurface& surface,
                                           double reach_m, const Work& work) {
  const std::vector<Vec3>& samples = surface.predicted.vertices_m;
  std::vector<std::optional<double>> ways(samples.size());
  if (measured.triangles.empty()) return ways;
  const TriangleTree tree(measured);
  const Box whole = tree.bounds();
  // A measured surface is a small part: only samples near it are looked at.
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < samples.size(); ++i) {
    const Vec3 low = samples[i] - whole.least_m, high = whole.most_m - samples[i];
    if (std::min({low.x, low.y, low.z, high.x, high.y, high.z}) >= -reach_m) near.push_back(i);
  }
  constexpr int kGrain = 64;
  parallel_for(work, static_cast<int>(near.size()), kGrain, [&](int begin, int end) {
    for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
      const std::uint32_t i = near[k];
      const Vec3 normal = surface.network->normals[i];
      const std::array ends{samples[i] - reach_m * normal, samples[i] + reach_m * normal};
      const Box box = bounds_of(std::span<const Vec3>(ends));
      std::optional<double> shortest;
      tree.visit_box(box.least_m, box.most_m, [&](std::uint32_t t) {
        const auto& c = measured.triangles[t];
        const auto way = meets(samples[i], normal, measured.vertices_m[c[0]], measured.vertices_m[c[1]],
                               measured.vertices_m[c[2]]);
        if (!way || std::abs(*way) > reach_m) return;
        if (!shortest || std::abs(*way) < std::abs(*shortest)) shortest = way;
      });
      ways[i] = shortest;
    }
  });
  return ways;
}

/// Samples within a geodesic distance of one, by a walk over the mesh's edges that ends there. Edges zigzag,
/// so the walk only tells who is connected; the distance itself is the arc over the chord that both normals
/// say, exact on a sphere.
class Geodesic {
 public:
  explicit Geodesic(const CorrectedSurface& surface)
      : places_m_(surface.predicted.vertices_m),
        network_(*surface.network),
        walked_(places_m_.size(), kFar) {}

  /// Calls visit(sample) for those that may be within the radius: distance_m() tells.
  template <class Visit>
  void around(std::uint32_t from, double radius_m, Visit&& visit) {
    constexpr double kZigzag = 1.25;
    const auto reach = [&](std::uint32_t i, double walked) {
      if (walked >= walked_[i] || walked > kZigzag * radius_m) return;
      if (walked_[i] == kFar) seen_.push_back(i);
      walked_[i] = walked;
      open_.push_back({i, walked});
    };
    reach(from, 0.0);
    // Edges are about as long as each other: few are walked twice, first come first served.
    for (std::size_t k = 0; k < open_.size(); ++k) {
      const SampleNetwork::Way here = open_[k];
      if (here.length_m > walked_[here.to]) continue;
      for (const SampleNetwork::Way& way : network_.from(here.to))
        reach(way.to, here.length_m + way.length_m);
    }
    for (const std::uint32_t i : seen_) {
      if (squared_norm(places_m_[from] - places_m_[i]) < radius_m * radius_m) visit(i);
      walked_[i] = kFar;
    }
    seen_.clear();
    open_.clear();
  }

  double distance_m(std::uint32_t a, std::uint32_t b) const {
    const double chord = norm(places_m_[a] - places_m_[b]);
    const double half_sine = 0.5 * norm(network_.normals[a] - network_.normals[b]);
    return half_sine > 1e-6 ? chord * std::asin(std::min(half_sine, 1.0)) / half_sine : chord;
  }

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  const std::vector<Vec3>& places_m_;
  const SampleNetwork& network_;
  std::vector<double> walked_;
  std::vector<std::uint32_t> seen_;
  std::vector<SampleNetwork::Way> open_;
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
  geodesic.around(y, delta_m, [&](std::uint32_t x) {
    if (!s.measured[x]) return;
    const double distance_m = geodesic.distance_m(x, y);
    if (distance_m >= delta_m) return;
    const double w = (delta_m - distance_m) / (delta_m * distance_m);
    sum += w * w * s.translations_m[x];
    weights += w * w;
    nearest = std::min(nearest, distance_m);
  });
  if (weights == 0.0) return {};
  const double u = nearest / delta_m;
  return (1.0 - u * u * u * (10.0 - u * (15.0 - 6.0 * u))) / weights * sum;
}

}  // namespace

Mesh CorrectedSurface::adapted() const {
  Mesh mesh = predicted;
  for (std::size_t i = 0; i < translations_m.size(); ++i) mesh.vertices_m[i] += translations_m[i];
  return mesh;
}

Mesh CorrectedSurface::changed() const {
  // What moved, and two rings around it: its triangles, and those with a corner in common.
  std::vector<bool> is_near(predicted.vertices_m.size());
  for (const Moved& m : moved) {
    is_near[m.sample] = true;
    for (const SampleNetwork::Way& way : network->from(m.sample)) is_near[way.to] = true;
  }
  Mesh now;
  std::vector<std::uint32_t> place(predicted.vertices_m.size(), std::numeric_limits<std::uint32_t>::max());
  for (auto t : predicted.triangles) {
    if (std::none_of(t.begin(), t.end(), [&](std::uint32_t i) { return is_near[i]; })) continue;
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

Mesh CorrectedSurface::pulled_surface() const {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  Mesh mesh;
  std::vector<std::uint32_t> place(predicted.vertices_m.size(), kNone);
  for (const std::uint32_t i : pulled) {
    place[i] = static_cast<std::uint32_t>(mesh.vertices_m.size());
    mesh.vertices_m.push_back(predicted.vertices_m[i] + translations_m[i]);
  }
  std::vector<bool> lone(pulled.size(), true);
  for (const auto& t : predicted.triangles) {
    const std::array<std::uint32_t, 3> at{place[t[0]], place[t[1]], place[t[2]]};
    if (std::find(at.begin(), at.end(), kNone) != at.end()) continue;
    mesh.triangles.push_back(at);
    for (const std::uint32_t i : at) lone[i] = false;
  }
  for (std::uint32_t i = 0; i < lone.size(); ++i)
    if (lone[i]) mesh.triangles.push_back({i, i, i});
  return mesh;
}

double CorrectedSurface::greatest_step_m() const {
  double greatest2 = 0.0;
  for (const Moved& m : moved)
    greatest2 = std::max(greatest2, squared_norm(translations_m[m.sample] - m.before_m));
  return std::sqrt(greatest2);
}

Result<CorrectedSurface> predicted_surface(Mesh mesh) {
  if (!is_watertight(mesh)) return invalid_input("a predicted surface must be closed");
  CorrectedSurface s;
  s.translations_m.resize(mesh.vertices_m.size());
  s.measured.resize(mesh.vertices_m.size());
  s.network = std::make_shared<const SampleNetwork>(network_of(mesh));
  s.predicted = std::move(mesh);
  return s;
}

Result<CorrectedSurface> correct_surface(CorrectedSurface s, const Mesh& measured,
                                         const CorrectionOptions& options, const Work& work) {
  if (auto valid = check(measured, options); !valid) return std::move(valid).error();
  s.moved.clear();
  const SampleNetwork& network = *s.network;
  work.report(0.1, "meeting the measured surface");
  const auto ways = ways_to(measured, s, options.reach_m, work);
  const auto move_to = [&](std::size_t i, Vec3 translation) {
    if (s.translations_m[i] == translation) return;
    s.moved.push_back({static_cast<std::uint32_t>(i), s.translations_m[i]});
    s.translations_m[i] = translation;
  };
  s.pulled.clear();
  for (std::uint32_t i = 0; i < ways.size(); ++i) {
    if (!ways[i]) continue;
    s.measured[i] = true;
    move_to(i, *ways[i] * network.normals[i]);
    s.pulled.push_back(i);
  }
  if (work.cancelled()) return Work::interrupted();
  work.report(0.5, "following around it");
  // What follows is reached from what was pulled across its border: samples with a neighbour that was not.
  const auto at_border = [&](std::uint32_t i) {
    const auto around = network.from(i);
    return std::any_of(around.begin(), around.end(), [&](const auto& way) { return !ways[way.to]; });
  };
  std::vector<std::uint32_t> border;
  std::copy_if(s.pulled.begin(), s.pulled.end(), std::back_inserter(border), at_border);
  std::vector<std::uint32_t> follows;
  {
    Geodesic geodesic(s);
    std::vector<bool> known = s.measured;
    for (const std::uint32_t i : border)
      geodesic.around(i, options.transition_m, [&](std::uint32_t y) {
        if (known[y] || geodesic.distance_m(i, y) >= options.transition_m) return;
        known[y] = true;
        follows.push_back(y);
      });
  }
  std::sort(follows.begin(), follows.end());
  std::vector<Vec3> translations(follows.size());
  constexpr int kGrain = 256;
  parallel_for(work, static_cast<int>(follows.size()), kGrain, [&](int begin, int end) {
    Geodesic geodesic(s);
    for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k)
      translations[k] = transition(follows[k], s, geodesic, options.transition_m);
  });
  for (std::size_t k = 0; k < follows.size(); ++k) move_to(follows[k], translations[k]);
  if (work.cancelled()) return Work::interrupted();
  return s;
}

}  // namespace palpable::sculpt
