// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/coordinate_convention.hpp"
#include "palpable/core/mesh.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace palpable::sources {

struct MeshFile {
  Mesh mesh;
  CoordinateConvention convention;
};

/// Reads the triangles of an OBJ, PLY, STL or GLB file, all its parts in one, as they stand in the file's own
/// coordinates (axes and units as in the file, with what its format says of them); larger faces are cut into
/// triangles, lines and points left out. Errors: invalid_input, naming the file, for what cannot be read, has
/// no triangle, or has over 20 million.
Result<MeshFile> read_mesh(const std::filesystem::path& path);

/// The same in memory. All but PLY is parsed in the decoder process (isolated/isolated.hpp). `ending` names
/// the format ("obj", "ply", "stl", "glb"). Errors without a place.
Result<Mesh> decode_mesh(std::span<const std::byte> file, const std::string& ending);

/// What a format says: glTF (glb) has y up and metres; STL has z up, as 3D printers and CAD programs use it;
/// of OBJ and PLY, y up is the usual. Those three have no unit.
CoordinateConvention convention_of_format(const std::string& ending);

}  // namespace palpable::sources
