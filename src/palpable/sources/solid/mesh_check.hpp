// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace palpable::sources {

/// Checks that a mesh file is complete, as far as its format allows. Binary STL has the stated number of
/// triangles; in text STL all facets and the solid are closed; the last line of an OBJ is complete, and its
/// faces refer to existing vertices; a GLB has the stated length. `ending`: "stl", "obj", "glb"; other
/// formats pass. Errors: invalid_input.
Result<void> check_mesh_file(std::span<const std::byte> file, const std::string& ending);

/// The size in bytes of a binary STL with the stated number of triangles; 0 for a file that is too short.
std::size_t stated_stl_bytes(std::span<const std::byte> file);

/// Whether the name ends in .stl, in any case.
bool is_named_stl(const std::filesystem::path& path);

}  // namespace palpable::sources
