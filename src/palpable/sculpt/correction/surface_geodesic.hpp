// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sculpt/correction/surface_correction.hpp"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace palpable::sculpt {

/// The samples of a closed surface and the edges between them, metres.
struct SampleNetwork {
  struct Edge {
    std::uint32_t to = 0;
    double length_m = 0.0;
  };
  /// Unit normals, outwards: the mean over the triangles around a sample, weighted by area.
  std::vector<Vec3> normals;
  /// Sample i's neighbours are edges[begin[i]] ... edges[begin[i + 1] - 1].
  std::vector<std::uint32_t> begin;
  std::vector<Edge> edges;

  std::span<const Edge> from(std::uint32_t i) const {
    return {edges.data() + begin[i], begin[i + 1] - begin[i]};
  }
};

/// Of a closed mesh.
SampleNetwork network_of(const Mesh& mesh);

/// The samples within a geodesic distance of one of them, by a search along the mesh's edges. Edges zigzag,
/// so the length of a path only bounds the search. The distance itself is the length of an arc over the
/// chord, whose angle follows from both normals; it is exact on a sphere.
class Geodesic {
 public:
  /// `surface` must outlive it. Paths are at most `longest_path` times as long as the radius, 1 or more.
  Geodesic(const CorrectedSurface& surface, double longest_path)
      : longest_path_(longest_path),
        places_m_(surface.predicted.vertices_m),
        network_(*surface.network),
        path_m_(places_m_.size(), kFar) {}

  /// Calls visit(sample) for samples that may be within the radius; distance_m() gives the exact distance.
  template <class Visit>
  void around(std::uint32_t from, double radius_m, Visit&& visit) {
    spread({&from, 1}, radius_m);
    for (const std::uint32_t i : seen_)
      if (squared_norm(places_m_[from] - places_m_[i]) < radius_m * radius_m) visit(i);
    clear();
  }

  /// The same for samples that may be within the radius of one of several, each once, by one search.
  template <class Visit>
  void around_all(std::span<const std::uint32_t> from, double radius_m, Visit&& visit) {
    spread(from, radius_m);
    for (const std::uint32_t i : seen_) visit(i);
    clear();
  }

  /// Length of the arc between two samples, m.
  double distance_m(std::uint32_t a, std::uint32_t b) const;

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();

  void spread(std::span<const std::uint32_t> from, double radius_m) {
    const auto reach = [&](std::uint32_t i, double path_m) {
      if (!(path_m < path_m_[i]) || path_m > longest_path_ * radius_m) return;
      if (path_m_[i] == kFar) seen_.push_back(i);
      path_m_[i] = path_m;
      open_.push_back({i, path_m});
    };
    for (const std::uint32_t i : from) reach(i, 0.0);
    // Edges have similar lengths, so a queue in order of arrival visits few samples twice.
    for (std::size_t k = 0; k < open_.size(); ++k) {
      const SampleNetwork::Edge here = open_[k];
      if (here.length_m > path_m_[here.to]) continue;
      for (const SampleNetwork::Edge& edge : network_.from(here.to))
        reach(edge.to, here.length_m + edge.length_m);
    }
  }
  void clear() {
    for (const std::uint32_t i : seen_) path_m_[i] = kFar;
    seen_.clear();
    open_.clear();
  }

  double longest_path_;
  const std::vector<Vec3>& places_m_;
  const SampleNetwork& network_;
  std::vector<double> path_m_;
  std::vector<std::uint32_t> seen_;
  std::vector<SampleNetwork::Edge> open_;
};

}  // namespace palpable::sculpt
