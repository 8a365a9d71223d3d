// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/solid/smooth_surface.hpp"

#include "palpable/sculpt/solid/inside_test.hpp"
#include "palpable/sculpt/solid/nearest_in_balls.hpp"
#include "palpable/sculpt/solid/small_facets.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::sculpt {
/// A triangle's corners with their normals, linear in the weights u and v of the second and the third corner.
struct SmoothSurface::Patch {
  std::array<Vec3, 3> corners, normals;

  Vec3 place(double u, double v) const {
    return corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
  }
  Vec3 normal(double u, double v) const {
    return normals[0] + u * (normals[1] - normals[0]) + v * (normals[2] - normals[0]);
  }
  /// The height of the smooth surface above the triangle.
  double bulge_m(double u, double v) const {
    const Vec3 q = place(u, v);
    return 0.5 * ((1.0 - u - v) * dot(corners[0] - q, normals[0]) + u * dot(corners[1] - q, normals[1]) +
                  v * dot(corners[2] - q, normals[2]));
  }
  /// An upper bound of |bulge_m()|.
  double greatest_bulge_m() const {
    double most = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        most = std::max(most, std::abs(dot(corners[i] - corners[j], normals[j])));
    return most;
  }
  double greatest_turn() const {
    return std::sqrt(std::max({squared_norm(normals[1] - normals[0]), squared_norm(normals[2] - normals[0]),
                               squared_norm(normals[2] - normals[1])}));
  }
};

namespace {

double angle_between(Vec3 a, Vec3 b) { return std::acos(std::clamp(dot(unit(a), unit(b)), -1.0, 1.0)); }

/// The coordinates of a point over a patch: weights in its plane, and the multiple of its normal above it.
struct Foot {
  double u = 0.0, v = 0.0, along = 0.0;
};

/// The barycentric weights of a point in the triangle's plane.
Foot foot_at(const SmoothSurface::Patch& patch, Vec3 q, double along) {
  const Vec3 a = patch.corners[1] - patch.corners[0], b = patch.corners[2] - patch.corners[0];
  const Vec3 w = q - patch.corners[0];
  const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), wa = dot(w, a), wb = dot(w, b);
  const double det = aa * bb - ab * ab;
  if (!(det > 0.0)) return {0.0, 0.0, along};
  return {(bb * wa - ab * wb) / det, (aa * wb - ab * wa) / det, along};
}

/// Newton's method for place(u, v) + along normal(u, v) = p.
bool solve_foot(const SmoothSurface::Patch& patch, Vec3 p, Foot& foot) {
  const Vec3 a = patch.corners[1] - patch.corners[0], b = patch.corners[2] - patch.corners[0];
  const Vec3 na = patch.normals[1] - patch.normals[0], nb = patch.normals[2] - patch.normals[0];
  const double enough2 = 1e-16 * std::max(dot(a, a), dot(b, b));
  constexpr int kSteps = 8;
  for (int step = 0; step < kSteps; ++step) {
    const Vec3 n = patch.normal(foot.u, foot.v);
    const Vec3 rest = p - patch.place(foot.u, foot.v) - foot.along * n;
    if (squared_norm(rest) <= enough2) return true;
    const Vec3 by_u = a + foot.along * na, by_v = b + foot.along * nb;
    const Vec3 vn = cross(by_v, n);
    const double det = dot(by_u, vn);
    // Beyond the point where the normals cross, the offset surface folds over.
    if (!(det > 0.0)) return false;
    foot.u += dot(rest, vn) / det;
    foot.v += dot(rest, cross(n, by_u)) / det;
    foot.along += dot(rest, cross(by_u, by_v)) / det;
    if (!(std::abs(foot.u) + std::abs(foot.v) < 8.0)) return false;
  }
  return false;
}

}  // namespace

SmoothSurface::SmoothSurface(Mesh mesh, const Rounding& rounding)
    : rounding_(rounding),
      mesh_(std::move(mesh)),
      tree_(mesh_),
      faces_(mesh_.triangles.size()),
      normals_(mesh_.triangles.size()),
      across_(mesh_.triangles.size()),
      smooth_(mesh_.triangles.size()),
      around_(mesh_.vertices_m.size()),
      fan_begin_(mesh_.vertices_m.size() + 1) {
  for (const auto& t : mesh_.triangles)
    for (const std::uint32_t v : t) ++fan_begin_[v + 1];
  for (std::size_t v = 1; v < fan_begin_.size(); ++v) fan_begin_[v] += fan_begin_[v - 1];
  fans_.resize(3 * mesh_.triangles.size());
  std::vector<std::uint32_t> next(fan_begin_.begin(), fan_begin_.end() - 1);
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) fans_[next[mesh_.triangles[t][k]]++] = 3 * t + k;
    set_face(t);
  }
  find_neighbours();
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) set_edges(t);
  for (std::uint32_t v = 0; v < mesh_.vertices_m.size(); ++v) set_normals(v);
  if (rounding_.noise_turn_share > 0.0 || rounding_.noise_rise_share > 0.0) measure_noise();
}

SmoothSurface::Patch SmoothSurface::patch_of(std::uint32_t triangle) const {
  const auto& t = mesh_.triangles[triangle];
  return {{mesh_.vertices_m[t[0]], mesh_.vertices_m[t[1]], mesh_.vertices_m[t[2]]}, normals_[triangle]};
}

void SmoothSurface::find_neighbours() {
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t end = mesh_.triangles[t][(k + 1) % 3];
      for (const std::uint32_t corner : fan(mesh_.triangles[t][k]))
        if (mesh_.triangles[corner / 3][(corner % 3 + 2) % 3] == end) across_[t][k] = corner / 3;
    }
}

void SmoothSurface::set_face(std::uint32_t triangle) {
  const auto& t = mesh_.triangles[triangle];
  const Vec3 a = mesh_.vertices_m[t[0]];
  faces_[triangle] = unit(cross(mesh_.vertices_m[t[1]] - a, mesh_.vertices_m[t[2]] - a));
}

void SmoothSurface::set_edges(std::uint32_t triangle) {
  for (std::size_t side = 0; side < 3; ++side) {
    const std::uint32_t other = across_[triangle][side];
    const auto corners = [&](std::uint32_t t) {
      const auto& of = mesh_.triangles[t];
      return std::array{mesh_.vertices_m[of[0]], mesh_.vertices_m[of[1]], mesh_.vertices_m[of[2]]};
    };
    const auto one = corners(triangle), two = corners(other);
    const bool smooth = dot(faces_[triangle], faces_[other]) > kSmoothCosine &&
                        std::max(inradius_m(one), inradius_m(two)) <= rounding_.largest_facet_m &&
                        bulge_over_edge_m(one, two, norm(one[(side + 1) % 3] - one[side]),
                                          norm(faces_[triangle] - faces_[other])) <= rounding_.most_m;
    const auto back = static_cast<std::size_t>(
        std::find(across_[other].begin(), across_[other].end(), triangle) - across_[other].begin());
    const auto set = [&](std::uint32_t t, std::size_t k) {
      const auto bit = static_cast<std::uint8_t>(1U << k);
      smooth_[t] = static_cast<std::uint8_t>(smooth ? smooth_[t] | bit : smooth_[t] & ~bit);
    };
    set(triangle, side);
    set(other, back);
  }
}

void SmoothSurface::set_normals(std::uint32_t vertex) {
  const auto corners = fan(vertex);
  std::vector<std::uint32_t> left(corners.begin(), corners.end());
  around_[vertex] = {};
  while (!left.empty()) {
    // All triangles that are reached without crossing a sharp edge.
    std::vector<std::uint32_t> part{left.back()};
    left.pop_back();
    Vec3 sum;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const std::uint32_t t = part[i] / 3, k = part[i] % 3;
      const auto place = [&](std::uint32_t j) { return mesh_.vertices_m[mesh_.triangles[t][(k + j) % 3]]; };
      sum += angle_between(place(1) - place(0), place(2) - place(0)) * faces_[t];
      for (const std::size_t side : {std::size_t{k}, std::size_t{(k + 2) % 3}}) {
        const std::uint32_t next = across_[t][side];
        const auto at =
            std::find_if(left.begin(), left.end(), [&](std::uint32_t c) { return c / 3 == next; });
        if (at == left.end() || !is_smooth(t, side)) continue;
        part.push_back(*at);
        left.erase(at);
      }
    }
    around_[vertex] += sum;
    for (const std::uint32_t corner : part) normals_[corner / 3][corner % 3] = unit(sum);
  }
}

void SmoothSurface::move(std::span<const Move> moves) {
  std::vector<std::uint32_t> triangles;
  for (const Move& m : moves) {
    mesh_.vertices_m[m.vertex] = m.to_m;
    for (const std::uint32_t corner : fan(m.vertex)) triangles.push_back(corner / 3);
  }
  const auto only_once = [](std::vector<std::uint32_t>& all) {
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
  };
  only_once(triangles);
  std::vector<std::uint32_t> vertices;
  for (const std::uint32_t t : triangles) set_face(t);
  for (const std::uint32_t t : triangles) {
    set_edges(t);
    vertices.insert(vertices.end(), mesh_.triangles[t].begin(), mesh_.triangles[t].end());
  }
  only_once(vertices);
  for (const std::uint32_t v : vertices) set_normals(v);
  tree_.move(mesh_, triangles);
}

/// The squared difference between the normal at a vertex and the mean normal of its neighbours; 0 for
/// constant curvature. Also 0 if an edge turns by more than 20 degrees or a facet is not small, since that is
/// the mesh's own shape.
double SmoothSurface::normal_scatter2(std::uint32_t vertex) const {
  Vec3 sum;
  for (const std::uint32_t corner : fan(vertex)) {
    const std::uint32_t t = corner / 3, other = across_[t][corner % 3];
    if (dot(faces_[t], faces_[other]) <= kSmoothCosine ||
        inradius_m(patch_of(t).corners) > rounding_.largest_facet_m)
      return 0.0;
    sum += unit(around_[mesh_.triangles[t][(corner % 3 + 1) % 3]]);
  }
  return squared_norm(unit(around_[vertex]) - unit(sum));
}

/// For each triangle, the root mean square over the vertices of the triangles around it.
void SmoothSurface::measure_noise() {
  const std::size_t count = mesh_.triangles.size();
  std::vector<double> at_vertex(mesh_.vertices_m.size());
  for (std::uint32_t v = 0; v < at_vertex.size(); ++v) at_vertex[v] = normal_scatter2(v);
  const auto mean_of = [&](std::uint32_t t) {
    const auto& of = mesh_.triangles[t];
    return (at_vertex[of[0]] + at_vertex[of[1]] + at_vertex[of[2]]) / 3.0;
  };
  noise_.resize(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    double sum = 0.0, triangles = 0.0;
    for (const std::uint32_t v : mesh_.triangles[t])
      for (const std::uint32_t corner : fan(v)) sum += mean_of(corner / 3), triangles += 1.0;
    const Patch patch = patch_of(t);
    const double size_m = std::sqrt(
        0.5 * norm(cross(patch.corners[1] - patch.corners[0], patch.corners[2] - patch.corners[0])));
    const double turn = std::sqrt(sum / triangles);
    noise_[t] = {static_cast<float>(turn), static_cast<float>(turn * size_m)};
  }
}

Vec3 SmoothSurface::pseudo_normal(const NearestTriangle& near) const {
  using enum TrianglePart;
  if (near.part == face) return faces_[near.triangle];
  if (near.part <= edge_20) {
    const auto side = static_cast<std::size_t>(near.part) - static_cast<std::size_t>(edge_01);
    return faces_[near.triangle] + faces_[across_[near.triangle][side]];
  }
  const auto corner = static_cast<std::size_t>(near.part) - static_cast<std::size_t>(corner_0);
  return around_[mesh_.triangles[near.triangle][corner]];
}

models::DistanceSample SmoothSurface::faceted(Vec3 p, const NearestTriangle& near, const Hint& hint) const {
  const Vec3 way = p - near.point_m;
  const Vec3 normal = pseudo_normal(near);
  if (near.part == TrianglePart::face) return {dot(way, normal), normal};
  const double distance = std::sqrt(near.squared_distance_m2);
  if (distance == 0.0) return {0.0, unit(normal)};
  const double sign = is_behind(InsideTest{tree_}, p, way, normal, hint) ? -1.0 : 1.0;
  return {sign * distance, (sign / distance) * way};
}

std::size_t SmoothSurface::rounded_facets() const {
  std::size_t count = 0;
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
    count += std::any_of(normals_[t].begin(), normals_[t].end(),
                         [&](Vec3 n) { return squared_norm(n - faces_[t]) > 1e-12; });
  return count;
}

std::optional<models::DistanceSample> SmoothSurface::projected(Vec3 p, const NearestTriangle& near,
                                                               double faceted_m) const {
  std::uint32_t triangle = near.triangle;
  Vec3 from = near.point_m;
  double along = faceted_m;
  constexpr int kHops = 6;
  for (int hop = 0; hop < kHops; ++hop) {
    const Patch patch = patch_of(triangle);
    Foot foot = foot_at(patch, from, along);
    if (!solve_foot(patch, p, foot)) return std::nullopt;
    const std::array<double, 3> weights{1.0 - foot.u - foot.v, foot.u, foot.v};
    const auto least =
        static_cast<std::size_t>(std::min_element(weights.begin(), weights.end()) - weights.begin());
    constexpr double kBorder = 1e-6;
    if (weights[least] >= -kBorder) {
      const Vec3 normal = patch.normal(foot.u, foot.v);
      const double length = norm(normal);
      const double bulge_m = patch.bulge_m(foot.u, foot.v);
      if (std::abs(bulge_m) > rounding_.most_m) return std::nullopt;
      const double distance_m = foot.along * length - bulge_m;
      const double slack_m =
          patch.greatest_bulge_m() + 2.0 * TriangleTree::kNearestSlack * std::abs(faceted_m);
      if (!(std::abs(std::abs(distance_m) - std::abs(faceted_m)) <= slack_m)) return std::nullopt;
      return models::DistanceSample{distance_m, normal / length};
    }
    const std::size_t side = (least + 1) % 3;
    if (!is_smooth(triangle, side)) return std::nullopt;
    // The same point of the common edge.
    from = patch.place(foot.u, foot.v);
    along = foot.along;
    triangle = across_[triangle][side];
  }
  return std::nullopt;
}

void SmoothSurface::enter(Vec3 centre_m, double radius_m, Hint& hint) const {
  enter_ball(tree_, centre_m, radius_m, hint);
}
void SmoothSurface::leave(Hint& hint) const { leave_ball(hint); }

models::DistanceSample SmoothSurface::at(Vec3 place_m, Hint& hint) const {
  const NearestTriangle near = nearest_in_ball(tree_, place_m, hint);
  const Patch patch = patch_of(near.triangle);
  hint.coarse_m = rounding_.coarse_share * patch.greatest_bulge_m();
  hint.coarse_turn = rounding_.coarse_share * patch.greatest_turn();
  if (!noise_.empty()) {
    hint.coarse_m += rounding_.noise_rise_share * static_cast<double>(noise_[near.triangle].rise_m);
    hint.coarse_turn += rounding_.noise_turn_share * static_cast<double>(noise_[near.triangle].turn);
  }
  models::DistanceSample sample = faceted(place_m, near, hint);
  if (const auto smooth = projected(place_m, near, sample.distance_m)) sample = *smooth;
  remember(near, place_m, sample.distance_m, hint);
  return sample;
}

}  // namespace palpable::sculpt
