// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/mesh_orientation.hpp"

#include "palpable/sculpt/triangles/mesh_edges.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <random>
#include <unordered_map>
#include <utility>
#include <vector>

namespace palpable::sculpt {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

struct PlaceHash {
  std::size_t operator()(const Vec3& p) const {
    std::uint64_t hash = 0xCBF29CE484222325U;
    for (const double v : {p.x, p.y, p.z}) hash = (hash ^ std::bit_cast<std::uint64_t>(v)) * 0x100000001B3U;
    return static_cast<std::size_t>(hash ^ hash >> 29U);
  }
};

void turn(Triangle& t) { std::swap(t[1], t[2]); }

/// Whether the triangle contains the directed edge from a to b.
bool runs(const Triangle& t, std::uint32_t a, std::uint32_t b) {
  return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
}

/// For each triangle, the one across each of its edges; itself if there is none or more than one.
std::vector<Triangle> neighbours_of(const Mesh& mesh) {
  struct Users {
    std::uint32_t first = 0, second = 0;
    int count = 0;
  };
  std::unordered_map<std::uint64_t, Users> edges;
  edges.reserve(2 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      Users& users = edges[edge_key(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3])];
      (users.count == 0 ? users.first : users.second) = t;
      ++users.count;
    }
  std::vector<Triangle> neighbours(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const Users& users = edges[edge_key(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3])];
      neighbours[t][k] = users.count != 2 ? t : users.first == t ? users.second : users.first;
    }
  return neighbours;
}

constexpr int kRays = 41;

/// The volume that a part encloses: positive if it faces outwards, 0 if it is so open that its sign is not
/// certain. Its lids could contribute at most their total area vector times the part's radius.
double certain_volume_m3(const Mesh& mesh, const std::vector<std::uint32_t>& part) {
  Vec3 sum, centre;
  double area = 0.0;
  const auto corners = [&](std::uint32_t i) {
    const Triangle& t = mesh.triangles[i];
    return std::array{mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]};
  };
  for (const std::uint32_t i : part) {
    const auto c = corners(i);
    const Vec3 own = 0.5 * cross(c[1] - c[0], c[2] - c[0]);
    sum += own;
    area += norm(own);
    centre += (norm(own) / 3.0) * (c[0] + c[1] + c[2]);
  }
  centre = centre / area;
  double volume = 0.0, radius2 = 0.0;
  for (const std::uint32_t i : part) {
    const auto c = corners(i);
    const Vec3 a = c[0] - centre, b = c[1] - centre, d = c[2] - centre;
    volume += dot(a, cross(b, d)) / 6.0;
    radius2 = std::max({radius2, squared_norm(a), squared_norm(b), squared_norm(d)});
  }
  // Sheets of two faces enclose nothing but rounding errors.
  constexpr double kFlat = 1e-9;
  const double radius = std::sqrt(radius2);
  return std::abs(volume) > (norm(sum) / 3.0 + kFlat * area) * radius ? volume : 0.0;
}

/// From how many of kRays places more of a part's front than of its back faces the solid, by the parity of
/// rays, minus the number of the opposite.
int inward_votes(const Mesh& mesh, const std::vector<std::uint32_t>& part, const TriangleTree& tree,
                 double lift_m, std::mt19937_64& random) {
  std::vector<double> area_until(part.size());
  double area = 0.0;
  for (std::size_t i = 0; i < part.size(); ++i) {
    const Triangle& t = mesh.triangles[part[i]];
    const Vec3 a = mesh.vertices_m[t[0]];
    area += norm(cross(mesh.vertices_m[t[1]] - a, mesh.vertices_m[t[2]] - a));
    area_until[i] = area;
  }
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal;
  int inwards = 0;
  for (int ray = 0; ray < kRays; ++ray) {
    const auto pick = std::lower_bound(area_until.begin(), area_until.end(), area * uniform(random));
    const auto index = std::min(static_cast<std::size_t>(pick - area_until.begin()), part.size() - 1);
    const Triangle& t = mesh.triangles[part[index]];
    const Vec3 a = mesh.vertices_m[t[0]], ab = mesh.vertices_m[t[1]] - a, ac = mesh.vertices_m[t[2]] - a;
    double u = uniform(random), v = uniform(random);
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    const Vec3 n = unit(cross(ab, ac));
    Vec3 direction = unit({normal(random), normal(random), normal(random)});
    if (dot(direction, n) < 0.0) direction = -direction;
    const Vec3 place = a + u * ab + v * ac;
    const int front = tree.crossings(place + lift_m * n, direction);
    const int back = tree.crossings(place - lift_m * n, -direction);
    inwards += front % 2 - back % 2;
  }
  return inwards;
}

}  // namespace

Mesh welded(const Mesh& mesh, std::size_t& removed) {
  Mesh result;
  std::unordered_map<Vec3, std::uint32_t, PlaceHash> places;
  std::vector<std::uint32_t> now(mesh.vertices_m.size());
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i) {
    // Adding zero turns -0 into 0.
    const Vec3 p = mesh.vertices_m[i] + Vec3{};
    if (!is_finite(p)) continue;
    const auto [at, fresh] = places.try_emplace(p, static_cast<std::uint32_t>(result.vertices_m.size()));
    if (fresh) result.vertices_m.push_back(p);
    now[i] = at->second;
  }
  removed = 0;
  for (const Triangle& t : mesh.triangles) {
    const bool is_valid = std::all_of(t.begin(), t.end(), [&](std::uint32_t v) {
      return v < mesh.vertices_m.size() && is_finite(mesh.vertices_m[v]);
    });
    const Triangle n = is_valid ? Triangle{now[t[0]], now[t[1]], now[t[2]]} : Triangle{};
    const bool has_area =
        is_valid && squared_norm(cross(result.vertices_m[n[1]] - result.vertices_m[n[0]],
                                       result.vertices_m[n[2]] - result.vertices_m[n[0]])) > 0.0;
    if (has_area)
      result.triangles.push_back(n);
    else
      ++removed;
  }
  return result;
}

namespace {

/// Triangles that are connected across edges that two of them share.
struct Part {
  std::vector<std::uint32_t> triangles;
  /// Whether some were turned to agree with their neighbours, and whether the whole part was turned
  /// afterwards.
  bool made_to_agree = false, turned = false;
  /// The share of its area that was turned to agree with the rest, at most a half.
  double disagreeing = 0.0;
};

void turn_all(Mesh& mesh, Part& part) {
  for (const std::uint32_t t : part.triangles) turn(mesh.triangles[t]);
  part.turned = !part.turned;
}

double area_m2(const Mesh& mesh, std::uint32_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  const Vec3 a = mesh.vertices_m[t[0]];
  return 0.5 * norm(cross(mesh.vertices_m[t[1]] - a, mesh.vertices_m[t[2]] - a));
}

/// `first`: triangles before this one belong to no part.
std::vector<Part> agreeing_parts(Mesh& mesh, const std::vector<Triangle>& neighbours, std::size_t first = 0) {
  std::vector<Part> parts;
  std::vector<bool> seen(mesh.triangles.size());
  for (auto start = static_cast<std::uint32_t>(first); start < mesh.triangles.size(); ++start) {
    if (seen[start]) continue;
    Part part;
    part.triangles = {start};
    double turned_m2 = 0.0, all_m2 = 0.0;
    seen[start] = true;
    for (std::size_t i = 0; i < part.triangles.size(); ++i) {
      const Triangle t = mesh.triangles[part.triangles[i]];
      all_m2 += area_m2(mesh, part.triangles[i]);
      for (std::size_t k = 0; k < 3; ++k) {
        // Neighbours were stored by an edge's position before any turning: compare the shared edge itself.
        const std::uint32_t other = neighbours[part.triangles[i]][k];
        if (seen[other]) continue;
        seen[other] = true;
        part.triangles.push_back(other);
        Triangle& o = mesh.triangles[other];
        bool same_way = false;
        for (std::size_t e = 0; e < 3; ++e) same_way = same_way || runs(o, t[e], t[(e + 1) % 3]);
        if (same_way) {
          turn(o);
          turned_m2 += area_m2(mesh, other);
          part.made_to_agree = true;
        }
      }
    }
    // The orientation of the majority, not that of the first triangle.
    if (turned_m2 > 0.5 * all_m2)
      for (const std::uint32_t t : part.triangles) turn(mesh.triangles[t]);
    part.disagreeing = std::min(turned_m2, all_m2 - turned_m2) / all_m2;
    parts.push_back(std::move(part));
  }
  return parts;
}

/// Whether a part is to be turned. Where bodies overlap, rays are ambiguous: then the volume that a part
/// encloses decides. A part that encloses a negative volume is the wall of a cavity if all rays agree and
/// most of its triangles were given with that orientation.
bool faces_inwards(const Mesh& mesh, const Part& part, const TriangleTree& tree, double lift_m,
                   std::mt19937_64& random) {
  const double volume_m3 = certain_volume_m3(mesh, part.triangles);
  if (volume_m3 > 0.0) return false;
  const int inwards = inward_votes(mesh, part.triangles, tree, lift_m, random);
  // A ray through an edge may be counted wrongly.
  constexpr int kAll = kRays - 2;
  constexpr double kMostDisagreeing = 0.25;
  if (volume_m3 == 0.0) return inwards > 0;
  return inwards > -kAll || part.disagreeing > kMostDisagreeing;
}

/// The edges that more than two triangles share, with the directions in which parts use them.
class SharedEdges {
 public:
  SharedEdges(const Mesh& mesh, const std::vector<Part>& parts) : of_part_(parts.size()) {
    struct Use {
      std::uint64_t key;
      std::uint32_t part;
      int step;
    };
    std::vector<Use> uses;
    for (std::uint32_t p = 0; p < parts.size(); ++p)
      for (const std::uint32_t i : parts[p].triangles) {
        const Triangle& t = mesh.triangles[i];
        for (std::size_t k = 0; k < 3; ++k)
          uses.push_back({edge_key(t[k], t[(k + 1) % 3]), p, t[k] < t[(k + 1) % 3] ? 1 : -1});
      }
    std::sort(uses.begin(), uses.end(),
              [](const Use& a, const Use& b) { return std::pair(a.key, a.part) < std::pair(b.key, b.part); });
    for (std::size_t i = 0, end = 0; i < uses.size(); i = end) {
      while (end < uses.size() && uses[end].key == uses[i].key) ++end;
      if (end - i < 3) continue;
      const auto edge = static_cast<std::uint32_t>(sums_.size());
      int sum = 0;
      for (std::size_t k = i; k < end; ++k) {
        auto& of_part = of_part_[uses[k].part];
        if (of_part.empty() || of_part.back().edge != edge) of_part.push_back({edge, 0});
        of_part.back().steps += uses[k].step;
        sum += uses[k].step;
      }
      sums_.push_back(sum);
      lengths_m_.push_back(norm(mesh.vertices_m[uses[i].key >> 32U] -
                                mesh.vertices_m[static_cast<std::uint32_t>(uses[i].key)]));
    }
  }
  /// Length of open edges that is saved if the part is turned, metres.
  double gain_m(std::uint32_t part) const {
    double gain = 0.0;
    for (const Along& a : of_part_[part])
      gain += lengths_m_[a.edge] * (std::abs(sums_[a.edge]) - std::abs(sums_[a.edge] - 2 * a.steps));
    return gain;
  }
  void turn(std::uint32_t part) {
    for (Along& a : of_part_[part]) {
      sums_[a.edge] -= 2 * a.steps;
      a.steps = -a.steps;
    }
  }

 private:
  struct Along {
    std::uint32_t edge;
    int steps;
  };
  std::vector<std::vector<Along>> of_part_;
  std::vector<int> sums_;
  std::vector<double> lengths_m_;
};

/// The triangles of a closed solid use every edge once in each direction. A wall shared by two bodies is a
/// separate part for each body, and rays cannot decide its orientation, since the solid is on both sides. It
/// is turned so that its edges match, small parts before large ones.
void turn_as_shared_edges_want(Mesh& mesh, std::vector<Part>& parts) {
  if (parts.size() < 2) return;
  SharedEdges edges(mesh, parts);
  std::vector<std::pair<double, std::uint32_t>> order;
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    double area = 0.0;
    for (const std::uint32_t t : parts[p].triangles) area += area_m2(mesh, t);
    order.emplace_back(area, p);
  }
  std::sort(order.begin(), order.end());
  constexpr int kSweeps = 32;
  bool any = true;
  for (int sweep = 0; any && sweep < kSweeps; ++sweep) {
    any = false;
    for (const auto& [area, p] : order) {
      if (!(edges.gain_m(p) > 0.0)) continue;
      edges.turn(p);
      turn_all(mesh, parts[p]);
      any = true;
    }
  }
}

}  // namespace

std::size_t orient_outwards(Mesh& mesh, std::uint64_t seed, std::size_t oriented) {
  if (mesh.triangles.size() <= oriented) return 0;
  auto parts = agreeing_parts(mesh, neighbours_of(mesh), oriented);
  const TriangleTree tree(mesh);
  const Box box = tree.bounds();
  const double lift_m = 1e-6 * norm(box.size_m());
  std::mt19937_64 random(seed);
  for (Part& part : parts)
    if (faces_inwards(mesh, part, tree, lift_m, random)) turn_all(mesh, part);
  turn_as_shared_edges_want(mesh, parts);
  return static_cast<std::size_t>(
      std::count_if(parts.begin(), parts.end(), [](const Part& p) { return p.made_to_agree || p.turned; }));
}

std::size_t turn_inside_out_parts(Mesh& mesh, const TriangleTree& tree) {
  auto parts = agreeing_parts(mesh, neighbours_of(mesh));
  const double lift_m = 1e-6 * norm(tree.bounds().size_m());
  std::size_t turned = 0;
  for (Part& part : parts) {
    // Distributed over the part, which may have many triangles.
    constexpr std::size_t kMost = 64;
    const std::size_t step = std::max<std::size_t>(1, part.triangles.size() / kMost);
    double inside_out = 0.0, all = 0.0;
    for (std::size_t i = 0; i < part.triangles.size(); i += step) {
      const Triangle& t = mesh.triangles[part.triangles[i]];
      const Vec3 a = mesh.vertices_m[t[0]], b = mesh.vertices_m[t[1]], c = mesh.vertices_m[t[2]];
      const double area = area_m2(mesh, part.triangles[i]);
      all += area;
      if (tree.winding((a + b + c) / 3.0 + lift_m * unit(cross(b - a, c - a))) < -0.5) inside_out += area;
    }
    if (!(inside_out > 0.5 * all)) continue;
    turn_all(mesh, part);
    ++turned;
  }
  return turned;
}

}  // namespace palpable::sculpt
