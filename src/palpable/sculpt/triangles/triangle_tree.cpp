// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include "palpable/core/check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace palpable::sculpt {
namespace {

constexpr std::uint32_t kLeafTriangles = FourTriangles::kCount;

Vec3 smaller(Vec3 a, Vec3 b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3 larger(Vec3 a, Vec3 b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

}  // namespace

TriangleTree::TriangleTree(const Mesh& mesh) {
  PALPABLE_CHECK(!mesh.triangles.empty());
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  corners_.reserve(count);
  std::vector<Vec3> centres;
  centres.reserve(count);
  for (const auto& t : mesh.triangles) {
    corners_.push_back({mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]});
    const Corners& c = corners_.back();
    centres.push_back((smaller(c[0], smaller(c[1], c[2])) + larger(c[0], larger(c[1], c[2]))) / 2.0);
  }
  order_.resize(count);
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.reserve(count);
  build(0, count, centres);
  std::vector<Corners> sorted(count);
  place_.resize(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    sorted[i] = corners_[order_[i]];
    place_[order_[i]] = i;
  }
  corners_ = std::move(sorted);
  dipoles_.resize(nodes_.size());
  // Children come after their parents.
  for (auto i = static_cast<std::uint32_t>(nodes_.size()); i-- > 0;) bound(i);
  origin_m_ = 0.5 * (nodes_[0].low + nodes_[0].high);
  rounding_m_ = rounding_m();
  for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].right != 0) continue;
    nodes_[i].leaf = static_cast<std::uint32_t>(leaves_.size());
    leaves_.emplace_back();
    set_leaf(i);
  }
  lane_of_.assign(nodes_.size(), kNone);
  gather(0);
}

std::uint32_t TriangleTree::gather(std::uint32_t at) {
  const auto four = static_cast<std::uint32_t>(fours_.size());
  fours_.emplace_back();
  std::array<std::uint32_t, FourBoxes::kCount> members{};
  std::size_t count = 0;
  const auto add_parts = [&](std::uint32_t node, auto&& add) {
    if (nodes_[node].right == 0) return add(node);
    add(node + 1);
    add(nodes_[node].right);
  };
  const auto add_one = [&](std::uint32_t node) { members[count++] = node; };
  add_parts(at, [&](std::uint32_t child) { child == at ? add_one(child) : add_parts(child, add_one); });
  fours_[four].node.fill(kNone);
  for (std::size_t lane = 0; lane < count; ++lane) {
    const std::uint32_t node = members[lane];
    fours_[four].node[lane] = node;
    lane_of_[node] = static_cast<std::uint32_t>(FourBoxes::kCount * four + lane);
    put_into_four(node);
    const std::uint32_t below = nodes_[node].right == 0 ? kNone : gather(node);
    fours_[four].below[lane] = below;
  }
  return four;
}

OrientedBox TriangleTree::oriented_box(const Node& node, Vec3 area_m2) const {
  OrientedBox box;
  box.axes = {Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}};
  const Vec3 low = node.low - origin_m_, high = node.high - origin_m_;
  box.low = {low.x, low.y, low.z};
  box.high = {high.x, high.y, high.z};
  constexpr std::uint32_t kFew = 1024;
  const double size = norm(area_m2);
  if (node.count > kFew || !(size > 0.0)) return box;
  const Vec3 n = area_m2 / size;
  const Vec3 least = std::abs(n.x) <= std::min(std::abs(n.y), std::abs(n.z)) ? box.axes[0]
                     : std::abs(n.y) <= std::abs(n.z)                        ? box.axes[1]
                                                                             : box.axes[2];
  const Vec3 across = unit(cross(n, least));
  box.axes = {n, across, cross(n, across)};
  box.low.fill(std::numeric_limits<double>::infinity());
  box.high.fill(-std::numeric_limits<double>::infinity());
  for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
    for (const Vec3 corner : corners_[i])
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double along = dot(box.axes[axis], corner - origin_m_);
        box.low[axis] = std::min(box.low[axis], along);
        box.high[axis] = std::max(box.high[axis], along);
      }
  return box;
}

void TriangleTree::put_into_four(std::uint32_t at) {
  const std::uint32_t lane = lane_of_[at];
  if (lane == kNone) return;
  // From this multiple of its radius on, a group's dipole replaces it.
  constexpr double kFarRadii = 2.5;
  Four& four = fours_[lane / FourBoxes::kCount];
  const Dipole& dipole = dipoles_[at];
  four.boxes.set(lane % FourBoxes::kCount, oriented_box(nodes_[at], dipole.area_m2), rounding_m_);
  four.dipoles.set(lane % FourBoxes::kCount, dipole.area_m2, dipole.centre_m - origin_m_,
                   kFarRadii * dipole.radius_m + rounding_m_);
}

void TriangleTree::set_leaf(std::uint32_t at) {
  const Node& node = nodes_[at];
  for (std::uint32_t i = 0; i < FourTriangles::kCount; ++i) {
    // Missing triangles repeat the first one.
    const Corners& c = corners_[node.first + (i < node.count ? i : 0)];
    leaves_[node.leaf].set(i, {c[0] - origin_m_, c[1] - origin_m_, c[2] - origin_m_});
  }
}

void TriangleTree::move(const Mesh& mesh, std::span<const std::uint32_t> triangles) {
  std::vector<std::uint32_t> places;
  places.reserve(triangles.size());
  for (const std::uint32_t i : triangles) {
    const auto& t = mesh.triangles[i];
    corners_[place_[i]] = {mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]]};
    places.push_back(place_[i]);
  }
  std::sort(places.begin(), places.end());
  if (!places.empty()) bound_over(0, places);
  rounding_m_ = rounding_m();
}

double TriangleTree::rounding_m() const {
  // Rounding errors of coordinates, of the query point and of the sums: a few units in the last place.
  constexpr double kDigits = 1e-6;
  return kDigits * norm(larger(nodes_[0].high - origin_m_, origin_m_ - nodes_[0].low));
}

void TriangleTree::bound_over(std::uint32_t at, std::span<const std::uint32_t> places) {
  if (const std::uint32_t right = nodes_[at].right; right != 0) {
    const auto middle = static_cast<std::size_t>(
        std::lower_bound(places.begin(), places.end(), nodes_[right].first) - places.begin());
    if (middle > 0) bound_over(at + 1, places.first(middle));
    if (middle < places.size()) bound_over(right, places.subspan(middle));
  }
  bound(at);
  if (nodes_[at].right == 0) set_leaf(at);
  put_into_four(at);
}

void TriangleTree::bound(std::uint32_t at) {
  bound_box(at);
  bound_dipole(at);
}

std::uint32_t TriangleTree::build(std::uint32_t first, std::uint32_t count,
                                  const std::vector<Vec3>& centres) {
  const auto at = static_cast<std::uint32_t>(nodes_.size());
  Node node;
  node.first = first;
  node.count = count;
  nodes_.push_back(node);
  if (count <= kLeafTriangles) return at;
  Vec3 low = centres[order_[first]], high = low;
  for (std::uint32_t i = first; i < first + count; ++i) {
    low = smaller(low, centres[order_[i]]);
    high = larger(high, centres[order_[i]]);
  }
  const Vec3 size = high - low;
  const auto key = [&](std::uint32_t t) {
    const Vec3 c = centres[t];
    return size.x >= size.y && size.x >= size.z ? c.x : size.y >= size.z ? c.y : c.z;
  };
  const std::uint32_t half = count / 2;
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + half, begin + count,
                   [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  build(first, half, centres);
  nodes_[at].right = build(first + half, count - half, centres);
  return at;
}

void TriangleTree::bound_box(std::uint32_t at) {
  Node& node = nodes_[at];
  if (node.right != 0) {
    node.low = smaller(nodes_[at + 1].low, nodes_[node.right].low);
    node.high = larger(nodes_[at + 1].high, nodes_[node.right].high);
    return;
  }
  node.low = node.high = corners_[node.first][0];
  for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
    for (const Vec3 corner : corners_[i]) {
      node.low = smaller(node.low, corner);
      node.high = larger(node.high, corner);
    }
}

void TriangleTree::bound_dipole(std::uint32_t at) {
  const Node& n = nodes_[at];
  Dipole dipole;
  const auto add = [&](Vec3 area_m2, double size_m2, Vec3 centre_m) {
    dipole.area_m2 += area_m2;
    dipole.size_m2 += size_m2;
    dipole.centre_m += size_m2 * centre_m;
  };
  if (n.right != 0) {
    for (const std::uint32_t child : {at + 1, n.right})
      add(dipoles_[child].area_m2, dipoles_[child].size_m2, dipoles_[child].centre_m);
  } else {
    for (std::uint32_t i = n.first; i < n.first + n.count; ++i) {
      const Corners& c = corners_[i];
      const Vec3 area = 0.5 * cross(c[1] - c[0], c[2] - c[0]);
      add(area, norm(area), (c[0] + c[1] + c[2]) / 3.0);
    }
  }
  dipole.centre_m = dipole.size_m2 > 0.0 ? dipole.centre_m / dipole.size_m2 : (n.low + n.high) / 2.0;
  dipole.radius_m = norm(larger(n.high - dipole.centre_m, dipole.centre_m - n.low));
  dipoles_[at] = dipole;
}

}  // namespace palpable::sculpt
