// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace palpable::sources {

/// Whether a file of triangles is whole, as far as its format tells: an STL has the number of triangles that
/// it states (binary), or its facets and itself are ended (text); an OBJ's last line is a whole one, and its
/// faces name vertices that there are; a GLB has the length that it states. `ending`: "stl", "obj", "glb";
/// other formats pass. Errors: invalid_input.
Result<void> check_mesh_file(std::span<const std::byte> file, const std::string& ending);

/// The bytes of a binary STL that holds the number of triangles which this one states; 0 for what is too
/// short to be one.
std::size_t stated_stl_bytes(std::span<const std::byte> file);

/// Whether the name ends in .stl, in any case.
bool is_named_stl(const std::filesystem::path& path);

}  // namespace palpable::sources
