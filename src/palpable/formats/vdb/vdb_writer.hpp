// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/level_set.hpp"

#include <string>

namespace palpable::formats {

/// The function in the module palpable-vdb-writer.so, which alone links OpenVDB: its library has 69 000
/// symbols to be looked up at a start, so it is loaded only where a file is written. Gives the bytes of a
/// file with this level set, whose steps are equal and along the axes; voxels that have the background's
/// magnitude are written as inactive. Takes the blocks. Throws std::exception for OpenVDB's own errors.
using WriteLevelSet = void(LevelSet& level_set, std::string& bytes);
/// Its name in the module.
inline constexpr const char* kWriteLevelSet = "palpable_write_level_set";

}  // namespace palpable::formats
