// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <vector>

namespace palpable::formats {

/// Binary STL in millimetres, as printing programs expect it. Errors: failed for a mesh without triangles or
/// with more than 50 million.
Result<std::vector<std::byte>> encode_stl(const Mesh& mesh);

}  // namespace palpable::formats
