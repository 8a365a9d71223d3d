// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/models/scene/scene.hpp"

#include <optional>
#include <string>

namespace palpable::page {

/// The cells of an adaptively sampled field at its surface, seen from above.
struct SurfaceCells {
  /// Covers the scene's rectangle, origin top-left. Finer cells are lighter; cells that are large enough are
  /// outlined.
  Raster<Rgb8> picture;
  /// What the picture shows, as a sentence.
  std::string words;
};

/// nullopt for a scene without such cells.
std::optional<SurfaceCells> surface_cells(const models::Scene& scene);

}  // namespace palpable::page
