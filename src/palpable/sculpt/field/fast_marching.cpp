// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/field/fast_marching.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <queue>
#include <utility>

namespace palpable::sculpt {
namespace {

constexpr std::size_t kFloats = 4;

/// A known neighbour from which the front may arrive.
struct Neighbour {
  double distance_m = 0.0;
  std::size_t index = 0;
};

/// The known neighbours of a point, the nearer one on each axis; sorted by distance.
class Upwind {
 public:
  void add(const Neighbour& neighbour) {
    std::size_t at = count_++;
    for (; at > 0 && neighbours_[at - 1].distance_m > neighbour.distance_m; --at)
      neighbours_[at] = neighbours_[at - 1];
    neighbours_[at] = neighbour;
  }

  /// Solves sum of (d - d_i)^2 = h^2 over as many of the nearest neighbours as have d_i < d.
  double solve(double spacing_m) {
    double sum = 0.0, squares = 0.0, solved = 0.0;
    std::size_t used = 0;
    while (used < count_) {
      const double d = neighbours_[used].distance_m;
      if (used > 0 && solved <= d) break;
      sum += d;
      squares += d * d;
      ++used;
      const double n = static_cast<double>(used);
      const double rest = sum * sum - n * (squares - spacing_m * spacing_m);
      solved = (sum + std::sqrt(std::max(rest, 0.0))) / n;
    }
    count_ = used;
    return solved;
  }

  std::size_t count() const { return count_; }
  const Neighbour& operator[](std::size_t i) const { return neighbours_[i]; }

 private:
  std::array<Neighbour, 3> neighbours_{};
  std::size_t count_ = 0;
};

class March {
 public:
  explicit March(Front& front) : front_(front), counts_(front.lattice.counts) {
    steps_ = {1, static_cast<std::size_t>(counts_[0]),
              static_cast<std::size_t>(counts_[0]) * static_cast<std::size_t>(counts_[1])};
  }

  Result<void> run(const Work& work) {
    const std::size_t places = front_.lattice.places();
    std::size_t known = 0;
    for (std::size_t i = 0; i < places; ++i)
      if (front_.known[i]) {
        ++known;
        offer_neighbours(i);
      }
    constexpr std::size_t kReport = std::size_t{1} << 18U;
    while (!waiting_.empty()) {
      const std::size_t index = waiting_.top().second;
      waiting_.pop();
      if (front_.known[index]) continue;
      settle(index);
      front_.known[index] = true;
      offer_neighbours(index);
      if (++known % kReport != 0) continue;
      if (work.cancelled()) return Work::interrupted();
      work.report(static_cast<double>(known) / static_cast<double>(places), "marching from the surface");
    }
    return {};
  }

 private:
  float* at(std::size_t index) { return front_.values.data() + kFloats * index; }

  /// Calls use(axis, index) for each of up to six neighbours.
  template <class Use>
  void each_neighbour(std::size_t index, const Use& use) const {
    // In 32 bits, where a division is several times faster; a lattice has at most 2^31 places.
    const auto at = static_cast<std::uint32_t>(index);
    const auto width = static_cast<std::uint32_t>(counts_[0]),
               height = static_cast<std::uint32_t>(counts_[1]);
    const std::uint32_t row = at / width, layer = row / height;
    const std::array<std::uint32_t, 3> place{at - row * width, row - layer * height, layer};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (place[axis] > 0) use(axis, index - steps_[axis]);
      if (place[axis] + 1 < static_cast<std::uint32_t>(counts_[axis])) use(axis, index + steps_[axis]);
    }
  }

  Upwind upwind_of(std::size_t index) {
    std::array<Neighbour, 3> nearest{};
    std::array<bool, 3> have{};
    each_neighbour(index, [&](std::size_t axis, std::size_t other) {
      if (!front_.known[other]) return;
      const double d = std::abs(static_cast<double>(*at(other)));
      if (have[axis] && nearest[axis].distance_m <= d) return;
      nearest[axis] = {d, other};
      have[axis] = true;
    });
    Upwind upwind;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (have[axis]) upwind.add(nearest[axis]);
    return upwind;
  }

  void offer_neighbours(std::size_t index) {
    each_neighbour(index, [&](std::size_t, std::size_t other) {
      if (front_.known[other]) return;
      Upwind upwind = upwind_of(other);
      const auto distance_m = static_cast<float>(upwind.solve(front_.lattice.spacing_m));
      // Where a point waits already, only a shorter way changes when it is reached. Until then its value
      // holds the shortest one so far.
      float& shortest_m = *at(other);
      if (shortest_m > 0.0F && distance_m >= shortest_m) return;
      shortest_m = distance_m;
      waiting_.emplace(distance_m, static_cast<std::uint32_t>(other));
    });
  }

  void settle(std::size_t index) {
    Upwind upwind = upwind_of(index);
    const double d = upwind.solve(front_.lattice.spacing_m);
    Vec3 force;
    for (std::size_t i = 0; i < upwind.count(); ++i) {
      const float* other = at(upwind[i].index);
      force += (d - upwind[i].distance_m) * Vec3{static_cast<double>(other[1]), static_cast<double>(other[2]),
                                                 static_cast<double>(other[3])};
    }
    // Where fronts from opposite sides meet, that of the nearest surface.
    const float* nearest = at(upwind[0].index);
    constexpr double kOpposite = 1e-3;
    if (norm(force) < kOpposite * front_.lattice.spacing_m)
      force = {static_cast<double>(nearest[1]), static_cast<double>(nearest[2]),
               static_cast<double>(nearest[3])};
    force = unit(force);
    float* here = at(index);
    here[0] = static_cast<float>(std::copysign(d, static_cast<double>(nearest[0])));
    here[1] = static_cast<float>(force.x);
    here[2] = static_cast<float>(force.y);
    here[3] = static_cast<float>(force.z);
  }

  using Waiting = std::pair<float, std::uint32_t>;
  Front& front_;
  std::array<int, 3> counts_;
  /// Index offset to the next point along each axis.
  std::array<std::size_t, 3> steps_{};
  std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting_;
};

}  // namespace

Result<void> march(Front& front, const Work& work) { return March(front).run(work); }

}  // namespace palpable::sculpt
