// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/grid/occupancy_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpable::models {
namespace {

constexpr double kDepthSteps = 128.0;
constexpr double kNormalSteps = 127.0;
constexpr double kMostDepth = 32767.0 / kDepthSteps;

std::array<Vec3, 256> make_normal_table() {
  std::array<Vec3, 256> table;
  for (unsigned mask = 0; mask < table.size(); ++mask) {
    Vec3 out;
    for (unsigned corner = 0; corner < 8; ++corner) {
      const Vec3 place{(corner & 1U) != 0U ? 1.0 : -1.0, (corner & 2U) != 0U ? 1.0 : -1.0,
                       (corner & 4U) != 0U ? 1.0 : -1.0};
      out += ((mask >> corner) & 1U) != 0U ? -place : place;
    }
    table[mask] = norm(out) > 0.5 ? unit(out) : Vec3{};
  }
  return table;
}

const std::array<Vec3, 256>& normal_table() {
  static const std::array<Vec3, 256> table = make_normal_table();
  return table;
}

/// Exact squared Euclidean distance transform in spacings, with the nearest free point, one axis at a time
/// (Felzenszwalb & Huttenlocher 2012). Points beyond the lattice are free.
struct NearestFree {
  std::vector<float> squared;
  std::vector<std::array<std::int16_t, 3>> offset;
};

/// Lower envelope of parabolas along one line of `n` points, with free points at -1 and at n.
void along_line(std::vector<double>& f, std::vector<int>& from, std::vector<int>& roots,
                std::vector<double>& bounds) {
  const int n = static_cast<int>(f.size());
  const auto at = [&](int i) { return i == -1 || i == n ? 0.0 : f[static_cast<std::size_t>(i)]; };
  int last = 0;
  roots[0] = -1;
  bounds[0] = -std::numeric_limits<double>::infinity();
  for (int q = 0; q <= n; ++q) {
    double crossing = 0.0;
    for (;;) {
      const int r = roots[static_cast<std::size_t>(last)];
      crossing = ((at(q) + double{1.0} * q * q) - (at(r) + double{1.0} * r * r)) / (2.0 * (q - r));
      if (last == 0 || crossing > bounds[static_cast<std::size_t>(last)]) break;
      --last;
    }
    ++last;
    roots[static_cast<std::size_t>(last)] = q;
    bounds[static_cast<std::size_t>(last)] = crossing;
  }
  int k = 0;
  std::vector<double>& g = f;
  std::vector<double> result(f.size());
  for (int q = 0; q < n; ++q) {
    while (k < last && bounds[static_cast<std::size_t>(k + 1)] < q) ++k;
    const int r = roots[static_cast<std::size_t>(k)];
    result[static_cast<std::size_t>(q)] = double{1.0} * (q - r) * (q - r) + at(r);
    from[static_cast<std::size_t>(q)] = r;
  }
  g = std::move(result);
}

NearestFree nearest_free(const Occupancy& o, const Work& work) {
  NearestFree out;
  constexpr float kFar = 1e9F;
  out.squared.resize(o.points());
  out.offset.resize(o.points());
  std::transform(o.occupied.begin(), o.occupied.end(), out.squared.begin(),
                 [](std::uint8_t on) { return on != 0 ? kFar : 0.0F; });
  const std::array<std::size_t, 3> stride{
      1, static_cast<std::size_t>(o.counts[0]),
      static_cast<std::size_t>(o.counts[0]) * static_cast<std::size_t>(o.counts[1])};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = axis == 0 ? 1 : 0;
    const std::size_t v = axis == 2 ? 1 : 2;
    const auto n = static_cast<std::size_t>(o.counts[axis]);
    parallel_for(work, o.counts[v], 1, [&](int begin, int end) {
      std::vector<double> f(n);
      std::vector<int> from(n);
      std::vector<int> roots(n + 2);
      std::vector<double> bounds(n + 2);
      std::vector<std::array<std::int16_t, 3>> offsets(n);
      for (int j = begin; j < end; ++j)
        for (int i = 0; i < o.counts[u]; ++i) {
          const std::size_t first =
              static_cast<std::size_t>(i) * stride[u] + static_cast<std::size_t>(j) * stride[v];
          for (std::size_t k = 0; k < n; ++k) {
            f[k] = static_cast<double>(out.squared[first + k * stride[axis]]);
            offsets[k] = out.offset[first + k * stride[axis]];
          }
          along_line(f, from, roots, bounds);
          for (std::size_t k = 0; k < n; ++k) {
            const int r = from[k];
            const bool inner = r >= 0 && r < static_cast<int>(n);
            std::array<std::int16_t, 3> offset =
                inner ? offsets[static_cast<std::size_t>(r)] : std::array<std::int16_t, 3>{};
            offset[axis] = static_cast<std::int16_t>(r - static_cast<int>(k));
            out.squared[first + k * stride[axis]] = static_cast<float>(f[k]);
            out.offset[first + k * stride[axis]] = offset;
          }
        }
    });
  }
  return out;
}

/// Mean of the table normals of the eight cells around a point.
Vec3 normal_around(const Occupancy& o, int x, int y, int z) {
  const auto on = [&](int i, int j, int k) -> unsigned {
    const bool within = i >= 0 && j >= 0 && k >= 0 && i < o.counts[0] && j < o.counts[1] && k < o.counts[2];
    return within && o.occupied[o.index(i, j, k)] != 0 ? 1U : 0U;
  };
  Vec3 sum;
  for (int cz = z - 1; cz <= z; ++cz)
    for (int cy = y - 1; cy <= y; ++cy)
      for (int cx = x - 1; cx <= x; ++cx) {
        unsigned mask = 0;
        for (int corner = 0; corner < 8; ++corner)
          mask |= on(cx + (corner & 1), cy + ((corner >> 1) & 1), cz + (corner >> 2))
                  << static_cast<unsigned>(corner);
        sum += neighbour_normal(mask);
      }
  return unit(sum);
}

/// Whether a block or its neighbouring points contain an occupied point.
bool anything_near(const Occupancy& o, std::array<int, 3> block, int side) {
  std::array<int, 3> low{};
  std::array<int, 3> high{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    low[axis] = std::max(block[axis] * side - 1, 0);
    high[axis] = std::min((block[axis] + 1) * side + 1, o.counts[axis]);
  }
  for (int z = low[2]; z < high[2]; ++z)
    for (int y = low[1]; y < high[1]; ++y) {
      const auto* row = o.occupied.data() + o.index(0, y, z);
      if (std::any_of(row + low[0], row + high[0], [](std::uint8_t on) { return on != 0; })) return true;
    }
  return false;
}

Result<void> check(const Occupancy& o) {
  double points = 1.0;
  for (const int count : o.counts) {
    if (count < 2) return invalid_input("a grid has at least 2 points along each axis");
    points *= count;
  }
  if (points > static_cast<double>(kMaxGridPoints))
    return invalid_input("a grid of more than 33 million points is not made: choose a coarser one");
  if (o.occupied.size() != static_cast<std::size_t>(points))
    return invalid_input("a grid's occupancy does not have the size that it states");
  if (!(o.spacing_m >= 1e-6 && o.spacing_m <= 1.0) || !is_finite(o.origin_m))
    return invalid_input("a grid's spacing must be 0.001 to 1000 mm");
  if (std::all_of(o.occupied.begin(), o.occupied.end(), [](std::uint8_t on) { return on == 0; }))
    return invalid_input("nothing in the grid is occupied");
  return {};
}

}  // namespace

Vec3 neighbour_normal(unsigned mask) noexcept { return normal_table()[mask & 0xFFU]; }

Result<OccupancyGrid> OccupancyGrid::from(const Occupancy& o, const Work& work) {
  if (auto valid = check(o); !valid) return std::move(valid).error();
  OccupancyGrid grid;
  grid.counts_ = o.counts;
  grid.origin_m_ = o.origin_m;
  grid.spacing_m_ = o.spacing_m;
  for (std::size_t axis = 0; axis < 3; ++axis) grid.blocks_[axis] = (o.counts[axis] + kBlock - 1) / kBlock;
  work.report(0.1, "finding the nearest surface");
  const NearestFree free = nearest_free(o, work);
  if (work.cancelled()) return Work::interrupted();
  work.report(0.7, "laying out the grid");
  grid.block_of_.reserve(static_cast<std::size_t>(grid.blocks_[0]) *
                         static_cast<std::size_t>(grid.blocks_[1]) *
                         static_cast<std::size_t>(grid.blocks_[2]));
  for (int bz = 0; bz < grid.blocks_[2]; ++bz)
    for (int by = 0; by < grid.blocks_[1]; ++by)
      for (int bx = 0; bx < grid.blocks_[0]; ++bx) {
        if (!anything_near(o, {bx, by, bz}, kBlock)) {
          grid.block_of_.push_back(kNone);
          continue;
        }
        std::array<Cell, 512> block{};
        for (int k = 0; k < 512; ++k) {
          Cell& c = block[static_cast<std::size_t>(k)];
          c.depth = static_cast<std::int16_t>(-0.5 * kDepthSteps);
          const int x = bx * kBlock + k % kBlock;
          const int y = by * kBlock + k / kBlock % kBlock;
          const int z = bz * kBlock + k / kBlock / kBlock;
          if (x >= o.counts[0] || y >= o.counts[1] || z >= o.counts[2]) continue;
          const std::size_t i = o.index(x, y, z);
          // With no free neighbour among 26, the nearest free point gives the outward direction.
          const bool deep = free.squared[i] > 3.5F;
          Vec3 normal = deep ? Vec3{} : normal_around(o, x, y, z);
          if (o.occupied[i] != 0) {
            const double depth = std::sqrt(static_cast<double>(free.squared[i])) - 0.5;
            c.occupied = 1;
            c.depth = static_cast<std::int16_t>(std::lround(kDepthSteps * std::min(depth, kMostDepth)));
            const auto& to = free.offset[i];
            if (norm(normal) == 0.0)
              normal = unit({double{1.0} * to[0], double{1.0} * to[1], double{1.0} * to[2]});
            ++grid.occupied_points_;
          }
          const auto small = [](double part) {
            return static_cast<std::int8_t>(std::lround(kNormalSteps * part));
          };
          c.normal = {small(normal.x), small(normal.y), small(normal.z)};
        }
        grid.block_of_.push_back(static_cast<std::uint32_t>(grid.cells_.size()));
        grid.cells_.push_back(block);
      }
  grid.cells_.shrink_to_fit();
  return grid;
}

const OccupancyGrid::Cell* OccupancyGrid::cell(int x, int y, int z) const noexcept {
  if (x < 0 || y < 0 || z < 0 || x >= counts_[0] || y >= counts_[1] || z >= counts_[2]) return nullptr;
  const int block = ((z / kBlock) * blocks_[1] + y / kBlock) * blocks_[0] + x / kBlock;
  const std::uint32_t at = block_of_[static_cast<std::size_t>(block)];
  if (at == kNone) return nullptr;
  return &cells_[at][static_cast<std::size_t>(((z % kBlock) * kBlock + y % kBlock) * kBlock + x % kBlock)];
}

bool OccupancyGrid::occupied(int x, int y, int z) const noexcept {
  const Cell* c = cell(x, y, z);
  return c != nullptr && c->occupied != 0;
}

GridSample OccupancyGrid::sample(Point<SceneFrame> place) const noexcept {
  const double outside = -0.5 * spacing_m_;
  const Vec3 q = (place.v - origin_m_) / spacing_m_;
  // Also false for NaN; one point beyond the lattice still interpolates its border.
  const bool near =
      q.x > -1.0 && q.y > -1.0 && q.z > -1.0 && q.x < counts_[0] && q.y < counts_[1] && q.z < counts_[2];
  if (!near) return {outside, {}};
  const double fx = std::floor(q.x);
  const double fy = std::floor(q.y);
  const double fz = std::floor(q.z);
  const std::array<double, 2> wx{1.0 - (q.x - fx), q.x - fx};
  const std::array<double, 2> wy{1.0 - (q.y - fy), q.y - fy};
  const std::array<double, 2> wz{1.0 - (q.z - fz), q.z - fz};
  double depth = 0.0;
  Vec3 normal;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1;
    const int j = (corner >> 1) & 1;
    const int k = corner >> 2;
    const double w =
        wx[static_cast<std::size_t>(i)] * wy[static_cast<std::size_t>(j)] * wz[static_cast<std::size_t>(k)];
    const Cell* c = cell(static_cast<int>(fx) + i, static_cast<int>(fy) + j, static_cast<int>(fz) + k);
    if (c == nullptr) {
      depth -= 0.5 * w;
      continue;
    }
    depth += w / kDepthSteps * c->depth;
    normal += w * Vec3{double{1.0} * c->normal[0], double{1.0} * c->normal[1], double{1.0} * c->normal[2]};
  }
  return {depth * spacing_m_, {unit(normal)}};
}

Occupancy OccupancyGrid::occupancy() const {
  Occupancy o;
  o.counts = counts_;
  o.origin_m = origin_m_;
  o.spacing_m = spacing_m_;
  o.occupied.reserve(static_cast<std::size_t>(counts_[0]) * static_cast<std::size_t>(counts_[1]) *
                     static_cast<std::size_t>(counts_[2]));
  for (int z = 0; z < counts_[2]; ++z)
    for (int y = 0; y < counts_[1]; ++y)
      for (int x = 0; x < counts_[0]; ++x) o.occupied.push_back(occupied(x, y, z) ? 1 : 0);
  return o;
}

void OccupancyGrid::touch_pages() const noexcept {
  for (const auto& block : cells_)
    static_cast<void>(*static_cast<const volatile std::uint8_t*>(&block.front().occupied));
  constexpr std::size_t kPage = 4096 / sizeof(std::uint32_t);
  const volatile std::uint32_t* blocks = block_of_.data();
  for (std::size_t at = 0; at < block_of_.size(); at += kPage) static_cast<void>(blocks[at]);
}

std::size_t OccupancyGrid::memory_bytes() const noexcept {
  return sizeof(*this) + block_of_.size() * sizeof(std::uint32_t) + cells_.size() * sizeof(cells_.front());
}

}  // namespace palpable::models
