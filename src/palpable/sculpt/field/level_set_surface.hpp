// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/level_set.hpp"
#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"

namespace palpable::sculpt {

/// The zero surface of an interpolated level set: triangles facing outwards, metres. Parts that span less
/// than half a block may be missed. Long work: all threads, polls cancel. Errors: invalid_input for a level
/// set without a surface, with a surface through more than 10 million voxels, or longer than 2^19 voxels;
/// interrupted.
Result<Mesh> surface_of_level_set(const LevelSet& set, const Work& work);

}  // namespace palpable::sculpt
