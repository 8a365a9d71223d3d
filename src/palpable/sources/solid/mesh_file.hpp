// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/files/file_bytes.hpp"
#include "palpable/core/geometry/coordinate_convention.hpp"
#include "palpable/core/geometry/mesh.hpp"
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

/// Reads the triangles of an OBJ, PLY, STL or GLB file, with all its parts merged, in the file's own
/// coordinates (axes and units as in the file, with the conventions of its format). Larger faces are split
/// into triangles; lines and points are omitted. Errors: invalid_input, naming the file, for an unreadable
/// file, one without triangles, or with more than 20 million.
Result<MeshFile> read_mesh(const std::filesystem::path& path);

/// The same in memory. All but PLY is parsed in the decoder process (isolated/isolated.hpp). `ending` names
/// the format ("obj", "ply", "stl", "glb"). Errors without a place.
Result<Mesh> decode_mesh(FileView file, const std::string& ending);

/// The coordinate convention of a format: glTF (glb) has y up and metres; STL has z up, as in 3D printing and
/// CAD; OBJ and PLY usually have y up. These three have no unit.
CoordinateConvention convention_of_format(const std::string& ending);

}  // namespace palpable::sources
