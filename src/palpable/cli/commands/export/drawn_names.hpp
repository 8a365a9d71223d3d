// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/cli/commands/export/sheet_files.hpp"
#include "palpable/models/scene/scene.hpp"

namespace palpable::cli {

/// Adds keys for the names of a scene to its drawing, and their lines to its key: names that persons gave,
/// and, but for contours, regions with a name of their own. What the program only counted ("line 3") has
/// none.
void add_names(const models::Scene& scene, KeyedDrawing& drawing);

/// Adds keys for the names that persons gave to a drawing that has keys already, of a map's streets: each key
/// is another one than those.
void add_written_names(const models::Scene& scene, KeyedDrawing& drawing);

}  // namespace palpable::cli
