// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace palpable::sources {

/// Reads the triangles of an OBJ, PLY, STL or GLB file, all its parts in one, as they stand in the file's own
/// coordinates (metres; axes as in the file); larger faces are cut into triangles, lines and points left out.
/// Errors: invalid_input, naming the file, for what cannot be read, has no triangle, or has over 20 million.
Result<Mesh> read_mesh(const std::filesystem::path& path);

/// The same in memory; `ending` names the format ("obj", "ply", "stl", "glb"). Errors without a place.
Result<Mesh> decode_mesh(std::span<const std::byte> file, const std::string& ending);

}  // namespace palpable::sources
