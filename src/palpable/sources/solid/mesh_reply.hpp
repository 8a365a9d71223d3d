// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/files/file_bytes.hpp"
#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

// Meshes in replies of the decoder process.
namespace palpable::sources::isolated {

std::vector<std::byte> reply_of(const Mesh& mesh);

/// Decodes and checks a reply: valid vertex indices, finite coordinates, the limit of triangles. Errors:
/// those in the reply; invalid_input for an invalid reply.
Result<Mesh> mesh_in(std::span<const std::byte> reply);

/// Runs sources::decode_mesh() for "obj", "stl" or "glb" in the decoder process.
Result<Mesh> decode_mesh(FileView file, const std::string& ending);

}  // namespace palpable::sources::isolated
