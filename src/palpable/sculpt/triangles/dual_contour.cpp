// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/dual_contour.hpp"

#include "palpable/sculpt/triangles/key_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace palpable::sculpt {
namespace {

using Cell = std::array<int, 3>;

/// Corner k of a cube: x in bit 0, y in bit 1, z in bit 2.
Cell corner_of(Cell cell, unsigned k) {
  return {cell[0] + static_cast<int>(k & 1U), cell[1] + static_cast<int>(k >> 1U & 1U),
          cell[2] + static_cast<int>(k >> 2U & 1U)};
}

/// A cube's edges: those along x, then y, then z; `k` is the corner where one begins.
std::size_t edge_number(std::size_t axis, unsigned k) {
  const auto bit = [&](std::size_t a) { return k >> a & 1U; };
  return 4 * axis + bit((axis + 1) % 3) + 2 * bit((axis + 2) % 3);
}

/// The sheet of the surface that each edge of a cube crosses. Two sheets in one cube stay apart (Nielson
/// 2004), so the mesh is a manifold except at rare edges.
struct Sheets {
  std::array<std::uint8_t, 12> of_edge{};
  std::uint8_t count = 0;
};

Sheets found_sheets(unsigned mask) {
  const auto inside = [&](unsigned k) { return (mask >> k & 1U) != 0; };
  std::array<std::uint8_t, 12> sheet{};
  for (std::uint8_t e = 0; e < 12; ++e) sheet[e] = e;
  const auto join = [&](std::size_t a, std::size_t b) {
    const std::uint8_t from = sheet[b], to = sheet[a];
    std::replace(sheet.begin(), sheet.end(), from, to);
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (unsigned side = 0; side < 2; ++side) {
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      const unsigned origin = side << axis, du = 1U << u, dv = 1U << v;
      const unsigned all = (inside(origin) ? 1U : 0U) + (inside(origin | du) ? 1U : 0U) +
                           (inside(origin | dv) ? 1U : 0U) + (inside(origin | du | dv) ? 1U : 0U);
      // A corner that differs from both its neighbours is cut off; of two such pairs, those inside.
      const bool cut_off_inside = all <= 2;
      for (unsigned i = 0; i < 2; ++i)
        for (unsigned j = 0; j < 2; ++j) {
          const unsigned k = origin | i * du | j * dv;
          if (inside(k) != cut_off_inside || inside(k ^ du) == inside(k) || inside(k ^ dv) == inside(k))
            continue;
          join(edge_number(u, k & ~du), edge_number(v, k & ~dv));
        }
      // Two corners side by side: the surface goes straight across.
      if (all == 2 && inside(origin) == inside(origin | du))
        join(edge_number(v, origin), edge_number(v, origin | du));
      if (all == 2 && inside(origin) == inside(origin | dv))
        join(edge_number(u, origin), edge_number(u, origin | dv));
    }
  Sheets sheets;
  std::array<std::uint8_t, 12> number{};
  number.fill(12);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (unsigned k = 0; k < 8; ++k) {
      if ((k >> axis & 1U) != 0 || inside(k) == inside(k | 1U << axis)) continue;
      const std::size_t e = edge_number(axis, k);
      if (number[sheet[e]] == 12) number[sheet[e]] = sheets.count++;
      sheets.of_edge[e] = number[sheet[e]];
    }
  return sheets;
}

/// `mask`: the corners inside.
const Sheets& sheets_of(unsigned mask) {
  static const std::array<Sheets, 256> kAll = [] {
    std::array<Sheets, 256> all;
    for (unsigned m = 0; m < all.size(); ++m) all[m] = found_sheets(m);
    return all;
  }();
  return kAll[mask];
}

/// The crossing of an edge of the cubes with the surface.
struct Crossing {
  Cell from;
  std::uint8_t axis = 0;
  /// Whether the edge leads out of the solid.
  bool outwards = false;
  Vec3 place_m;
  Vec3 normal;
};

class Contourer {
 public:
  Contourer(const SolidFunction& solid, const Box& bounds, double spacing_m, const Work& work)
      : solid_(solid), work_(work), origin_m_(bounds.least_m), spacing_m_(spacing_m) {
    const Vec3 size = bounds.size_m();
    count_ = {cells(size.x), cells(size.y), cells(size.z)};
  }

  void follow(std::span<const Vec3> seeds_m) {
    std::vector<Cell> wave;
    for (const Vec3 seed : seeds_m) {
      const Vec3 p = (seed - origin_m_) / spacing_m_;
      const Cell cell{static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y)),
                      static_cast<int>(std::floor(p.z))};
      // The seed may be off by a cube.
      for (int z = -1; z <= 1; ++z)
        for (int y = -1; y <= 1; ++y)
          for (int x = -1; x <= 1; ++x) visit({cell[0] + x, cell[1] + y, cell[2] + z}, wave);
    }
    while (!wave.empty() && !work_.cancelled()) {
      ask_corners(wave);
      std::vector<Cell> next;
      for (const Cell cell : wave) spread(cell, next);
      wave = std::move(next);
    }
    std::sort(active_.begin(), active_.end(), [](const Cube& a, const Cube& b) { return a.cell < b.cell; });
  }

  Mesh mesh() {
    find_crossings();
    std::vector<std::uint32_t> first(active_.size() + 1, 0);
    for (std::size_t i = 0; i < active_.size(); ++i)
      first[i + 1] = first[i] + sheets_of(active_[i].mask).count;
    Mesh mesh;
    mesh.vertices_m.resize(first.back());
    cube_of_ = KeyMap<Vertices>(active_.size());
    for (std::uint32_t i = 0; i < active_.size(); ++i)
      cube_of_.put(key(active_[i].cell), {first[i], active_[i].mask});
    parallel_for(work_, static_cast<int>(active_.size()), 1024, [&](int begin, int end) {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
        const Sheets& sheets = sheets_of(active_[i].mask);
        for (std::uint8_t sheet = 0; sheet < sheets.count; ++sheet)
          mesh.vertices_m[first[i] + sheet] = vertex(active_[i].cell, sheets, sheet);
      }
    });
    for (const Crossing& crossing : crossings_) add_quad(crossing, mesh);
    return mesh;
  }

 private:
  int cells(double size_m) const { return std::max(1, static_cast<int>(std::ceil(size_m / spacing_m_))); }
  static std::uint64_t key(Cell c) {
    return static_cast<std::uint64_t>(c[2]) << 40U | static_cast<std::uint64_t>(c[1]) << 20U |
           static_cast<std::uint64_t>(c[0]);
  }
  static std::uint64_t edge_key(Cell from, unsigned axis) { return key(from) << 2U | axis; }
  Vec3 place(Cell c) const {
    return origin_m_ +
           spacing_m_ * Vec3{static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])};
  }
  bool within(Cell c) const {
    return c[0] >= 0 && c[1] >= 0 && c[2] >= 0 && c[0] < count_[0] && c[1] < count_[1] && c[2] < count_[2];
  }
  void visit(Cell cell, std::vector<Cell>& wave) {
    if (within(cell) && visited_.put(key(cell), {}).second) wave.push_back(cell);
  }
  double value_at(Cell corner) const { return *values_.find(key(corner)); }

  unsigned mask_of(Cell cell) const {
    unsigned mask = 0;
    for (unsigned k = 0; k < 8; ++k) mask |= value_at(corner_of(cell, k)) < 0.0 ? 1U << k : 0U;
    return mask;
  }

  void ask_corners(const std::vector<Cell>& wave) {
    std::vector<Cell> unknown;
    for (const Cell cell : wave)
      for (unsigned k = 0; k < 8; ++k) {
        const Cell corner = corner_of(cell, k);
        if (values_.put(key(corner), 0.0).second) unknown.push_back(corner);
      }
    std::vector<double> values(unknown.size());
    parallel_for(work_, static_cast<int>(unknown.size()), 256, [&](int begin, int end) {
      for (int i = begin; i < end && !work_.cancelled(); ++i)
        values[static_cast<std::size_t>(i)] = solid_(place(unknown[static_cast<std::size_t>(i)])).distance_m;
    });
    for (std::size_t i = 0; i < unknown.size(); ++i) *values_.put(key(unknown[i]), 0.0).first = values[i];
  }

  /// Adds the cube if the surface passes through it, and its neighbours across faces that the surface
  /// crosses.
  void spread(Cell cell, std::vector<Cell>& next) {
    const unsigned mask = mask_of(cell);
    if (mask == 0 || mask == 255U) return;
    active_.push_back({cell, static_cast<std::uint8_t>(mask)});
    // The corners of a cube with x = 0, y = 0, z = 0.
    constexpr std::array<unsigned, 3> kLow{0x55U, 0x33U, 0x0FU};
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int side : {-1, 1}) {
        const unsigned face = side < 0 ? kLow[axis] : ~kLow[axis] & 255U;
        if ((mask & face) == 0 || (mask & face) == face) continue;
        Cell neighbour = cell;
        neighbour[axis] += side;
        visit(neighbour, next);
      }
  }

  void find_crossings() {
    crossing_of_ = KeyMap<std::uint32_t>(2 * active_.size());
    for (const auto& [cell, mask] : active_)
      for (unsigned axis = 0; axis < 3; ++axis)
        for (unsigned k = 0; k < 8; ++k) {
          if ((k >> axis & 1U) != 0) continue;
          const bool outwards = (mask >> k & 1U) != 0;
          if (outwards == ((mask >> (k | 1U << axis) & 1U) != 0)) continue;
          const Cell from = corner_of(cell, k);
          if (crossing_of_.put(edge_key(from, axis), static_cast<std::uint32_t>(crossings_.size())).second)
            crossings_.push_back({from, static_cast<std::uint8_t>(axis), outwards, {}, {}});
        }
    parallel_for(work_, static_cast<int>(crossings_.size()), 256, [&](int begin, int end) {
      for (int i = begin; i < end && !work_.cancelled(); ++i) find(crossings_[static_cast<std::size_t>(i)]);
    });
  }

  /// The crossing by false position, halving the retained end's value (Illinois).
  void find(Crossing& crossing) const {
    Cell to = crossing.from;
    ++to[crossing.axis];
    const Vec3 a = place(crossing.from), way = place(to) - a;
    double low = 0.0, high = 1.0;
    double at_low = value_at(crossing.from), at_high = value_at(to);
    models::DistanceSample sample;
    constexpr int kSteps = 4;
    for (int step = 0; step < kSteps; ++step) {
      const double t = low + (high - low) * at_low / (at_low - at_high);
      crossing.place_m = a + t * way;
      sample = solid_(crossing.place_m);
      if ((sample.distance_m < 0.0) == (at_low < 0.0)) {
        low = t, at_low = sample.distance_m, at_high *= 0.5;
      } else {
        high = t, at_high = sample.distance_m, at_low *= 0.5;
      }
      if (std::abs(sample.distance_m) < 1e-4 * spacing_m_) break;
    }
    crossing.normal = unit(sample.gradient);
  }

  /// The point nearest to the tangent planes at the crossings of one of the cube's sheets. It is regularised
  /// towards their mean, so that it is unique on flat and straight parts.
  Vec3 vertex(Cell cell, const Sheets& sheets, std::uint8_t sheet) const {
    Vec3 middle;
    std::array<const Crossing*, 12> found{};
    std::size_t count = 0;
    for (unsigned axis = 0; axis < 3; ++axis)
      for (unsigned k = 0; k < 8; ++k) {
        if ((k >> axis & 1U) != 0) continue;
        const std::uint32_t* at = crossing_of_.find(edge_key(corner_of(cell, k), axis));
        if (at == nullptr || sheets.of_edge[edge_number(axis, k)] != sheet) continue;
        found[count++] = &crossings_[*at];
        middle += crossings_[*at].place_m;
      }
    middle = middle / static_cast<double>(count);
    constexpr double kTowardsMiddle = 0.02;
    std::array<Vec3, 3> m{{{kTowardsMiddle, 0, 0}, {0, kTowardsMiddle, 0}, {0, 0, kTowardsMiddle}}};
    Vec3 right;
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 n = found[i]->normal;
      m[0] += n.x * n;
      m[1] += n.y * n;
      m[2] += n.z * n;
      right += dot(n, found[i]->place_m - middle) * n;
    }
    const double det = dot(m[0], cross(m[1], m[2]));
    const Vec3 x = (1.0 / det) * Vec3{dot(right, cross(m[1], m[2])), dot(m[0], cross(right, m[2])),
                                      dot(m[0], cross(m[1], right))};
    // Inside its own cube, since triangles would fold over otherwise; not on a side, where it could meet
    // others.
    constexpr double kApart = 1e-3;
    const double margin_m = kApart * spacing_m_, far_m = spacing_m_ - margin_m;
    const Vec3 corner = place(cell) - middle;
    const Vec3 low = corner + Vec3{margin_m, margin_m, margin_m}, high = corner + Vec3{far_m, far_m, far_m};
    return middle + Vec3{std::clamp(x.x, low.x, high.x), std::clamp(x.y, low.y, high.y),
                         std::clamp(x.z, low.z, high.z)};
  }

  void add_quad(const Crossing& crossing, Mesh& mesh) const {
    const std::size_t u = (crossing.axis + 1U) % 3, v = (crossing.axis + 2U) % 3;
    std::array<std::uint32_t, 4> ring{};
    constexpr std::array<std::array<int, 2>, 4> kRound{{{-1, -1}, {0, -1}, {0, 0}, {-1, 0}}};
    for (std::size_t k = 0; k < 4; ++k) {
      Cell cell = crossing.from;
      cell[u] += kRound[k][0];
      cell[v] += kRound[k][1];
      const Vertices* at = within(cell) ? cube_of_.find(key(cell)) : nullptr;
      if (at == nullptr) return;
      const unsigned corner = (kRound[k][0] < 0 ? 1U << u : 0U) | (kRound[k][1] < 0 ? 1U << v : 0U);
      ring[k] = at->first + sheets_of(at->mask).of_edge[edge_number(crossing.axis, corner)];
    }
    if (!crossing.outwards) std::swap(ring[1], ring[3]);
    // The shorter diagonal.
    const auto& p = mesh.vertices_m;
    if (squared_norm(p[ring[0]] - p[ring[2]]) <= squared_norm(p[ring[1]] - p[ring[3]])) {
      mesh.triangles.push_back({ring[0], ring[1], ring[2]});
      mesh.triangles.push_back({ring[0], ring[2], ring[3]});
    } else {
      mesh.triangles.push_back({ring[1], ring[2], ring[3]});
      mesh.triangles.push_back({ring[1], ring[3], ring[0]});
    }
  }

  const SolidFunction& solid_;
  const Work& work_;
  Vec3 origin_m_;
  double spacing_m_;
  std::array<int, 3> count_{};
  KeyMap<double> values_;
  struct Nothing {};
  KeyMap<Nothing> visited_;
  /// A cube that the surface passes, and its corners inside.
  struct Cube {
    Cell cell;
    std::uint8_t mask = 0;
  };
  std::vector<Cube> active_;
  std::vector<Crossing> crossings_;
  KeyMap<std::uint32_t> crossing_of_;
  struct Vertices {
    std::uint32_t first = 0;
    std::uint8_t mask = 0;
  };
  KeyMap<Vertices> cube_of_;
};

}  // namespace

Result<Mesh> dual_contour(const SolidFunction& solid, const Box& bounds, std::span<const Vec3> seeds_m,
                          const DualContourOptions& options, const Work& work) {
  const Vec3 size = bounds.size_m();
  constexpr double kMostCubes = 1 << 19;
  if (!(options.spacing_m > 0.0) || std::max({size.x, size.y, size.z}) / options.spacing_m > kMostCubes)
    return Error{ErrorCode::usage, "a contour's spacing must give 1 to 2^19 cubes along each side", {}};
  Contourer contourer(solid, bounds, options.spacing_m, work);
  work.report(0.1, "following the surface");
  contourer.follow(seeds_m);
  if (work.cancelled()) return Work::interrupted();
  work.report(0.6, "placing the vertices");
  Mesh mesh = contourer.mesh();
  if (work.cancelled()) return Work::interrupted();
  return mesh;
}

}  // namespace palpable::sculpt
