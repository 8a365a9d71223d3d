// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/surface_distances.hpp"

#include "palpable/sculpt/solid/superquadric_source.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace palpable::recipes {
namespace {

constexpr int kPointsAtOnce = 64;

}  // namespace

std::vector<double> distances_from(std::span<const Vec3> points, const Mesh& surface, const Work& work) {
  const sculpt::TriangleTree tree(surface);
  std::vector<double> distances(points.size());
  parallel_for(work, static_cast<int>(points.size()), kPointsAtOnce, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      distances[i] = std::sqrt(tree.nearest(points[i], 0).squared_distance_m2);
  });
  return distances;
}

Result<std::vector<double>> distances_from(std::span<const Vec3> points,
                                           std::span<const models::Superquadric> shapes, const Work& work) {
  const auto source = sculpt::distance_of(shapes);
  if (!source) return source.error();
  std::vector<double> distances(points.size());
  parallel_for(work, static_cast<int>(points.size()), kPointsAtOnce, [&](int begin, int end) {
    sculpt::DistanceSource::Hint hint;
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      distances[i] = std::abs((*source)->at(points[i], hint).distance_m);
  });
  return distances;
}

double mean_distance(std::span<const double> distances, double most) {
  double sum = 0.0;
  for (const double d : distances) sum += std::min(d, most);
  return distances.empty() ? 0.0 : sum / static_cast<double>(distances.size());
}

}  // namespace palpable::recipes
