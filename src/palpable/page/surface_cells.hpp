// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"
#include "palpable/core/raster.hpp"
#include "palpable/models/scene/scene.hpp"

#include <optional>
#include <string>

namespace palpable::page {

/// The cells of an adaptively sampled field where its surface, seen from above, goes through them.
struct SurfaceCells {
  /// Covers the scene's rectangle, origin top-left: the finer the lighter, with lines round those that are
  /// large enough to be seen.
  Raster<Rgb8> picture;
  /// What the picture shows, as a sentence.
  std::string words;
};

/// Nothing for a scene that has no such cells.
std::optional<SurfaceCells> surface_cells(const models::Scene& scene);

}  // namespace palpable::page
