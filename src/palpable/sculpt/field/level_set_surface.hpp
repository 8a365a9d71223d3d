// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/level_set.hpp"
#include "palpable/core/mesh.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"

namespace palpable::sculpt {

/// The surface where a level set, interpolated between its places, is 0: triangles facing outwards, metres.
/// Parts that span less than half a block may be missed. Long work: all threads, polls cancel. Errors:
/// invalid_input for a level set without a surface, one whose surface passes over 10 million voxels, or one
/// over 2^19 voxels long; interrupted.
Result<Mesh> surface_of_level_set(const LevelSet& set, const Work& work);

}  // namespace palpable::sculpt
