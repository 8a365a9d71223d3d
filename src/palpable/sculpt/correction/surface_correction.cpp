// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/correction/surface_correction.hpp"

#include "palpable/sculpt/correction/surface_geodesic.hpp"
#include "palpable/sculpt/triangles/box.hpp"
#include "palpable/sculpt/triangles/pinched_edges.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

namespace palpable::sculpt {
namespace {

constexpr double kRadian = std::numbers::pi / 180.0;

Vec3 normal_of(const Mesh& mesh, const std::array<std::uint32_t, 3>& t) {
  const Vec3 a = mesh.vertices_m[t[0]];
  return unit(cross(mesh.vertices_m[t[1]] - a, mesh.vertices_m[t[2]] - a));
}

/// The parameter t at which the line p + t d meets a triangle, border included (Moller & Trumbore
/// 1997).
std::optional<double> intersection(Vec3 p, Vec3 d, Vec3 a, Vec3 b, Vec3 c) {
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

/// For each sample the shortest signed distance along its normal to the measured surface, if there is one.
std::vector<std::optional<double>> distances_along_normals(const Mesh& measured,
                                                           const CorrectedSurface& surface,
                                                           const CorrectionOptions& options,
                                                           const Work& work) {
  const double reach_m = options.reach_m;
  const double least_cosine = std::cos(options.most_match_angle_deg * kRadian);
  const std::vector<Vec3>& samples = surface.predicted.vertices_m;
  std::vector<std::optional<double>> distances(samples.size());
  if (measured.triangles.empty()) return distances;
  const TriangleTree tree(measured);
  const Box whole = tree.bounds();
  // A measured surface is usually a small part, so only samples near it are tested.
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
        const auto distance = intersection(samples[i], normal, measured.vertices_m[c[0]],
                                           measured.vertices_m[c[1]], measured.vertices_m[c[2]]);
        if (!distance || std::abs(*distance) > reach_m) return;
        if (dot(normal_of(measured, c), normal) < least_cosine) return;
        if (!shortest || std::abs(*distance) < std::abs(*shortest)) shortest = distance;
      });
      distances[i] = shortest;
    }
  });
  return distances;
}

Result<void> check(const Mesh& measured, const CorrectionOptions& options) {
  if (auto valid = check_ranges(options); !valid) return valid;
  if (!std::all_of(measured.vertices_m.begin(), measured.vertices_m.end(),
                   [](Vec3 v) { return is_finite(v); }))
    return invalid_input("a vertex of the measured surface is not a finite number");
  for (const auto& t : measured.triangles)
    if (std::max({t[0], t[1], t[2]}) >= measured.vertices_m.size())
      return invalid_input("a triangle of the measured surface refers to a vertex that does not exist");
  return {};
}

/// Eq. 2 at one sample outside W.
Vec3 transition(std::uint32_t y, const CorrectedSurface& s, Geodesic& geodesic, double delta_m) {
  Vec3 sum;
  double weights = 0.0;
  double nearest = delta_m;
  geodesic.around(y, delta_m, [&](std::uint32_t x) {
    if (!s.measured[x]) return;
    // Two samples may be at one place (with_pinches_divided()).
    constexpr double kLeastShare = 1e-6;
    const double distance_m = std::max(geodesic.distance_m(x, y), kLeastShare * delta_m);
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

/// Translations of samples in the transition, as far as an earlier round has them.
using KnownTransitions = std::vector<std::optional<Vec3>>;

/// Those that the matches of some samples have a part in.
void forget_around(const std::vector<std::uint32_t>& samples, const CorrectedSurface& s,
                   const CorrectionOptions& options, KnownTransitions& known) {
  // The sum of a path's edges may differ in its last digit from the other direction's.
  constexpr double kWithRounding = 1.0 + 1e-9;
  Geodesic geodesic(s, options.longest_path);
  for (const std::uint32_t i : samples)
    geodesic.around(i, kWithRounding * options.transition_m, [&](std::uint32_t y) { known[y].reset(); });
}

/// Moves the matched samples by their distances along their normals, and the transition around them.
void move_surface(const std::vector<std::optional<double>>& distances, const CorrectionOptions& options,
                  const Work& work, KnownTransitions& known_transitions, CorrectedSurface& s) {
  s.moved.clear();
  const SampleNetwork& network = *s.network;
  const auto move_to = [&](std::size_t i, Vec3 translation) {
    if (s.translations_m[i] == translation) return;
    s.moved.push_back({static_cast<std::uint32_t>(i), s.translations_m[i]});
    s.translations_m[i] = translation;
  };
  s.matched.clear();
  for (std::uint32_t i = 0; i < distances.size(); ++i) {
    if (!distances[i]) continue;
    s.measurements[i] = s.measured[i] ? std::min(s.measurements[i] + 1, options.averaged_measurements) : 1;
    s.measured[i] = true;
    if (s.measurements[i] == 1) {
      move_to(i, *distances[i] * network.normals[i]);
    } else {
      const double before_m = dot(s.translations_m[i], network.normals[i]);
      move_to(i, (before_m + (*distances[i] - before_m) / s.measurements[i]) * network.normals[i]);
    }
    s.matched.push_back(i);
  }
  if (work.cancelled()) return;
  work.report(0.5, "moving the transition");
  // The transition is searched from the border of the matched samples: those with a neighbour that is not
  // matched.
  const auto at_border = [&](std::uint32_t i) {
    const auto around = network.from(i);
    return std::any_of(around.begin(), around.end(), [&](const auto& edge) { return !distances[edge.to]; });
  };
  std::vector<std::uint32_t> border;
  std::copy_if(s.matched.begin(), s.matched.end(), std::back_inserter(border), at_border);
  std::vector<std::uint32_t> in_transition;
  {
    Geodesic geodesic(s, options.longest_path);
    geodesic.around_all(border, options.transition_m, [&](std::uint32_t y) {
      if (!s.measured[y]) in_transition.push_back(y);
    });
  }
  std::sort(in_transition.begin(), in_transition.end());
  constexpr int kGrain = 256;
  parallel_for(work, static_cast<int>(in_transition.size()), kGrain, [&](int begin, int end) {
    Geodesic geodesic(s, options.longest_path);
    for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
      auto& known = known_transitions[in_transition[k]];
      if (!known) known = transition(in_transition[k], s, geodesic, options.transition_m);
    }
  });
  if (work.cancelled()) return;
  for (const std::uint32_t y : in_transition) move_to(y, *known_transitions[y]);
}

/// The corners of triangles that the corrections so far have turned too far.
std::vector<std::uint32_t> corners_turned_too_far(const CorrectedSurface& s,
                                                  const CorrectionOptions& options) {
  const double least_cosine = std::cos(options.most_turn_deg * kRadian);
  const Mesh now = s.adapted();
  std::vector<std::uint32_t> out;
  for (const auto& t : s.predicted.triangles)
    if (dot(normal_of(now, t), normal_of(s.predicted, t)) < least_cosine)
      out.insert(out.end(), t.begin(), t.end());
  return out;
}

}  // namespace

std::vector<Parameter> parameters_of(CorrectionOptions& o) {
  return {
      {"reach_m", &o.reach_m, {1e-6, 10.0}, "m", "greatest distance along a sample's normal"},
      {"transition_m", &o.transition_m, {1e-6, 10.0}, "m", "width of the transition"},
      {"longest_path", &o.longest_path, {1.0, 4.0}, "", "length of a path along edges over the transition"},
      {"most_match_angle_deg",
       &o.most_match_angle_deg,
       {1.0, 180.0},
       "deg",
       "greatest angle between a sample's normal and the measured surface's"},
      {"most_turn_deg",
       &o.most_turn_deg,
       {1.0, 180.0},
       "deg",
       "greatest angle by which a triangle may be turned"},
      {"averaged_measurements",
       &o.averaged_measurements,
       {1, 10000},
       "",
       "measurements of a sample whose mean is its place"}};
}

Mesh CorrectedSurface::adapted() const {
  Mesh mesh = predicted;
  for (std::size_t i = 0; i < translations_m.size(); ++i) mesh.vertices_m[i] += translations_m[i];
  return mesh;
}

Mesh CorrectedSurface::changed() const {
  // The moved samples and their neighbours: all triangles around them, or the normals of these, change.
  std::vector<bool> is_near(predicted.vertices_m.size());
  for (const Moved& m : moved) {
    is_near[m.sample] = true;
    for (const SampleNetwork::Edge& edge : network->from(m.sample)) is_near[edge.to] = true;
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
  // The same triangles once more, with the moved samples at their earlier positions.
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

Mesh CorrectedSurface::matched_surface() const {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  Mesh mesh;
  std::vector<std::uint32_t> place(predicted.vertices_m.size(), kNone);
  for (const std::uint32_t i : matched) {
    place[i] = static_cast<std::uint32_t>(mesh.vertices_m.size());
    mesh.vertices_m.push_back(predicted.vertices_m[i] + translations_m[i]);
  }
  std::vector<bool> is_isolated(matched.size(), true);
  for (const auto& t : predicted.triangles) {
    const std::array<std::uint32_t, 3> at{place[t[0]], place[t[1]], place[t[2]]};
    if (std::find(at.begin(), at.end(), kNone) != at.end()) continue;
    mesh.triangles.push_back(at);
    for (const std::uint32_t i : at) is_isolated[i] = false;
  }
  for (std::uint32_t i = 0; i < is_isolated.size(); ++i)
    if (is_isolated[i]) mesh.triangles.push_back({i, i, i});
  return mesh;
}

double CorrectedSurface::greatest_step_m() const {
  double greatest2 = 0.0;
  for (const Moved& m : moved)
    greatest2 = std::max(greatest2, squared_norm(translations_m[m.sample] - m.before_m));
  return std::sqrt(greatest2);
}

Result<CorrectedSurface> predicted_surface(Mesh mesh) {
  if (!is_watertight(mesh)) mesh = with_pinches_divided(mesh);
  if (!is_watertight(mesh)) return invalid_input("a predicted surface must be closed");
  CorrectedSurface s;
  s.translations_m.resize(mesh.vertices_m.size());
  s.measured.resize(mesh.vertices_m.size());
  s.measurements.resize(mesh.vertices_m.size());
  s.network = std::make_shared<const SampleNetwork>(network_of(mesh));
  s.predicted = std::move(mesh);
  return s;
}

Result<CorrectedSurface> correct_surface(CorrectedSurface s, const Mesh& measured,
                                         const CorrectionOptions& options, const Work& work) {
  if (auto valid = check(measured, options); !valid) return std::move(valid).error();
  work.report(0.1, "matching the measured surface");
  auto distances = distances_along_normals(measured, s, options, work);
  if (work.cancelled()) return Work::interrupted();
  KnownTransitions known(s.predicted.vertices_m.size());
  if (options.most_turn_deg >= 180.0) {
    move_surface(distances, options, work, known, s);
    if (work.cancelled()) return Work::interrupted();
    return s;
  }
  // Each round takes back the matches at the corners of folded triangles; their neighbours may fold then.
  constexpr int kRounds = 6;
  for (int round = 0;; ++round) {
    CorrectedSurface tried = s;
    move_surface(distances, options, work, known, tried);
    if (work.cancelled()) return Work::interrupted();
    std::vector<std::uint32_t> taken_back;
    for (const std::uint32_t i : corners_turned_too_far(tried, options)) {
      if (!distances[i] && !s.measured[i]) continue;
      distances[i].reset();
      s.measured[i] = false;
      taken_back.push_back(i);
    }
    if (taken_back.empty() || round == kRounds) return tried;
    forget_around(taken_back, s, options, known);
  }
}

}  // namespace palpable::sculpt
