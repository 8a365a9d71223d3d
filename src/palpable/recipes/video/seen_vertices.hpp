// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/recipes/video/video_colours.hpp"

#include <span>
#include <vector>

// Inside recipes' sources only.
namespace palpable::recipes {

/// Where a frame shows a vertex, px.
struct SeenVertex {
  double x = 0.0, y = 0.0;
  /// Cosine between the normal and the line of sight; 0 = the frame does not show it.
  double facing = 0.0;

  bool seen() const { return facing > 0; }
};

/// For each vertex of a mesh in the scene's frame. `normals`: of its vertices.
std::vector<SeenVertex> seen_vertices(const Mesh& mesh, std::span<const Vec3> normals,
                                      const VideoReconstruction& video,
                                      const VideoReconstruction::Depth& view,
                                      const VideoColourOptions& options);

}  // namespace palpable::recipes
