// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/recipes/solid/solid.hpp"

#include <string>

namespace palpable::recipes {

/// The solid with the surface that the recipe asks for (SolidSurface), with a note on its errors. A solid
/// that already consists of superquadrics stays as it is. Long work. Errors: as predicted_solid() and
/// enclose().
Result<Solid> with_surface(Solid solid, FieldRecipe recipe, const Work& work);

/// The scene of a solid with that surface: "field of INPUT, …". Errors: also as stored_field().
Result<MadeScene> field_scene(Solid given, const std::string& input, const FieldRecipe& recipe,
                              const Work& work);

}  // namespace palpable::recipes
