// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Queries of a tree of triangles: the nearest one, those that may be nearest in a ball, whether any is
// near.
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace palpable::sculpt {

namespace {

constexpr double kRounding = 1e-6;

/// A point t can be nearer than the found point q, for some point of the ball about c, only if their
/// bisecting plane cuts the ball: |t - c|^2 - |q - c|^2 <= 2 r |t - q|.
struct CloserTest {
  std::array<float, 3> centre, found;
  double squared_m2, radius_m;

  /// Calls visit(lane, squared distance from the centre) for the boxes that may hold such a place.
  template <class Visit>
  void visit(const FourBoxes& boxes, const Visit& visit) const {
    const FourBoxes::Distances squared = boxes.squared_distances(centre),
                               reach = boxes.squared_reaches(found);
    const double most = 2.0 * (1.0 + kRounding) * radius_m;
    for (std::size_t lane = 0; lane < FourBoxes::kCount; ++lane) {
      const double beyond = (1.0 - kRounding) * static_cast<double>(squared[lane]) - squared_m2;
      if (beyond <= 0.0 || beyond * beyond <= most * most * static_cast<double>(reach[lane]))
        visit(lane, squared[lane]);
    }
  }
};

/// Candidate leaves of a list, and the distances of the nearest and the farthest.
struct Leaves {
  struct Leaf {
    float squared;
    std::uint32_t node;
    const FourBoxes* boxes;
    std::size_t lane;
  };
  std::array<Leaf, TriangleShortlist::kMost> leaf;
  std::size_t count = 0;
  bool too_many = false;
  float least2 = std::numeric_limits<float>::infinity(), most2 = 0.0F;

  void add(const Leaf& next) {
    too_many = count == leaf.size();
    if (too_many) return;
    leaf[count++] = next;
    least2 = std::min(least2, next.squared);
    most2 = std::max(most2, next.squared);
  }
};

/// A bucket sort: an approximate order is enough.
void put_nearest_first(const Leaves& found, TriangleShortlist& list) {
  constexpr std::size_t kSteps = 32;
  const float per_step = static_cast<float>(kSteps) / (found.most2 - found.least2);
  const auto step_of = [&](const Leaves::Leaf& leaf) {
    const float steps = per_step * (leaf.squared - found.least2);
    // NaN if all distances are equal.
    return steps < static_cast<float>(kSteps) ? static_cast<std::size_t>(steps) : kSteps - 1;
  };
  std::array<std::size_t, kSteps + 1> begin{};
  for (std::size_t i = 0; i < found.count; ++i) ++begin[step_of(found.leaf[i]) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  list.fours.resize((found.count + FourBoxes::kCount - 1) / FourBoxes::kCount);
  std::array<float, TriangleShortlist::kMost> squared_from;
  for (std::size_t i = 0; i < found.count; ++i) {
    const Leaves::Leaf& leaf = found.leaf[i];
    const std::size_t rank = begin[step_of(leaf)]++, lane = rank % FourBoxes::kCount;
    TriangleShortlist::Four& four = list.fours[rank / FourBoxes::kCount];
    four.boxes.set(lane, *leaf.boxes, leaf.lane);
    four.node[lane] = leaf.node;
    squared_from[rank] = leaf.squared;
  }
  float after = std::numeric_limits<float>::infinity();
  for (std::size_t rank = found.count; rank-- > 0;) {
    after = std::min(after, squared_from[rank]);
    if (rank % FourBoxes::kCount == 0)
      list.fours[rank / FourBoxes::kCount].from_m = std::sqrt(static_cast<double>(after)) * (1.0 - kRounding);
  }
}

}  // namespace

NearestTriangle nearest_on_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  using enum TrianglePart;
  const auto found = [&](Vec3 q, TrianglePart part) {
    return NearestTriangle{q, squared_norm(p - q), 0, part};
  };
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return found(a, corner_0);
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return found(b, corner_1);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return found(a + (d1 / (d1 - d3)) * ab, edge_01);
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return found(c, corner_2);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return found(a + (d2 / (d2 - d6)) * ac, edge_20);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0)
    return found(b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b), edge_12);
  const double inverse = 1.0 / (va + vb + vc);
  return found(a + (vb * inverse) * ab + (vc * inverse) * ac, face);
}

NearestTriangle TriangleTree::measured(Vec3 p, std::uint32_t place) const {
  const Corners& c = corners_[place];
  NearestTriangle found = nearest_on_triangle(p, c[0], c[1], c[2]);
  found.triangle = order_[place];
  return found;
}

void TriangleTree::try_leaf(Vec3 p, const std::array<float, 3>& place, std::uint32_t node,
                            NearestTriangle& best) const {
  const Node& leaf = nodes_[node];
  const FourTriangles::Distances squared = leaves_[leaf.leaf].squared_distances(place);
  const double most_m = std::sqrt(best.squared_distance_m2) + rounding_m_;
  const double most_m2 = most_m * most_m;
  for (std::uint32_t i = 0; i < leaf.count; ++i) {
    if (static_cast<double>(squared[i]) > most_m2) continue;
    const NearestTriangle found = measured(p, leaf.first + i);
    if (found.squared_distance_m2 < best.squared_distance_m2) best = found;
  }
}

NearestTriangle TriangleTree::nearest(Vec3 p, std::uint32_t guess) const {
  NearestTriangle best = measured(p, place_[guess]);
  const std::array<float, 3> place = from_origin(p);
  struct Entry {
    std::uint32_t node, below;
    float squared;
  };
  std::array<Entry, FourBoxes::kCount * kStack> stack;
  std::size_t size = 0;
  stack[size++] = {0, 0, 0.0F};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (static_cast<double>(entry.squared) >= kShare * best.squared_distance_m2) continue;
    if (entry.below == kNone) {
      try_leaf(p, place, entry.node, best);
      continue;
    }
    const Four& four = fours_[entry.below];
    const FourBoxes::Distances squared = four.boxes.squared_distances(place);
    // The nearest is pushed last and so visited first.
    const std::size_t first = size;
    for (std::size_t lane = 0; lane < FourBoxes::kCount; ++lane) {
      if (!(static_cast<double>(squared[lane]) < kShare * best.squared_distance_m2)) continue;
      std::size_t at = size++;
      for (; at > first && stack[at - 1].squared < squared[lane]; --at) stack[at] = stack[at - 1];
      stack[at] = {four.node[lane], four.below[lane], squared[lane]};
    }
  }
  return best;
}

NearestTriangle TriangleTree::nearest(Vec3 p, std::uint32_t guess, const TriangleShortlist& among) const {
  if (among.is_whole) return nearest(p, guess);
  NearestTriangle best = measured(p, place_[guess]);
  const std::array<float, 3> place = from_origin(p);
  const double off_centre_m = norm(p - among.centre_m);
  for (const TriangleShortlist::Four& four : among.fours) {
    const double least_m = four.from_m - off_centre_m;
    if (least_m > 0.0 && least_m * least_m > best.squared_distance_m2) break;
    const FourBoxes::Distances squared = four.boxes.squared_distances(place);
    for (std::size_t lane = 0; lane < FourBoxes::kCount; ++lane)
      if (static_cast<double>(squared[lane]) < kShare * best.squared_distance_m2)
        try_leaf(p, place, four.node[lane], best);
  }
  return best;
}

void TriangleTree::list_near(Vec3 centre, double radius_m, std::uint32_t guess,
                             const TriangleShortlist* within, TriangleShortlist& list) const {
  list.centre_m = centre;
  list.fours.clear();
  const bool listed = within != nullptr && !within->is_whole;
  const NearestTriangle near = listed ? nearest(centre, guess, *within) : nearest(centre, guess);
  const CloserTest rival{from_origin(centre), from_origin(near.point_m), near.squared_distance_m2, radius_m};
  Leaves found;
  if (listed) {
    for (const TriangleShortlist::Four& four : within->fours)
      rival.visit(four.boxes, [&](std::size_t lane, float squared) {
        found.add({squared, four.node[lane], &four.boxes, lane});
      });
  } else {
    std::array<std::uint32_t, FourBoxes::kCount * kStack> stack;
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0 && !found.too_many) {
      const Four& four = fours_[stack[--size]];
      rival.visit(four.boxes, [&](std::size_t lane, float squared) {
        if (four.below[lane] == kNone)
          found.add({squared, four.node[lane], &four.boxes, lane});
        else
          stack[size++] = four.below[lane];
      });
    }
  }
  list.is_whole = found.too_many;
  if (!list.is_whole && found.count > 0) put_nearest_first(found, list);
}

bool TriangleTree::any_within(Vec3 p, double radius_m, std::uint32_t except) const {
  const double radius2 = radius_m * radius_m;
  const std::array<float, 3> place = from_origin(p);
  std::array<std::uint32_t, FourBoxes::kCount * kStack> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const Four& four = fours_[stack[--size]];
    const FourBoxes::Distances squared = four.boxes.squared_distances(place);
    for (std::size_t lane = 0; lane < FourBoxes::kCount; ++lane) {
      if (static_cast<double>(squared[lane]) > radius2) continue;
      if (four.below[lane] != kNone) {
        stack[size++] = four.below[lane];
        continue;
      }
      if (four.node[lane] == kNone) continue;
      const Node& node = nodes_[four.node[lane]];
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        if (order_[i] != except && measured(p, i).squared_distance_m2 <= radius2) return true;
    }
  }
  return false;
}

}  // namespace palpable::sculpt
