// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/field/dense_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace palpable::models {
namespace {

/// c0 + c1 s + c2 s^2 + c3 s^3 on 0 <= s <= 1.
struct Cubic {
  std::array<double, 4> c{};

  double at(double s) const noexcept { return c[0] + s * (c[1] + s * (c[2] + s * c[3])); }

  /// The least of its Bezier points: it is nowhere lower.
  double bound() const noexcept {
    const double second = c[0] + c[1] / 3.0, third = c[0] + (2.0 * c[1] + c[2]) / 3.0;
    return std::min({c[0], second, third, c[0] + c[1] + c[2] + c[3]});
  }

  /// Where it is lowest.
  double lowest() const noexcept {
    double best = at(1.0) < c[0] ? 1.0 : 0.0;
    const auto try_place = [&](double s) {
      if (s > 0.0 && s < 1.0 && at(s) < at(best)) best = s;
    };
    // The roots of c1 + 2 c2 s + 3 c3 s^2, without a division by a small number.
    const double root2 = c[2] * c[2] - 3.0 * c[1] * c[3];
    if (root2 < 0.0) return best;
    const double q = -(c[2] + std::copysign(std::sqrt(root2), c[2]));
    if (c[3] != 0.0) try_place(q / (3.0 * c[3]));
    if (q != 0.0) try_place(c[1] / q);
    return best;
  }

  /// Where it falls below a value between 0, where it is above, and `low`, where it is below.
  double falls_below(double value, double low) const noexcept {
    constexpr int kHalvings = 40;
    double high = 0.0;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (high + low);
      (at(middle) < value ? low : high) = middle;
    }
    return high;
  }
};

/// A line through a lattice, from one face between cells to the next.
class LatticeLine {
 public:
  /// In spacings from the lattice's first place.
  LatticeLine(const std::array<double, 3>& from, const std::array<double, 3>& way) noexcept
      : from_(from), way_(way) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      face_[axis] = way[axis] > 0.0 ? std::floor(from[axis]) + 1.0 : std::ceil(from[axis]) - 1.0;
      meets_[axis] = share_at(axis);
    }
  }

  /// The share of the line at which it meets the next face; then goes on to the one after that.
  double next() noexcept {
    const auto axis =
        static_cast<std::size_t>(std::min_element(meets_.begin(), meets_.end()) - meets_.begin());
    const double share = meets_[axis];
    face_[axis] += way_[axis] > 0.0 ? 1.0 : -1.0;
    meets_[axis] = share_at(axis);
    return share;
  }

 private:
  double share_at(std::size_t axis) const noexcept {
    return way_[axis] == 0.0 ? std::numeric_limits<double>::infinity()
                             : (face_[axis] - from_[axis]) / way_[axis];
  }

  std::array<double, 3> from_;
  std::array<double, 3> way_;
  std::array<double, 3> face_{};
  std::array<double, 3> meets_{};
};

/// The product of a polynomial of degree 2 at most and a + b s.
Cubic times(const Cubic& p, double a, double b) noexcept {
  return {{a * p.c[0], a * p.c[1] + b * p.c[0], a * p.c[2] + b * p.c[1], b * p.c[2]}};
}

/// The distance along the line from `start`, in spacings, to `start + way`, both in one cell.
Cubic along(const DenseField& field, const std::array<double, 3>& start,
            const std::array<double, 3>& way) noexcept {
  const Lattice& lattice = field.lattice();
  std::array<int, 3> cell{};
  std::array<double, 3> in_cell{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    cell[axis] = std::clamp(static_cast<int>(start[axis] + 0.5 * way[axis]), 0, lattice.counts[axis] - 2);
    in_cell[axis] = start[axis] - cell[axis];
  }
  const auto at = [&](int x, int y, int z) {
    const std::size_t place = lattice.index(cell[0] + x, cell[1] + y, cell[2] + z);
    return static_cast<double>(field.values()[floats_of(field.content()) * place]);
  };
  // Along x on the four edges, then y, then z.
  const auto edge = [&](int y, int z) {
    const double rise = at(1, y, z) - at(0, y, z);
    return Cubic{{at(0, y, z) + rise * in_cell[0], rise * way[0], 0.0, 0.0}};
  };
  const auto mixed = [&](const Cubic& low, const Cubic& high, std::size_t axis) {
    Cubic sum = times({{high.c[0] - low.c[0], high.c[1] - low.c[1], high.c[2] - low.c[2], 0.0}},
                      in_cell[axis], way[axis]);
    for (std::size_t k = 0; k < sum.c.size(); ++k) sum.c[k] += low.c[k];
    return sum;
  };
  return mixed(mixed(edge(0, 0), edge(1, 0), 1), mixed(edge(0, 1), edge(1, 1), 1), 2);
}

}  // namespace

std::optional<Dip> first_dip(const DenseField& field, Point<SceneFrame> from, Point<SceneFrame> to,
                             double below_m) noexcept {
  const auto in_spacings = [&](Vec3 v) {
    const double spacing_m = field.lattice().spacing_m;
    return std::array<double, 3>{v.x / spacing_m, v.y / spacing_m, v.z / spacing_m};
  };
  const std::array<double, 3> first = in_spacings(from.v - field.lattice().origin_m);
  const std::array<double, 3> way = in_spacings(to.v - from.v);
  LatticeLine line(first, way);
  for (double share = 0.0; share < 1.0;) {
    const double next = std::clamp(line.next(), share, 1.0);
    const double part = next - share;
    const std::array<double, 3> start{first[0] + share * way[0], first[1] + share * way[1],
                                      first[2] + share * way[2]};
    const Cubic distance = along(field, start, {part * way[0], part * way[1], part * way[2]});
    if (distance.bound() < below_m) {
      const double lowest = distance.lowest();
      if (distance.at(lowest) < below_m) {
        const bool begins_in_it = distance.c[0] < below_m;
        return Dip{share + part * (begins_in_it ? 0.0 : distance.falls_below(below_m, lowest)),
                   share + part * lowest};
      }
    }
    share = next;
  }
  return std::nullopt;
}

}  // namespace palpable::models
