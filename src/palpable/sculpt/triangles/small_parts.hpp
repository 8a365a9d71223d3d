// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"

namespace palpable::sculpt {

/// The mesh without its connected parts whose longest side is shorter than that share of the whole mesh's
/// longest side, 0 … 1: crumbs of noise around a measured surface, and bubbles within it. The order of the
/// remaining triangles and vertices stays. Without picture_places. Any thread.
Mesh without_small_parts(const Mesh& mesh, double least_share);

}  // namespace palpable::sculpt
