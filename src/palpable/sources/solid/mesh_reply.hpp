// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

// Meshes as the decoder process replies with them.
namespace palpable::sources::isolated {

std::vector<std::byte> reply_of(const Mesh& mesh);

/// What a reply says, checked: corners that are vertices, coordinates that are finite, no more triangles than
/// are read. Errors: the reply's own; invalid_input for one that is not what it should be.
Result<Mesh> mesh_in(std::span<const std::byte> reply);

/// sources::decode_mesh() of an "obj", "stl" or "glb", run in the decoder process.
Result<Mesh> decode_mesh(std::span<const std::byte> file, const std::string& ending);

}  // namespace palpable::sources::isolated
