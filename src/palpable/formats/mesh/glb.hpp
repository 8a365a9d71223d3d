// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace palpable::formats {

/// glTF 2.0 binary in metres, y up and z towards the user, which is glTF's own frame. It has smooth
/// normals, and `picture` as its texture if that is not empty and the mesh has texture coordinates.
/// `colours`: empty, or the colour of each vertex (sRGB). `normals`: empty, or that of each vertex, where
/// those of the triangles around it are not meant (vertices doubled for the texture). Errors: failed for a
/// mesh without triangles.
Result<std::vector<std::byte>> encode_glb(const Mesh& mesh, const Raster<Rgb8>& picture = {},
                                          std::span<const Rgb8> colours = {},
                                          std::span<const Vec3> normals = {});

}  // namespace palpable::formats
