// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/recipes/video/video_colours.hpp"

#include <vector>

namespace palpable::recipes {

/// A mesh with its texture.
struct TexturedMesh {
  /// With picture_places. Vertices where the parts of the texture meet occur once for each part.
  Mesh mesh;
  /// Unit normals of its vertices: those of the given mesh, so that seams are not seen in the shading.
  std::vector<Vec3> normals;
  Raster<Rgb8> picture;
};

/// The surface of a scene with the frames of its depth maps as its texture. Each triangle shows the frame in
/// which it is largest, or that of its neighbours where this one shows it too. Frames are brought to one
/// brightness, and the parts of them that are used become one picture. Triangles that no frame shows get the
/// plain colours of colours_of(). `mesh`: in the scene's frame, with triangles.
TexturedMesh textured(const Mesh& mesh, const VideoReconstruction& video, const VideoColourOptions& options);

}  // namespace palpable::recipes
