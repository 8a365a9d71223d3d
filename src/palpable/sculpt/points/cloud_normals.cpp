// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/points/cloud_normals.hpp"

#include "palpable/sculpt/points/plane_fit.hpp"
#include "palpable/sculpt/points/point_index.hpp"
#include "palpable/sculpt/triangles/box.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <queue>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace palpable::sculpt {
namespace {

constexpr std::size_t kFewestForNormals = 16;
constexpr std::size_t kNormalNeighbours = 12;
constexpr std::uint32_t kNoNeighbour = 0xFFFFFFFFU;

using Neighbours = std::array<std::uint32_t, kNormalNeighbours>;

/// The nearest other points, which are expected about `guess_m` away; kNoNeighbour if there are fewer.
Neighbours nearest(const PointIndex& index, Vec3 p, std::uint32_t self, double guess_m, double most_m) {
  std::vector<std::pair<double, std::uint32_t>> found;
  for (double radius_m = guess_m;; radius_m *= 1.6) {
    found.clear();
    index.within(p, radius_m, [&](std::uint32_t i, double squared) {
      if (i != self && squared > 0.0) found.emplace_back(squared, i);
    });
    if (found.size() >= kNormalNeighbours || radius_m > most_m) break;
  }
  const std::size_t count = std::min(found.size(), kNormalNeighbours);
  std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count), found.end());
  Neighbours neighbours;
  neighbours.fill(kNoNeighbour);
  for (std::size_t k = 0; k < count; ++k) neighbours[k] = found[k].second;
  return neighbours;
}

/// The normal of the plane through a point and its neighbours; its sign is undetermined.
Vec3 normal_of(const std::vector<Vec3>& places, std::uint32_t self, const Neighbours& neighbours) {
  std::array<Vec3, kNormalNeighbours + 1> around{places[self]};
  std::size_t count = 1;
  for (const std::uint32_t i : neighbours)
    if (i != kNoNeighbour) around[count++] = places[i];
  return plane_through(std::span(around).first(count)).normal;
}

/// Orients the normals of each connected part consistently.
class NormalOrientation {
 public:
  NormalOrientation(PointCloud& cloud, const std::vector<Neighbours>& neighbours)
      : cloud_(cloud),
        neighbours_(neighbours),
        nearest_to_(cloud.places_m.size()),
        done_(nearest_to_.size()) {
    // The relation "is among the nearest" is not symmetric, so both directions are stored.
    for (std::uint32_t i = 0; i < neighbours_.size(); ++i)
      for (const std::uint32_t other : neighbours_[i])
        if (other != kNoNeighbour) nearest_to_[other].push_back(i);
  }

  void run() {
    for (std::uint32_t i = 0; i < done_.size(); ++i)
      if (!done_[i]) orient_part(i);
  }

 private:
  void orient_part(std::uint32_t first) {
    std::vector<std::uint32_t> part;
    waiting_.emplace(0.0, first, first);
    while (!waiting_.empty()) {
      const auto [bend, i, from] = waiting_.top();
      waiting_.pop();
      if (done_[i]) continue;
      done_[i] = true;
      part.push_back(i);
      Vec3& n = cloud_.normals[i];
      if (dot(n, cloud_.normals[from]) < 0.0) n = -n;
      for (const std::uint32_t other : neighbours_[i]) offer(i, other);
      for (const std::uint32_t other : nearest_to_[i]) offer(i, other);
    }
    if (!faces_out(part))
      for (const std::uint32_t i : part) cloud_.normals[i] = -cloud_.normals[i];
  }

  void offer(std::uint32_t from, std::uint32_t to) {
    if (to == kNoNeighbour || done_[to]) return;
    waiting_.emplace(1.0 - std::abs(dot(cloud_.normals[from], cloud_.normals[to])), to, from);
  }

  /// Whether most of a part's normals at its extreme points in 26 directions agree with the direction.
  bool faces_out(const std::vector<std::uint32_t>& part) const {
    double out = 0.0;
    for (int k = 0; k < 27; ++k) {
      if (k == 13) continue;
      const int row = k / 3 % 3, layer = k / 9;
      const Vec3 direction = unit({k % 3 - 1.0, row - 1.0, layer - 1.0});
      const auto farthest = std::max_element(part.begin(), part.end(), [&](std::uint32_t a, std::uint32_t b) {
        return dot(direction, cloud_.places_m[a]) < dot(direction, cloud_.places_m[b]);
      });
      out += dot(direction, cloud_.normals[*farthest]);
    }
    return out >= 0.0;
  }

  /// The angle's measure between two normals, the point, and the neighbour that determines its sign.
  using Step = std::tuple<double, std::uint32_t, std::uint32_t>;
  PointCloud& cloud_;
  const std::vector<Neighbours>& neighbours_;
  std::vector<std::vector<std::uint32_t>> nearest_to_;
  std::vector<bool> done_;
  std::priority_queue<Step, std::vector<Step>, std::greater<>> waiting_;
};

}  // namespace

Result<PointCloud> with_normals(PointCloud cloud, const Work& work) {
  if (cloud.places_m.size() < kFewestForNormals) return invalid_input("holds fewer than 16 points");
  for (const Vec3 p : cloud.places_m)
    if (!is_finite(p)) return invalid_input("holds a point that is not a finite number");
  const auto less = [](Vec3 a, Vec3 b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
  std::sort(cloud.places_m.begin(), cloud.places_m.end(), less);
  cloud.places_m.erase(std::unique(cloud.places_m.begin(), cloud.places_m.end()), cloud.places_m.end());
  const Vec3 size = bounds_of(cloud.places_m).size_m();
  const double longest_m = std::max({size.x, size.y, size.z});
  const double guess_m =
      std::max(2.0 * longest_m / std::sqrt(static_cast<double>(cloud.places_m.size())), 1e-12);
  work.report(0.0, "estimating normals");
  const PointIndex index(cloud.places_m, guess_m);
  std::vector<Neighbours> neighbours(cloud.places_m.size());
  cloud.normals.resize(cloud.places_m.size());
  parallel_for(work, static_cast<int>(neighbours.size()), 256, [&](int begin, int end) {
    for (int i = begin; i < end && !work.cancelled(); ++i) {
      const auto at = static_cast<std::size_t>(i);
      const auto self = static_cast<std::uint32_t>(i);
      neighbours[at] = nearest(index, cloud.places_m[at], self, 0.5 * guess_m, longest_m);
      cloud.normals[at] = normal_of(cloud.places_m, self, neighbours[at]);
    }
  });
  if (work.cancelled()) return Work::interrupted();
  NormalOrientation(cloud, neighbours).run();
  return cloud;
}

}  // namespace palpable::sculpt
