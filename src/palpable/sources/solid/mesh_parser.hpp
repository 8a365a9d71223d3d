// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <span>
#include <string>

namespace palpable::sources {

/// Parses an OBJ, STL or GLB file with Assimp in this process: only for the decoder process, which is
/// sandboxed (docs/adr/0007-foreign-parsers-in-a-child.md). All others call decode_mesh() (mesh_file.hpp),
/// which uses that process. `ending` is "obj", "stl" or "glb". Errors as decode_mesh().
Result<Mesh> parse_mesh(std::span<const std::byte> file, const std::string& ending);

}  // namespace palpable::sources
