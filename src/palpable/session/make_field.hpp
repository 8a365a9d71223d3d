// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/session/make_scene.hpp"

#include <filesystem>

namespace palpable::session {

/// A distance field of a mesh file. With options.relief.size_m the mesh is scaled into that box, its lowest
/// point at z = 0 and its middle over the origin; else it keeps its metres and origin. Errors: as
/// make_scene().
Result<MadeScene> field_from_mesh_file(const MakeOptions& options, const std::filesystem::path& file,
                                       const Work& work);

}  // namespace palpable::session
